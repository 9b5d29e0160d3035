//! The command `groebot`.

use std::ffi::OsString;
use std::io::Write;

use pyo3::prelude::*;

/// Runs the command with these arguments. The first one is the program's name. Returns the exit status.
#[pyfunction]
#[pyo3(name = "_run")]
pub fn run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        let status = groebot::cli::run_on(arguments);
        // Rust's main function would flush here, but there is none. A closed reader is not an error.
        let _ = std::io::stdout().flush();
        status
    })
}
