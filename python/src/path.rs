//! Paths of an arm through poses: `Solver.solve_path`.

use groebot::Watch;
use groebot::kinematics::{Chain, InverseKinematics, Solution, Target};
use groebot::motion::{Pace, PathRequest, follow};
use groebot::solver::redundant::PathOptions;
use groebot::spatial::Pose;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arrays::{Numbers, TargetShape, finite, shaped};
use crate::batch::reason;
use crate::errors::{bad_value, raised, unsupported};
use crate::given::{self, GivenValues};
use crate::redundant::{self, arm, joint_values, lacks_given};
use crate::rotation;
use crate::sink::Status;
use crate::solver::Solver;
use crate::stored::{Stored, chain};
use crate::work::{threads, watched};

/// A kernel as an [`InverseKinematics`] solver.
struct ByKernel<'a> {
    stored: &'a Stored,
    /// The constant values of the given joints.
    given: &'a [f64],
}

impl std::fmt::Debug for ByKernel<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.stored.program.name)
    }
}

impl InverseKinematics for ByKernel<'_> {
    fn solve(&self, target: &Target, _: &[f64], out: &mut Vec<Solution>) -> groebot::Result<()> {
        out.clear();
        let numbers = self.stored.program.numbers(target, self.given)?;
        self.stored.kernel.solve(&numbers, &mut |answer| out.push(answer.into()))
    }

    fn nearest_to(
        &self,
        target: &Target,
        _: &[f64],
        q0: &[f64],
        limits: &[[f64; 2]],
    ) -> groebot::Result<Option<Solution>> {
        self.stored.kernel.nearest_to(&self.stored.program.numbers(target, self.given)?, q0, limits)
    }
}

/// The options of a path, each optional.
pub struct Wishes<'a, 'py> {
    /// The joint values before the first target.
    pub q0: Option<&'a Bound<'py, PyAny>>,
    /// The time between two targets \[s\].
    pub dt: Option<f64>,
    /// The time of each target \[s\].
    pub times: Option<&'a Bound<'py, PyAny>>,
    /// The maximum velocity of each joint.
    pub speeds: Option<&'a Bound<'py, PyAny>>,
    pub limits: Option<&'a Bound<'py, PyAny>>,
    /// The values of the given joints, by default those of `q0`.
    pub given: Option<&'a Bound<'py, PyAny>>,
    /// Largest deviation of a rotation that is projected.
    pub tolerance: Option<f64>,
}

/// The options, converted.
struct Given {
    start: Option<Vec<f64>>,
    pace: Pace,
    speeds: Vec<Option<f64>>,
}

impl Wishes<'_, '_> {
    fn given(&self, joints: usize) -> PyResult<Given> {
        let start = self.q0.map(|q0| joint_values(q0, joints, "q0")).transpose()?;
        let speeds = self.speeds.map(|speeds| joint_values(speeds, joints, "speeds")).transpose()?.unwrap_or_default();
        if speeds.iter().any(|speed| *speed <= 0.0) {
            return Err(bad_value(format!("`speeds` are {speeds:?}; give positive numbers")));
        }
        let pace = match (self.times, self.dt) {
            (Some(_), Some(_)) => return Err(bad_value("give `dt` or `times`, not both")),
            (Some(times), None) => Pace::At(ascending(times)?),
            (None, dt) => Pace::Every(dt.unwrap_or(1.0)),
        };
        // Without times, maximum speeds have no effect.
        let has_times = self.times.is_some() || self.dt.is_some();
        let speeds = speeds.into_iter().map(|speed| Some(speed).filter(|_| has_times)).collect();
        Ok(Given { start, pace, speeds })
    }
}

/// Times in ascending order.
fn ascending(times: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let numbers = Numbers::of(times)?;
    let times = numbers.to_vec()?;
    let are_ascending = times.iter().all(|time| time.is_finite()) && times.windows(2).all(|pair| pair[0] < pair[1]);
    if numbers.shape().len() != 1 || !are_ascending {
        return Err(bad_value("`times` must be finite numbers that ascend, of the shape (N,)"));
    }
    Ok(times)
}

/// Computes the joint values along poses, and the jumps between branches, as `groebot.Path`.
///
/// # Errors
/// `BadValueError` for rows that are not poses, and for a pose out of reach or beyond limits, with its row.
pub fn solve_path<'py>(
    py: Python<'py>,
    solver: &Solver,
    poses: &Bound<'py, PyAny>,
    wishes: &Wishes<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    if lacks_given(&solver.0, poses, wishes.given)? {
        return along_arcs(py, solver, poses, wishes);
    }
    if wishes.limits.is_some() {
        return Err(unsupported(
            "`limits` of a path are for a redundant solver; other paths have the described limits",
        ));
    }
    let stored = &*solver.0;
    let chain = with_constants(chain(stored)?)?;
    let poses = self::poses(stored, poses, wishes.tolerance)?;
    let Given { start, pace, speeds } = wishes.given(stored.program.joints.len())?;
    let given = GivenValues::new(stored, wishes.given, start.as_deref())?;
    let given = given.values(true);
    if given.len() != stored.target_shape.given {
        return Err(given::refusal(&stored.given(), given.len(), stored.target_shape.given, poses.len()));
    }
    let solver = ByKernel { stored, given };
    let followed = watched(py, None, 1, |watch| {
        let request = PathRequest::new(&poses, &pace).speeds(&speeds);
        let request = start.as_deref().map_or(request, |start| request.start(start));
        follow(&chain, &solver, &request, watch)
    })?;
    let jumps: Vec<_> =
        followed.jumps.iter().map(|found| (found.sample, found.joint, found.step, found.why.as_str())).collect();
    made(py, &followed.trajectory.q, &jumps, (false, None))
}

