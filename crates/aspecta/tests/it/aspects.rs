//! Generalized aspects: the paper's Table 2 under every change that must not matter, brute force in coordinates in which it
//! can be trusted, limits, determinism.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectId, ClassId, DetSign, Options, Place, Reachable, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::num::Interval;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Actuator, Leg, Platform, Revolute, Robot, catalogue};
use std::collections::{BTreeMap, HashSet, VecDeque};
use std::f64::consts::{PI, TAU};

fn analyzed(robot: &Robot, depth: u32) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    analyze(robot, &Options { budget, ..Options::default() }, &Control::unwatched()).unwrap()
}

fn five_bar() -> Robot {
    catalogue::find("five-bar").unwrap()
}

/// Depth at which the five-bar's ten aspects are apart.
const APART: u32 = 9;

/// Table 2: modes in the order of Table 1 (++, +-, --, -+), det A > 0, then < 0.
const TABLE_2: [[usize; 4]; 2] = [[1, 1, 1, 2], [1, 2, 1, 1]];

fn counts(analysis: &Analysis) -> BTreeMap<(String, i8), usize> {
    analysis.classes.iter().map(|c| ((c.mode.to_string(), c.det_a.factor()), c.low)).collect()
}

/// Table 2 with the signs of modes and of det A changed by `change`.
fn table_2(change: impl Fn([i8; 2], i8) -> ([i8; 2], i8)) -> BTreeMap<(String, i8), usize> {
    let modes = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
    let mut table = BTreeMap::new();
    for (sign, row) in [1, -1].into_iter().zip(TABLE_2) {
        for (mode, count) in modes.into_iter().zip(row) {
            let (mode, sign) = change(mode, sign);
            let mode = WorkingMode::from_signs(mode.map(|s| s > 0));
            table.insert((mode.to_string(), sign), count);
        }
    }
    table
}

fn total_measure(analysis: &Analysis) -> f64 {
    analysis.classes.iter().map(|c| c.measure).sum()
}

/// Samples lie where their aspects say, by the Jacobians at (X, q).
fn check_samples(analysis: &Analysis) {
    for class in &analysis.classes {
        assert_eq!(class.aspects.len(), class.low);
        for aspect in &class.aspects {
            let j = analysis.robot.jacobians(&aspect.sample.pose, &aspect.sample.q).unwrap();
            assert!(j.residual < 1e-12, "{}", j.residual);
            assert_eq!(j.mode(), class.mode);
            assert_eq!(j.det_a() > 0.0, class.det_a == DetSign::Positive);
            assert!(aspect.measure > 0.0);
        }
        let sum: f64 = class.aspects.iter().map(|a| a.measure).sum();
        assert!((sum - class.measure).abs() <= 1e-9 * sum);
    }
}

#[test]
fn table_2_of_the_paper() {
    let analysis = analyzed(&five_bar(), APART);
    let order: Vec<_> = analysis.modes.iter().map(|m| m.mode.to_string()).collect();
    assert_eq!(order, ["++", "+-", "--", "-+"]);
    assert_eq!(counts(&analysis), table_2(|mode, sign| (mode, sign)));
    assert_eq!(analysis.aspects.low, 10);
    check_samples(&analysis);
    // The robot is its own image in the x axis, which swaps (s, σ) and (−s, −σ).
    for class in &analysis.classes {
        let image =
            analysis.classes.iter().find(|c| c.det_a != class.det_a && opposite(c.mode, class.mode)).unwrap();
        assert!((image.measure / class.measure - 1.0).abs() < 0.01, "{} {}", image.measure, class.measure);
    }
    assert!(analysis.modes.iter().all(|m| m.reachable == Reachable::Yes && m.sample.is_some()));
    // No two aspects have the same number.
    let mut ids: Vec<_> = analysis.classes.iter().flat_map(|c| c.aspects.iter().map(|a| a.id)).collect();
    ids.sort_unstable();
    assert!(ids.into_iter().eq((1..=10).map(AspectId::new)));
}

fn opposite(a: WorkingMode, b: WorkingMode) -> bool {
    a.signs().zip(b.signs()).all(|(a, b)| a == -b)
}

