//! The array methods of [`crate::solver::Solver`]: many targets or joint values at once.

use groebot::kinematics::Chain;
use groebot::kinematics::jacobian::Jacobian;
use groebot::spatial::Pose;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PySlice, PyTuple};

use crate::arrays::{self, Numbers, finite, joint_rows, no_targets};
use crate::batch::{Job, Room, solve_all};
use crate::choose::Choice;
use crate::errors::{bad_value, raised, unsupported};
use crate::given::GivenValues;
use crate::rotation;
use crate::sink::Rows;
use crate::stored::{Stored, chain};

/// Options of a batch.
pub struct Wanted<'a, 'py> {
    pub given: Option<&'a Bound<'py, PyAny>>,
    pub limits: Option<&'a [[f64; 2]]>,
    pub near: Option<&'a Bound<'py, PyAny>>,
    pub out: Option<&'a Bound<'py, PyAny>>,
    pub threads: usize,
    pub strict: bool,
    /// Largest deviation of a rotation that is projected.
    pub tolerance: Option<f64>,
}

/// Computes the arrays q, starts, residual, branch, free, status of all solutions.
///
/// # Errors
/// `BadValueError` for wrong shapes, for `out` with too few rows, and in strict mode for invalid targets.
pub fn solve_batch<'py>(
    py: Python<'py>,
    stored: &Stored,
    targets: &Bound<'py, PyAny>,
    wanted: &Wanted<'_, 'py>,
) -> PyResult<Bound<'py, PyTuple>> {
    let joints = stored.program.joints.len();
    let numbers = Numbers::of(targets)?;
    let near = wanted.near.map(|near| reference(near, joints)).transpose()?;
    let given = GivenValues::new(stored, wanted.given, near.as_deref())?;
    let tolerance = rotation::tolerance(wanted.tolerance, numbers.precision)?;
    let borrowed = numbers.array.try_readonly()?;
    let (data, names) = (borrowed.as_slice()?, || stored.given_names());
    let (rows, one) = stored.target_shape.targets(numbers.shape(), data, &given, tolerance, names)?;
    let rows = rows.placed(stored.placement.as_ref());
    if one {
        return Err(bad_value("`targets` holds one target; use solve, or give it an axis more: targets[None]"));
    }
    check_rows(near.as_deref(), joints, rows.len())?;
    let choice = Choice { limits: wanted.limits, near: near.as_deref() };
    let job = Job { kernel: &*stored.kernel, targets: &rows, choice: &choice };
    let solved = solved(py, job, wanted)?;
    if wanted.strict {
        refuse(solved.status.try_readonly()?.as_slice()?, |row, status| rows.reason(row, status))?;
    }
    PyTuple::new(py, solved.arrays(py)?)
}

/// Arrays with all solutions, and unused rows after them.
struct Solved<'py> {
    q: Bound<'py, PyArray2<f64>>,
    residual: Bound<'py, PyArray1<f64>>,
    branch: Bound<'py, PyArray1<i32>>,
    free: Bound<'py, PyArray1<u32>>,
    starts: Bound<'py, PyArray1<i64>>,
    status: Bound<'py, PyArray1<u8>>,
    answers: usize,
    /// Whether `q` is the caller's array.
    is_lent: bool,
}

/// Solves a job into new numpy arrays, whose memory is reused from call to call. Targets with more solutions than ordinary ones are rare. Only if there are
/// many of them are arrays of the maximum size allocated.
fn solved<'py>(py: Python<'py>, job: Job<'_>, wanted: &Wanted<'_, 'py>) -> PyResult<Solved<'py>> {
    let (shape, targets, joints) = (job.kernel.shape(), job.targets.len(), job.kernel.shape().turns.len());
    let lent = wanted.out.map(|out| room(out, joints)).transpose()?;
    let usual = if job.choice.near.is_some() { 1 } else { shape.usual };
    let starts = new(py, targets + 1, "int64")?;
    let status = new(py, targets, "uint8")?;
    for own in [targets * usual + shape.capacity, targets * shape.capacity] {
        let own = lent.as_ref().map_or(own, |lent| lent.shape()[0]);
        let q = lent.clone().map_or_else(|| new::<PyArray2<f64>>(py, (own, joints), "float64"), Ok)?;
        let mut solved = Solved {
            q,
            residual: new(py, own, "float64")?,
            branch: new(py, own, "int32")?,
            free: new(py, own, "uint32")?,
            starts: Bound::clone(&starts),
            status: Bound::clone(&status),
            answers: 0,
            is_lent: lent.is_some(),
        };
        if let Some(answers) = solved.fill(py, job, wanted.threads)? {
            solved.answers = answers;
            return Ok(solved);
        }
    }
    let text =
        "`out` has too few rows for all solutions; (N * solver.solutions, joints) are enough but for singular targets";
    Err(bad_value(text))
}

