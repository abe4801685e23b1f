//! The main job: a robot in, its working modes and generalized aspects out.

use super::ascent::Class;
use super::atlas::{Atlas, Leaf};
use super::certify::certificate;
use super::components::{Components, Piece};
use super::count::{Counted, Group};
use super::doubt::doubts;
use super::earlier::{parallel_aspects, serial_aspects};
use super::measure::{Held, Measure};
use super::options::Options;
use super::project::{q_bounds, w_bounds};
use super::refusal::{AnalysisError, refuse};
use super::result::*;
use super::seams::centre;
use super::search::Search;
use super::{AspectId, SingularMode};
use crate::paving::{Budget, Control, MODES, Mark, Node, Paving, Progress, Share, Stop};
use aspecta_kinematics::chart::uncharted_folds;
use aspecta_kinematics::parallel_rods::parallel_rods;
use aspecta_kinematics::{AgileEye, Architecture, Kinematics, WorkingMode, architecture};
use aspecta_robot::work::Stopwatch;
use aspecta_robot::{Leg, LegIndex, Robot, Window, work};
use aspecta_verify::certificate::Certificate;
use std::collections::BTreeSet;

/// Boxes after which a search ends by itself that cannot make the bounds meet.
const HOPELESS_BOXES: u64 = 4_000_000;

/// Working modes (Def. 7) and generalized aspects (Def. 8) of a robot with up to three free coordinates.
///
/// The workspace is paved once for each [`crate::paving::MODES`] modes, a budget being shared among these passes; per mode and sign of det A the aspects are bounded by
///
/// - **low** (certified): the number of components of G⁺, the graph of inside and undecided boxes that share a
///   point, which hold an inside box. A component of S_{s,σ} is connected and covered by those closed
///   boxes, so it lies in one component of G⁺; distinct such components hold distinct aspects.
/// - **pieces** of an aspect (certified): inside boxes joined by touching, or by certified ascent paths.
///
/// - **high** (certified): the number of components of G⁻ that may hold the summit of an aspect, provided that no undecided box may
///   (`docs/theory.md`, 4 and 5); else `None`.
///
/// Boxes are refined where they keep the bounds apart, until they meet or the budget ends; [`Analysis::doubts`] then
/// says where they are apart and why.
///
/// In a slice ([`Options::fix`]) S_{s,σ} is cut by the slice; det A remains that of the whole robot. Each aspect of the slice
/// lies in one aspect of the robot; several may lie in the same.
///
/// # Errors
/// [`AnalysisError`] if the workspace is unbounded or empty, more than three coordinates are free, there is no such slice or no such
/// mode, or too many modes for a certificate.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Control, Options, Robot, analyze};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(7), ..Budget::default() };
/// let options = Options { budget, modes: vec!["++".parse()?], ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// for class in &analysis.classes {
///     println!("mode {}, det A {}: at least {}", class.mode, class.det_a, class.low);
/// }
/// assert_eq!(analysis.classes.len(), 2);
/// assert!(analysis.aspects.low >= 2);
/// # Ok(())
/// # }
/// ```
pub fn analyze(robot: &Robot, options: &Options, control: &Control<'_>) -> Result<Analysis, AnalysisError> {
    with_deep_stacks(robot, || analyze_here(robot, options, control))
}

/// Does work on threads whose stacks hold the kernels of the robot: with six degrees of freedom these keep matrices of slopes of packs, hundreds of
/// kilobytes, and a thread that waits for another takes tasks over on top of its own.
fn with_deep_stacks<T: Send>(robot: &Robot, work: impl FnOnce() -> T + Send) -> T {
    const STACK: usize = 64 << 20;
    if robot.dof() <= 3 {
        return work();
    }
    work::with_stack(STACK, work)
}

