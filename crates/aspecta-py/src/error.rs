//! Errors as Python raises them: the library's own words.

use aspecta::motion::modes::NoRoute;
use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::Serialize;
use std::fmt::Display;
use std::path::Path;

create_exception!(
    aspecta,
    Error,
    PyValueError,
    "Input that makes no sense for the robot, or a question it cannot be asked."
);
create_exception!(
    aspecta,
    NoPlan,
    Error,
    "There is no motion, or none was found.

Attributes:
    proved: whether it is proved that there is none.
    finer: whether finer boxes may find one."
);

/// An error of the libraries.
pub fn of(error: impl Into<aspecta::Error>) -> PyErr {
    Error::new_err(error.into().to_string())
}

/// What is wrong with a file or a directory, which is named.
pub fn at(path: &Path, reason: impl Display) -> PyErr {
    Error::new_err(format!("`{}`: {reason}", path.display()))
}

/// The refusal to plan: `proved` where there is no motion at all, `finer` where finer boxes may find one.
pub fn no_plan(py: Python<'_>, refusal: &NoRoute) -> PyErr {
    if refusal.is_bad_input() {
        return Error::new_err(refusal.to_string());
    }
    let error = NoPlan::new_err(refusal.to_string());
    let marked = error
        .value(py)
        .setattr("proved", refusal.is_proof())
        .and_then(|()| error.value(py).setattr("finer", refusal.is_of_resolution()));
    marked.map_or_else(|other| other, |()| error)
}

/// A value as JSON.
pub fn json(value: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(of)
}
