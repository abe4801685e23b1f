//! Working modes (Definition 7): the signs of B_jj, which name the inverse solutions.

use crate::{LegIndex, Robot};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// A vector of n signs, one per leg: sign(B_jj) = sign(∂f_j/∂q_j). Printed as `+-+`.
///
/// Modes are ordered as in Table 1: from `++…+`, each differing from the one before in one leg (Gray's code).
///
/// # Examples
/// ```
/// use aspecta_robot::WorkingMode;
///
/// let mode: WorkingMode = "+-+".parse()?;
/// assert_eq!((mode.legs(), mode.sign(1), mode.to_string().as_str()), (3, -1, "+-+"));
/// assert_eq!(mode, WorkingMode::from_signs([true, false, true]));
/// # Ok::<(), aspecta_robot::NotAMode>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct WorkingMode {
    /// Bit j set: B_jj < 0.
    negative: u8,
    legs: u8,
}

impl WorkingMode {
    /// The mode with the given signs (`true` is +), first leg first. At most 8 legs.
    pub fn from_signs(signs: impl IntoIterator<Item = bool>) -> Self {
        let mut mode = Self { negative: 0, legs: 0 };
        for plus in signs.into_iter().take(8) {
            mode.negative |= u8::from(!plus) << mode.legs;
            mode.legs += 1;
        }
        mode
    }

    /// +1 or −1, the sign of B_jj for the leg with index `j`, from 0.
    pub fn sign(self, j: usize) -> i8 {
        if self.negative >> j & 1 == 1 { -1 } else { 1 }
    }

    /// Every leg in its other posture.
    pub fn opposite(self) -> Self {
        Self::from_signs(self.signs().map(|sign| sign < 0))
    }

    /// This leg in its other posture.
    pub fn with_other_posture(self, leg: LegIndex) -> Self {
        Self { negative: self.negative ^ 1 << leg.index(), ..self }
    }

    /// Number of legs.
    pub fn legs(self) -> usize {
        self.legs.into()
    }

    /// The signs as ±1, first leg first.
    pub fn signs(self) -> impl Iterator<Item = i8> {
        (0..self.legs()).map(move |j| self.sign(j))
    }
}

/// A set of legs, of those whose postures something depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LegSet(u8);

impl LegSet {
    /// No leg.
    pub const NONE: Self = Self(0);
    /// Every leg.
    pub const ALL: Self = Self(u8::MAX);

    /// This leg alone.
    pub fn of(leg: LegIndex) -> Self {
        Self(1 << leg.index())
    }

    /// These two legs.
    pub fn of_two([first, second]: [LegIndex; 2]) -> Self {
        Self(Self::of(first).0 | Self::of(second).0)
    }

    /// The legs of either.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether this leg belongs to it.
    pub fn holds(self, leg: LegIndex) -> bool {
        self.0 >> leg.index() & 1 == 1
    }

    /// Whether two modes have these legs in the same postures.
    pub fn are_alike(self, a: WorkingMode, b: WorkingMode) -> bool {
        (a.negative ^ b.negative) & self.0 == 0
    }

    /// Every choice of postures of these legs, as modes of `legs` legs whose others are positive.
    pub fn choices(self, legs: usize) -> impl Iterator<Item = WorkingMode> {
        let among = self.0 & ((1u16 << legs) - 1) as u8;
        let all = (0..=among).filter(move |negative| negative & !among == 0);
        all.map(move |negative| WorkingMode { negative, legs: legs as u8 })
    }
}

impl Robot {
    /// All working modes in the order of Table 1 (`++`, `+-`, `--`, `-+`): each differs from the one before in one leg. A leg with one inverse solution (a
    /// strut, B = −2q < 0) contributes one sign.
    ///
    /// # Examples
    /// ```
    /// let robot = aspecta_robot::catalogue::find("five-bar").unwrap();
    /// let modes: Vec<String> = robot.working_modes().iter().map(|mode| mode.to_string()).collect();
    /// assert_eq!(modes, ["++", "+-", "--", "-+"]);
    /// ```
    pub fn working_modes(&self) -> Vec<WorkingMode> {
        let n = self.dof();
        (0..1usize << n)
            .map(|k| k ^ k >> 1)
            .map(|bits| WorkingMode::from_signs((0..n).map(|j| bits >> (n - 1 - j) & 1 == 0)))
            .filter(|m| (0..n).all(|j| self.legs[j].actuator.postures() == 2 || m.sign(j) < 0))
            .collect()
    }
}

impl fmt::Display for WorkingMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let signs: String = self.signs().map(|s| if s > 0 { '+' } else { '-' }).collect();
        f.pad(&signs)
    }
}

impl fmt::Debug for WorkingMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "WorkingMode({self})")
    }
}

/// A text that is not a string of `+` and `-`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{0}` is not a working mode: write one sign per leg, such as `+-+`")]
pub struct NotAMode(pub String);

impl FromStr for WorkingMode {
    type Err = NotAMode;
    fn from_str(s: &str) -> Result<Self, NotAMode> {
        let well_formed = !s.is_empty() && s.len() <= 8 && s.chars().all(|c| c == '+' || c == '-');
        if !well_formed {
            return Err(NotAMode(s.into()));
        }
        Ok(Self::from_signs(s.chars().map(|c| c == '+')))
    }
}

impl Serialize for WorkingMode {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for WorkingMode {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        String::deserialize(d)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each choice of the postures of some legs, and which modes make the same.
    #[test]
    fn legs_choose_their_postures() {
        let choices =
            |legs: LegSet| legs.choices(3).map(|mode| mode.to_string()).collect::<Vec<_>>().join(" ");
        assert_eq!(choices(LegSet::NONE), "+++");
        assert_eq!(choices(LegSet::of(LegIndex::new(1))), "+++ +-+");
        assert_eq!(choices(LegSet::ALL).split(' ').count(), 8);
        let [zero, one] = [0, 1].map(|j| LegSet::of(LegIndex::new(j)));
        let [a, b] = ["+-+", "--+"].map(|mode| mode.parse().unwrap());
        assert!(one.are_alike(a, b) && !zero.are_alike(a, b) && !LegSet::ALL.are_alike(a, b));
    }
}
