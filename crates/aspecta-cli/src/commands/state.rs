//! `aspecta state`: where a configuration stands among working modes and singularities.

use crate::args::format::ShownArgs;
use crate::args::given::{Poses, Query};
use crate::args::help::help;
use crate::args::mode::ModeArg;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{Align, Labels, Shown, Table, det_a_unit, exact, note, number, print_each};
use crate::show::beyond::{entry, of_state};
use crate::show::solutions::signs;
use crate::work::solve;
use aspecta::Kinematics;
use aspecta::kinematics::{self, WorkingMode};
use aspecta::robot::{LegIndex, Robot};
use clap::Args;
use serde::Serialize;
use std::io::Write;

/// A residual above this says that pose and joint vector do not belong together (rounded input has less).
const NOT_CLOSED: f64 = 1e-3;

/// Arguments of `state`.
#[derive(Args)]
#[command(mut_args(help(
    "file",
    "A CSV file of poses, or of poses and joint vectors, one a line; `-` reads stdin"
)))]
#[command(mut_args(help("mode", "Only the inverse solution in this working mode, such as `+-`")))]
pub struct State {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    poses: Poses,
    /// The joint vector, one number per leg; without it, the inverse solutions of the pose
    #[arg(long, value_name = "LIST", allow_hyphen_values = true, conflicts_with_all = ["file", "mode"])]
    q: Option<String>,
    #[command(flatten)]
    mode: ModeArg,
    #[command(flatten)]
    shown: ShownArgs,
}

/// A configuration, or pose, asked about and its states.
struct Found {
    query: Query,
    states: Vec<kinematics::State>,
}

impl State {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let mode = self.mode.of(&robot)?;
        let pose = Columns::pose(&robot);
        let joints = Columns::joints(&robot);
        let q = self.q.as_deref().map(|q| input::list("--q", q, &joints, self.shown.deg)).transpose()?;
        let layouts = [pose.clone().and(&joints), pose];
        // A list is a pose alone, a row of a file may be either.
        let layouts = if self.poses.is_one() { &layouts[1..] } else { &layouts[..] };
        let solved = |query: Query| {
            let states = states(&robot, &query, q.as_deref(), mode)?;
            let found = Found { query, states };
            if let Some(state) = found.open() {
                say_open(state, found.query.line);
            }
            Ok(found)
        };
        let found = self.poses.read(layouts, self.shown.deg)?.map(|query| solved(query?));
        print_each(out, &States { robot: &robot, degrees: self.shown.deg }, self.shown.format(), found)
    }
}

impl Found {
    /// A state that is no configuration of the robot.
    fn open(&self) -> Option<&kinematics::State> {
        self.states.iter().find(|s| s.residual.is_nan() || s.residual > NOT_CLOSED)
    }
}

/// The state at the joints given, or at each inverse solution (in `mode`, if given).
fn states(
    robot: &Robot,
    query: &Query,
    q: Option<&[f64]>,
    mode: Option<WorkingMode>,
) -> Result<Vec<kinematics::State>, Failure> {
    let n = robot.dof();
    let (pose, given) = match q {
        Some(q) => (query.values.as_slice(), q),
        None => query.values.split_at(query.values.len().min(n)),
    };
    if q.is_some() || !given.is_empty() {
        return Ok(solve::answered(robot.state(pose, given), query.line)?.into_iter().collect());
    }
    let solutions = solve::inverse(robot, pose, query.line)?;
    let wanted = solutions.iter().filter(|s| mode.is_none_or(|m| s.mode == m));
    Ok(wanted.map(|s| robot.state(pose, &s.q)).collect::<Result<_, _>>()?)
}

/// Says that a pose and joints do not belong together.
fn say_open(state: &kinematics::State, line: Option<u64>) {
    let place = line.map_or(String::new(), |line| format!("line {line}: "));
    note(&format!(
        "{place}pose and joints are no configuration of the robot: the leg equations are off by {:.1e} \
         of the legs' lengths squared",
        state.residual
    ));
}

/// States, as they are shown.
struct States<'a> {
    robot: &'a Robot,
    degrees: bool,
}

#[derive(Serialize)]
struct AnswerInFull<'a> {
    states: Vec<InFull<'a>>,
}