fn analyze_here(robot: &Robot, options: &Options, control: &Control<'_>) -> Result<Analysis, AnalysisError> {
    let start = Stopwatch::start();
    refuse(robot, options)?;
    let window = robot.slice(&options.fix)?;
    let all_modes = robot.working_modes();
    if let Some(&mode) = options.modes.iter().find(|mode| !all_modes.contains(mode)) {
        return Err(AnalysisError::Mode { robot: robot.name.clone(), mode });
    }
    let modes = if options.modes.is_empty() { &all_modes } else { &options.modes };
    let parallel_rods = parallel_rods(robot, &window);
    let uncharted_folds = uncharted_folds(robot, &window);
    let architecturally_singular = architecture(robot) == Architecture::Singular;
    let hopeful = parallel_rods.is_empty() && uncharted_folds.is_empty() && !architecturally_singular;
    let budget = bounded(options.budget, hopeful);
    let mut passes: Vec<Pass> = Vec::new();
    let groups = modes.chunks(MODES);
    for (k, group) in groups.clone().enumerate() {
        let spent = (passes.iter().map(|pass| pass.boxes).sum(), start.seconds());
        let share = budget.share(groups.len() - k, spent);
        passes.push(Pass::run(robot, &window, group, &share, options, control));
    }
    (control.progress)(Progress { stage: "definitions 5 and 6", done: 0, total: 1 });
    let (parallel, serial) = match &passes[..] {
        [pass] if options.modes.is_empty() && !control.is_cancelled() => {
            work::join(|| parallel_aspects(robot, &pass.paving), || serial_aspects(robot, &pass.paving))
        }
        _ => Default::default(),
    };
    let depth = passes.iter().map(|pass| pass.paving.depth).max().unwrap_or(0);
    let run = Run {
        boxes: passes.iter().map(|pass| pass.boxes).sum(),
        depth,
        resolution: window.ranges.iter().map(|r| (r.1 - r.0) / f64::from(1u32 << depth)).collect(),
        stop: passes.iter().map(|pass| pass.stop).fold(Stop::Exact, Stop::worse),
        seconds: 0.0,
        allowed_seconds: budget.seconds,
    };
    let mut found = Vec::new();
    let (mut reports, mut doubts, mut certificate, mut pavings) = (vec![], vec![], None, vec![]);
    let mut singular_modes = Vec::new();
    for mut pass in passes {
        pass.paving.leave_vanishing();
        singular_modes.extend(pass.singular_modes);
        found.extend(pass.found);
        reports.extend(pass.modes);
        doubts.extend(pass.doubts);
        certificate = pass.certificate;
        pavings.push(pass.paving);
    }
    let (classes, labels) = number(found);
    let low = classes.iter().map(|c| c.low).sum();
    let high = classes.iter().map(|c| c.high).sum::<Option<usize>>();
    Ok(Analysis {
        format_version: FORMAT_VERSION,
        fixed: Held::all(robot, &window),
        measure: Measure::over(robot, &window),
        aspects: Count { low, high, certified: high == Some(low) },
        legs: leg_reports(robot),
        modes: reports,
        classes,
        singular_modes,
        doubts,
        architecturally_singular,
        agile_eye: AgileEye::of(robot).is_some(),
        parallel_rods,
        uncharted_folds,
        certificate,
        parallel_aspects: parallel,
        serial_aspects: serial,
        run: Run { seconds: start.seconds(), ..run },
        robot: robot.clone(),
        window,
        labels,
        pavings,
    })
}

/// The findings of one pass over its modes.
struct Pass {
    found: Vec<Found>,
    singular_modes: Vec<SingularMode>,
    doubts: Vec<Doubt>,
    modes: Vec<ModeReport>,
    certificate: Option<Certificate>,
    paving: Paving,
    boxes: u64,
    stop: Stop,
}

