//! `--avoid`: how far a motion must stay away from singularities.

use crate::failure::Failure;
use aspecta::kinematics::constraints::Margins;
use clap::Args;

/// The margins asked for.
#[derive(Args)]
pub struct Away {
    /// Stay away from singularities: |det Â| at least M and every |B_jj|/max at least N (or M), each from 0
    /// to 1, proved. Â is A with moments divided by the greatest arm of the platform and then every row scaled
    /// to length 1, so that |det Â| is 1 at most
    #[arg(long, value_name = "M[,N]", allow_hyphen_values = true)]
    avoid: Option<String>,
}

impl Away {
    /// Returns the margins as the library takes them; none unless asked for.
    pub fn margins(&self) -> Result<Margins, Failure> {
        let Some(text) = &self.avoid else { return Ok(Margins::default()) };
        let number = |x: &str| x.trim().parse::<f64>().ok().filter(|x| (0.0..1.0).contains(x));
        let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
        match numbers.as_deref() {
            Some([both]) => Ok(Margins { parallel: *both, serial: *both }),
            Some([parallel, serial]) => Ok(Margins { parallel: *parallel, serial: *serial }),
            _ => Err(Failure::Input(format!(
                "--avoid: `{text}` is not a number from 0 to 1 and below it, nor two separated by a comma"
            ))),
        }
    }
}
