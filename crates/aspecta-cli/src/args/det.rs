//! `--det`: a sign of det A.

use aspecta::aspect::DetSign;
use clap::{Args, ValueEnum};

/// A sign of det A, if one is given. Each command says what for.
#[derive(Args)]
pub struct DetArg {
    #[arg(long, value_name = "SIGN", allow_hyphen_values = true)]
    det: Option<Sign>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Sign {
    #[value(name = "+")]
    Plus,
    #[value(name = "-")]
    Minus,
}

impl DetArg {
    /// The sign.
    pub fn sign(&self) -> Option<DetSign> {
        self.det.map(|sign| match sign {
            Sign::Plus => DetSign::Positive,
            Sign::Minus => DetSign::Negative,
        })
    }
}
