//! Reach maps of a solver over a grid: `groebot.reach_map`.

use groebot::kinematics::Solution;
use groebot::reach::{Axis, Entry, Grid, Measure, ReachMap, Request, Solves, Survey};
use groebot::solver::Solved;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{bad_value, raised};
use crate::kernel::Kernel;
use crate::solver::Solver;
use crate::work::watched;

struct Solving<'a>(&'a dyn Kernel);

impl Solves for Solving<'_> {
    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> groebot::Result<()> {
        self.0.each(targets, take)
    }

    fn within(&self, target: &[f64], limits: &[[f64; 2]]) -> groebot::Result<Vec<Solution>> {
        self.0.solve_within(target, limits)
    }
}

/// Computes the columns of a map for the grid points from `start` to before `stop`, by default all: see
/// `groebot.reach_map`.
#[pyfunction]
#[pyo3(name = "_reach", signature = (solver, axes, orientations, measure, limits, given, seed, start, stop, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "the package calls it with all of them")]
pub fn reach<'py>(
    py: Python<'py>,
    solver: &Solver,
    axes: [(f64, f64, usize); 3],
    orientations: usize,
    measure: &str,
    limits: Option<&Bound<'py, PyAny>>,
    given: Vec<f64>,
    seed: Option<u64>,
    start: usize,
    stop: Option<usize>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let stored = &solver.0;
    let is_described = limits.is_some_and(|limits| limits.extract::<bool>().is_ok_and(|is_requested| is_requested));
    let limits = if is_described {
        Some(Request::described(&stored.program).map_err(|error| raised(&error))?)
    } else {
        solver.bounds(limits)?
    };
    let measure = Measure::of(measure).map_err(|error| raised(&error))?;
    let grid = Grid::new(axes.map(|(from, to, count)| Axis { from, to, count })).map_err(|error| raised(&error))?;
    let stop = stop.unwrap_or(grid.places());
    if start > stop || stop > grid.places() {
        return Err(bad_value(format!("places from {start} to {stop}; the grid has {}", grid.places())));
    }
    let request = Request { orientations, seed, given, measure, limits, ..Request::new(grid) };
    let solving = Solving(&*stored.kernel);
    let survey =
        Survey::new(&solving, &stored.program, stored.chain.as_ref(), &request).map_err(|error| raised(&error))?;
    let entries = watched(py, progress, crate::work::threads(threads)?, |watch| survey.entries(start..stop, watch))?;
    let columns = PyDict::new(py);
    let wholes = |number: fn(&Entry) -> u32| PyArray1::from_iter(py, entries.iter().map(number));
    columns.set_item("orientations", survey.orientations())?;
    columns.set_item("reached", wholes(|entry| entry.reached))?;
    columns.set_item("answers", wholes(|entry| entry.answers))?;
    columns.set_item("open", wholes(|entry| entry.open))?;
    if measure == Measure::Manipulability {
        let singles = |number: fn(&Entry) -> f32| PyArray1::from_iter(py, entries.iter().map(number));
        columns.set_item("best", singles(|entry| entry.best))?;
        columns.set_item("mean", singles(|entry| entry.mean))?;
    }
    Ok(columns)
}

/// Checks a map's JSON and converts it. `format` is csv, svg or json (unchanged).
#[pyfunction]
#[pyo3(name = "_reach_as", signature = (text, format, across=None))]
pub fn reach_as(py: Python<'_>, text: &str, format: &str, across: Option<usize>) -> PyResult<String> {
    py.detach(|| {
        let map = ReachMap::from_json(text)?;
        Ok(match format {
            "csv" => map.to_csv(),
            "svg" => map.to_svg(across),
            _ => map.to_json(),
        })
    })
    .map_err(|error: groebot::Error| raised(&error))
}
