//! `--json`, `--csv` and `--deg`: how results are shown.

use crate::output::{Format, note};
use clap::Args;
use std::sync::Once;

/// The `--json` and `--csv` switches.
#[derive(Args, Clone, Copy)]
pub struct FormatArgs {
    /// Print JSON, and nothing else, on stdout (angles in radians)
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print CSV with a header (angles in radians, whatever --deg says)
    #[arg(long)]
    csv: bool,
}

/// The `--json` switch.
#[derive(Args, Clone, Copy)]
pub struct JsonArg {
    /// Print JSON, and nothing else, on stdout (angles in radians)
    #[arg(long)]
    pub json: bool,
}

impl JsonArg {
    /// The format asked for.
    pub fn format(self) -> Format {
        if self.json { Format::Json } else { Format::Table }
    }
}

/// How tables are shown, or JSON instead.
#[derive(Args, Clone, Copy)]
pub struct TableArgs {
    /// Angles of the table are in degrees
    #[arg(long)]
    pub deg: bool,
    #[command(flatten)]
    json: JsonArg,
}

impl TableArgs {
    /// Whether JSON is asked for.
    pub fn json(self) -> bool {
        self.json.json
    }

    /// The format asked for.
    pub fn format(self) -> Format {
        self.json.format()
    }
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
        self.format.beside(self.deg)
    }
}

impl FormatArgs {
    /// The format asked for, beside `--deg` or not. Who asks for degrees and gets CSV is told that it is in
    /// radians: the next command would else be told to read degrees.
    pub fn beside(self, degrees: bool) -> Format {
        static TOLD: Once = Once::new();
        match self {
            Self { json: true, .. } => Format::Json,
            Self { csv: true, .. } => {
                if degrees {
                    TOLD.call_once(|| note(IN_RADIANS));
                }
                Format::Csv
            }
            _ => Format::Table,
        }
    }
}

const IN_RADIANS: &str = "\
    warning: angles of this CSV are in radians, as of all that is printed (--deg is for the input and for what \
    people read): what reads it is to go without --deg";
