//! Navigation of a humanoid over a map: `groebot.navigate`.

use std::path::PathBuf;

use groebot::gait::{Biped, Footprint, GaitDefaults, Walker};
use groebot::model::Meshes;
use groebot::nav::{Cell, Map, Room};
use groebot::robots::{self, Outline};
use groebot::task::{Blocked, Body, Floor, Goal, Method, Pilot, Plan};
use groebot::{Error, ErrorKind, Result, sim};
use nalgebra::Point2;
use numpy::{PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::errors::{bad_value, raised};
use crate::work::{threads, watched};

/// Plans the walk of a humanoid over a map to a goal and checks every sample: see `groebot.Walk`.
///
/// `robot` is nao, rh0 or teo. `map` is a file (ROS YAML, PGM, PNG, text, a room in TOML), the name of a room (living-room, encirclement), or an array of
/// booleans. The array has the shape (rows, columns), begins at y = 0 and is true where there is an obstacle; `resolution` is the size of its cells \[m\].
/// `start` and `goal` are (x, y) or (x, y, heading) \[m, rad\]. A room has a default start. `method` is exact, fmm, m3r or potential. `apart` is the distance
/// of the body from obstacles \[m\]. If there is no path, it raises `NoPathError`, which has the cells that enclose the start or the goal.
#[pyfunction]
#[pyo3(signature = (robot, map, goal, start=None, *, method="exact", resolution=0.05, apart=0.02, progress=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn navigate<'py>(
    py: Python<'py>,
    robot: &str,
    map: &Bound<'py, PyAny>,
    goal: Vec<f64>,
    start: Option<Vec<f64>>,
    method: &str,
    resolution: f64,
    apart: f64,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let method = self::method(method)?;
    let (map, default_start) = self::map(map, resolution)?;
    let start = start.map(|start| place("start", &start)).transpose()?;
    let start = start.map(|(at, heading)| [at.x, at.y, heading.unwrap_or(0.0)]).or(default_start).unwrap_or_default();
    let (place, heading) = place("goal", &goal)?;
    let goal = Goal { place, heading };
    let (pilot, found) = watched(py, progress, threads(None)?, |watch| {
        let pilot = pilot(robot, watch)?;
        let floor = Floor::new(&map, apart)?;
        let [x, y, yaw] = start;
        let feet = Footprint { x, y, yaw }.feet(pilot.half_width());
        let found = Plan::find(&pilot, &floor, feet, goal.by(method), watch)?;
        Ok((pilot, found))
    })?;
    match found {
        Ok(plan) => walk(py, &pilot.walker().biped, &plan),
        Err(blocked) => Err(no_path(py, &blocked)?),
    }
}

/// The humanoid of this name, with the settings of `groebot navigate`.
fn pilot(name: &str, watch: &groebot::Watch) -> Result<Pilot> {
    let unknown =
        || Error::new(ErrorKind::UnknownName, format!("no walker is called `{name}`; there are nao, rh0 and teo"));
    let robot = robots::robot(name).ok_or_else(unknown)?;
    let walker: Walker = robots::walker(name, Outline::Measured).ok_or_else(unknown)??;
    let body = Body::new(&robot, &walker.biped, &Meshes::default())?;
    let one_step =
        |(_, defaults): &(&str, GaitDefaults)| Some(defaults.clone()).filter(|defaults| defaults.gait.is_one_step());
    let none = || Error::new(ErrorKind::Unsupported, format!("`{name}` has no gait by one step goal"));
    let defaults = walker.gaits.iter().find_map(one_step).ok_or_else(none)?;
    Pilot::new(walker, defaults, body, true, watch)
}

/// A map, and the start that a room defines.
fn map(map: &Bound<'_, PyAny>, resolution: f64) -> PyResult<(Map, Option<[f64; 3]>)> {
    if let Ok(cells) = map.cast::<PyArray2<bool>>() {
        let (rows, columns) = (cells.shape()[0], cells.shape()[1]);
        let occupied = cells.try_readonly()?;
        let cells =
            occupied.as_array().iter().map(|occupied| if *occupied { Cell::Occupied } else { Cell::Free }).collect();
        return Map::of_cells(columns, rows, resolution, cells).map(|map| (map, None)).map_err(|error| raised(&error));
    }
    let path: PathBuf = map
        .extract()
        .map_err(|_| bad_value("`map` is neither a path, nor the name of a room, nor an array of booleans"))?;
    of_file(&path, resolution).map_err(|error| raised(&error))
}