/// A lower bound stays one at every depth: ten are not found before they are there, and never more.
#[test]
fn the_count_never_exceeds_ten() {
    for depth in 1..=10 {
        let low = analyzed(&five_bar(), depth).aspects.low;
        assert!(low <= 10, "{low} at depth {depth}");
        assert!(depth < APART || low == 10, "{low} at depth {depth}");
    }
}

fn five_bar_at(anchors: [[f64; 2]; 2], scale: f64) -> Robot {
    let leg = |k: usize, l: f64, m: f64| {
        Leg::revolute(anchors[k].map(|x| x * scale), [0.0, 0.0], l * scale, m * scale)
    };
    Robot::new("five-bar", Platform::PlanePoint, vec![leg(0, 8.0, 5.0), leg(1, 5.0, 8.0)]).unwrap()
}

/// Where the robot stands, which way it looks and in which unit it is measured do not matter.
#[test]
fn aspects_do_not_depend_on_place_direction_and_unit() {
    let (sin, cos) = 0.3f64.sin_cos();
    let reference = total_measure(&analyzed(&five_bar(), APART));
    for (anchors, scale) in [
        ([[17.3, -4.1], [26.3, -4.1]], 1.0),
        ([[1.0, 2.0], [1.0 + 9.0 * cos, 2.0 + 9.0 * sin]], 1.0),
        ([[0.0, 0.0], [9.0, 0.0]], 1e-3),
        ([[0.0, 0.0], [9.0, 0.0]], 1e3),
    ] {
        let analysis = analyzed(&five_bar_at(anchors, scale), APART);
        assert_eq!(counts(&analysis), table_2(|mode, sign| (mode, sign)), "{anchors:?} {scale}");
        let measure = total_measure(&analysis) / (scale * scale);
        assert!((measure / reference - 1.0).abs() < 0.02, "{measure} {reference}");
        check_samples(&analysis);
    }
}

#[test]
fn a_mirror_changes_all_signs() {
    let analysis = analyzed(&five_bar_at([[0.0, 0.0], [-9.0, 0.0]], 1.0), APART);
    assert_eq!(counts(&analysis), table_2(|mode, sign| (mode.map(|s| -s), -sign)));
}

#[test]
fn renumbered_legs_swap_signs_and_rows() {
    let mut robot = five_bar();
    robot.legs.reverse();
    let analysis = analyzed(&robot, APART);
    assert_eq!(counts(&analysis), table_2(|[a, b], sign| ([b, a], -sign)));
    assert!((total_measure(&analysis) / total_measure(&analyzed(&five_bar(), APART)) - 1.0).abs() < 0.01);
}

// Brute force. On a grid of the workspace it fails: D = 0 touches H = 0. On one of elbow angles D = 0 crosses H = 0.

type Visit<'a> = &'a mut dyn FnMut(usize);

/// Marks the component of `start` in `seen` and returns its size.
fn flood(start: usize, inside: &[bool], neighbours: &impl Fn(usize, Visit), seen: &mut [bool]) -> usize {
    seen[start] = true;
    let (mut open, mut size) = (vec![start], 0);
    while let Some(i) = open.pop() {
        size += 1;
        neighbours(i, &mut |j| {
            if inside[j] && !std::mem::replace(&mut seen[j], true) {
                open.push(j);
            }
        });
    }
    size
}

/// Components of a set of cells, given which cells are in it and what they touch: a cell of each, and its size.
fn components(inside: &[bool], neighbours: impl Fn(usize, Visit)) -> Vec<(usize, usize)> {
    let mut seen = vec![false; inside.len()];
    let mut found = Vec::new();
    for start in 0..inside.len() {
        if inside[start] && !seen[start] {
            found.push((start, flood(start, inside, &neighbours, &mut seen)));
        }
    }
    found
}

