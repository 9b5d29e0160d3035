//! Navigation of a humanoid over a map: `groebot.navigate`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use groebot::gait::{Biped, Footprint};
use groebot::nav::{Cell, Map, Room};
use groebot::task::{Blocked, Body, Floor, Goal, Method, Navigator, Plan};
use groebot::{Error, ErrorKind, Result, sim};
use nalgebra::Point2;
use numpy::{PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::errors::{bad_value, raised};
use crate::stabilizer::walking;
use crate::work::{threads, watched};

/// Plans the walk of a humanoid over a map to a goal and checks every sample: see `groebot.Walk`.
///
/// `robot` is nao, rh0 or teo, or the path of a URDF or TOML, whose legs are derived first. `map` is a file (ROS YAML, PGM, PNG, text, a room in TOML), the name
/// of a room (living-room, encirclement), or an array of booleans. The array has the shape (rows, columns), begins at y = 0 and is true where there is an
/// obstacle; `resolution` is the size of its cells \[m\]. `start` and `goal` are (x, y) or (x, y, heading) \[m, rad\]. A room has a default start.
/// `furniture` moves pieces of a room: their names with (x, y) or (x, y, yaw) \[m, rad\], or None, which removes the piece. `unknown_free` treats unknown cells
/// as free.
///
/// `gait` is preview, which does not rest between the steps and is the default, or one by one step goal, which rests after each: osg, or of rh0 also rh0, rh0-sim,
/// rh0-real. Where no walk without rests is feasible, the robot rests after each step, and `Walk.notes` has the reason. With `crouched` it starts and ends in the
/// crouch. `method` is exact, fmm, m3r or potential. `body` is the length and the width of the body \[m\], by default those of its shapes. `apart` is the distance
/// of the body from obstacles \[m\]. If there is no path, it raises `NoPathError`, which has the cells that enclose the start or the goal.
#[pyfunction]
#[pyo3(signature = (robot, map, goal, start=None, *, gait=None, crouched=false, method="exact", body=None, furniture=None, resolution=0.05, unknown_free=false, apart=0.02,
    progress=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn navigate<'py>(
    py: Python<'py>,
    robot: &str,
    map: &Bound<'py, PyAny>,
    goal: Vec<f64>,
    start: Option<Vec<f64>>,
    gait: Option<&str>,
    crouched: bool,
    method: &str,
    body: Option<Vec<f64>>,
    furniture: Option<Furniture>,
    resolution: f64,
    unknown_free: bool,
    apart: f64,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let method = self::method(method)?;
    let (map, default_start) = self::map(map, resolution, &furniture.unwrap_or_default())?;
    let map = if unknown_free { map.with_unknown_free() } else { map };
    let start = start.map(|start| place("start", &start)).transpose()?;
    let start = start.map(|(at, heading)| [at.x, at.y, heading.unwrap_or(0.0)]).or(default_start).unwrap_or_default();
    let [x, y, yaw] = start;
    let (place, heading) = place("goal", &goal)?;
    let goal = Goal { place, heading };
    let (navigator, found) = watched(py, progress, threads(None)?, |watch| {
        let (robot, meshes, walker) = walking(robot)?;
        let body = match body.as_deref() {
            None => Body::new(&robot, &walker.biped, &meshes)?,
            Some(&[length, width]) => Body::of_size(length, width)?,
            Some(_) => return Err(Error::new(ErrorKind::BadValue, "`body` takes two numbers: length, width")),
        };
        let navigator = Navigator::new(walker, gait, body, !crouched, watch)?;
        let found = navigator.plan(&Floor::new(&map, apart)?, &Footprint { x, y, yaw }, goal.by(method), watch)?;
        Ok((navigator, found))
    })?;
    match found {
        Ok(plan) => walk(py, &navigator.pilot().walker().biped, &plan),
        Err(blocked) => Err(no_path(py, &blocked)?),
    }
}

/// The new places of furniture \[m, rad\]; `None` removes a piece.
type Furniture = BTreeMap<String, Option<Vec<f64>>>;

/// A map, and the start that a room defines.
fn map(map: &Bound<'_, PyAny>, resolution: f64, furniture: &Furniture) -> PyResult<(Map, Option<[f64; 3]>)> {
    if let Ok(cells) = map.cast::<PyArray2<bool>>() {
        no_furniture(furniture).map_err(|error| raised(&error))?;
        let (rows, columns) = (cells.shape()[0], cells.shape()[1]);
        let occupied = cells.try_readonly()?;
        let cells =
            occupied.as_array().iter().map(|occupied| if *occupied { Cell::Occupied } else { Cell::Free }).collect();
        return Map::of_cells(columns, rows, resolution, cells).map(|map| (map, None)).map_err(|error| raised(&error));
    }
    let path: PathBuf = map
        .extract()
        .map_err(|_| bad_value("`map` is neither a path, nor the name of a room, nor an array of booleans"))?;
    of_file(&path, resolution, furniture).map_err(|error| raised(&error))
}

fn of_file(path: &std::path::Path, resolution: f64, furniture: &Furniture) -> Result<(Map, Option<[f64; 3]>)> {
    let known = path.to_str().and_then(sim::room).filter(|_| !path.exists());
    let is_room = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"));
    let text = match known {
        Some(text) => text.to_owned(),
        None if is_room => groebot::document::read_text(path, groebot::document::TEXT_LIMIT)?,
        None => {
            no_furniture(furniture).map_err(|error| error.in_file(path))?;
            return Ok((Map::read(path, resolution)?, None));
        }
    };
    let room = Room::from_toml(&text).map_err(|error| error.in_file(path))?;
    let room = furniture.iter().try_fold(room, moved)?;
    Ok((room.map().map_err(|error| error.in_file(path))?, room.start))
}

fn moved(room: Room, (name, at): (&String, &Option<Vec<f64>>)) -> Result<Room> {
    match at.as_deref() {
        None => room.without(name),
        Some(&[x, y]) => room.with_moved(name, Point2::new(x, y), 0.0),
        Some(&[x, y, yaw]) => room.with_moved(name, Point2::new(x, y), yaw),
        Some(_) => {
            let text = format!("the place of `{name}` takes two or three numbers: x, y, yaw; None removes it");
            Err(Error::new(ErrorKind::BadValue, text))
        }
    }
}

/// Only rooms have furniture.
fn no_furniture(furniture: &Furniture) -> Result<()> {
    if furniture.is_empty() {
        return Ok(());
    }
    Err(Error::new(ErrorKind::BadValue, "`furniture` needs a room; give one in TOML, living-room or encirclement"))
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
        plan.notes(),
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
