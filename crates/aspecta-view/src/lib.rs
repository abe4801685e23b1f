//! Drawings and files of the results of Aspecta, for people and for other programs.
//!
//! Every entry point takes a result of the library `aspecta` and returns text, or writes files that are there only when
//! they are complete. Equal results give equal files.
//!
//! | of | is made | by |
//! |---|---|---|
//! | [`Analysis`](aspecta::aspect::Analysis) | `report.html` and its figures | [`write_report`] |
//! | [`Domains`](aspecta::domain::Domains) | pictures of regions and uniqueness domains, meshes | [`write_domains`] |
//! | [`PathCheck`](aspecta::motion::PathCheck) | det A and B along the path (figure 11) | [`figure_11`] |
//! | a path, a plan, a route | a page on which the robot moves | [`Motion`] |
//! | [`ModeGraph`](aspecta::motion::modes::ModeGraph) | the graph of aspects and changes of mode | [`mode_graph`] |
//! | [`Robot`](aspecta::robot::Robot) | a model for MuJoCo | [`mjcf`] |
//! | [`Doubt`](aspecta::aspect::Doubt)s | where and why bounds are apart, in words | [`doubt`] |
//!
//! Nothing here decides anything about a robot. `figure`, `mesh` and `report` are kernels: open to tests, and without
//! a promise of stability.
//!
//! ```
//! use aspecta::kinematics::Solution;
//! use aspecta::{Kinematics, Robot};
//!
//! let robot = Robot::resolve("five-bar")?;
//! let start: Vec<Solution> = robot.inverse(&[2.0, 8.0])?;
//! let model = aspecta_view::mjcf::model(&robot, &start[0]);
//! assert!(model.contains("<mujoco model=\"five-bar\">"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod domains;
mod export;
#[doc(hidden)]
pub mod figure;
pub mod file;
#[doc(hidden)]
pub mod mesh;
#[doc(hidden)]
pub mod report;
pub mod words;
mod xml;

pub use aspecta::text::doubt;
pub use domains::{Choice, MeshFormat, write as write_domains};
pub use export::mjcf;
pub use figure::cut::Cut;
pub use figure::graph::mode_graph;
pub use figure::profile::figure_11;
pub use report::motion::Motion;
pub use report::write as write_report;
