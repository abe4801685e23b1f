//! Certificates, checked.

use crate::error;
use crate::watch::watched;
use aspecta::Certificate;
use pyo3::prelude::*;

/// Checks the certificate in a JSON text by code that shares next to nothing with what wrote it. Returns the verdict as
/// JSON, its summary, and whether it is verified.
#[pyfunction]
pub fn verify(py: Python<'_>, certificate: &[u8], progress: Option<Bound<'_, PyAny>>) -> PyResult<Py<PyAny>> {
    let certificate = Certificate::from_json(certificate).map_err(error::of)?;
    let found = watched(py, progress.as_ref(), move |control| aspecta::verify(&certificate, control))?;
    found.or_partial(py, |verdict| Ok((error::json(&verdict)?, verdict.to_string(), verdict.is_verified())))
}