/// Table 2 by flood fill over the angles at the elbows. They give |A₁X| and |A₂X|, so two points X, mirror images in A₁A₂:
/// two sheets, glued where the triangle A₁A₂X is flat. Nothing of the library is used.
fn five_bar_by_flood_fill(n: usize, mode: [i8; 2], sign: i8) -> usize {
    let links = [(8.0, 5.0), (5.0, 8.0)];
    let base = 9.0;
    // 2 L M sin ψ = −B / …: the elbow angle has the opposite sign of B_jj.
    let elbow = |j: usize, i: usize| -f64::from(mode[j]) * PI * (i as f64 + 0.5) / n as f64;
    let reach = |j: usize, psi: f64| {
        let (l, m): (f64, f64) = links[j];
        (l * l + m * m + 2.0 * l * m * psi.cos()).sqrt()
    };
    // y² of X, which must not be negative.
    let square = |psi: [f64; 2]| {
        let (d1, d2) = (reach(0, psi[0]), reach(1, psi[1]));
        let x = (d1 * d1 - d2 * d2 + base * base) / (2.0 * base);
        (x, d1 * d1 - x * x)
    };
    let det = |psi: [f64; 2], side: f64| {
        let (x, y2) = square(psi);
        let y = side * y2.sqrt();
        let rod = |j: usize| {
            let (l, m) = links[j];
            let from = [x - base * j as f64, y];
            let crank = from[1].atan2(from[0]) - (m * psi[j].sin()).atan2(l + m * psi[j].cos());
            [(crank + psi[j]).cos() * m, (crank + psi[j]).sin() * m]
        };
        let (u, v) = (rod(0), rod(1));
        4.0 * (u[0] * v[1] - u[1] * v[0])
    };
    let at = |cell: usize| [elbow(0, cell % n), elbow(1, cell / n % n)];
    let exists: Vec<bool> = (0..n * n).map(|cell| square(at(cell)).1 >= 0.0).collect();
    let inside: Vec<bool> = (0..2 * n * n)
        .map(|cell| {
            let side = if cell < n * n { 1.0 } else { -1.0 };
            exists[cell % (n * n)] && f64::from(sign) * det(at(cell), side) > 0.0
        })
        .collect();
    components(&inside, |cell, visit| {
        let (i, j, sheet) = (cell % n, cell / n % n, cell / (n * n));
        let mut flat = false;
        for (di, dj) in [(-1, 0), (1, 0), (0, -1), (0, 1)] {
            let (i, j) = (i as isize + di, j as isize + dj);
            if (0..n as isize).contains(&i) && (0..n as isize).contains(&j) {
                let other = i as usize + n * j as usize;
                flat |= !exists[other];
                visit(other + sheet * n * n);
            }
        }
        if flat {
            visit((cell + n * n) % (2 * n * n));
        }
    })
    .len()
}

#[test]
fn flood_fill_over_elbow_angles_counts_as_the_paving_does() {
    for n in [300, 701] {
        let mut table = BTreeMap::new();
        for mode in [[1, 1], [1, -1], [-1, -1], [-1, 1]] {
            for sign in [1, -1] {
                let name = WorkingMode::from_signs(mode.map(|s| s > 0)).to_string();
                table.insert((name, sign), five_bar_by_flood_fill(n, mode, sign));
            }
        }
        assert_eq!(table, table_2(|mode, sign| (mode, sign)), "n = {n}");
    }
}

/// The sign of det A of the catalogue's 3-RPR at x, y, φ, from its figures; `None` beyond the struts' limits.
fn three_rpr_sign([x, y, phi]: [f64; 3]) -> Option<bool> {
    let base = [[0.0, 0.0], [15.91, 0.0], [0.0, 10.0]];
    let platform = [[0.0, 0.0], [17.04, 0.0], [13.236_373_239_436_62, 16.096708466836508]];
    let (sin, cos) = phi.sin_cos();
    let [p, q, r]: [[f64; 3]; 3] = std::array::from_fn(|j| {
        let [bx, by]: [f64; 2] = platform[j];
        let arm = [cos * bx - sin * by, sin * bx + cos * by];
        let d = [x + arm[0] - base[j][0], y + arm[1] - base[j][1]];
        [d[0], d[1], arm[0] * d[1] - arm[1] * d[0]]
    });
    let cross = |i: usize, k: usize| q[i] * r[k] - q[k] * r[i];
    let det = p[0] * cross(1, 2) + p[1] * cross(2, 0) + p[2] * cross(0, 1);
    let within = [p, q, r].iter().all(|d| (10.0..32.0).contains(&d[0].hypot(d[1])));
    within.then_some(det > 0.0)
}

/// A grid of x, y, φ with φ glued.
struct Grid {
    n: i64,
    ranges: Vec<(f64, f64)>,
}