/// The chain for paths on which the given joints are constant.
fn with_constants(chain: &Chain) -> PyResult<Chain> {
    chain.with_task(chain.task(), chain.direction().clone(), Vec::new()).map_err(|error| raised(&error))
}

/// The path of a redundant solver along arcs, also with scanned joints, as `groebot.Path`.
fn along_arcs<'py>(
    py: Python<'py>,
    solver: &Solver,
    targets: &Bound<'py, PyAny>,
    wishes: &Wishes<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let stored = &*solver.0;
    let (rows, one) = redundant::targets(stored, targets, wishes.tolerance)?;
    if one {
        return Err(bad_value("`poses` holds one pose; give it an axis more: poses[None]"));
    }
    let fault = |row: usize, status: Status| bad_value(format!("row {row} {}", reason(status as u8)));
    let targets = rows.into_iter().enumerate().map(|(row, target)| target.map_err(|status| fault(row, status)));
    let targets = targets.collect::<PyResult<Vec<_>>>()?;
    let Given { start, pace, speeds } = wishes.given(stored.program.joints.len())?;
    let times = pace.times(targets.len()).map_err(|error| raised(&error))?;
    let options = PathOptions::new().speeds(&times, &speeds);
    let options = start.as_deref().map_or(options, |start| options.start(start));
    let (path, has_arcs) = if let Some(scan) = stored.scan() {
        let limits = solver.bounds(wishes.limits)?;
        let path = |watch: &Watch| scan.path(&targets, limits.as_deref(), &options, watch);
        (watched(py, None, threads(None)?, path)?, false)
    } else {
        let (arm, options) = (arm(stored)?, options.limits(redundant::limits(solver, wishes.limits)?));
        (watched(py, None, 1, |watch| arm.path(&targets, &options, watch))?, true)
    };
    let jumps: Vec<_> =
        path.jumps.iter().map(|found| (found.sample, found.joint, found.step, found.why.as_str())).collect();
    let arcs = has_arcs.then(|| path.arcs.iter().map(|arc| *arc as i64).collect());
    made(py, &path.q, &jumps, (path.is_unsure, arcs))
}

/// A `groebot.Path`. Jumps have the index of their pose, that of their joint, the step and the reason.
fn made<'py>(
    py: Python<'py>,
    q: &[Vec<f64>],
    jumps: &[(usize, usize, f64, &str)],
    (is_unsure, arcs): (bool, Option<Vec<i64>>),
) -> PyResult<Bound<'py, PyAny>> {
    let made = py.import("groebot._records")?;
    let jump = made.getattr("Jump")?;
    let jumps = PyList::new(py, jumps.iter().map(|found| jump.call1(*found)).collect::<PyResult<Vec<_>>>()?)?;
    let arcs = arcs.map(|arcs| shaped(py, arcs, &[q.len()])).transpose()?;
    let q = shaped(py, q.concat(), &[q.len(), q.first().map_or(0, Vec::len)])?;
    made.getattr("Path")?.call1((q, jumps, is_unsure, arcs))
}

/// Converts rows to poses.
fn poses(stored: &Stored, poses: &Bound<'_, PyAny>, tolerance: Option<f64>) -> PyResult<Vec<Pose>> {
    let numbers = Numbers::of(poses)?;
    if !stored.target_shape.is_pose {
        return Err(unsupported(format!(
            "a path is of poses; the task of this solver is {}",
            stored.program.task_text()
        )));
    }
    let (shape, given) = (TargetShape { given: 0, ..stored.target_shape }, GivenValues::default());
    let tolerance = rotation::tolerance(tolerance, numbers.precision)?;
    let borrowed = numbers.array.try_readonly()?;
    let (targets, one) = shape.targets(numbers.shape(), borrowed.as_slice()?, &given, tolerance, Vec::new)?;
    let targets = targets.placed(stored.placement.as_ref());
    if one {
        return Err(bad_value("`poses` holds one pose; give it an axis more: poses[None]"));
    }
    let mut out = vec![0.0; 12];
    (0..targets.len())
        .map(|row| match targets.row(row, &mut out) {
            Status::Solved => pose(&out, row),
            status => Err(bad_value(format!("row {row} {}", targets.reason(row, status as u8)))),
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
