//! The `groebot` program: see `groebot --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    groebot::cli::run()
}
