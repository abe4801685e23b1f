//! Solutions as Python has them: one by one, or many as arrays, a solution a row.

use aspecta::Solution;
use aspecta::robot::work;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// The parts of a solution: pose, q, mode, det A, residual, certified, within limits, serial legs.
pub type Parts<'py> =
    (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, String, f64, f64, bool, bool, Bound<'py, PyTuple>);

/// The parts of one solution.
pub fn parts<'py>(py: Python<'py>, s: &Solution) -> PyResult<Parts<'py>> {
    let serial = PyTuple::new(py, s.serial_legs.iter().map(|leg| leg.number()))?;
    let (pose, q) = (PyArray1::from_slice(py, &s.pose), PyArray1::from_slice(py, &s.q));
    Ok((pose, q, s.mode.to_string(), s.det_a, s.residual, s.certified, s.within_limits, serial))
}

/// Columns of solutions.
#[derive(Default)]
pub struct Columns {
    /// Which of the rows asked about.
    row: Vec<i64>,
    pose: Vec<f64>,
    q: Vec<f64>,
    /// Signs of the working mode, leg by leg.
    signs: Vec<i8>,
    det_a: Vec<f64>,
    residual: Vec<f64>,
    certified: Vec<bool>,
    within_limits: Vec<bool>,
    serial: Vec<bool>,
    /// How many rows were asked about.
    rows: usize,
    /// Of each row, of direct solutions: whether they are proved to be all.
    complete: Vec<bool>,
}

impl Columns {
    /// Adds the solutions of one row.
    pub fn push(&mut self, row: usize, dof: usize, solutions: &[Solution], complete: Option<bool>) {
        for s in solutions {
            self.row.push(row as i64);
            self.pose.extend(&s.pose);
            self.q.extend(&s.q);
            self.signs.extend(s.mode.signs());
            self.det_a.push(s.det_a);
            self.residual.push(s.residual);
            self.certified.push(s.certified);
            self.within_limits.push(s.within_limits);
            self.serial.extend((0..dof).map(|j| s.serial_legs.iter().any(|leg| leg.index() == j)));
        }
        self.rows += 1;
        self.complete.extend(complete);
    }

    /// The columns of one part of the rows after the other.
    pub fn joined(parts: Vec<Self>) -> Self {
        fn one<T: Copy + Send + Sync>(parts: &[Columns], column: fn(&Columns) -> &Vec<T>) -> Vec<T> {
            let columns: Vec<&[T]> = parts.iter().map(|part| &column(part)[..]).collect();
            columns.concat()
        }
        let parts = &parts[..];
        let (row, det_a, residual) =
            (one(parts, |p| &p.row), one(parts, |p| &p.det_a), one(parts, |p| &p.residual));
        let ((pose, signs), (q, serial)) = work::join(
            || (one(parts, |p| &p.pose), one(parts, |p| &p.signs)),
            || (one(parts, |p| &p.q), one(parts, |p| &p.serial)),
        );
        Self {
            row,
            pose,
            q,
            signs,
            det_a,
            residual,
            serial,
            certified: one(parts, |p| &p.certified),
            within_limits: one(parts, |p| &p.within_limits),
            rows: parts.iter().map(|p| p.rows).sum(),
            complete: one(parts, |p| &p.complete),
        }
    }

    /// Arrays by name.
    pub fn into_arrays(self, py: Python<'_>, dof: usize) -> PyResult<Bound<'_, PyDict>> {
        let shape = [self.row.len(), dof];
        let arrays = PyDict::new(py);
        arrays.set_item("row", PyArray1::from_vec(py, self.row))?;
        arrays.set_item("pose", PyArray1::from_vec(py, self.pose).reshape(shape)?)?;
        arrays.set_item("q", PyArray1::from_vec(py, self.q).reshape(shape)?)?;
        arrays.set_item("signs", PyArray1::from_vec(py, self.signs).reshape(shape)?)?;
        arrays.set_item("det_a", PyArray1::from_vec(py, self.det_a))?;
        arrays.set_item("residual", PyArray1::from_vec(py, self.residual))?;
        arrays.set_item("certified", PyArray1::from_vec(py, self.certified))?;
        arrays.set_item("within_limits", PyArray1::from_vec(py, self.within_limits))?;
        arrays.set_item("serial", PyArray1::from_vec(py, self.serial).reshape(shape)?)?;
        arrays.set_item("rows", self.rows)?;
        arrays.set_item("complete", PyArray1::from_vec(py, self.complete))?;
        Ok(arrays)
    }
}
