//! The command `groebot`.

use std::ffi::OsString;
use std::io::Write;

use pyo3::prelude::*;

/// Runs the command on these arguments, the first of which is its name: the exit status.
#[pyfunction]
#[pyo3(name = "_run")]
pub fn run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        let status = groebot::cli::run_on(arguments);
        // No main function of Rust ends here, which would do it; a reader that has gone away is no error.
        let _ = std::io::stdout().flush();
        status
    })
}
