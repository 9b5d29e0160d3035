//! The model of a robot as a Python class. Main type: [`Robot`].

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::OnceLock;

use groebot::derive::Ends;
use groebot::document::{XmlText, as_utf8, read_xml};
use groebot::dynamics::{Base, Equations, State};
use groebot::limits::XML_BYTES;
use groebot::model::ReadOptions;
use groebot::{ErrorKind, model, robots};
use nalgebra::Vector3;
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::arrays::{Numbers, finite};
use crate::dynamics::{self, Columns};
use crate::errors::{bad_value, raised};
use crate::origin::Origin;

/// A robot: a tree of links and joints with inertial parameters.
///
/// Metres, kilograms, seconds, radians. Methods take one state, such as q of shape (freedoms,), or many, (N, freedoms). For many states the result has an
/// additional first axis. On a `floating` base q begins with the root's position and quaternion x, y, z, w in the world frame. Velocities then begin with the
/// root's linear and angular velocity in its own frame.
#[pyclass(frozen, module = "groebot", name = "Robot")]
pub struct Robot {
    robot: model::Robot,
    text: String,
    base: Option<String>,
    tip: Option<String>,
    root: Base,
    gravity: Vector3<f64>,
    equations: OnceLock<groebot::Result<Equations>>,
}

#[pymethods]
impl Robot {
    /// Reads a URDF: a path, or the text itself.
    ///
    /// `base` and `tip` are the end links of the chain that `derive` uses. By default they are the root and the only leaf link, else the only link named
    /// `tool0`, `flange`, `tcp` or `ee_link`, in that order. Faults of parts outside this chain are in `notes`; dynamics refuse them.
    #[staticmethod]
    #[pyo3(signature = (path_or_text, base=None, tip=None, *, floating=false, gravity=None))]
    fn from_urdf(
        path_or_text: &Bound<'_, PyAny>,
        base: Option<String>,
        tip: Option<String>,
        floating: bool,
        gravity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let text = path_or_text.cast::<PyString>().ok().map(|text| text.to_str()).transpose()?;
        let XmlText { text, notes } =
            match text.filter(|text| text.trim_start_matches('\u{feff}').trim_start().starts_with('<')) {
                Some(text) => XmlText { text: as_utf8(text).into_owned(), notes: Vec::new() },
                None => {
                    let path: PathBuf = path_or_text.extract()?;
                    read_xml(&path, XML_BYTES).map_err(|error| raised(&error))?
                }
            };
        let robot = model::Robot::from_urdf(&text).map_err(|error| raised(&error))?.with_notes(notes);
        Robot::of(robot, text, [base, tip], floating, gravity)
    }

