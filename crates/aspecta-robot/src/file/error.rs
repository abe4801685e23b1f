//! The mistakes a robot file can have, worded so that the reader can mend them.

use super::format::hint;
use crate::RobotError;
use crate::num::written;
use std::borrow::Cow;
use std::fmt;

/// Why a robot could not be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file does not exist or cannot be read as text.
    #[error("{file}: cannot be read: {reason}")]
    Unreadable {
        /// Path, as given.
        file: String,
        /// The system's reason.
        #[source]
        reason: std::io::Error,
    },
    /// The file is too large for a robot.
    #[error("{file}: larger than the {} KiB that a robot file may hold", super::LARGEST >> 10)]
    TooLarge {
        /// Path, as given.
        file: String,
    },
    /// Neither a built-in robot nor a file.
    #[error("`{name}` is neither a built-in robot nor a file{}; built-in robots: {}", suggest(.closest), super::catalogue_names())]
    UnknownRobot {
        /// The name asked for.
        name: String,
        /// Built-in names that look like it, most similar first.
        closest: Vec<String>,
    },
    /// The file is not a robot.
    #[error(transparent)]
    Invalid(#[from] Box<Mistake>),
}

/// A mistake in a robot file, and where it is.
///
/// Printed as `file:line:column: key = value: what is wrong; what to do`, with the line of the file below.
#[derive(Debug)]
pub struct Mistake {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The key, as in `legs[2].actuator.crank`: legs are numbered from 1. Empty if it is the file as a whole.
    pub key: String,
    /// The value as the file has it; empty for tables and missing keys.
    pub value: String,
    /// The mistake.
    pub problem: Problem,
    /// The line of the file.
    pub source_line: String,
    /// How many characters to underline.
    pub width: usize,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        if !self.key.is_empty() {
            let equals = if self.value.is_empty() { "" } else { " = " };
            write!(f, "{}{equals}{}: ", short(&self.key), short(&self.value))?;
        }
        let number = self.line.to_string();
        let gutter = " ".repeat(number.len());
        let is_long = self.source_line.chars().nth(SHOWN).is_some();
        let skipped = if is_long { self.column.saturating_sub(SHOWN / 2) } else { 0 };
        let line: String = self.source_line.chars().skip(skipped).collect();
        writeln!(f, "{}\n{gutter} |\n{number} | {}", self.problem, short(&line))?;
        // Tabs stay tabs, so that the underline stands below its place.
        let lead = line.chars().take(self.column - 1 - skipped);
        let lead: String = lead.map(|c| if c == '\t' { c } else { ' ' }).collect();
        write!(f, "{gutter} | {lead}{}", "^".repeat(self.width.min(SHOWN)))
    }
}

/// The most characters of a key, a value or a line of a file that are printed.
const SHOWN: usize = 200;

/// A text of which no more is left than is printed.
fn short(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]).into(),
        None => text.into(),
    }
}

impl std::error::Error for Mistake {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.problem)
    }
}