fn of_file(path: &std::path::Path, resolution: f64) -> Result<(Map, Option<[f64; 3]>)> {
    let known = path.to_str().and_then(sim::room).filter(|_| !path.exists());
    let is_room = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"));
    let text = match known {
        Some(text) => text.to_owned(),
        None if is_room => groebot::document::read_text(path, groebot::document::TEXT_LIMIT)?,
        None => return Ok((Map::read(path, resolution)?, None)),
    };
    let room = Room::from_toml(&text).map_err(|error| error.in_file(path))?;
    Ok((room.map().map_err(|error| error.in_file(path))?, room.start))
}

fn method(name: &str) -> PyResult<Method> {
    match name {
        "exact" => Ok(Method::Exact),
        "fmm" => Ok(Method::FastMarching),
        "m3r" => Ok(Method::M3r),
        "potential" => Ok(Method::Potential),
        _ => Err(bad_value(format!("the method `{name}` is not known; give exact, fmm, m3r or potential"))),
    }
}

/// A position with an optional heading.
fn place(name: &str, numbers: &[f64]) -> PyResult<(Point2<f64>, Option<f64>)> {
    crate::arrays::finite(numbers, numbers.len(), name)?;
    match *numbers {
        [x, y] => Ok((Point2::new(x, y), None)),
        [x, y, heading] => Ok((Point2::new(x, y), Some(heading))),
        _ => Err(bad_value(format!("`{name}` takes two or three numbers: x, y, heading"))),
    }
}

/// The walk as `groebot.Walk`.
fn walk<'py>(py: Python<'py>, biped: &Biped, plan: &Plan) -> PyResult<Bound<'py, PyAny>> {
    let trajectory = plan.walk.trajectory(biped);
    let names: Vec<&str> = trajectory.joints.iter().map(|joint| joint.name.as_str()).collect();
    let samples = trajectory.times.len();
    let figure = |name: &str| trajectory.figures.iter().find(|figure| figure.name == name);
    let margin = figure("margin").map(|figure| figure.values.clone()).unwrap_or_default();
    let steps = &plan.walk.schedule.route.steps;
    let prints = steps.iter().flat_map(|step| [step.print.x, step.print.y, step.print.yaw]).collect();
    let sides: Vec<&str> = steps.iter().map(|step| step.side.name()).collect();
    let base = trajectory.base.iter().flat_map(|pose| pose.to_homogeneous().transpose().as_slice().to_vec()).collect();
    let path: Vec<f64> = plan.course.path.points.iter().flat_map(|point| [point.x, point.y]).collect();
    let corners = plan.course.path.points.len();
    let arguments = (
        shaped(py, trajectory.times.clone(), &[samples])?,
        names,
        shaped(py, trajectory.q.concat(), &[samples, trajectory.joints.len()])?,
        shaped(py, base, &[samples, 4, 4])?,
        shaped(py, margin, &[samples])?,
        shaped(py, path, &[corners, 2])?,
        shaped(py, prints, &[steps.len(), 3])?,
        sides,
        plan.walk.to_csv(biped),
    );
    py.import("groebot._records")?.getattr("Walk")?.call1(arguments)
}

fn no_path(py: Python<'_>, blocked: &Blocked) -> PyResult<PyErr> {
    let cells = &blocked.enclosure.cells;
    let middles = cells.iter().map(|cell| blocked.map.centre(*cell)).flat_map(|at| [at.x, at.y]).collect();
    let enclosure = shaped(py, middles, &[cells.len(), 2])?;
    let made = py.import("groebot._errors")?.getattr("NoPathError")?.call1((blocked.to_string(), enclosure))?;
    Ok(PyErr::from_value(made))
}