impl Pass {
    fn run(
        robot: &Robot,
        window: &Window,
        modes: &[WorkingMode],
        budget: &Budget,
        options: &Options,
        control: &Control<'_>,
    ) -> Self {
        let Search { atlas, counted, shares, stop } =
            Search::run(robot, window, modes, (budget, options.purpose), control);
        let paving = &atlas.sheets[0];
        let of_class: Vec<_> =
            counted.iter().enumerate().map(|(k, counted)| (counted, shares.of(k))).collect();
        let mut found =
            work::map(&of_class, |((class, counted), shares)| Found::new(&atlas, *class, counted, shares));
        let mut singular_modes = Vec::new();
        for ((class, _), found) in counted.iter().zip(&mut found).filter(|(c, _)| c.0.vanishes()) {
            let domains = std::mem::replace(found, Found::none(*class)).class;
            if domains.det_a == DetSign::Positive {
                singular_modes.extend(SingularMode::new(robot, domains));
            }
        }
        let in_doubt = counted.iter().filter(|(class, _)| !class.vanishes());
        Self {
            found,
            singular_modes,
            doubts: in_doubt.flat_map(|(class, counted)| doubts(&atlas, *class, counted)).collect(),
            modes: modes.iter().enumerate().map(|(m, mode)| mode_report(robot, paving, m, *mode)).collect(),
            certificate: options.certificate.then(|| certificate(&atlas, &counted)),
            boxes: atlas.boxes(),
            stop,
            paving: { atlas.sheets }.swap_remove(0),
        }
    }
}

/// The budget, ended early if it names no end and the bounds are not going to meet.
fn bounded(budget: Budget, hopeful: bool) -> Budget {
    let is_open = budget.seconds.is_none() && budget.boxes.is_none();
    if is_open && !hopeful { Budget { boxes: Some(HOPELESS_BOXES), ..budget } } else { budget }
}

/// One class, its aspects not yet numbered: label k + 1 stands for `class.aspects[k]`.
struct Found {
    class: AspectClass,
    labels: Vec<(u32, u32)>,
}

impl Found {
    /// Of a class that there is nothing of.
    fn none(class: Class) -> Self {
        let (mode, det_a) = (class.mode, class.det_a());
        let class = AspectClass {
            mode,
            det_a,
            low: 0,
            high: Some(0),
            measure: 0.0,
            undecided: 0.0,
            aspects: Vec::new(),
        };
        Self { class, labels: Vec::new() }
    }

    fn new(atlas: &Atlas<'_>, class: Class, counted: &Counted, shares: &[(u32, Share)]) -> Self {
        let components = &counted.components;
        let total =
            |group: &Group| group.pieces.iter().map(|&k| components.pieces[k as usize].measure).sum::<f64>();
        let mut groups: Vec<&Group> = counted.found.iter().filter(|group| group.anchored).collect();
        groups.sort_by(|a, b| total(b).total_cmp(&total(a)));
        let mut label_of_piece = vec![0; components.pieces.len()];
        for (k, group) in groups.iter().enumerate() {
            group.pieces.iter().for_each(|&piece| label_of_piece[piece as usize] = k as u32 + 1);
        }
        let paving = &atlas.sheets[0];
        let mut label = vec![0; paving.nodes.len()];
        for (&(sheet, node), piece) in components.boxes.iter().zip(&components.piece_of) {
            if let (0, Some(piece)) = (sheet, piece) {
                label[node as usize] = label_of_piece[*piece as usize];
            }
        }
        let mut labels = Vec::new();
        let classify = |node: &Node| node.of_classes(class.bit);
        paving.boxes_of(&classify, &mut |node| labels.push((node, label[node as usize])));
        labels.sort_unstable();
        let mut aspects: Vec<Aspect> = groups.iter().map(|g| aspect(atlas, class, components, g)).collect();
        let whole = |node: u32| paving.measure(paving.depth_of(node));
        let mut undecided: f64 = labels.iter().filter(|l| l.1 == 0).map(|l| whole(l.0)).sum();
        let owner = counted.owners(&groups);
        for &(node, share) in shares {
            let [inside, outside] = share.of(whole(node));
            undecided -= outside;
            // What may belong to an aspect that is not found stays undecided.
            if let Some(k) = owner(node) {
                undecided -= inside;
                aspects[k].measure += inside;
            }
        }
        let class = AspectClass {
            mode: class.mode,
            det_a: class.det_a(),
            low: aspects.len(),
            high: counted.high(),
            measure: aspects.iter().map(|aspect| aspect.measure).sum(),
            undecided: undecided.max(0.0),
            aspects,
        };
        Self { class, labels }
    }
}

