//! Joint limits as people read them.

use super::brief;
use crate::{Clearance, Limit};

impl Limit {
    /// The limit in words: `q from -0.3491 to 3.4907 rad`; lengths are in `unit`.
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::catalogue;
    ///
    /// let strut = &catalogue::find("gough-stewart").unwrap().legs[0];
    /// assert_eq!(strut.limits[0].in_words("m"), "q from 0.2000 to 2.0000 m");
    /// ```
    pub fn in_words(&self, unit: &str) -> String {
        match self {
            Self::ActuatorAngle { half_cos, .. } => {
                range("q", self.middle_angle().unwrap_or(0.0), half_cos.mid().acos())
            }
            Self::ActuatorLength { min, max } => {
                format!("q from {} to {} {unit}", brief(min.mid()), brief(max.mid()))
            }
            Self::Elbow { middle: (cos, sin), half_cos } => {
                range("elbow", sin.mid().atan2(cos.mid()), half_cos.mid().acos())
            }
            Self::SpatialElbow { min_cos, max_cos } => {
                format!("elbow from {} to {} rad", brief(min_cos.mid().acos()), brief(max_cos.mid().acos()))
            }
            Self::BaseCone { half_cos, .. } => {
                format!("base joint within {} rad", brief(half_cos.mid().acos()))
            }
            Self::PlatformCone { half_cos, .. } => {
                format!("platform joint within {} rad", brief(half_cos.mid().acos()))
            }
            Self::Clearance(Clearance { obstacle, part, distance, .. }) => {
                format!("{} {} {unit} from obstacle {obstacle}", part.name(), brief(distance.mid()))
            }
        }
    }
}

fn range(what: &str, middle: f64, half: f64) -> String {
    format!("{what} from {} to {} rad", brief(middle - half), brief(middle + half))
}