impl<'py> Solved<'py> {
    /// Solves the job. Returns the number of solutions; `None` when there are too few rows.
    fn fill(&mut self, py: Python<'py>, job: Job<'_>, threads: usize) -> PyResult<Option<usize>> {
        let (mut q, mut residual) = (self.q.try_readwrite()?, self.residual.try_readwrite()?);
        let (mut branch, mut free) = (self.branch.try_readwrite()?, self.free.try_readwrite()?);
        let (mut starts, mut status) = (self.starts.try_readwrite()?, self.status.try_readwrite()?);
        let rows = Rows {
            q: q.as_slice_mut()?,
            residual: residual.as_slice_mut()?,
            branch: branch.as_slice_mut()?,
            free: free.as_slice_mut()?,
        };
        let starts = starts.as_slice_mut()?;
        let room = Room { rows, counts: &mut starts[1..], status: status.as_slice_mut()? };
        let Some(answers) = py.detach(|| solve_all(job, threads, room))? else { return Ok(None) };
        starts[0] = 0;
        let mut all = 0;
        for start in starts {
            all += *start;
            *start = all;
        }
        Ok(Some(answers))
    }

    /// q, starts, residual, branch, free, status without the unused rows.
    fn arrays(self, py: Python<'py>) -> PyResult<[Bound<'py, PyAny>; 6]> {
        let front = front(py, self.answers)?;
        // Arrays that are much too large are copied.
        let is_large = !self.is_lent && self.q.shape()[0] > 2 * self.answers + 64;
        let cut = |array: Bound<'py, PyAny>| {
            let front = array.get_item(&front)?;
            if is_large { front.call_method0("copy") } else { Ok(front) }
        };
        Ok([
            cut(self.q.into_any())?,
            self.starts.into_any(),
            cut(self.residual.into_any())?,
            cut(self.branch.into_any())?,
            cut(self.free.into_any())?,
            self.status.into_any(),
        ])
    }
}

/// The slice of the first rows. `PySlice::new` of PyO3 0.30 keeps the memory of its numbers for ever.
pub fn front(py: Python<'_>, rows: usize) -> PyResult<Bound<'_, PyAny>> {
    py.get_type::<PySlice>().call1((rows,))
}

/// A new, uninitialised numpy array.
fn new<'py, A>(py: Python<'py>, shape: impl IntoPyObject<'py>, dtype: &str) -> PyResult<Bound<'py, A>>
where
    A: pyo3::PyTypeCheck,
{
    Ok(py.import("numpy")?.getattr("empty")?.call1((shape, dtype))?.cast_into::<A>()?)
}

/// Fails if rows are invalid targets, with their indices and the reason of the first one.
pub fn refuse(status: &[u8], reason: impl Fn(usize, u8) -> String) -> PyResult<()> {
    let (rows, count) = no_targets(status);
    let Some(first) = rows.first() else { return Ok(()) };
    let others = if count > 1 { format!("; {count} rows are not targets: {rows:?}") } else { String::new() };
    let more = if count > rows.len() { " and more" } else { "" };
    Err(bad_value(format!("row {first} {}{others}{more}", reason(*first, status[*first]))))
}

/// Reference joint values: one row for all targets, or one for each.
pub fn reference(near: &Bound<'_, PyAny>, joints: usize) -> PyResult<Vec<f64>> {
    let numbers = Numbers::of(near)?;
    joint_rows(&numbers, joints, "near")?;
    let list = numbers.to_vec()?;
    finite(&list, joints, "near")?;
    Ok(list)
}

/// Checks the number of rows of the reference joint values.
pub fn check_rows(near: Option<&[f64]>, joints: usize, targets: usize) -> PyResult<()> {
    match near.map(|near| near.len() / joints.max(1)) {
        Some(rows) if rows != 1 && rows != targets => {
            Err(bad_value(format!("`near` has {rows} rows; give one, or one for each of {targets} targets")))
        }
        _ => Ok(()),
    }
}

/// The caller's array for joint values.
pub fn room<'py>(out: &Bound<'py, PyAny>, joints: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let array = out.cast::<PyArray2<f64>>().ok().filter(|array| array.is_c_contiguous());
    let array = array.filter(|array| array.shape()[1] == joints);
    array
        .cloned()
        .ok_or_else(|| bad_value(format!("`out` must be a contiguous float64 array of shape (rows, {joints})")))
}

