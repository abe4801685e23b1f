//! The facts that hold for all legs of a kind.

use super::Part;
use crate::Platform;

/// The facts that hold for all legs of a kind.
#[derive(Debug)]
pub struct Facts {
    /// The name used in robot files.
    pub name: &'static str,
    /// The keys beside `kind` that such an actuator has in a robot file in the plane; it takes no others.
    pub planar_keys: &'static [&'static str],
    /// The keys of a leg in space, all of which it needs.
    pub spatial_keys: &'static [&'static str],
    /// Whether the leg drives a platform that turns about a point, and no other.
    pub is_on_sphere: bool,
    /// How many inverse solutions a leg has.
    pub postures: usize,
    /// What the postures with the signs + and − are called; none has a name where there is one only.
    pub posture_names: &'static [&'static str],
    /// Why the sign of ∂f/∂q names them.
    pub why_not_cuspidal: &'static str,
    /// Whether q is an angle (rad) rather than a length.
    pub is_angle: bool,
    /// Whether q is a length that is positive in every configuration.
    pub is_positive: bool,
    /// Whether there is an angle between crank and rod that can be limited.
    pub has_elbow: bool,
    /// Whether there is a rod (a strut) whose direction can be limited.
    pub has_rod: bool,
    /// The parts of a drawn leg, in the order of a legend.
    pub parts: &'static [Part],
}

impl Facts {
    /// The keys beside `kind` that such an actuator needs in the plane (2) or in space (3); it takes no
    /// others.
    pub const fn keys(&self, space: usize) -> &'static [&'static str] {
        if space == 2 { self.planar_keys } else { self.spatial_keys }
    }

    /// Whether legs of the kind drive such a platform.
    pub fn fits(&self, platform: Platform) -> bool {
        self.is_on_sphere == (platform == Platform::TurningBody)
    }
}

/// [`Facts::why_not_cuspidal`] of legs with a quadratic equation.
pub(super) const ROOTS_OF_A_QUADRATIC: &str = "two postures, the roots of a quadratic in closed form: the sign of \
                                               B_jj names them, and they meet only where B_jj = 0";