    /// Reads a file of any robot format: URDF, xacro, MJCF, SDF or TOML, or the YAML calibration of an arm of Universal Robots.
    ///
    /// `packages` has the folders of packages by name, for xacro and meshes. Others are searched in `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`. `arguments` has the
    /// values of xacro's arguments by name. The other arguments are those of `from_urdf`. A DH table has no links: `derive` takes its path.
    #[staticmethod]
    #[pyo3(signature = (path, base=None, tip=None, *, floating=false, gravity=None, packages=None, arguments=None))]
    fn load(
        path: PathBuf,
        base: Option<String>,
        tip: Option<String>,
        floating: bool,
        gravity: Option<&Bound<'_, PyAny>>,
        packages: Option<BTreeMap<String, PathBuf>>,
        arguments: Option<BTreeMap<String, String>>,
    ) -> PyResult<Self> {
        let options = ReadOptions::from_environment();
        let options =
            packages.unwrap_or_default().into_iter().fold(options, |all, (name, path)| all.package(name, path));
        let given = arguments.unwrap_or_default().into_iter();
        let options = given.fold(options, |all, (name, value)| all.argument(name, value));
        let robot = model::Robot::read_with(&path, &options).map_err(|error| raised(&error))?;
        // The text of a URDF is kept, with its line numbers, if it needs no expansion.
        let is_urdf = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("urdf"));
        let own = is_urdf.then(|| read_xml(&path, XML_BYTES)).transpose().map_err(|error| raised(&error))?;
        let own = own.filter(|own| !own.text.contains("xacro"));
        let text = own.map_or_else(|| robot.to_urdf(), |own| own.text);
        Robot::of(robot, text, [base, tip], floating, gravity)
    }

    /// Returns a robot by name, such as nao or ur10e.
    #[staticmethod]
    #[pyo3(signature = (name, base=None, tip=None, *, floating=false, gravity=None))]
    fn named(
        name: &str,
        base: Option<String>,
        tip: Option<String>,
        floating: bool,
        gravity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (robot, ends) = named(name).map_err(|error| raised(&error))?;
        let text = robot.to_urdf();
        let [own_base, own_tip] = ends.map_or([None, None], |ends| ends.map(|link| Some(link.to_owned())));
        Robot::of(robot, text, [base.or(own_base), tip.or(own_tip)], floating, gravity)
    }

    /// Converts the robot to URDF.
    fn to_urdf(&self) -> &str {
        &self.text
    }

    fn __repr__(&self) -> String {
        format!(
            "<groebot.Robot {}: {} links, {} joints>",
            self.name(),
            self.robot.links().len(),
            self.robot.joints().len()
        )
    }

    #[expect(clippy::type_complexity, reason = "what pickle wants")]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, Option<String>, Option<String>, bool, [f64; 3]))> {
        let again = py.import("groebot._records")?.getattr("_robot")?;
        let state =
            (self.text.clone(), self.base.clone(), self.tip.clone(), self.root == Base::Floating, self.gravity.into());
        Ok((again, state))
    }

    /// The robot's name.
    #[getter]
    fn name(&self) -> &str {
        self.robot.name()
    }

    /// The names of the links, in the order of the description.
    #[getter]
    fn links(&self) -> Vec<&str> {
        self.robot.links().iter().map(|link| link.name.as_str()).collect()
    }

    /// The base link of the chain that `derive` uses: `base`, by default the root.
    #[getter]
    fn base(&self) -> &str {
        self.base.as_deref().unwrap_or(self.robot.root())
    }

    /// The tip link of the chain that `derive` uses: `tip`, else the default. `None` if there is no default, because the robot has several tips.
    #[getter]
    fn tip(&self) -> Option<String> {
        self.robot.path(self.base.as_deref(), self.tip.as_deref()).ok().map(|path| path.tip)
    }

    /// The possible tip links of a chain from `base`, the likeliest first: leaf links that move. If there is a default tip, it is the first one.
    #[getter]
    fn tips(&self) -> PyResult<Vec<String>> {
        let base = self.link(self.base())?;
        let default = self.robot.path(self.base.as_deref(), None).ok().map(|path| path.tip);
        let others = self.robot.suggested_tips(base).into_iter().filter(|tip| Some(*tip) != default.as_deref());
        Ok(default.iter().cloned().chain(others.map(str::to_owned)).collect())
    }

    /// The names of the independent joints, in the order of a configuration.
    #[getter]
    fn joints(&self) -> PyResult<Vec<String>> {
        Ok(self.equations()?.joints().to_vec())
    }

    /// Parts of the description that were ignored, such as faults of parts outside the chain between `base` and `tip`, and other remarks.
    #[getter]
    fn notes(&self) -> Vec<String> {
        match self.robot.path(self.base.as_deref(), self.tip.as_deref()) {
            Ok(path) => self.robot.ignored(&path),
            // There is no chain yet, so all of them are returned.
            Err(_) => {
                let faults = self.robot.faults().iter().map(|fault| fault.error.to_string());
                self.robot.parts().notes.iter().cloned().chain(faults).collect()
            }
        }
    }

    /// The mass of all links \[kg\].
    #[getter]
    fn mass(&self) -> f64 {
        self.robot.mass()
    }

    /// Inverse dynamics (RNEA): the torques \[N m, N\] for the accelerations `a` in the state `q`, `v`, with friction and rotors.
    fn inverse_dynamics<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        a: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let equations = self.equations()?;
        let columns = Columns::new(equations, q, &[("v", v), ("a", a)])?;
        columns.rows(q.py(), &[equations.freedoms()], |room, state, third| {
            dynamics::vector(equations.inverse(room, state, third))
        })
    }

    /// Forward dynamics (ABA): the accelerations for the torques `tau` in the state `q`, `v`.
    fn forward_dynamics<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let equations = self.equations()?;
        let columns = Columns::new(equations, q, &[("v", v), ("tau", tau)])?;
        columns.rows(q.py(), &[equations.freedoms()], |room, state, third| {
            dynamics::vector(equations.forward(room, state, third))
        })
    }

    /// The mass matrix (CRBA), (freedoms, freedoms).
    fn mass_matrix<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (equations, n) = (self.equations()?, self.equations()?.freedoms());
        let columns = Columns::new(equations, q, &[])?;
        columns.rows(q.py(), &[n, n], |room, state, _| dynamics::matrix(equations.inertia(room, state.q)))
    }

    /// The Coriolis matrix with Christoffel symbols, (freedoms, freedoms).
    fn coriolis_matrix<'py>(&self, q: &Bound<'py, PyAny>, v: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (equations, n) = (self.equations()?, self.equations()?.freedoms());
        let columns = Columns::new(equations, q, &[("v", v)])?;
        columns.rows(q.py(), &[n, n], |room, state, _| dynamics::matrix(equations.coriolis(room, state)))
    }

    /// The gravity torques: those that hold the robot at rest.
    fn gravity_torques<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let equations = self.equations()?;
        let columns = Columns::new(equations, q, &[])?;
        columns
            .rows(q.py(), &[equations.freedoms()], |room, state, _| dynamics::vector(equations.gravity(room, state.q)))
    }

    /// The centre of mass in the world frame; for a fixed base, in its frame, (3,).
    fn center_of_mass<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let equations = self.equations()?;
        let columns = Columns::new(equations, q, &[])?;
        columns.rows(q.py(), &[3], |room, state, _| {
            Ok(equations.centre_of_mass(room, state.q)?.coords.as_slice().to_vec())
        })
    }

    /// The kinetic and the potential energy \[J\], (2,).
    fn energy<'py>(&self, q: &Bound<'py, PyAny>, v: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let equations = self.equations()?;
        let columns = Columns::new(equations, q, &[("v", v)])?;
        columns.rows(q.py(), &[2], |room, state, _| {
            equations.energy(room, state).map(|energy| vec![energy.kinetic, energy.potential])
        })
    }

    /// The pose of a link in the world frame; for a fixed base, in its frame, (4, 4).
    fn link_pose<'py>(&self, q: &Bound<'py, PyAny>, link: &str) -> PyResult<Bound<'py, PyAny>> {
        let (equations, place) = (self.equations()?, self.link(link)?);
        let columns = Columns::new(equations, q, &[])?;
        columns.rows(q.py(), &[4, 4], |room, state, _| {
            Ok(equations.pose(room, state.q, place)?.to_homogeneous().transpose().as_slice().to_vec())
        })
    }

    /// The Jacobian of a link, (6, freedoms): the linear velocity of its origin in the first three rows, then its angular velocity, along the axes of the world
    /// frame.
    fn link_jacobian<'py>(&self, q: &Bound<'py, PyAny>, link: &str) -> PyResult<Bound<'py, PyAny>> {
        let (equations, place) = (self.equations()?, self.link(link)?);
        let columns = Columns::new(equations, q, &[])?;
        columns.rows(q.py(), &[6, equations.freedoms()], |room, state, _| {
            let still = vec![0.0; equations.freedoms()];
            let [jacobian, _] = equations.jacobian(room, State::new(state.q, &still), place)?;
            Ok(jacobian.transpose().as_slice().to_vec())
        })
    }
}