impl Grid {
    /// The pose at the middle of a cell; cell coordinates may be fractions.
    fn pose(&self, cell: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| {
            let (lo, hi) = self.ranges[k];
            lo + (hi - lo) * (cell[k] + 0.5) / self.n as f64
        })
    }
    fn cell(&self, index: usize) -> [i64; 3] {
        let (i, n) = (index as i64, self.n);
        [i % n, i / n % n, i / n / n]
    }
    fn index(&self, [i, j, k]: [i64; 3]) -> Option<usize> {
        let inside = (0..self.n).contains(&i) && (0..self.n).contains(&j);
        inside.then(|| ((k.rem_euclid(self.n) * self.n + j) * self.n + i) as usize)
    }
}

fn around(cell: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..6).map(move |side| {
        let mut next = cell;
        next[side / 2] += if side % 2 == 0 { 1 } else { -1 };
        next
    })
}

/// Whether steps of a 16th of a cell, all in the set, lead from the middle of a cell to that of one of `goal`.
fn leads_to(grid: &Grid, positive: bool, from: usize, goal: &[bool]) -> bool {
    const FINER: i64 = 16;
    let start = grid.cell(from).map(|c| c * FINER);
    let mut seen = HashSet::from([start]);
    let mut open = VecDeque::from([start]);
    while let Some(at) = open.pop_front() {
        let middle = at.iter().all(|c| c % FINER == 0);
        if middle && grid.index(at.map(|c| c / FINER)).is_some_and(|i| goal[i]) {
            return true;
        }
        for next in around(at) {
            let pose = grid.pose(next.map(|c| c as f64 / FINER as f64));
            if three_rpr_sign(pose) == Some(positive) && seen.insert(next) {
                open.push_back(next);
            }
        }
        assert!(seen.len() < 2_000_000, "no way out of {:?} found", grid.cell(from));
    }
    false
}

/// The 3-RPR has one aspect per sign of det A (six assembly modes, joined without singularity). Struts have no h, so a grid of
/// the workspace will do; single cells that the grid cuts off in sharp edges, where det A = 0 meets a limit, are led back by
/// a finer one rather than filtered away.
#[test]
fn the_3_rpr_has_two_aspects() {
    let analysis = analyzed(&catalogue::find("3-rpr").unwrap(), 6);
    let low: Vec<_> = analysis.classes.iter().map(|c| c.low).collect();
    assert_eq!((low, analysis.aspects.low), (vec![1, 1], 2));
    check_samples(&analysis);
    let grid = Grid { n: 48, ranges: analysis.window.ranges.clone() };
    let size = (grid.n * grid.n * grid.n) as usize;
    let signs: Vec<_> =
        (0..size).map(|i| three_rpr_sign(grid.pose(grid.cell(i).map(|c| c as f64)))).collect();
    for (class, positive) in analysis.classes.iter().zip([true, false]) {
        let neighbours = |i: usize, visit: &mut dyn FnMut(usize)| {
            around(grid.cell(i)).filter_map(|next| grid.index(next)).for_each(visit);
        };
        let inside: Vec<bool> = signs.iter().map(|s| *s == Some(positive)).collect();
        let mut found = components(&inside, neighbours);
        found.sort_by_key(|&(_, size)| std::cmp::Reverse(size));
        let mut main = vec![false; size];
        flood(found[0].0, &inside, &neighbours, &mut main);
        for &(cell, _) in &found[1..] {
            assert!(leads_to(&grid, positive, cell, &main), "{:?}", grid.cell(cell));
        }
        // The certified measure is a lower bound, with what is undecided an upper one.
        let cell: f64 = grid.ranges.iter().map(|r| (r.1 - r.0) / grid.n as f64).product();
        let volume = inside.iter().filter(|&&x| x).count() as f64 * cell;
        let most = class.measure + class.undecided;
        assert!(class.measure < 1.01 * volume && 0.99 * volume < most, "{volume} {} {most}", class.measure);
    }
}

