//! Paths of an arm through poses: `Solver.solve_path`.

use groebot::kinematics::{InverseKinematics, Solution, Target};
use groebot::motion::{Pace, PathRequest, follow};
use groebot::spatial::Pose;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arrays::{Numbers, finite, joint_rows, shaped};
use crate::batch::reason;
use crate::errors::bad_value;
use crate::sink::Status;
use crate::solver::chain;
use crate::stored::Stored;
use crate::work::{threads, watched};

/// A kernel as an [`InverseKinematics`] solver.
struct ByKernel<'a>(&'a Stored);

impl std::fmt::Debug for ByKernel<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.program.name)
    }
}

impl InverseKinematics for ByKernel<'_> {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> groebot::Result<()> {
        out.clear();
        self.0.kernel.solve(&self.0.program.numbers(target, given)?, &mut |answer| out.push(answer.into()))
    }

    fn nearest_to(
        &self,
        target: &Target,
        given: &[f64],
        q0: &[f64],
        limits: &[[f64; 2]],
    ) -> groebot::Result<Option<Solution>> {
        self.0.kernel.nearest_to(&self.0.program.numbers(target, given)?, q0, limits)
    }
}

/// Computes the joint values along poses, and the jumps between branches, as `groebot.Path`.
///
/// # Errors
/// `BadValueError` for rows that are not poses, and for a pose out of reach or beyond limits, with its row.
pub fn solve_path<'py>(
    py: Python<'py>,
    stored: &Stored,
    poses: &Bound<'py, PyAny>,
    q0: Option<&Bound<'py, PyAny>>,
    dt: Option<f64>,
    speeds: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (chain, joints) = (chain(stored)?, stored.program.joints.len());
    let poses = self::poses(stored, poses)?;
    let start = q0.map(|q0| row(q0, joints, "q0")).transpose()?;
    let speeds = speeds.map(|speeds| row(speeds, joints, "speeds")).transpose()?.unwrap_or_default();
    // Without times, maximum speeds have no effect.
    let speeds: Vec<Option<f64>> = speeds.into_iter().map(|speed| Some(speed).filter(|_| dt.is_some())).collect();
    let pace = Pace::Every(dt.unwrap_or(1.0));
    let solver = ByKernel(stored);
    let followed = watched(py, None, threads(Some(1)), |watch| {
        let request = PathRequest::new(&poses, &pace).speeds(&speeds);
        let request = start.as_deref().map_or(request, |start| request.start(start));
        follow(chain, &solver, &request, watch)
    })?;
    let q = followed.trajectory.q.concat();
    let q = shaped(py, q, &[poses.len(), joints])?;
    let made = py.import("groebot._records")?;
    let jump = made.getattr("Jump")?;
    let jumps =
        followed.jumps.iter().map(|found| jump.call1((found.sample, found.joint, found.step, found.why.as_str())));
    let jumps = PyList::new(py, jumps.collect::<PyResult<Vec<_>>>()?)?;
    made.getattr("Path")?.call1((q, jumps))
}

/// Converts rows to poses.
fn poses(stored: &Stored, poses: &Bound<'_, PyAny>) -> PyResult<Vec<Pose>> {
    let numbers = Numbers::of(poses)?;
    if !stored.target_shape.is_pose || stored.target_shape.given > 0 {
        return Err(crate::errors::unsupported("a path is of poses, without given joints"));
    }
    let borrowed = numbers.array.try_readonly()?;
    let (targets, one) = stored.target_shape.targets(numbers.shape(), borrowed.as_slice()?, None, numbers.single)?;
    let targets = targets.placed(stored.placement.as_ref());
    if one {
        return Err(bad_value("`poses` holds one pose; give it an axis more: poses[None]"));
    }
    let mut out = vec![0.0; 12];
    (0..targets.len())
        .map(|row| match targets.row(row, &mut out) {
            Status::Solved => pose(&out, row),
            status => Err(bad_value(format!("row {row} {}", reason(status as u8)))),
        })
        .collect()
}

/// The pose of twelve numbers.
fn pose(numbers: &[f64], row: usize) -> PyResult<Pose> {
    finite(numbers, 12, "poses").map_err(|_| bad_value(format!("row {row} {}", reason(Status::NotFinite as u8))))?;
    let turn = Matrix3::from_row_slice(&numbers[3..]);
    let off = (turn.transpose() * turn - Matrix3::identity()).amax();
    if off > 1e-9 || turn.determinant() < 0.0 {
        return Err(bad_value(format!("row {row} {}", reason(Status::NotRotation as u8))));
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    Ok(Pose::from_parts(Translation3::new(numbers[0], numbers[1], numbers[2]), rotation))
}

/// Checks that there is one finite number for each joint.
fn row(list: &Bound<'_, PyAny>, joints: usize, name: &str) -> PyResult<Vec<f64>> {
    let numbers = Numbers::of(list)?;
    if !joint_rows(&numbers, joints, name)? {
        return Err(bad_value(format!("`{name}` has many rows; give one")));
    }
    let list = numbers.to_vec()?;
    finite(&list, joints, name)?;
    Ok(list)
}
