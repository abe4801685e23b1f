//! # Aspecta
//!
//! Which solution is a parallel robot in, and where can it go from there without meeting a singularity?
//!
//! The theory is Chablat & Wenger, *Mechanism and Machine Theory* 36(6), 2001; "the paper" throughout.
//!
//! # Examples
//! ```
//! use aspecta::{AspectId, Budget, Control, DomainOptions, Kinematics, Map, MappedAspect, Options, Robot};
//!
//! # fn main() -> Result<(), aspecta::Error> {
//! let robot = Robot::resolve("five-bar")?;
//! let pose = [4.0, 7.0];
//! let solutions = robot.inverse(&pose)?; // one per working mode
//! assert_eq!(solutions.len(), 4);
//!
//! // Definition 8: the generalized aspects, and proved bounds on their number.
//! let budget = Budget { depth: Some(7), ..Budget::default() };
//! let options = Options { budget, ..Options::default() };
//! let analysis = aspecta::analyze(&robot, &options, &Control::unwatched())?;
//! assert!(analysis.aspects.low >= 8);
//!
//! // Theorem 3: where in the first of them a joint vector means one pose.
//! let options = DomainOptions { cells: 20, samples: 100 };
//! let domains = aspecta::domains(&analysis, AspectId::new(1), &options, &Control::unwatched())?;
//! let map = Map::new(&analysis, vec![MappedAspect { domains, surfaces: None }]);
//! let location = map.locate(&pose, solutions[0].mode)?;
//! assert_eq!(location.mode.to_string(), "++");
//!
//! // Is the straight segment to another pose free of singularities, between its ends too?
//! let check = aspecta::check_path(&robot, &[pose.to_vec(), vec![4.5, 7.5]], location.mode)?;
//! assert_eq!(check.singularity_free, Some(true));
//! # Ok(())
//! # }
//! ```
//!
//! # What is where
//! | question | here |
//! |---|---|
//! | which robots are there, what does a file describe | [`Robot`], [`catalogue`] |
//! | all joint vectors of a pose, all poses of a joint vector (5) | [`Kinematics::inverse`], [`Kinematics::direct_certified`] |
//! | Jacobians (2), kind of singularity (Defs 3 and 4) | [`Kinematics::state`] |
//! | working modes (Def. 7), aspects (Def. 8) and their number | [`analyze()`] |
//! | is the number right? checked by independent code | [`Certificate`], [`verify()`] |
//! | basic regions (Def. 10), uniqueness domains (Theorem 3) | [`domains()`] |
//! | in which aspect, region and domains is a pose | [`Map::locate`], [`Analysis::locate`] |
//! | does a path meet a singularity, how near does it come | [`check_path()`], [`check_poses()`], [`check_joints()`] |
//! | how to get there without one | [`Planner`]; six coordinates: [`explore::plan`](motion::explore::plan()) |
//! | which aspects are joined by changes of posture | [`ModeGraph`] |
//! | which aspects hold a set of poses | [`traversability()`] |
//! | the poses of a joint vector, by aspect | [`assembly_modes()`] |
//! | where three direct solutions meet | [`cusps()`] |
//! | how fast can the joints run through a path | [`trajectory()`] |
//! | which pose now? in a control loop | [`Follower`], [`InverseFollower`] |
//! | the whole pose space of a robot with six coordinates | [`explore()`] |
//!
//! Results print (`{}`) as the summary that the terminal shows: [`Analysis`], [`Domains`], [`PathCheck`], [`Plan`] and [`Route`], [`Verdict`];
//! with angles in degrees as [`PathSummary`] and [`RouteSummary`].
//!
//! The names of this page are the front door, and what a version promises. The modules hold what they are made of, and
//! the types of their fields: data flows one way, [`robot`] → [`kinematics`] → [`paving`] → [`aspect`] → [`domain`] →
//! [`motion`], and beside it stands [`verify`](mod@verify), which shares next to nothing with the rest and checks what
//! [`certificate`]s claim. Kernels ([`paving`], [`num`], [`legs`]) change from one version to the next.

// A variant that is added leads to every place that must decide about it.
#![warn(clippy::wildcard_enum_match_arm)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod aspect;
pub mod domain;
mod error;
mod id;
pub mod motion;
pub mod paving;
#[doc(hidden)]
pub mod text;

pub use aspecta_kinematics as kinematics;
pub use aspecta_robot as robot;
pub use aspecta_robot::{catalogue, legs, num};
pub use aspecta_verify as verify;
pub use aspecta_verify::certificate;

// The front door, in the order in which a robot goes through it.
#[doc(inline)]
pub use aspecta_kinematics::constraints::Margins;
#[doc(inline)]
pub use aspecta_kinematics::cusps::{Cusps, Options as CuspOptions, cusps};
#[doc(inline)]
pub use aspecta_kinematics::follow::{Follower, InverseFollower};
#[doc(inline)]
pub use aspecta_kinematics::path::time::{JointLimits, Trajectory, trajectory};
#[doc(inline)]
pub use aspecta_kinematics::path::{
    Joined, PathCheck, PathOptions, PathSummary, check_joints, check_path, check_poses,
};
#[doc(inline)]
pub use aspecta_kinematics::{DirectSolutions, Kinematics, Singularity, Solution, State};
#[doc(inline)]
pub use aspecta_robot::work::Control;
#[doc(inline)]
pub use aspecta_robot::{Actuator, Leg, LegIndex, Platform, Robot, WorkingMode};
#[doc(inline)]
pub use aspecta_verify::certificate::Certificate;
#[doc(inline)]
pub use aspecta_verify::{Verdict, verify};

pub use aspect::{Analysis, Aspect, AspectId, ClassId, DetSign, Options, Purpose, analyze};
pub use domain::{DomainOptions, Domains, Location, Map, MappedAspect, RegionId, domains};
pub use error::Error;
pub use motion::assembly::{AssemblyModes, assembly_modes};
pub use motion::explore::{Effort, Exploration, explore};
pub use motion::modes::{ModeGraph, Route};
pub use motion::plan::{Plan, PlanOptions, Planner};
pub use motion::traverse::{PoseSet, Traversability, traversability};
pub use paving::Budget;
pub use text::RouteSummary;
