//! Certificates: all that is claimed of a robot's aspects, in a form that another program can check.
//!
//! The file format is described in `docs/certificate.md`; [`crate`] checks it. Nothing in a certificate is to be believed.

mod check;
mod scale;
mod tree;

pub use check::Unsound;
pub use tree::{DEEPEST, Entry, Leaf, Tree, TreeError};

use aspecta_robot::chart::Chart;
pub use aspecta_robot::constraint::Scale;
use aspecta_robot::{Robot, Window, WorkingMode};
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Version of the file format; raised when a field changes its meaning or goes away.
pub const FORMAT_VERSION: u32 = 2;

/// The largest file that is read, in bytes: more than an analysis of as many boxes as there may be writes, some
/// 16 bytes each.
const LARGEST: u64 = 1 << 30;

/// Bounds on the numbers of aspects and what proves them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`FORMAT_VERSION`].
    pub certificate_version: u32,
    /// The robot.
    pub robot: Robot,
    /// The poses that were analysed: [`Robot::slice`] of it.
    pub window: Window,
    /// The working modes, in the order of the class bits: class 2m is mode m with det A > 0, class 2m + 1 with det A < 0.
    pub modes: Vec<WorkingMode>,
    /// The divisors of the functions whose minimum is P.
    pub scale: Scale,
    /// The bounds claimed, one entry per class.
    pub claims: Vec<Claim>,
    /// Sheet 0 is in pose coordinates; the others are charts that replace the boxes of earlier sheets that are covered.
    pub sheets: Vec<Sheet>,
    /// Paths that join inside boxes of a sheet.
    pub joins: Vec<Join>,
    /// Points that inside boxes of sheets share with inside boxes of the sheets beneath them.
    pub seams: Vec<Seam>,
}

/// The number of aspects of a class is at least `low` and at most `high`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// At least this many.
    pub low: usize,
    /// At most this many, if anything is claimed.
    pub high: Option<usize>,
}

/// The paving of one chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sheet {
    /// The coordinates in which the boxes are given.
    pub chart: Chart,
    /// The boxes.
    pub tree: Tree,
}

/// A polyline in S_{s,σ} from an inside box of a sheet to another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Join {
    /// The class.
    pub class: usize,
    /// The sheet.
    pub sheet: usize,
    /// Points, to be joined by straight segments in the coordinates of that sheet.
    pub path: Vec<Vec<f64>>,
}

/// A configuration that lies in an inside box of a sheet from 1 on and in one of the sheet beneath: of sheet 0, as a pose, or of sheet 1 if that is
/// a chain and the former a bend of another leg.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seam {
    /// The class.
    pub class: usize,
    /// The sheet.
    pub sheet: usize,
    /// The point, in the coordinates of that sheet.
    pub point: Vec<f64>,
}

/// Why a file is no certificate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CertificateError {
    /// The file cannot be read.
    #[error("cannot read `{}`: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// It is too large for this program.
    #[error("`{}`: larger than the {} MiB that a certificate may hold", path.display(), LARGEST >> 20)]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// It is not the JSON of a certificate; the message says where.
    #[error("not a certificate, or damaged: {0}")]
    Form(#[from] serde_json::Error),
    /// Another version of the format.
    #[error("the certificate has version {found}, this program reads version {FORMAT_VERSION}")]
    Version {
        /// The version.
        found: u32,
    },
    /// The parts do not fit together.
    #[error("the certificate makes no sense: {0}")]
    Unsound(#[from] Unsound),
}

impl Certificate {
    /// The certificate in a file.
    ///
    /// # Errors
    /// [`CertificateError`]
    pub fn load(path: &Path) -> Result<Self, CertificateError> {
        let unreadable = |error| CertificateError::Read { path: path.to_owned(), error };
        let mut text = Vec::new();
        File::open(path).and_then(|f| f.take(LARGEST + 1).read_to_end(&mut text)).map_err(unreadable)?;
        if text.len() as u64 > LARGEST {
            return Err(CertificateError::TooLarge { path: path.to_owned() });
        }
        Self::from_json(&text)
    }

    /// The certificate in a JSON text.
    ///
    /// # Errors
    /// [`CertificateError`] if the text is none, or its parts do not fit together.
    ///
    /// # Examples
    /// ```
    /// use aspecta_verify::certificate::{Certificate, CertificateError};
    ///
    /// let refused = Certificate::from_json(b"{ \"certificate_version\": 2 }");
    /// assert!(matches!(refused, Err(CertificateError::Form(_))));
    /// ```
    pub fn from_json(text: &[u8]) -> Result<Self, CertificateError> {
        let certificate: Self = serde_json::from_slice(text)?;
        if certificate.certificate_version != FORMAT_VERSION {
            return Err(CertificateError::Version { found: certificate.certificate_version });
        }
        certificate.check()?;
        Ok(certificate)
    }

    /// The leaves of all sheets.
    pub(crate) fn leaves(&self) -> impl Iterator<Item = &Leaf> {
        let entries = self.sheets.iter().flat_map(|sheet| &sheet.tree.0);
        entries.filter_map(|entry| if let Entry::Leaf(leaf) = entry { Some(leaf) } else { None })
    }

    /// The text of its file.
    ///
    /// # Errors
    /// Those of the JSON writer.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }
}
