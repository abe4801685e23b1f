//! `--threads`: how many cores long work takes.

use clap::Args;

/// How many threads.
#[derive(Args, Clone, Copy)]
pub struct Threads {
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

/// The help of `--threads` where it is no matter what is chosen.
pub const OF_NO_WEIGHT: &str = "Number of threads [default: all cores]; the result does not depend on it";