/// φ = −175° is 185°: a pose is where it is, whichever way its angle is written.
#[test]
fn locate_counts_angles_modulo_full_turns() {
    let mut robot = catalogue::find("3-rpr").unwrap();
    let degrees = |d: f64| d.to_radians();
    robot.window[2] = Some((degrees(165.0), degrees(195.0)));
    let analysis = analyzed(&robot, 5);
    let mut located = 0;
    for i in 0..1000 {
        let part = |k: usize| (f64::from(i) * [0.618_034, 0.754_878, 0.569_84][k]).fract();
        let at = |k: usize| {
            analysis.window.ranges[k].0
                + part(k) * (analysis.window.ranges[k].1 - analysis.window.ranges[k].0)
        };
        let pose = [at(0), at(1), at(2)];
        for class in [0, 1].map(ClassId::new) {
            let place = analysis.locate(&pose, class);
            located += usize::from(matches!(place, Place::Inside(_)));
            assert_eq!(place, analysis.locate(&[pose[0], pose[1], pose[2] - TAU], class));
            assert_eq!(place, analysis.locate(&[pose[0], pose[1], pose[2] + TAU], class));
        }
        assert_eq!(analysis.locate(&[pose[0], pose[1], 0.5], ClassId::new(0)), Place::Outside);
    }
    assert!(located > 20, "{located}");
}

// Runs.

fn json(analysis: &Analysis) -> serde_json::Value {
    let mut json = serde_json::to_value(analysis).unwrap();
    assert!(json["run"]["seconds"].take().is_number());
    json
}

/// The same to the last bit, whatever the number of threads.
#[test]
fn results_do_not_depend_on_threads() {
    for (name, depth) in [("five-bar", 8), ("3-rpr", 5), ("3-rrr", 4)] {
        let robot = catalogue::find(name).unwrap();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| json(&analyzed(&robot, depth)))
        };
        let alone = with(1);
        assert_eq!(alone, with(2), "{name}");
        assert_eq!(alone, with(3), "{name}");
    }
}

// Limits.

