//! Many solutions as arrays, a solution a row.

use aspecta::Solution;
use numpy::{PyArray1, PyArrayMethods, ToPyArray};
use pyo3::prelude::*;
use pyo3::types::PyDict;

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
    /// Of each row asked about: whether its solutions are proved to be all.
    complete: Vec<bool>,
}

impl Columns {
    /// Adds the solutions of one row.
    pub fn push(&mut self, row: usize, dof: usize, solutions: &[Solution], complete: bool) {
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
        self.complete.push(complete);
    }

    /// Adds the columns of later rows.
    pub fn append(&mut self, mut later: Self) {
        self.row.append(&mut later.row);
        self.pose.append(&mut later.pose);
        self.q.append(&mut later.q);
        self.signs.append(&mut later.signs);
        self.det_a.append(&mut later.det_a);
        self.residual.append(&mut later.residual);
        self.certified.append(&mut later.certified);
        self.within_limits.append(&mut later.within_limits);
        self.serial.append(&mut later.serial);
        self.complete.append(&mut later.complete);
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
        arrays.set_item("certified", self.certified.to_pyarray(py))?;
        arrays.set_item("within_limits", self.within_limits.to_pyarray(py))?;
        arrays.set_item("serial", PyArray1::from_vec(py, self.serial).reshape(shape)?)?;
        arrays.set_item("complete", self.complete.to_pyarray(py))?;
        Ok(arrays)
    }
}
