//! Feedback of a walk: `groebot.Stabilizer`.

use std::path::Path;
use std::sync::Arc;

use groebot::control::{SoleForce, StabilizerGains, State};
use groebot::gait::{Footing, LegSolver, Walker};
use groebot::kinematics::Chain;
use groebot::model::{Meshes, Robot};
use groebot::motion::Trajectory;
use groebot::robots::{self, Outline};
use groebot::{Error, ErrorKind, Result};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::{Numbers, finite};
use crate::errors::{bad_value, raised};

/// The tolerance of the length of a quaternion.
const UNIT: f64 = 1e-6;

/// Feedback for a planned walk of nao, rh0, teo or a described robot: joint targets from the measured state (docs/walking.md).
#[pyclass(module = "groebot")]
pub struct Stabilizer {
    stabilizer: groebot::control::Stabilizer,
    joints: Vec<String>,
}

#[pymethods]
impl Stabilizer {
    /// `robot` is nao, rh0 or teo, or the path of a URDF or TOML, whose legs are derived first. `walk` is the CSV of `groebot walk` or `groebot navigate`, as text.
    /// `stiffness` is that of position controllers without integral action \[N m/rad\]: the targets then contain the deflection of the joints under the weight.
    /// `heading` is the fraction of the error of the heading that a footstep corrects, by default 0.5; 0 for an inertial sensor whose heading drifts.
    #[new]
    #[pyo3(signature = (robot, walk, *, stiffness=None, heading=None))]
    fn new(py: Python<'_>, robot: &str, walk: &str, stiffness: Option<f64>, heading: Option<f64>) -> PyResult<Self> {
        if stiffness.is_some_and(|stiffness| !(stiffness.is_finite() && stiffness > 0.0)) {
            return Err(bad_value("`stiffness` must be a positive number"));
        }
        if heading.is_some_and(|heading| !(0.0..=1.0).contains(&heading)) {
            return Err(bad_value("`heading` must be a number from 0 to 1"));
        }
        let made = || {
            let (_, _, walker) = walking(robot)?;
            let joints = walker.biped.joints.iter().map(|joint| joint.name.clone()).collect();
            let mut gains = StabilizerGains::default();
            gains.heading = heading.unwrap_or(gains.heading);
            let stabilizer = groebot::control::Stabilizer::new(walker, &Trajectory::from_csv(walk)?)?.gains(gains);
            let stabilizer = stiffness.into_iter().fold(stabilizer, groebot::control::Stabilizer::stiffness);
            Ok(Stabilizer { stabilizer, joints })
        };
        py.detach(made).map_err(|error| raised(&error))
    }

    /// The names of the joints, in the order of `q` and of the targets.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.joints.clone()
    }

    /// The targets of the joints at a state: positions \[rad\] and feed-forward velocities \[rad/s\], each of shape (joints,).
    ///
    /// `time` is the time since the start of the walk \[s\], `q` has shape (joints,) \[rad\]. `orientation` is the quaternion (x, y, z, w) from the base to a
    /// world with a vertical z axis, `angular_velocity` that of the base in its own frame, shape (3,) \[rad/s\]. `soles` has shape (2, 6): for the left and the
    /// right sole force \[N\] and moment \[N m\] in the frame of the sole. Times must not decrease from call to call.
    #[expect(clippy::type_complexity, reason = "two arrays")]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        time: f64,
        q: &Bound<'py, PyAny>,
        orientation: &Bound<'py, PyAny>,
        angular_velocity: &Bound<'py, PyAny>,
        soles: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let [x, y, z, w] = fixed(orientation, "orientation", &[4])?;
        let quaternion = Quaternion::new(w, x, y, z);
        if (quaternion.norm() - 1.0).abs() > UNIT {
            return Err(bad_value(format!(
                "`orientation` has the length {}; give a unit quaternion",
                quaternion.norm()
            )));
        }
        let forces: [f64; 12] = fixed(soles, "soles", &[2, 6])?;
        let vector = |at: usize| Vector3::new(forces[at], forces[at + 1], forces[at + 2]);
        let state = State {
            time,
            q: Numbers::of(q)?.to_vec()?,
            orientation: UnitQuaternion::new_normalize(quaternion),
            angular_velocity: Vector3::from(fixed::<3>(angular_velocity, "angular_velocity", &[3])?),
            soles: [0, 6].map(|at| SoleForce { force: vector(at), moment: vector(at + 3) }),
        };
        let targets = self.stabilizer.step(&state).map_err(|error| raised(&error))?;
        Ok((PyArray1::from_vec(py, targets.positions), PyArray1::from_vec(py, targets.velocities)))
    }
}

/// The walking robot of that name, or of a description, with its meshes. The root link of a description is turned to the torso.
pub fn walking(robot: &str) -> Result<(Robot, Meshes, Walker)> {
    if let (Some(walker), Some(robot)) = (robots::walker(robot, Outline::default()), robots::robot(robot)) {
        return Ok((robot, Meshes::default(), walker?));
    }
    let path = Path::new(robot);
    if !path.exists() {
        let text = format!("`{robot}` is neither a file nor a walking robot of groebot; give a file, nao, rh0 or teo");
        return Err(Error::new(ErrorKind::UnknownName, text));
    }
    let meshes = Meshes::beside(path);
    let at_file = |error: Error| error.in_file(path);
    let footing = Footing::find(&Robot::read(path)?, &meshes, [None, None], None).map_err(at_file)?;
    let leg = |chain: &Chain| -> Result<LegSolver> { Ok(Arc::new(groebot::derive(chain)?.solver())) };
    let walker = footing.walker(leg).map_err(at_file)?;
    Ok((footing.robot().clone(), meshes, walker))
}

/// The numbers of an array with this shape.
fn fixed<const N: usize>(object: &Bound<'_, PyAny>, name: &str, shape: &[usize]) -> PyResult<[f64; N]> {
    let numbers = Numbers::of(object)?;
    let wrong = || bad_value(format!("`{name}` has the shape {:?}; give {shape:?}", numbers.shape()));
    if numbers.shape() != shape {
        return Err(wrong());
    }
    let list = numbers.to_vec()?;
    finite(&list, N, name)?;
    list.try_into().map_err(|_| wrong())
}
