//! Working modes by the names of postures.

use crate::{LegIndex, Robot, WorkingMode};

/// A text that names no working mode of the robot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{text}` is not a working mode of `{robot}`; it has {known}")]
pub struct NoSuchMode {
    /// The text.
    pub text: String,
    /// The robot's name.
    pub robot: String,
    /// The modes it has, and how else they may be given.
    pub known: String,
}

impl Robot {
    /// The working mode that a text means: its signs, `+-`, or leg by leg a sign or the name that legs of this
    /// kind have for the posture, `left,-`.
    ///
    /// # Errors
    /// [`NoSuchMode`] if it is none of the robot's.
    ///
    /// # Examples
    /// ```
    /// let robot = aspecta_robot::catalogue::find("five-bar").unwrap();
    /// assert_eq!(robot.working_mode("left,right").ok(), "+-".parse().ok());
    /// assert_eq!(robot.working_mode("+,right"), robot.working_mode("+-"));
    /// assert!(robot.working_mode("left,ahead").unwrap_err().to_string().contains("+ left, - right"));
    /// ```
    pub fn working_mode(&self, text: &str) -> Result<WorkingMode, NoSuchMode> {
        self.mode_that_is(text).ok_or_else(|| {
            let modes: Vec<String> = self.working_modes().iter().map(WorkingMode::to_string).collect();
            let by_name = |words| format!("; or a name for each leg, with commas: {words}");
            NoSuchMode {
                text: text.to_owned(),
                robot: self.name.clone(),
                known: modes.join(", ") + &self.postures_in_words().map_or(String::new(), by_name),
            }
        })
    }

    fn mode_that_is(&self, text: &str) -> Option<WorkingMode> {
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let mode = match parts[..] {
            [signs] => signs.parse().ok()?,
            _ if parts.len() == self.dof() => {
                let signs: Option<Vec<bool>> =
                    parts.iter().enumerate().map(|(j, part)| self.sign(j, part)).collect();
                WorkingMode::from_signs(signs?)
            }
            _ => return None,
        };
        self.working_modes().contains(&mode).then_some(mode)
    }

    /// Whether a posture of leg j, by its sign or by its name, is that of the sign +.
    fn sign(&self, j: usize, posture: &str) -> Option<bool> {
        match posture {
            "+" => Some(true),
            "-" => Some(false),
            name => self.posture_names(j).iter().position(|known| *known == name).map(|k| k == 0),
        }
    }

    fn posture_names(&self, j: usize) -> &'static [&'static str] {
        self.legs[j].actuator.kind().facts().posture_names
    }

    /// A mode by the names of its postures, `left,right`, as [`Robot::working_mode`] reads it; `None` if no leg has a
    /// posture with a name.
    ///
    /// # Examples
    /// ```
    /// let robot = aspecta_robot::catalogue::find("2-prr").unwrap();
    /// assert_eq!(robot.mode_in_words("+-".parse().unwrap()).as_deref(), Some("ahead,behind"));
    /// ```
    pub fn mode_in_words(&self, mode: WorkingMode) -> Option<String> {
        let name = |j| self.posture_names(j).get(usize::from(mode.sign(j) < 0)).copied();
        let names: Vec<Option<&str>> = (0..self.dof()).map(name).collect();
        let words: Vec<&str> = names.iter().map(|name| name.unwrap_or("-")).collect();
        names.iter().any(Option::is_some).then(|| words.join(","))
    }

    /// The names of the postures with their signs, `+ left, - right`, leg by leg where they differ; `None` if
    /// every leg has one posture only.
    ///
    /// # Examples
    /// ```
    /// let robot = aspecta_robot::catalogue::find("2-prr").unwrap();
    /// assert_eq!(robot.postures_in_words().as_deref(), Some("+ ahead, - behind"));
    /// ```
    pub fn postures_in_words(&self) -> Option<String> {
        let words = |j| match self.posture_names(j) {
            [plus, minus] => format!("+ {plus}, - {minus}"),
            _ => "- always".into(),
        };
        let all: Vec<String> = (0..self.dof()).map(words).collect();
        if all.iter().any(|other| *other != all[0]) {
            let of_leg = |(j, words): (usize, &String)| format!("leg {} {words}", LegIndex::new(j));
            return Some(all.iter().enumerate().map(of_leg).collect::<Vec<_>>().join("; "));
        }
        all.into_iter().next().filter(|_| !self.posture_names(0).is_empty())
    }
}
