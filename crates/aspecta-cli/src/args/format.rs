//! `--json`, `--csv` and `--deg`: how results are shown.

use crate::output::Format;
use clap::Args;

/// The `--json` and `--csv` switches.
#[derive(Args, Clone, Copy)]
pub struct FormatArgs {
    /// Print JSON, and nothing else, on stdout (angles in radians)
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print CSV with a header (angles in radians)
    #[arg(long)]
    csv: bool,
}

/// How what commands find for the vectors they are asked about is shown.
#[derive(Args, Clone, Copy)]
pub struct ShownArgs {
    /// Angles of the input and of the table are in degrees
    #[arg(long)]
    pub deg: bool,
    #[command(flatten)]
    format: FormatArgs,
}

impl ShownArgs {
    /// The format asked for.
    pub fn format(self) -> Format {
        self.format.format()
    }
}

impl FormatArgs {
    /// The format asked for.
    pub fn format(self) -> Format {
        match self {
            Self { json: true, .. } => Format::Json,
            Self { csv: true, .. } => Format::Csv,
            _ => Format::Table,
        }
    }
}