#[derive(Serialize)]
struct InFull<'a> {
    #[serde(flatten)]
    state: &'a kinematics::State,
    velocities: kinematics::Velocities,
    beyond: Vec<String>,
}

impl Shown for States<'_> {
    type Found = Found;

    fn robot(&self) -> &Robot {
        self.robot
    }

    fn line(&self, found: &Found) -> Option<u64> {
        found.query.line
    }

    fn is_positive(&self, found: &Found) -> bool {
        !found.states.is_empty() && found.open().is_none()
    }

    fn json(&self, found: &Found) -> impl Serialize {
        let robot = self.robot;
        let in_full = |state| InFull {
            velocities: kinematics::State::velocities(state, robot),
            beyond: of_state(robot, state),
            state,
        };
        AnswerInFull { states: found.states.iter().map(in_full).collect() }
    }

    fn columns(&self) -> Vec<String> {
        let names = Columns::pose(self.robot).and(&Columns::joints(self.robot)).names.into_iter();
        let labels =
            ["mode", "singularity", "det_a", "det_b", "condition_a", "condition_b", "parallel_measure"];
        let serial = (1..=self.robot.dof()).map(|k| format!("serial_measure_{k}"));
        names
            .chain(labels.map(String::from))
            .chain(serial)
            .chain(["residual", "within_limits"].map(String::from))
            .collect()
    }

    fn records(&self, found: &Found) -> Vec<Vec<String>> {
        let record = |s: &kinematics::State| {
            let mode = s.mode.map_or(String::new(), |m| m.to_string());
            let labels = [mode, s.singularity.name().into()];
            let measures = [s.det_a, s.det_b, s.condition_a, s.condition_b, s.parallel_measure];
            let numbers = measures.iter().chain(&s.serial_measures).chain([&s.residual]).map(|x| exact(*x));
            let vectors = s.pose.iter().chain(&s.q).map(|x| exact(*x));
            vectors.chain(labels).chain(numbers).chain([s.within_limits.to_string()]).collect()
        };
        found.states.iter().map(record).collect()
    }

    fn lines(&self, found: &Found) -> usize {
        found.states.len()
    }

    fn table(&self, out: &mut dyn Write, found: &[Found]) -> Result<(), Failure> {
        print_table(out, self.robot, found, self.degrees)
    }
}

fn print_table(out: &mut dyn Write, robot: &Robot, found: &[Found], degrees: bool) -> Result<(), Failure> {
    if let [Found { query: Query { line: None, values }, states }] = found {
        writeln!(out, "{} at {}", robot.name, Labels::pose(robot, degrees).sentence(values))?;
        return states.iter().try_for_each(|s| print_one(out, robot, s, degrees, states.len() == 1));
    }
    let right = ["line", "mode", "det A", "cond. A", "cond. B", "to parallel", "to serial"];
    let headings = right.map(|name| (name.to_owned(), Align::Right));
    let mut table = Table::new(
        headings.into_iter().chain(["singularity", "limits"].map(|name| (name.to_owned(), Align::Left))),
    );
    for f in found {
        for s in &f.states {
            let serial = s.serial_measures.iter().copied().fold(f64::INFINITY, f64::min);
            let numbers = [s.det_a, s.condition_a, s.condition_b, s.parallel_measure, serial].map(number);
            let line = f.query.line.unwrap_or_default().to_string();
            let labels = [s.singularity.name().into(), entry(&of_state(robot, s))];
            table.row([line, mode(s)].into_iter().chain(numbers).chain(labels));
        }
    }
    write!(out, "{table}")?;
    Ok(())
}

/// The working mode, with 0 for legs at a serial singularity.
fn mode(s: &kinematics::State) -> String {
    signs(WorkingMode::from_signs(s.b.iter().map(|&b| b > 0.0)), &s.serial_legs)
}

