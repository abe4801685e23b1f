//! The program `aspecta`.

use std::process::ExitCode;

fn main() -> ExitCode {
    aspecta_cli::main()
}
