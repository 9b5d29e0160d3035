//! A derived solver as a Python class. Main type: [`Solver`].

use std::path::PathBuf;
use std::sync::Arc;

use groebot::codegen::{rust, single_file};
use groebot::derive::report::explain::explain;
use groebot::robots::{Kind, LISTED, Listed};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays;
use crate::choose::nearest_first;
use crate::closest;
use crate::errors::raised;
use crate::kernel::Answer;
use crate::many::{self, Wanted};
use crate::options::TargetOptions;
use crate::path::Wishes;
use crate::placed::PlacedSolver;
use crate::redundant::joint_values;
use crate::solution::{Solution, answers};
use crate::stored::Stored;
use crate::work::{threads as threads_of, watched};
use crate::{known, origin, path, redundant, rows, work};

/// A closed-form inverse-kinematics solver: it returns all joint values that move the tip of a chain to a target.
///
/// Angles are in radians, lengths in metres unless `length_unit` is `mm`. Targets are in the frame of the chain's base. A solver is immutable and can be used
/// by several threads.
#[pyclass(frozen, module = "groebot", name = "Solver")]
pub struct Solver(pub Arc<Stored>);

#[pymethods]
impl Solver {
    /// Returns the solver with this name; `Solver.names()` lists them. A solver that is not compiled into the package is derived at its first use and stored in
    /// the user's cache folder.
    #[staticmethod]
    #[pyo3(signature = (name, *, progress=None))]
    fn named(py: Python<'_>, name: &str, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        if let Some(known) = known::by_name(name) {
            return Stored::known(known).map(Solver::of).map_err(|error| raised(&error));
        }
        watched(py, progress, threads_of(None)?, |watch| Stored::cached(name, watch)).map(Solver::of)
    }

    /// The names of solvers: those that are compiled into the package, then those of other robots by name, unless `compiled`.
    #[staticmethod]
    #[pyo3(signature = (*, compiled=false))]
    fn names(compiled: bool) -> Vec<&'static str> {
        let others = LISTED.iter().filter(|robot| robot.kind() != Kind::Robot).map(Listed::name);
        let others = others.filter(|name| !compiled && known::by_name(name).is_none());
        known::ALL.iter().map(|known| known.name).chain(others).collect()
    }

    /// Reads a solver: the folder of a derivation, its `5_program.json`, or a file with the result of `to_json`. The certificate of a thin folder is proved
    /// again.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        Stored::load(&path).map(Solver::of).map_err(|error| raised(&error))
    }

    /// Reads the result of `to_json`, or a program of `groebot derive`.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        Stored::from_json(text).map(Solver::of).map_err(|error| raised(&error))
    }

    /// Converts the solver and its description to JSON.
    pub fn to_json(&self) -> String {
        self.0.to_json()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((py.get_type::<Solver>().getattr("from_json")?, (self.to_json(),)))
    }

    fn __repr__(&self) -> String {
        format!("<groebot.Solver {}: {}, {} joints>", self.name(), self.task(), self.0.program.joints.len())
    }

    /// The name of the mechanism.
    #[getter]
    pub fn name(&self) -> &str {
        &self.0.program.name
    }

    /// The task of the tip: `pose`, `position`, `ray of [1, 0, 0]`, `pose, A3 given`, ...
    #[getter]
    pub fn task(&self) -> String {
        self.0.program.task_text()
    }

    /// The names of the joints from base to tip: the order of joint values.
    #[getter]
    pub fn joints(&self) -> Vec<String> {
        self.0.program.joints.iter().map(|joint| joint.name.clone()).collect()
    }

    /// The names of a target's numbers, in order.
    #[getter]
    pub fn inputs(&self) -> Vec<String> {
        self.0.program.inputs.iter().map(|input| input.name.clone()).collect()
    }

    /// The names of the joints whose values are given with each target.
    #[getter]
    pub fn given(&self) -> Vec<String> {
        self.0.given_names()
    }

    /// `m` or `mm`.
    #[getter]
    fn length_unit(&self) -> &'static str {
        self.0.chain.as_ref().map_or("m", |chain| chain.length_unit().symbol())
    }

    /// The limits of each joint in the description, infinite where there are none: shape (joints, 2).
    #[getter]
    pub fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let limits = self.0.program.limits();
        arrays::shaped(py, limits.concat(), &[limits.len(), 2])
    }

    /// Whether it finds all solutions within limits of an arm with one joint more than its task determines, or with `scanned` joints those of samples. Targets
    /// are then without the values of `given`; with them, it solves as other solvers.
    #[getter]
    pub fn is_redundant(&self) -> bool {
        self.0.program.redundancy.is_some()
    }

    /// The names of the joints whose ranges are scanned, of an arm with two to four joints more than its task determines; empty for other solvers. Then
    /// `solve`, `any_within`, `best`, `nearest`, `solve_path` and `closest` use samples of these joints' values: completeness is that of the scan.
    #[getter]
    fn scanned(&self) -> Vec<&str> {
        self.0.scanned()
    }

    /// The number of complex solutions of a generic target, if it was counted.
    #[getter]
    fn solutions(&self) -> Option<usize> {
        self.0.program.about.as_ref().and_then(|about| about.solutions)
    }

    /// Whether the solver has compiled code for ordinary targets. Other targets and other solvers are interpreted, with bitwise identical solutions.
    #[getter]
    fn compiled(&self) -> bool {
        self.0.is_printed
    }

    /// Returns all solutions of one target, sorted by branch; an empty list if the target is out of reach.
    ///
    /// `target` is a matrix (4, 4), 12 numbers (position, rotation by rows), 7 numbers (position, quaternion x, y, z, w), a pair of a position and a rotation
    /// (a matrix, a quaternion, or scipy's), or a pose of scipy or spatialmath. For other tasks it is the numbers of `inputs`. With `limits`, only solutions are
    /// returned that are within them after whole turns. `limits` has the shape (joints, 2), or is `True` for those of the description, or a dict of joint names
    /// and pairs, which replace those of the description. With `q0` (joints,), each angle is moved by whole turns to the nearest value, and the nearest solution
    /// is the first one. With `as_array`, the joint values are returned as an array (solutions, joints).
    ///
    /// `given` are the values of the given joints: numbers in the order of `Solver.given`, or a dict of joint names and values. By default they are those of
    /// `q0`. `tolerance` is the largest deviation of a rotation, by default 1e-5: the largest entry of R^T R - 1, or the difference of a quaternion's length from
    /// one. A rotation within it is replaced by the nearest one. Arrays of float16 have a greater default.
    ///
    /// A redundant solver returns the best solution of each arc within the described limits as `groebot.Solutions`: by the margin to the limits, with `q0` by
    /// the distance to it. `limits` can only narrow the described ones. Without a solution, the list is empty and has a `reason`. With `scanned` joints, the
    /// list has the best solution of the scan only, which misses narrow ranges of solutions.
    #[pyo3(signature = (target, *, q0=None, given=None, limits=None, tolerance=None, as_array=false))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    pub fn solve<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
        given: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
        tolerance: Option<f64>,
        as_array: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = TargetOptions { given, limits, tolerance, as_array };
        if redundant::lacks_given(&self.0, target, given)? {
            return redundant::solve(py, self, target, q0, &options);
        }
        let turns = &self.0.kernel.shape().turns;
        let q0 = q0.map(|q0| joint_values(q0, turns.len(), "q0")).transpose()?;
        let bounds = self.bounds(limits)?;
        let mut found = self.found(target, &options, q0.as_deref(), bounds.as_deref())?;
        if let Some(q0) = &q0 {
            nearest_first(turns, q0, bounds.as_deref(), &mut found);
        }
        answers(py, found, turns.len(), as_array)
    }

    /// Returns the solution of one target that is nearest to the joint values `q0` after whole turns, within `limits` if these are given. `None` if there is
    /// none. Its angles are not wrapped. At a singular target the whole self-motion is searched, not only its listed member. Given joints keep their values of
    /// `q0`, unless `given` has others. A redundant solver searches all arcs within the described limits; with `scanned` joints, completeness is that of the
    /// scan. Other arguments are those of `solve`.
    #[pyo3(signature = (target, q0, *, given=None, limits=None, tolerance=None))]
    pub fn nearest(
        &self,
        py: Python<'_>,
        target: &Bound<'_, PyAny>,
        q0: &Bound<'_, PyAny>,
        given: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Option<Solution>> {
        let turns = &self.0.kernel.shape().turns;
        let q0 = joint_values(q0, turns.len(), "q0")?;
        let options = TargetOptions { given, limits, tolerance, as_array: false };
        if redundant::lacks_given(&self.0, target, given)? {
            return redundant::nearest(py, self, target, &q0, &options);
        }
        let bounds = self.bounds(limits)?.unwrap_or_else(|| vec![[f64::NEG_INFINITY, f64::INFINITY]; turns.len()]);
        let numbers = self.one_target(target, &options, Some(&q0), self.0.placement.as_ref())?;
        let nearest = self.0.kernel.nearest_to(&numbers, &q0, &bounds).map_err(|error| raised(&error))?;
        Ok(nearest.map(|nearest| Solution::from(Answer::from(&nearest))))
    }

    /// Returns all solutions of many targets, as arrays: see `groebot.Batch`.
    ///
    /// `targets` has the shape (N, 4, 4), (N, 12), (N, 7), or (N, numbers of `inputs`), or is a pair of N positions and N rotations. `given` has the shape (given
    /// joints,) or (N, given joints), or is a dict of joint names and values; by default it is that of `near`. With `limits`, only solutions are kept that are
    /// within them after whole turns. With `near`, of shape (joints,) or (N, joints), only the nearest solution of each target is kept. `out`, of shape (rows,
    /// joints), receives the joint values. Invalid targets are reported in `status`; with `strict` they raise an exception. `threads` is by default the number
    /// of processors, as for -1. `tolerance` is that of `solve`. A redundant solver returns for each target what `solve` returns; with `scanned` joints there
    /// are no batches.
    #[pyo3(signature = (targets, *, given=None, layout="ragged", limits=None, near=None, out=None, dtype=None, threads=None, strict=false, tolerance=None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    pub fn solve_batch<'py>(
        &self,
        py: Python<'py>,
        targets: &Bound<'py, PyAny>,
        given: Option<&Bound<'py, PyAny>>,
        layout: &str,
        limits: Option<&Bound<'py, PyAny>>,
        near: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        dtype: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
        strict: bool,
        tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let limits = self.bounds(limits)?;
        let (limits, threads) = (limits.as_deref(), work::threads(threads)?);
        let wanted = Wanted { given, limits, near, out, threads, strict, tolerance };
        let arrays = if redundant::lacks_given(&self.0, targets, given)? {
            rows::solve_batch(py, self, targets, &wanted)?
        } else {
            many::solve_batch(py, &self.0, targets, &wanted)?
        };
        let make = py.import("groebot._batch")?.getattr("made")?;
        make.call1((arrays, self.joints(), layout, dtype))
    }

    /// Forward kinematics of joint values of shape (joints,) or (N, joints). Returns matrices (4, 4) or (N, 4, 4) for poses, else the numbers of `inputs`
    /// without those of given joints.
    pub fn forward<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        many::forward(py, &self.0, q)
    }

    /// Returns the Jacobian of the tip at joint values of shape (joints,) or (N, joints): (6, joints) or (N, 6, joints). The linear velocity is in the first
    /// three rows.
    ///
    /// `frame="base"` is the Jacobian of the tip's origin, along the base's axes. `"tip"` is that of the tip's origin, along the tip's axes. `"spatial"` is
    /// that of the point of the tip at the base's origin.
    #[pyo3(signature = (q, frame="base"))]
    fn jacobian<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>, frame: &str) -> PyResult<Bound<'py, PyAny>> {
        many::jacobian(py, &self.0, q, frame)
    }

    /// Returns the joint values along poses (N, 4, 4) with the fewest jumps between branches, and among these the shortest motion: see `groebot.Path`.
    ///
    /// `q0` are the joint values before the first pose. A step is a jump if it exceeds `speeds` (joints,) \[rad/s, m/s\] times the time between two poses \[s\].
    /// This is `dt`, or the difference of `times` (N,). Without these, a jump is a step above half a radian or a tenth of the reach. Limits are those of the
    /// description. Given joints keep their values of `q0`, unless `given` has others. A redundant solver follows targets of any task along arcs, also within
    /// narrower `limits`. With `scanned` joints, these move over a grid of their values first. `tolerance` is that of `solve`.
    #[pyo3(signature = (poses, q0=None, *, dt=None, times=None, speeds=None, limits=None, given=None, tolerance=None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    pub fn solve_path<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
        dt: Option<f64>,
        times: Option<&Bound<'py, PyAny>>,
        speeds: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
        given: Option<&Bound<'py, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        path::solve_path(py, self, poses, &Wishes { q0, dt, times, speeds, limits, given, tolerance })
    }

    /// Returns the joint values whose target has the least error: see `groebot.Closest`. They are a solution if the target is reachable.
    ///
    /// The error is distance^2 + (2 length sin(angle / 2))^2. `length` is by default the reach. With `limits`, of shape (joints, 2) or `True` for those of the
    /// description, the joint values are within them; without, limits are not respected. A redundant solver without `given` moves all joints, within the
    /// described limits; `limits` can only narrow them.
    #[pyo3(signature = (target, *, length=None, given=None, limits=None, tolerance=None))]
    pub fn closest<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        length: Option<f64>,
        given: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        closest::closest(py, self, target, length, &TargetOptions { given, limits, tolerance, as_array: false })
    }

    /// Returns the solver for targets of a tool in a world frame, world_from_tool: see `groebot.PlacedSolver`. `base` is world_from_base and `tool` is
    /// tip_from_tool, each a pose in a form of `solve`; the default is the identity. Other tasks than `pose` allow the placements that do not change their kind
    /// of target. `tolerance` is that of `solve`.
    #[pyo3(signature = (*, base=None, tool=None, tolerance=None))]
    fn placed(
        &self,
        base: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<PlacedSolver> {
        PlacedSolver::new(&self.0, base, tool, tolerance)
    }

    /// Proves the derivation again from its certificate, without the Groebner engine. Then checks the solutions of all kinds of targets against forward
    /// kinematics, exact counts, the screw solver and a numeric search: see `groebot.Check`. Raises an exception if a check fails.
    #[pyo3(signature = (*, progress=None, threads=None))]
    fn check<'py>(
        &self,
        py: Python<'py>,
        progress: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let stored = &self.0;
        let checked = work::watched(py, progress, work::threads(threads)?, |watch| {
            let proved = stored.proved(watch)?;
            let mut source = stored.source()?;
            source.choose_given(watch)?;
            origin::check(&source, &proved, watch)
        })?;
        let made = py.import("groebot._records")?.getattr("Check")?;
        made.call1((checked.targets, PyTuple::new(py, checked.weak_spots)?, checked.table))
    }

    /// Explains the derivation step by step: see `groebot.Explanation`, which notebooks display.
    #[pyo3(signature = (*, progress=None, threads=None))]
    fn explain<'py>(
        &self,
        py: Python<'py>,
        progress: Option<&Bound<'py, PyAny>>,
        threads: Option<i64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let stored = &self.0;
        let (markdown, latex) = work::watched(py, progress, work::threads(threads)?, |watch| {
            let document = explain(&*stored.proved(watch)?)?;
            Ok((document.to_markdown(), document.to_latex()))
        })?;
        py.import("groebot._records")?.getattr("Explanation")?.call1((markdown, latex))
    }

    /// Generates the solver as one self-contained C99 file, to be linked with `-lm`. With `single`, all numbers are
    /// floats.
    #[pyo3(signature = (*, single=false))]
    fn c_source(&self, single: bool) -> String {
        single_file::c(&self.0.program, &format!("{}.c", self.0.program.name), single)
    }

    /// Generates the solver as a Rust file: self-contained, or using the crate `groebot-runtime`.
    #[pyo3(signature = (*, alone=true))]
    fn rust_source(&self, alone: bool) -> String {
        if alone { single_file::rust(&self.0.program) } else { rust::emit(&self.0.program) }
    }
}