/// Prints one state as a paragraph, with A and B if `matrices`.
fn print_one(
    out: &mut dyn Write,
    robot: &Robot,
    s: &kinematics::State,
    degrees: bool,
    matrices: bool,
) -> Result<(), Failure> {
    let meaning = match s.mode.map(|mode| robot.mode_in_words(mode)) {
        None => " (0: serial singularity)".to_owned(),
        Some(None) => String::new(),
        Some(Some(names)) => format!(" ({names})"),
    };
    writeln!(out, "\nworking mode  {}{meaning}", mode(s))?;
    let beyond = of_state(robot, s);
    let limits =
        if beyond.is_empty() { String::new() } else { format!(" (beyond limits: {})", beyond.join(", ")) };
    writeln!(out, "joints        {}{limits}", Labels::joints(robot, degrees).sentence(&s.q))?;
    writeln!(
        out,
        "det A         {}{}, condition {}",
        number(s.det_a),
        det_a_unit(robot),
        number(s.condition_a)
    )?;
    writeln!(out, "det B         {}, condition {}", number(s.det_b), number(s.condition_b))?;
    writeln!(
        out,
        "to parallel   {} (smallest singular value of the homogeneous A)",
        number(s.parallel_measure)
    )?;
    let serial: Vec<_> = s.serial_measures.iter().map(|m| number(*m)).collect();
    writeln!(out, "to serial     {} (|B_jj| / max, per leg)", serial.join(", "))?;
    let legs: Vec<_> = s.serial_legs.iter().map(LegIndex::to_string).collect();
    let which = if legs.is_empty() {
        String::new()
    } else {
        format!(", legs in serial singularity: {}", legs.join(", "))
    };
    writeln!(
        out,
        "singularity   {} (a measure ≤ {:e} counts as singular){which}",
        s.singularity.name(),
        s.tolerance
    )?;
    writeln!(out, "residual      {:.1e}", s.residual)?;
    let velocities = s.velocities(robot);
    print_velocities(out, robot, &velocities)?;
    if matrices {
        for (j, (row, b)) in s.a.iter().zip(&s.b).enumerate() {
            let row: Vec<_> = row.iter().map(|x| number(*x)).collect();
            writeln!(out, "leg {:<2}        A: {}    B: {}", j + 1, row.join("  "), number(*b))?;
        }
        for (k, row) in velocities.twist_of_joints.iter().flatten().enumerate() {
            let row: Vec<_> = row.iter().map(|x| number(*x)).collect();
            let name = if k == 0 { "−A⁻¹B" } else { "" };
            writeln!(out, "{name:<13} {}    of {}", row.join("  "), speed(robot, k))?;
        }
    }
    Ok(())
}

/// The name of a component of a twist.
fn speed(robot: &Robot, k: usize) -> String {
    let coordinates = robot.platform.coordinates();
    let turns = coordinates.iter().filter(|c| c.angle).count();
    let translations = coordinates.len() - turns;
    match k.checked_sub(translations) {
        None => format!("v_{}", coordinates[k].name),
        Some(_) if turns == 1 => "ω".into(),
        Some(k) => format!("ω_{}", ["x", "y", "z"][k]),
    }
}

/// Prints what the platform gains and loses (Definitions 3 and 4).
fn print_velocities(out: &mut dyn Write, robot: &Robot, v: &kinematics::Velocities) -> Result<(), Failure> {
    let values: Vec<_> = v.singular_values.iter().map(|x| number(*x)).collect();
    let length = v.length.map_or(String::new(), |length| {
        format!(" (turns count by {} {})", number(length), robot.length_unit)
    });
    writeln!(out, "ranks         A {}, B {}", v.rank_a, v.rank_b)?;
    writeln!(out, "sing. values  {}{length}", values.join(", "))?;
    let twist = |twist: &[f64]| {
        let parts = twist.iter().enumerate().map(|(k, x)| format!("{} = {}", speed(robot, k), number(*x)));
        parts.collect::<Vec<_>>().join(", ")
    };
    for gained in &v.gained {
        writeln!(
            out,
            "gained        {}: a twist that locked actuators do not hinder (Def. 3)",
            twist(gained)
        )?;
    }
    for lost in &v.lost {
        let posture = match lost.posture {
            kinematics::SerialPosture::Stretched => "stretched",
            kinematics::SerialPosture::Folded => "folded",
            _ => "square to what its motor moves",
        };
        writeln!(
            out,
            "lost          {}: leg {}, {posture}, lets no twist have a part along this (Def. 4)",
            twist(&lost.twist),
            lost.leg
        )?;
    }
    Ok(())
}