/// Rows of joint values, and whether there is a single row.
fn joint_values(stored: &Stored, q: &Bound<'_, PyAny>) -> PyResult<(Vec<f64>, bool)> {
    let (numbers, joints) = (Numbers::of(q)?, stored.program.joints.len());
    let one = joint_rows(&numbers, joints, "q")?;
    let list = numbers.to_vec()?;
    finite(&list, joints, "q")?;
    Ok((list, one))
}

/// Forward kinematics of joint values.
///
/// # Errors
/// `BadValueError` for wrong shapes and values that are not finite; an error of the kind `unsupported` if the equations do not determine the result.
pub fn forward<'py>(py: Python<'py>, stored: &Stored, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let (list, one) = joint_values(stored, q)?;
    let (joints, shape) = (stored.program.joints.len(), stored.target_shape);
    let reached = py.detach(|| {
        let mut all = Vec::new();
        for row in list.chunks(joints) {
            let mut numbers = stored.kernel.forward(row)?;
            if let Some(placement) = &stored.placement {
                placement.to_world(&mut numbers);
            }
            if shape.is_pose {
                for i in 0..3 {
                    all.extend_from_slice(&numbers[3 + 3 * i..6 + 3 * i]);
                    all.push(numbers[i]);
                }
                all.extend_from_slice(&[0.0, 0.0, 0.0, 1.0]);
            } else {
                all.extend_from_slice(&numbers[..shape.own]);
            }
        }
        Some(all)
    });
    let reached =
        reached.ok_or_else(|| unsupported("the equations of this solver do not say what joint values reach"))?;
    let own: &[usize] = if shape.is_pose { &[4, 4] } else { &[shape.own] };
    with_rows(py, reached, list.len() / joints, own, one)
}

/// The Jacobian in a frame.
///
/// # Errors
/// As [`forward`]; `BadValueError` for another frame; an error of the kind `unsupported` for a solver without a chain.
pub fn jacobian<'py>(
    py: Python<'py>,
    stored: &Stored,
    q: &Bound<'py, PyAny>,
    frame: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let (list, one) = joint_values(stored, q)?;
    let chain = chain(stored)?;
    let joints = stored.program.joints.len();
    if chain.joints().len() != joints {
        return Err(unsupported("this solver has other joints than its chain"));
    }
    let of: fn(&Chain, &[f64]) -> groebot::Result<Jacobian> = match frame {
        "base" => in_base,
        "tip" => |chain, q| chain.body_jacobian(q),
        "spatial" => |chain, q| chain.spatial_jacobian(q),
        _ => return Err(bad_value(format!("the frame `{frame}` is not known; give base, tip or spatial"))),
    };
    let rows = py.detach(|| {
        let each = list.chunks(joints).map(|q| of(chain, q).map(|jacobian| jacobian.transpose().as_slice().to_vec()));
        each.collect::<groebot::Result<Vec<_>>>()
    });
    let rows = rows.map_err(|error| raised(&error))?;
    with_rows(py, rows.concat(), rows.len(), &[6, joints], one)
}

/// The Jacobian of the tip's origin, along the base's axes.
fn in_base(chain: &Chain, q: &[f64]) -> groebot::Result<Jacobian> {
    let Pose { rotation, .. } = chain.forward(q)?;
    let turn = rotation.to_rotation_matrix().into_inner();
    let mut jacobian = chain.body_jacobian(q)?;
    for mut column in jacobian.column_iter_mut() {
        for part in [0, 3] {
            let turned = turn * column.fixed_rows::<3>(part);
            column.fixed_rows_mut::<3>(part).copy_from(&turned);
        }
    }
    Ok(jacobian)
}

/// Converts rows to an array with an additional first axis, unless there is a single row.
pub fn with_rows<'py>(
    py: Python<'py>,
    list: Vec<f64>,
    rows: usize,
    own: &[usize],
    one: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let shape = if one { own.to_vec() } else { [&[rows], own].concat() };
    arrays::shaped(py, list, &shape)
}