const FIVE_BAR: &str = "
name = \"five-bar\"
platform = \"plane-point\"
[[legs]]
anchor = [0, 0]
actuator = { kind = \"revolute\", crank = 8, rod = 5 }
limits = { LIMITS }
[[legs]]
anchor = [9, 0]
actuator = { kind = \"revolute\", crank = 5, rod = 8 }
";

fn limited(limits: &str) -> Robot {
    Robot::from_toml(&FIVE_BAR.replace("LIMITS", limits), "limited").unwrap()
}

/// An elbow that bends one way only: two modes are proved out of reach, the others lose nothing but what lies near
/// the stretched elbow.
#[test]
fn an_elbow_limit_forbids_modes() {
    let free = analyzed(&five_bar(), APART);
    // ψ in (5°, 175°): sin ψ > 0, so B_11 < 0.
    let analysis = analyzed(&limited("elbow = { deg = [5, 175] }"), APART);
    for report in &analysis.modes {
        let expected = if report.mode.sign(0) > 0 { Reachable::No } else { Reachable::Yes };
        assert_eq!(report.reachable, expected, "{report:?}");
        assert_eq!(report.sample.is_some(), expected == Reachable::Yes);
    }
    for (class, free) in analysis.classes.iter().zip(&free.classes) {
        if class.mode.sign(0) > 0 {
            // Nothing is left undecided, so that there are none is proved.
            assert_eq!((class.low, class.high, class.measure, class.undecided), (0, Some(0), 0.0, 0.0));
        } else {
            assert!(class.measure < free.measure && class.measure > 0.8 * free.measure, "{class:?}");
        }
    }
}

/// Narrower ranges of an actuator: less measure in every class, none beyond the limit.
#[test]
fn actuator_limits_shrink_aspects() {
    let measures =
        |robot: &Robot| -> Vec<f64> { analyzed(robot, 8).classes.iter().map(|c| c.measure).collect() };
    let free = measures(&five_bar());
    let wide = measures(&limited("actuator = { deg = [-150, 150] }"));
    let narrow = measures(&limited("actuator = { deg = [-60, 60] }"));
    for k in 0..8 {
        // Some aspects never turn the crank beyond 150°.
        assert!(narrow[k] < wide[k] && wide[k] <= free[k], "{narrow:?} {wide:?} {free:?}");
    }
    assert!(wide.iter().sum::<f64>() < free.iter().sum::<f64>());
    let analysis = analyzed(&limited("actuator = { deg = [-60, 60] }"), 8);
    let limit = 60f64.to_radians();
    for aspect in analysis.classes.iter().flat_map(|c| &c.aspects) {
        assert!(aspect.sample.q[0].abs() < limit);
        // Bounds over boxes overshoot, but not by much.
        assert!(aspect.q_bounds[0].0 > -limit - 0.3 && aspect.q_bounds[0].1 < limit + 0.3, "{aspect:?}");
    }
}

// The earlier definitions.

/// Section 3.3, figures 6 and 7: the aspects of Definitions 5 and 6 overlap.
#[test]
fn earlier_definitions_do_not_separate() {
    let analysis = analyzed(&five_bar(), 8);
    assert_eq!((analysis.parallel_aspects.len(), analysis.serial_aspects.len()), (2, 4));
    for entry in analysis.parallel_aspects.iter().chain(&analysis.serial_aspects) {
        assert!(entry.overlap > 0.0 && !entry.domains.is_empty(), "{entry:?}");
        let covered: f64 = entry.domains.iter().map(|d| d.measure).sum();
        assert!(entry.overlap <= covered * (1.0 + 1e-9));
    }
    // Without limits every mode exists in the same poses: the domains overlap wholly.
    let measure = |k: usize| analysis.serial_aspects[k].domains.iter().map(|d| d.measure).sum::<f64>();
    for k in 0..4 {
        assert!((analysis.serial_aspects[k].overlap / measure(0) - 1.0).abs() < 1e-9);
        assert!((measure(k) / measure(0) - 1.0).abs() < 1e-9);
    }
    // Some mode with det A > 0, and some with < 0: no less than each of them.
    for (entry, sign) in analysis.parallel_aspects.iter().zip([DetSign::Positive, DetSign::Negative]) {
        let covered: f64 = entry.domains.iter().map(|d| d.measure).sum();
        let most = analysis.classes.iter().filter(|c| c.det_a == sign).map(|c| c.measure).fold(0.0, f64::max);
        assert!(covered >= most * (1.0 - 1e-9), "{covered} {most}");
        for domain in &entry.domains {
            let j = analysis.robot.jacobians(&domain.sample.pose, &domain.sample.q).unwrap();
            assert_eq!(j.det_a() > 0.0, sign == DetSign::Positive);
        }
    }
}

/// W itself in closed form: the common part of two annuli of radii 3 and 13 about points 9 apart.
#[test]
fn the_workspace_has_the_area_of_two_annuli_cut() {
    let analysis = analyzed(&five_bar(), APART);
    let lens = |r: f64, s: f64| {
        let d = 9.0f64;
        if r + s <= d {
            return 0.0;
        }
        if d <= (r - s).abs() {
            return PI * r.min(s).powi(2);
        }
        let part = |r: f64, s: f64| r * r * ((d * d + r * r - s * s) / (2.0 * d * r)).acos();
        let kite = ((-d + r + s) * (d + r - s) * (d - r + s) * (d + r + s)).sqrt();
        part(r, s) + part(s, r) - 0.5 * kite
    };
    let exact = lens(13.0, 13.0) - 2.0 * lens(13.0, 3.0) + lens(3.0, 3.0);
    let inner: f64 = analysis.serial_aspects[0].domains.iter().map(|d| d.measure).sum();
    assert!(inner < exact && inner > 0.97 * exact, "{inner} {exact}");
    // Each mode: both signs of det A together are W but for a curve.
    for pair in analysis.classes.chunks(2) {
        let (low, undecided) = (pair[0].measure + pair[1].measure, pair[0].undecided + pair[1].undecided);
        assert!(low < exact && exact < low + undecided, "{low} {undecided} {exact}");
    }
}

/// Constants as intervals: a robot whose lengths are known to within a tolerance keeps its ten aspects, and what is
/// certified holds for each robot of the family, so the measure can only be less.
#[test]
fn toleranced_lengths_certify_less() {
    let mut robot = five_bar();
    for leg in &mut robot.legs {
        if let Actuator::Revolute(Revolute { crank, rod }) = &mut leg.actuator {
            let wide = |x: Interval| Interval::new(x.lo - 1e-3, x.hi + 1e-3);
            (*crank, *rod) = (wide(*crank), wide(*rod));
        }
    }
    let (loose, exact) = (analyzed(&robot, 8), analyzed(&five_bar(), 8));
    for (loose, exact) in loose.classes.iter().zip(&exact.classes) {
        assert!(loose.measure < exact.measure && loose.measure > 0.9 * exact.measure);
    }
}
