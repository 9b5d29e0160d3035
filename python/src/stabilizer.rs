//! Feedback of a walk: `groebot.Stabilizer`.

use groebot::control::{SoleForce, State};
use groebot::motion::Trajectory;
use groebot::robots::{self, Outline};
use groebot::{Error, ErrorKind};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::{Numbers, finite};
use crate::errors::{bad_value, raised};

/// The tolerance of the length of a quaternion.
const UNIT: f64 = 1e-6;

/// Feedback for a planned walk of nao, rh0 or teo: joint targets from the measured state (docs/walking.md).
#[pyclass(module = "groebot")]
pub struct Stabilizer {
    stabilizer: groebot::control::Stabilizer,
    joints: Vec<String>,
}

#[pymethods]
impl Stabilizer {
    /// `walk` is the CSV of `groebot walk` or `groebot navigate`, as text. `stiffness` is that of position controllers without integral action \[N m/rad\]: the
    /// targets then contain the deflection of the joints under the weight.
    #[new]
    #[pyo3(signature = (robot, walk, *, stiffness=None))]
    fn new(robot: &str, walk: &str, stiffness: Option<f64>) -> PyResult<Self> {
        let unknown = || {
            let text = format!("`{robot}` is not a walking robot of groebot; give nao, rh0 or teo");
            Error::new(ErrorKind::UnknownName, text)
        };
        if stiffness.is_some_and(|stiffness| !(stiffness.is_finite() && stiffness > 0.0)) {
            return Err(bad_value("`stiffness` must be a positive number"));
        }
        let made = || {
            let walker = robots::walker(robot, Outline::default()).ok_or_else(unknown)??;
            let joints = walker.biped.joints.iter().map(|joint| joint.name.clone()).collect();
            let stabilizer = groebot::control::Stabilizer::new(walker, &Trajectory::from_csv(walk)?)?;
            let stabilizer = stiffness.into_iter().fold(stabilizer, groebot::control::Stabilizer::stiffness);
            Ok(Stabilizer { stabilizer, joints })
        };
        made().map_err(|error| raised(&error))
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
