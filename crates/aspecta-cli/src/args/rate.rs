//! `--rate`: how finely a motion is written.

use crate::failure::Failure;
use clap::Args;

/// Rows a second.
#[derive(Args)]
pub struct Rate {
    /// Rows a second
    #[arg(long, value_name = "HZ", default_value_t = 100.0)]
    pub rate: f64,
}

impl Rate {
    /// Makes sure that it makes sense, as far as it alone tells.
    pub fn check(&self) -> Result<(), Failure> {
        let rate = self.rate;
        let bad = || Failure::Input(format!("--rate: {rate} is not a positive number of rows a second"));
        (rate > 0.0 && rate.is_finite()).then_some(()).ok_or_else(bad)
    }
}
