//! Certificates, checked.

use crate::error;
use crate::watch::watched_within;
use aspecta::Certificate;
use pyo3::prelude::*;

/// Checks the certificate in a JSON text by code that shares next to nothing with what wrote it. Returns the verdict as
/// JSON, and its summary.
#[pyfunction]
pub fn verify(
    py: Python<'_>,
    certificate: &[u8],
    seconds: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let certificate = Certificate::from_json(certificate).map_err(error::of)?;
    let check = move |control: &aspecta::Control<'_>| aspecta::verify(&certificate, control);
    let found = watched_within(py, seconds, progress.as_ref(), check)?;
    found.or_partial(py, |verdict| Ok((error::json(&verdict)?, verdict.to_string())))
}
