//! The Python module `groebot._groebot`, which the package `groebot` exports.

mod arcs;
mod arrays;
mod batch;
mod choose;
mod closest;
mod command;
mod compiled;
mod derive;
mod dynamics;
mod errors;
mod given;
mod kernel;
mod known;
mod many;
mod navigate;
mod options;
mod origin;
mod path;
mod placed;
mod reach;
mod redundant;
mod robot;
mod rotation;
mod rows;
mod scanned;
mod sink;
mod solution;
mod solver;
mod stabilizer;
mod stored;
mod targets;
mod work;

use pyo3::prelude::*;

#[pymodule]
fn _groebot(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<robot::Robot>()?;
    module.add_class::<solver::Solver>()?;
    module.add_class::<placed::PlacedSolver>()?;
    module.add_class::<solution::Solution>()?;
    module.add_class::<arcs::Arc>()?;
    module.add_class::<stabilizer::Stabilizer>()?;
    module.add_function(wrap_pyfunction!(solution::solution, module)?)?;
    module.add_function(wrap_pyfunction!(derive::derive, module)?)?;
    module.add_function(wrap_pyfunction!(navigate::navigate, module)?)?;
    module.add_function(wrap_pyfunction!(reach::reach, module)?)?;
    module.add_function(wrap_pyfunction!(reach::reach_as, module)?)?;
    module.add_function(wrap_pyfunction!(redundant::any_within, module)?)?;
    module.add_function(wrap_pyfunction!(redundant::arcs, module)?)?;
    module.add_function(wrap_pyfunction!(redundant::best, module)?)?;
    module.add_function(wrap_pyfunction!(redundant::optima, module)?)?;
    module.add_function(wrap_pyfunction!(rows::any_within_batch, module)?)?;
    module.add_function(wrap_pyfunction!(rows::best_batch, module)?)?;
    module.add_function(wrap_pyfunction!(command::run, module)?)?;
    Ok(())
}
