//! Targets in the numpy forms that are accepted. Main type: [`Targets`].

use groebot::solver::TaskPlacement;

use crate::batch;
use crate::rotation::{self, matrix_of_quaternion, project};
use crate::sink::Status;

/// Tolerance of the last row of a matrix.
const LAST_ROW: f64 = 1e-9;

/// Form of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A matrix with four rows.
    Matrix,
    /// The solver's own numbers: a position, a rotation by rows, ...
    Numbers,
    /// Same as `Numbers`, but with a quaternion x, y, z, w for the rotation.
    Quaternion,
}

/// Many targets, row by row.
#[derive(Clone, Copy)]
pub struct Targets<'a> {
    pub data: &'a [f64],
    pub form: Form,
    /// Numbers of a target in one row of the array, and numbers of a target.
    pub width: usize,
    pub inputs: usize,
    /// Index of the first number of the rotation, if the target has one.
    pub rotation: Option<usize>,
    /// The values of given joints, appended to the numbers of a target: one row for all, or one row for each.
    pub given: &'a [f64],
    /// Largest deviation of a rotation that is projected onto the nearest one: see [`project`].
    pub tolerance: f64,
    /// Where base and tool are.
    pub placement: Option<&'a TaskPlacement>,
}

impl<'a> Targets<'a> {
    /// The same targets, seen from a world in which base and tool are placed.
    pub fn placed(self, placement: Option<&'a TaskPlacement>) -> Self {
        Targets { placement, ..self }
    }

    pub fn len(&self) -> usize {
        self.data.len() / self.width
    }

    /// Writes the numbers of a target, and returns the fault of its form. The first number of an invalid target is NaN, so that no solver solves it.
    #[inline]
    pub fn row(&self, index: usize, out: &mut [f64]) -> Status {
        let row = &self.data[index * self.width..][..self.width];
        let status = match self.form {
            Form::Matrix => by_matrix(row, out),
            Form::Numbers => {
                out[..row.len()].copy_from_slice(row);
                Status::Solved
            }
            Form::Quaternion => self.by_quaternion(row, out),
        };
        let given = self.inputs - self.numbers();
        if given > 0 {
            let start = if self.given.len() == given { 0 } else { index * given };
            out[self.numbers()..].copy_from_slice(&self.given[start..start + given]);
        }
        let status = match self.rotation.map(|first| out[first..].first_chunk_mut()) {
            Some(Some(entries)) if status == Status::Solved && self.form != Form::Quaternion => {
                self.by_entries(entries)
            }
            _ => status,
        };
        match (status, self.placement) {
            (Status::Solved, None) => {}
            (Status::Solved, Some(placement)) => placement.to_base(out),
            _ => out[0] = f64::NAN,
        }
        status
    }

    /// The text for the status of a target, with the deviation of its rotation where a greater tolerance helps.
    pub fn reason(&self, index: usize, status: u8) -> String {
        let row = &self.data[index * self.width..][..self.width];
        let off = match (status == Status::NotRotation as u8, self.form, self.rotation) {
            (true, Form::Quaternion, Some(first)) => rotation::quaternion_deviation(&row[first..first + 4]),
            (true, Form::Numbers, Some(first)) => rotation::matrix_deviation(&row[first..first + 9]),
            (true, Form::Matrix, _) if has_last_row(row) => {
                rotation::matrix_deviation(&[&row[..3], &row[4..7], &row[8..11]].concat())
            }
            _ => None,
        };
        match off {
            Some(off) => format!("has {}", rotation::refusal(off, self.tolerance)),
            None => batch::reason(status).to_owned(),
        }
    }

    /// Number of a target's inputs that a row determines.
    fn numbers(&self) -> usize {
        match self.form {
            Form::Matrix => 12,
            Form::Numbers => self.width,
            Form::Quaternion => self.width + 5,
        }
    }

    fn by_quaternion(&self, row: &[f64], out: &mut [f64]) -> Status {
        let first = self.rotation.unwrap_or(0);
        out[..first].copy_from_slice(&row[..first]);
        out[first + 9..self.numbers()].copy_from_slice(&row[first + 4..]);
        if row.iter().any(|number| !number.is_finite()) {
            return Status::NotFinite;
        }
        let given = [row[first], row[first + 1], row[first + 2], row[first + 3]];
        let Some(rotation) = matrix_of_quaternion(given, self.tolerance) else { return Status::NotRotation };
        out[first..first + 9].copy_from_slice(&rotation);
        Status::Solved
    }

    /// Projects the entries of a rotation matrix, row by row.
    fn by_entries(&self, entries: &mut [f64; 9]) -> Status {
        if project(entries, self.tolerance) {
            Status::Solved
        } else if entries.iter().all(|entry| entry.is_finite()) {
            Status::NotRotation
        } else {
            Status::NotFinite
        }
    }
}

fn by_matrix(row: &[f64], out: &mut [f64]) -> Status {
    // Arrays of constant length need no checks of indices.
    if let (Some(row), Some(out)) = (row.first_chunk::<16>(), out.first_chunk_mut::<12>()) {
        for i in 0..3 {
            out[i] = row[4 * i + 3];
            for j in 0..3 {
                out[3 + 3 * i + j] = row[4 * i + j];
            }
        }
    }
    if has_last_row(row) {
        Status::Solved
    } else if row.iter().all(|number| number.is_finite()) {
        Status::NotRotation
    } else {
        Status::NotFinite
    }
}

/// Whether the last row of a matrix is 0, 0, 0, 1.
fn has_last_row(row: &[f64]) -> bool {
    row[12..].iter().zip([0.0, 0.0, 0.0, 1.0]).all(|(value, wanted)| (value - wanted).abs() <= LAST_ROW)
}