impl Robot {
    fn of(
        robot: model::Robot,
        text: String,
        [base, tip]: [Option<String>; 2],
        floating: bool,
        gravity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        for link in [&base, &tip].into_iter().flatten() {
            robot.link(link).map_err(|error| raised(&error))?;
        }
        let gravity = gravity.map_or(Ok(Vector3::new(0.0, 0.0, -9.81)), three)?;
        let root = if floating { Base::Floating } else { Base::Fixed };
        Ok(Robot { robot, text, base, tip, root, gravity, equations: OnceLock::new() })
    }

    /// The input from which it was read.
    pub fn origin(&self) -> Origin {
        Origin::of("0_robot.urdf", &self.text)
    }

    /// The end links of its chain.
    pub fn ends(&self) -> Ends {
        Ends { base: self.base.clone(), tip: self.tip.clone(), ..Ends::default() }
    }

    fn equations(&self) -> PyResult<&Equations> {
        let made = || Ok(Equations::new(&self.robot, self.root)?.with_gravity(self.gravity));
        self.equations.get_or_init(made).as_ref().map_err(raised)
    }

    fn link(&self, name: &str) -> PyResult<usize> {
        self.robot.link(name).map_err(|error| raised(&error))
    }
}

/// Three finite numbers.
fn three(list: &Bound<'_, PyAny>) -> PyResult<Vector3<f64>> {
    let numbers = Numbers::of(list)?;
    if numbers.shape() != [3] {
        return Err(bad_value("`gravity` takes three numbers, in m/s^2"));
    }
    let list = numbers.to_vec()?;
    finite(&list, 3, "gravity")?;
    Ok(Vector3::from_column_slice(&list))
}

/// The robot with this name, and the end links of its chain.
fn named(name: &str) -> groebot::Result<(model::Robot, Option<[&'static str; 2]>)> {
    if let Some(robot) = robots::robot(name) {
        return Ok((robot, None));
    }
    let listed = robots::find(name)?;
    let no_links = || {
        let text = format!("`{name}` is known as a chain of axes without links; `Solver.named` has its kinematics");
        groebot::Error::new(ErrorKind::Unsupported, text)
    };
    if listed.ends().is_none() {
        return Err(no_links());
    }
    Ok((model::Robot::from_toml(listed.text())?, listed.ends()))
}
