//! The command `groebot`.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the command on these arguments, the first of which is its name: the exit status.
#[pyfunction]
#[pyo3(name = "_run")]
pub fn run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| groebot::cli::run_on(arguments))
}