fn aspect(atlas: &Atlas<'_>, class: Class, components: &Components, group: &Group) -> Aspect {
    let paving = &atlas.sheets[0];
    let pieces: Vec<&Piece> = group.pieces.iter().map(|&k| &components.pieces[k as usize]).collect();
    let in_poses = |i: &usize| components.boxes[*i].0 == 0;
    let all: Vec<Leaf> = (0..components.boxes.len())
        .filter(|&i| components.component_of[i] == Some(group.component))
        .map(|i| components.boxes[i])
        .collect();
    let mine: BTreeSet<u32> = group.pieces.iter().copied().collect();
    let inner: Vec<u32> = (0..components.boxes.len())
        .filter(|&i| in_poses(&i) && components.piece_of[i].is_some_and(|piece| mine.contains(&piece)))
        .map(|i| components.boxes[i].1)
        .collect();
    // An aspect too small for the boxes of poses is seen in a chart.
    let largest = inner.iter().copied().reduce(|a, b| paving.larger(a, b)).map(|node| (0, node));
    let pose = centre(atlas.robot, &atlas.sheets, largest.unwrap_or(pieces[0].largest));
    let q = atlas.robot.inverse_in(&pose, class.mode).ok().flatten().unwrap_or_default();
    Aspect {
        id: AspectId::new(0),
        measure: pieces.iter().map(|p| p.measure).sum(),
        pieces: group.summits,
        sample: Sample { pose, q },
        w_bounds: w_bounds(atlas.robot, &atlas.sheets, &all),
        q_bounds: q_bounds(atlas.robot, paving, class.mode, &inner),
    }
}

/// Numbers the aspects of all classes from 1.
fn number(found: Vec<Found>) -> (Vec<AspectClass>, Vec<Vec<(u32, u32)>>) {
    let mut next = 1;
    let mut classes = Vec::new();
    let mut labels = Vec::new();
    for Found { mut class, labels: mut of_class } in found {
        let first = next as u32;
        for aspect in &mut class.aspects {
            aspect.id = AspectId::new(next);
            next += 1;
        }
        of_class.iter_mut().filter(|l| l.1 > 0).for_each(|l| l.1 += first - 1);
        classes.push(class);
        labels.push(of_class);
    }
    (classes, labels)
}

fn mode_report(robot: &Robot, paving: &Paving, m: usize, mode: WorkingMode) -> ModeReport {
    let classify = |node: &Node| node.of_mode(m);
    let (mut best, mut open) = (None::<u32>, false);
    paving.boxes_of(&classify, &mut |at| {
        if classify(&paving.nodes[at as usize]) == Mark::Inside {
            best = Some(best.map_or(at, |b| paving.larger(b, at)));
        } else {
            open = true;
        }
    });
    let sample = best.and_then(|at| {
        let pose = paving.centre(at);
        let q = robot.inverse_in(&pose, mode).ok().flatten()?;
        Some(Sample { pose, q })
    });
    let reachable = match (best, open) {
        (Some(_), _) => Reachable::Yes,
        (None, true) => Reachable::Undecided,
        (None, false) => Reachable::No,
    };
    let number = 1 + robot.working_modes().iter().position(|&other| other == mode).unwrap_or(m);
    ModeReport { number, mode, reachable, sample }
}

/// Theorem 1's hypothesis, leg by leg: working modes separate the inverse solutions if and only if no leg is
/// cuspidal (and each has at most two postures).
fn leg_reports(robot: &Robot) -> Vec<LegReport> {
    let report = |(k, leg): (usize, &Leg)| LegReport {
        leg: LegIndex::new(k),
        actuator: leg.actuator.kind().name(),
        postures: leg.actuator.postures(),
        cuspidal: false,
        reason: leg.actuator.kind().facts().why_not_cuspidal,
    };
    robot.legs.iter().enumerate().map(report).collect()
}
