//! How finely the map of a robot's aspects is computed.

use super::budget;
use aspecta::paving::Budget;
use clap::Args;

/// How a map is computed.
#[derive(Args)]
pub struct Making {
    /// How fine: cells are 1/N of the workspace's width in each coordinate [default: 500 for 1 or 2
    /// coordinates, 100 for 3; for robots with 6 500, 100 and 30 for 1, 2 and 3 that are free]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=2000))]
    pub cells: Option<u16>,
    /// When to stop telling the aspects apart, as for `analyze` [default: depth=16, 11 and 7 for
    /// 1, 2 and 3 free coordinates]
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    pub budget: Option<Budget>,
}
