//! Computations for each of many states of a robot. Main type: [`Columns`].

use groebot::Result;
use groebot::dynamics::{Equations, State, Workspace};
use nalgebra::{DMatrix, DVector};
use pyo3::prelude::*;

use crate::arrays::Numbers;
use crate::errors::{bad_value, raised};
use crate::many::with_rows;

/// Inputs of many states: a configuration, a velocity, and a third list. Each has one row for all states, or one row for each.
pub struct Columns<'a> {
    equations: &'a Equations,
    lists: [Vec<f64>; 3],
    widths: [usize; 3],
    rows: usize,
    one: bool,
}

impl<'a> Columns<'a> {
    /// # Errors
    /// `BadValueError` for another shape than (width,) or (N, width), and for different numbers of rows.
    pub fn new(equations: &'a Equations, q: &Bound<'_, PyAny>, others: &[(&str, &Bound<'_, PyAny>)]) -> PyResult<Self> {
        let widths = [equations.coordinates(), equations.freedoms(), equations.freedoms()];
        let mut columns = Columns { equations, lists: Default::default(), widths, rows: 1, one: true };
        for (place, (name, list)) in [("q", q)].iter().chain(others).enumerate() {
            let numbers = Numbers::of(list)?;
            match *numbers.shape() {
                [width] if width == widths[place] => {}
                [rows, width] if width == widths[place] && (columns.one || rows == columns.rows) => {
                    (columns.rows, columns.one) = (rows, false);
                }
                _ => {
                    let text = format!(
                        "`{name}` has the shape {:?}; give ({},), or (N, {}) with as many rows as others have",
                        numbers.shape(),
                        widths[place],
                        widths[place]
                    );
                    return Err(bad_value(text));
                }
            }
            columns.lists[place] = numbers.to_vec()?;
        }
        Ok(columns)
    }

    /// Computes a result for each state. Returns an array of this shape, with an additional first axis for several
    /// states.
    ///
    /// # Errors
    /// `BadValueError` with the row.
    pub fn rows<'py>(
        &self,
        py: Python<'py>,
        own: &[usize],
        compute: impl Fn(&mut Workspace, State<'_>, &[f64]) -> Result<Vec<f64>> + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let list =
            py.detach(|| {
                let mut room = self.equations.workspace();
                let mut all = Vec::new();
                for row in 0..self.rows {
                    let [q, velocity, third] = [0, 1, 2].map(|place| self.row(place, row));
                    let computed = compute(&mut room, State::new(q, velocity), third);
                    all.extend(computed.map_err(|error| {
                        if self.one { error } else { error.with_context(format_args!("row {row}")) }
                    })?);
                }
                Ok(all)
            });
        with_rows(py, list.map_err(|error| raised(&error))?, self.rows, own, self.one)
    }

    fn row(&self, place: usize, row: usize) -> &[f64] {
        let (list, width) = (&self.lists[place], self.widths[place]);
        if list.len() <= width { list } else { &list[row * width..][..width] }
    }
}

/// The entries of a vector.
pub fn vector(computed: Result<&DVector<f64>>) -> Result<Vec<f64>> {
    computed.map(|vector| vector.as_slice().to_vec())
}

/// The entries of a matrix, row by row.
pub fn matrix(computed: Result<&DMatrix<f64>>) -> Result<Vec<f64>> {
    computed.map(|matrix| matrix.transpose().as_slice().to_vec())
}
