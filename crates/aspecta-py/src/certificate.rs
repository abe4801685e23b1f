//! Certificates, checked.

use crate::error;
use crate::watch::watched;
use aspecta::Certificate;
use pyo3::prelude::*;

/// A verdict: its JSON, its summary, whether it is verified.
type Verdict = (String, String, bool);

/// Checks the certificate in a JSON text by code that shares next to nothing with what wrote it. Returns the verdict as
/// JSON, its summary, whether it is verified, and the exception that ended it early.
#[pyfunction]
pub fn verify(
    py: Python<'_>,
    certificate: &[u8],
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(Option<Verdict>, Option<PyErr>)> {
    let certificate = Certificate::from_json(certificate).map_err(error::of)?;
    let found = watched(py, progress.as_ref(), move |control| aspecta::verify(&certificate, control))?;
    let told = |verdict: aspecta::Verdict| {
        Ok::<_, PyErr>((error::json(&verdict)?, verdict.to_string(), verdict.is_verified()))
    };
    Ok((found.result.map(told).transpose()?, found.interrupted))
}