/// The kinds of mistakes, each with its way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Problem {
    /// Not TOML.
    #[error("this is not TOML: {}; if the file looks right up to here, it may have been cut off", short(.0))]
    Syntax(String),
    /// A key that stands twice in a table.
    #[error("`{}` is given a second time; keep one of them", short(.0))]
    DuplicateKey(String),
    /// A name without letters.
    #[error("the name is empty; {}", hint("name"))]
    Nameless,
    /// Words with line breaks and the like.
    #[error("a line break, tab or other character that cannot be seen; write it in one line, with blanks")]
    NotOneLine,
    /// A key no robot file has here.
    #[error("unknown key{}; the keys here are {}", suggest(.closest), list(.known))]
    UnknownKey {
        /// Known keys that look like it.
        closest: Vec<String>,
        /// All known keys.
        known: Vec<String>,
    },
    /// A name that is not in its list (platform, kind, unit).
    #[error("unknown name{}; give one of {}", suggest(.closest), list(.known))]
    UnknownName {
        /// Known names that look like it.
        closest: Vec<String>,
        /// All known names.
        known: Vec<String>,
    },
    /// A key that must be there is not.
    #[error("missing key `{key}`: {hint}")]
    MissingKey {
        /// The key.
        key: String,
        /// Advice on what to write.
        hint: &'static str,
    },
    /// A key that has no meaning on this robot.
    #[error("{reason}")]
    OutOfPlace {
        /// Why, and what to do.
        reason: String,
    },
    /// A string for a number and the like.
    #[error("wrong type: {}", short(.0))]
    WrongType(String),
    /// A vector of the wrong length.
    #[error("the legs of a `{platform}` live in {wanted} dimensions: give {wanted} numbers, not {found}")]
    VectorLength {
        /// The platform's name.
        platform: &'static str,
        /// 2 or 3.
        wanted: usize,
        /// Numbers given.
        found: usize,
    },
    /// NaN or infinity.
    #[error("not a finite number; give a finite one, or leave a limit out where there is none")]
    NotFinite,
    /// A decimal that a double takes for an integer it is not.
    #[error("double precision cannot tell this from {nearest}: give fewer digits")]
    TooPrecise {
        /// The integer.
        nearest: f64,
    },
    /// A length that is zero or negative.
    #[error("a length must be positive; directions and signs belong into `axis`, `zero` or `direction`")]
    NotPositive,
    /// A limit that a strut's length cannot fall below.
    #[error("the length of a strut is never negative; the minimum must be at least 0")]
    NegativeMinimum,
    /// A length that is too short or too long.
    #[error(
        "lengths must lie within [1e-6, 1e6] and coordinates within ±1e6: the intervals behind every proof stay \
         finite only for bounded robots; choose another length unit"
    )]
    Magnitude,
    /// A vector that gives no direction.
    #[error("the zero vector has no direction; give a vector of any other length")]
    ZeroVector,
    /// `zero` along `axis`.
    #[error(
        "`zero` is parallel to `axis`, so it does not say where the crank points at q = 0; give a vector across the axis"
    )]
    Parallel,
    /// min ≥ max.
    #[error("contradictory limits: the minimum {} is not below the maximum {}; exchange or widen them", written(*.min), written(*.max))]
    Contradiction {
        /// Lower limit.
        min: f64,
        /// Upper limit.
        max: f64,
    },
    /// A range of a full turn or more.
    #[error("a range of a full turn or more limits nothing; leave it out")]
    FullTurn,
    /// Degrees that are given as radians, it seems.
    #[error(
        "[{}, {}] radians are a full turn or more and would limit nothing; if they are degrees, write {{ deg = [{}, {}] }}",
        written(*.min), written(*.max), written(*.min), written(*.max)
    )]
    DegreesAsRadians {
        /// Lower limit.
        min: f64,
        /// Upper limit.
        max: f64,
    },
    /// An angle outside the range that has a meaning.
    #[error("{what} must lie {range}; give an angle in that range")]
    AngleOutOfRange {
        /// The quantity that it is an angle of.
        what: &'static str,
        /// The range.
        range: &'static str,
    },
    /// A plain range for an angle.
    #[error("{what} is an angle: give its unit, {{ deg = [min, max] }} or {{ rad = [min, max] }}")]
    AngleWanted {
        /// The offending value, described.
        what: String,
    },
    /// An angular range for a length.
    #[error("{what} is a length: give a plain range, [min, max]")]
    LengthWanted {
        /// The offending value, described.
        what: String,
    },
    /// A window on a coordinate the platform does not have.
    #[error("a `{platform}` has no such coordinate; its coordinates are {}", list(.known))]
    UnknownCoordinate {
        /// The platform's name.
        platform: &'static str,
        /// Its coordinates.
        known: Vec<String>,
    },
    /// A window no pose of the robot lies in.
    #[error(
        "contradictory limits: the legs, by their lengths, never take `{coordinate}` there; widen the range or leave it out"
    )]
    OutOfReach {
        /// The coordinate.
        coordinate: &'static str,
    },
    /// Legs that cannot be closed, wherever the platform is.
    #[error(
        "the legs never meet: no value of `{coordinate}` is within reach of all of them; check anchors, attachments, lengths and limits"
    )]
    NeverMeets {
        /// The coordinate.
        coordinate: &'static str,
    },
    /// Legs and platform do not make a robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
}

fn list(names: &[String]) -> String {
    let quoted: Vec<_> = names.iter().map(|n| format!("`{n}`")).collect();
    quoted.join(", ")
}

fn suggest(closest: &[String]) -> String {
    match closest {
        [] => String::new(),
        some => format!(" (did you mean {}?)", list(some).replace(", ", " or ")),
    }
}

/// Returns those of `names` that resemble `word`, most similar first.
pub(super) fn closest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut scored: Vec<_> = names.into_iter().map(|n| (strsim::jaro_winkler(word, n), n)).collect();
    scored.retain(|(score, _)| *score > 0.8);
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored.truncate(3);
    scored.into_iter().map(|(_, n)| n.to_owned()).collect()
}
