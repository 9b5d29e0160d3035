from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol, final, overload

import numpy as np
import numpy.typing as npt

from ._arms import ArcEnd, Arcs, Best, BestBatch, Within, WithinBatch
from ._batch import Batch, PaddedBatch
from ._records import Check, Closest, Explanation, Path, Walk
from ._view import View

__all__ = [
    "Arc",
    "PlacedSolver",
    "Robot",
    "Solution",
    "Solver",
    "Stabilizer",
    "__version__",
    "_any_within",
    "_any_within_batch",
    "_arcs",
    "_best",
    "_best_batch",
    "_optima",
    "_reach",
    "_reach_as",
    "_run",
    "_solution",
    "derive",
    "navigate",
]
__version__: str

class _Matrix(Protocol):
    """A Rotation or RigidTransform of scipy."""

    def as_matrix(self) -> npt.NDArray[Any]: ...

class _Se3(Protocol):
    """An SE3 or SO3 of spatialmath."""

    @property
    def A(self) -> Any: ...

_Target = npt.ArrayLike | _Matrix | _Se3 | tuple[npt.ArrayLike, npt.ArrayLike | _Matrix]
_Given = npt.ArrayLike | Mapping[str, npt.ArrayLike]
_Limits = npt.ArrayLike | bool | Mapping[str, npt.ArrayLike]
_Criterion = Literal["margin", "relative_margin", "nearest", "manipulability", "change"]
_PassedCriterion = tuple[str, list[float], list[float], int, float]
_Progress = Callable[[str, int, int], object]
_File = str | PathLike[str]
_Floats = npt.NDArray[np.float64]

@final
class Solution:
    """One solution: joint values that move the tip to its target.

    >>> ur5 = groebot.Solver.named("ur5")
    >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
    >>> solution = ur5.solve(ur5.forward(q), q0=q)[0]
    >>> np.allclose(solution.q, q), solution.free, solution.residual < 1e-9
    (True, (), True)
    >>> np.array(ur5.solve(ur5.forward(q))).shape
    (8, 6)
    """
    @property
    def q(self) -> _Floats:
        """The joint values, base to tip, in radians or the solver's unit of length; shape (joints,). Angles are in (-pi, pi], unless limits, `q0` or a
        redundant solver determine their turns. The array is read-only; `solution.q.copy()` and `numpy.array(solution)` can be changed.
        """
    @property
    def residual(self) -> float:
        """The largest residual of the equations at `q`, in their own unit."""
    @property
    def branch(self) -> int:
        """Branch number: which roots of which equations were used. A branch keeps its number from target to target. Of a redundant solver it is the index of
        the solution's arc among those of `arcs`.
        """
    @property
    def free(self) -> tuple[int, ...]:
        """The free joints (indices from 0) of a singular target: each can have any value, with other values of the other joints."""
    @property
    def chosen(self) -> bool:
        """Whether the source of the mechanism would select this solution."""
    @property
    def settled(self) -> bool:
        """Whether all polishing steps were completed. If false, other solutions may be missing, and `residual` shows the accuracy of this one. Of a redundant
        solver it is false if the arcs of the target are unsure.
        """
    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]: ...

@final
class Arc:
    """A maximal connected curve of solutions within limits. It never changes, and any number of threads may use it."""
    @property
    def start(self) -> ArcEnd:
        """Where it begins: see `groebot.ArcEnd`. For a closed curve, a point on it."""
    @property
    def end(self) -> ArcEnd:
        """Where it ends: see `groebot.ArcEnd`."""
    @property
    def length(self) -> float:
        """The length in the space of joint values [rad]. Lengths of prismatic joints are divided by the characteristic length of the solver."""
    @property
    def is_closed(self) -> bool:
        """Whether the curve is closed and reaches no limit."""
    @property
    def is_unsure(self) -> bool:
        """Whether something was not decided, such as which curve continues where two cross."""
    def at(self, s: npt.ArrayLike) -> _Floats:
        """Returns the joint values at distances `s` from the start, in the unit of `length`: shape (joints,) for a number, (N, joints) for N numbers. A
        distance is limited to the arc. Each call follows the arc again: for many distances, `sample` is faster.
        """
    def sample(self, n: int) -> _Floats:
        """Returns the joint values at `n` nearly equal distances along the arc, the ends included: shape (n, joints). An angle whose range is at least one turn
        may differ by whole turns between neighbours. `n` is from 1 to 1,000,000.
        """

@final
class Solver:
    """A closed-form inverse-kinematics solver: it returns all joint values that move the tip of a chain to a target.

    Angles are in radians, lengths in metres unless `length_unit` is `mm`. Targets are in the frame of the chain's base. A solver is immutable and can be used
    by several threads.

    >>> ur5 = groebot.Solver.named("ur5")
    >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
    >>> ur5
    <groebot.Solver ur5: pose, 6 joints>
    >>> for solution in ur5.solve(ur5.forward(q)):
    ...     assert np.allclose(ur5.forward(solution.q), ur5.forward(q))
    """
    @staticmethod
    def named(name: str, *, progress: _Progress | None = None) -> Solver:
        """Returns the solver with this name; `Solver.names()` lists them. A solver that is not compiled into the package is derived at its first use and stored in
        the user's cache folder.

        >>> groebot.Solver.named("iiwa14").given
        ['A3']
        """
    @staticmethod
    def names(*, compiled: bool = False) -> list[str]:
        """The names of solvers: those that are compiled into the package, then those of other robots by name, unless `compiled`.

        >>> "ur5" in groebot.Solver.names(compiled=True) and "franka_panda" in groebot.Solver.names()
        True
        """
    @staticmethod
    def load(path: _File) -> Solver:
        """Reads a solver: the folder of a derivation, its `5_program.json`, or a file with the result of `to_json`. The certificate of a thin folder is proved
        again.
        """
    @staticmethod
    def from_json(text: str) -> Solver:
        """Reads the result of `to_json`, or a program of `groebot derive`.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> again = groebot.Solver.from_json(ur5.to_json())
        >>> np.array_equal(again.solve(ur5.forward(q), as_array=True), ur5.solve(ur5.forward(q), as_array=True))
        True
        """
    def to_json(self) -> str:
        """Converts the solver and its description to JSON."""
    @property
    def name(self) -> str:
        """The name of the mechanism."""
    @property
    def task(self) -> str:
        """The task of the tip: `pose`, `position`, `ray of [1, 0, 0]`, `pose, A3 given`, ..."""
    @property
    def joints(self) -> list[str]:
        """The names of the joints from base to tip: the order of joint values.

        >>> groebot.Solver.named("ur5").joints
        ['ShoulderPan', 'ShoulderLift', 'Elbow', 'Wrist1', 'Wrist2', 'Wrist3']
        """
    @property
    def inputs(self) -> list[str]:
        """The names of a target's numbers, in order."""
    @property
    def given(self) -> list[str]:
        """The names of the joints whose values are given with each target."""
    @property
    def length_unit(self) -> str:
        """`m` or `mm`."""
    @property
    def limits(self) -> _Floats:
        """The limits of each joint in the description, infinite where there are none: shape (joints, 2)."""
    @property
    def is_redundant(self) -> bool:
        """Whether it finds all solutions within limits of an arm with one joint more than its task determines, or with `scanned` joints those of samples.
        Targets are then without the values of `given`; with them, it solves as other solvers.
        """
    @property
    def scanned(self) -> list[str]:
        """The names of the joints whose ranges are scanned, of an arm with two to four joints more than its task determines; empty for other solvers. Then
        `solve`, `any_within`, `best`, `nearest`, `solve_path` and `closest` use samples of these joints' values: completeness is that of the scan.
        """
    @property
    def solutions(self) -> int | None:
        """The number of complex solutions of a generic target, if it was counted."""
    @property
    def compiled(self) -> bool:
        """Whether the solver has compiled code for ordinary targets. Other targets and other solvers are interpreted, with bitwise identical solutions."""
    @overload
    def solve(
        self,
        target: _Target,
        *,
        q0: npt.ArrayLike | None = None,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
        as_array: Literal[False] = False,
    ) -> list[Solution]:
        """Returns all solutions of one target, sorted by branch; an empty list if the target is out of reach.

        `target` is a matrix (4, 4), 12 numbers (position, rotation by rows), 7 numbers (position, quaternion x, y, z, w), a pair of a position and a rotation
        (a matrix, a quaternion, or scipy's), or a pose of scipy or spatialmath. For other tasks it is the numbers of `inputs`. With `limits`, only solutions
        are returned that are within them after whole turns. `limits` has the shape (joints, 2), or is `True` for those of the description, or a dict of joint
        names and pairs, which replace those of the description. With `q0` (joints,), each angle is moved by whole turns to the nearest value, and the nearest
        solution is the first one. With `as_array`, the joint values are returned as an array (solutions, joints).

        `given` are the values of the given joints: numbers in the order of `Solver.given`, or a dict of joint names and values. By default they are those of
        `q0`. `tolerance` is the largest deviation of a rotation, by default 1e-5: the largest entry of R^T R - 1, or the difference of a quaternion's length
        from one. A rotation within it is replaced by the nearest one. Arrays of float16 have a greater default.

        A redundant solver returns the best solution of each arc within the described limits as `groebot.Solutions`: by the margin to the limits, with `q0` by
        the distance to it. `limits` can only narrow the described ones. Without a solution, the list is empty and has a `reason`. With `scanned` joints, the
        list has the best solution of the scan only, which misses narrow ranges of solutions.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> T = ur5.forward(q)
        >>> len(ur5.solve(T))
        8
        >>> np.allclose(ur5.solve(T, q0=q)[0].q, q)
        True
        >>> ur5.solve((T[:3, 3], T[:3, :3]), as_array=True).shape
        (8, 6)
        >>> len(ur5.solve(T, limits=np.tile([-2.0, 2.0], (6, 1)))) < 8
        True
        >>> arm, q0 = groebot.Solver.named("iiwa14"), np.full(7, 0.3)
        >>> len(arm.solve(arm.forward(q0), given={"A3": 0.3})) == len(arm.solve(arm.forward(q0), q0=q0))
        True
        """
    @overload
    def solve(
        self,
        target: _Target,
        *,
        q0: npt.ArrayLike | None = None,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
        as_array: Literal[True],
    ) -> _Floats: ...
    def nearest(
        self,
        target: _Target,
        q0: npt.ArrayLike,
        *,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> Solution | None:
        """Returns the solution of one target that is nearest to the joint values `q0` after whole turns, within `limits` if these are given. `None` if there is
        none. Its angles are not wrapped. At a singular target the whole self-motion is searched, not only its listed member. Given joints keep their values
        of `q0`, unless `given` has others. A redundant solver searches all arcs within the described limits; with `scanned` joints, completeness is that of
        the scan. Other arguments are those of `solve`.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> np.allclose(ur5.nearest(ur5.forward(q), q + 2 * np.pi).q, q + 2 * np.pi)
        True
        """
    @overload
    def solve_batch(
        self,
        targets: _Target,
        *,
        given: _Given | None = None,
        layout: Literal["ragged"] = "ragged",
        limits: _Limits | None = None,
        near: npt.ArrayLike | None = None,
        out: _Floats | None = None,
        dtype: npt.DTypeLike | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> Batch:
        """Returns all solutions of many targets, as arrays: see `groebot.Batch`.

        `targets` has the shape (N, 4, 4), (N, 12), (N, 7), or (N, numbers of `inputs`), or is a pair of N positions and N rotations. `given` has the shape
        (given joints,) or (N, given joints), or is a dict of joint names and values; by default it is that of `near`. With `limits`, only solutions are kept
        that are within them after whole turns. With `near`, of shape (joints,) or (N, joints), only the nearest solution of each target is kept. `out`, of
        shape (rows, joints), receives the joint values. Invalid targets are reported in `status`; with `strict` they raise an exception. `threads` is by
        default the number of processors, as for -1. `tolerance` is that of `solve`. A redundant solver returns for each target what `solve` returns; with
        `scanned` joints there are no batches.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> batch = ur5.solve_batch(ur5.forward(q + np.linspace(0, 0.1, 100)[:, None]))
        >>> len(batch), batch[7].shape
        (100, (8, 6))
        >>> for rows in batch[:3]:
        ...     assert rows.shape == (8, 6)
        """
    @overload
    def solve_batch(
        self,
        targets: _Target,
        *,
        given: _Given | None = None,
        layout: Literal["padded"],
        limits: _Limits | None = None,
        near: npt.ArrayLike | None = None,
        out: _Floats | None = None,
        dtype: npt.DTypeLike | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> PaddedBatch: ...
    def closest(
        self,
        target: _Target,
        *,
        length: float | None = None,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> Closest:
        """Returns the joint values whose target has the least error: see `groebot.Closest`. They are a solution if the target is reachable.

        The error is distance^2 + (2 length sin(angle / 2))^2. `length` is by default the reach. With `limits`, of shape (joints, 2) or `True` for those of the
        description, the joint values are within them; without, limits are not respected. A redundant solver without `given` moves all joints, within the
        described limits; `limits` can only narrow them.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> T = ur5.forward(q)
        >>> ur5.closest(T).reachable
        True
        >>> T[:3, 3] = 1.5, 0.0, 0.5
        >>> closest = ur5.closest(T)
        >>> closest.reachable, closest.distance > 0.3
        (False, True)
        """
    def forward(self, q: npt.ArrayLike) -> _Floats:
        """Forward kinematics of joint values of shape (joints,) or (N, joints). Returns matrices (4, 4) or (N, 4, 4) for poses, else the numbers of `inputs`
        without those of given joints.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> ur5.forward(q).shape, ur5.forward([q, q]).shape
        ((4, 4), (2, 4, 4))
        """
    def jacobian(self, q: npt.ArrayLike, frame: Literal["base", "tip", "spatial"] = "base") -> _Floats:
        """Returns the Jacobian of the tip at joint values of shape (joints,) or (N, joints): (6, joints) or (N, 6, joints). The linear velocity is in the first
        three rows.

        `frame="base"` is the Jacobian of the tip's origin, along the base's axes. `"tip"` is that of the tip's origin, along the tip's axes. `"spatial"` is
        that of the point of the tip at the base's origin.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> ur5.jacobian(q).shape
        (6, 6)
        """
    def solve_path(
        self,
        poses: _Target,
        q0: npt.ArrayLike | None = None,
        *,
        dt: float | None = None,
        times: npt.ArrayLike | None = None,
        speeds: npt.ArrayLike | None = None,
        limits: _Limits | None = None,
        given: _Given | None = None,
        tolerance: float | None = None,
    ) -> Path:
        """Returns the joint values along poses (N, 4, 4) with the fewest jumps between branches, and among these the shortest motion: see `groebot.Path`.

        `q0` are the joint values before the first pose. A step is a jump if it exceeds `speeds` (joints,) [rad/s, m/s] times the time between two poses [s].
        This is `dt`, or the difference of `times` (N,). Without these, a jump is a step above half a radian or a tenth of the reach. Limits are those of the
        description. Given joints keep their values of `q0`, unless `given` has others. A redundant solver follows targets of any task along arcs, also within
        narrower `limits`. With `scanned` joints, these move over a grid of their values first. `tolerance` is that of `solve`.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> route = q + np.linspace(0, 0.3, 20)[:, None]
        >>> path = ur5.solve_path(ur5.forward(route), q)
        >>> np.allclose(path.q, route), path.jumps
        (True, [])
        """
    def any_within(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Within:
        """Returns one solution of a redundant solver within limits, by no criterion, or the reason why there is none.

        `target` is that of `solve`, without the value of the given joint. Solutions are within the described limits. `limits` can only narrow them: an array
        (joints, 2), or a dict of joint names and pairs. With scanned joints, completeness is that of the scan: 33 values of one joint are tried (132 of two,
        528 of three), then values next to solutions beyond limits. `tolerance` is that of `solve`. `BadValueError` for a wrong target or limits; an error of
        the kind `unsupported` for a solver that is not redundant.
        """
    def any_within_batch(
        self,
        targets: _Target,
        *,
        limits: _Limits | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> WithinBatch:
        """Same as `any_within` for N targets, on all processors. Invalid targets are reported in `status`; with `strict` they raise an exception."""
    def arcs(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Arcs:
        """Returns all arcs of solutions of a redundant solver within limits. Arguments and errors are those of `any_within`; an error of the kind `unsupported`
        with scanned joints.
        """
    def best(
        self,
        target: _Target,
        criterion: _Criterion = "margin",
        *,
        q0: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        joint: str | int | None = None,
        value: float | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> Best | None:
        """Returns the best solution of a redundant solver within limits; None if there is none.

        Criteria: `margin`, the greatest least distance of a joint to its limits [rad]; `relative_margin`, the same divided by half of the range; `nearest`, the
        least distance to `q0` (joints,) with `weights` (joints,) of the squares; `manipulability`, the greatest one; `change`, the least difference of `joint`
        (name or index) from `value`. Lengths in margins and in the manipulability are divided by the characteristic length. With scanned joints, it is the best
        of the samples, refined by golden section search, and the manipulability is that of the other joints. Other arguments and errors are those of
        `any_within`.
        """
    def best_batch(
        self,
        targets: _Target,
        criterion: _Criterion = "margin",
        *,
        q0: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        joint: str | int | None = None,
        value: float | None = None,
        limits: _Limits | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> BestBatch:
        """Same as `best` for N targets, on all processors. `q0` has the shape (joints,) or (N, joints). Invalid targets are reported in `status`; with `strict`
        they raise an exception.
        """
    def optima(
        self,
        target: _Target,
        criterion: _Criterion = "margin",
        *,
        q0: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        joint: str | int | None = None,
        value: float | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> list[Best]:
        """Returns the local optima on all arcs, ends included, the best ones first, at most 128. Arguments and errors are those of `best`; an error of the kind
        `unsupported` with scanned joints.
        """
    def placed(self, *, base: _Target | None = None, tool: _Target | None = None, tolerance: float | None = None) -> PlacedSolver:
        """Returns the solver for targets of a tool in a world frame, world_from_tool: see `groebot.PlacedSolver`. `base` is world_from_base and `tool` is
        tip_from_tool, each a pose in a form of `solve`; the default is the identity. Other tasks than `pose` allow the placements that do not change their
        kind of target. `tolerance` is that of `solve`.

        >>> ur5 = groebot.Solver.named("ur5")
        >>> q = np.array([0.1, -1.2, 1.4, -0.3, 0.8, 0.5])
        >>> tool = np.eye(4)
        >>> tool[2, 3] = 0.12
        >>> placed = ur5.placed(tool=tool)
        >>> len(placed.solve(placed.forward(q)))
        8
        """
    def check(self, *, progress: _Progress | None = None, threads: int | None = None) -> Check:
        """Proves the derivation again from its certificate, without the Groebner engine. Then checks the solutions of all kinds of targets against forward
        kinematics, exact counts, the screw solver and a numeric search: see `groebot.Check`. Raises an exception if a check fails.
        """
    def explain(self, *, progress: _Progress | None = None, threads: int | None = None) -> Explanation:
        """Explains the derivation step by step: see `groebot.Explanation`, which notebooks display."""
    def c_source(self, *, single: bool = False) -> str:
        """Generates the solver as one self-contained C99 file, to be linked with `-lm`. With `single`, all numbers are floats.

        >>> "ur5_solve" in groebot.Solver.named("ur5").c_source()
        True
        """
    def rust_source(self, *, alone: bool = True) -> str:
        """Generates the solver as a Rust file: self-contained, or using the crate `groebot-runtime`."""
    def view(self, path: _File | None = None, *, open: bool | None = None, height: int = 600, reach: _File | None = None) -> View:
        """Writes the page of `groebot view` for this solver: all solutions, updated while the target is dragged.

        `path` is the output file, by default a temporary file. The page is opened in the browser, except in a notebook, which displays the returned object;
        `open` overrides this. `height` is that in a notebook [pixels]. `reach` is a file with a reach map (`ReachMap.save`). For tasks other than a pose the
        page shows only the chain. `BadValueError` for a solver without a chain.
        """

@final
class PlacedSolver:
    """A solver whose base is placed in a world frame, and whose tip has a tool: targets are those of the tool in the world frame, world_from_tool.

    Its methods are those of `groebot.Solver`. It never changes, and any number of threads may use it.
    """
    @property
    def base(self) -> _Floats:
        """The pose world_from_base, (4, 4)."""
    @property
    def tool(self) -> _Floats:
        """The pose tip_from_tool, (4, 4)."""
    @property
    def name(self) -> str:
        """Same as `Solver.name`."""
    @property
    def task(self) -> str:
        """Same as `Solver.task`."""
    @property
    def joints(self) -> list[str]:
        """Same as `Solver.joints`."""
    @property
    def inputs(self) -> list[str]:
        """Same as `Solver.inputs`."""
    @property
    def given(self) -> list[str]:
        """Same as `Solver.given`."""
    @property
    def limits(self) -> _Floats:
        """Same as `Solver.limits`."""
    @property
    def is_redundant(self) -> bool:
        """Same as `Solver.is_redundant`."""
    @overload
    def solve(
        self,
        target: _Target,
        *,
        q0: npt.ArrayLike | None = None,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
        as_array: Literal[False] = False,
    ) -> list[Solution]:
        """Same as `Solver.solve`."""
    @overload
    def solve(
        self,
        target: _Target,
        *,
        q0: npt.ArrayLike | None = None,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
        as_array: Literal[True],
    ) -> _Floats: ...
    def nearest(
        self,
        target: _Target,
        q0: npt.ArrayLike,
        *,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> Solution | None:
        """Same as `Solver.nearest`."""
    @overload
    def solve_batch(
        self,
        targets: _Target,
        *,
        given: _Given | None = None,
        layout: Literal["ragged"] = "ragged",
        limits: _Limits | None = None,
        near: npt.ArrayLike | None = None,
        out: _Floats | None = None,
        dtype: npt.DTypeLike | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> Batch:
        """Same as `Solver.solve_batch`."""
    @overload
    def solve_batch(
        self,
        targets: _Target,
        *,
        given: _Given | None = None,
        layout: Literal["padded"],
        limits: _Limits | None = None,
        near: npt.ArrayLike | None = None,
        out: _Floats | None = None,
        dtype: npt.DTypeLike | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> PaddedBatch: ...
    def closest(
        self,
        target: _Target,
        *,
        length: float | None = None,
        given: _Given | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> Closest:
        """Same as `Solver.closest`; the error is that of the tool."""
    def forward(self, q: npt.ArrayLike) -> _Floats:
        """Same as `Solver.forward`: world_from_tool."""
    def solve_path(
        self,
        poses: _Target,
        q0: npt.ArrayLike | None = None,
        *,
        dt: float | None = None,
        times: npt.ArrayLike | None = None,
        speeds: npt.ArrayLike | None = None,
        limits: _Limits | None = None,
        given: _Given | None = None,
        tolerance: float | None = None,
    ) -> Path:
        """Same as `Solver.solve_path`."""
    def any_within(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Within:
        """Returns one solution of a redundant solver within limits, by no criterion, or the reason why there is none.

        `target` is that of `solve`, without the value of the given joint. Solutions are within the described limits. `limits` can only narrow them: an array
        (joints, 2), or a dict of joint names and pairs. With scanned joints, completeness is that of the scan: 33 values of one joint are tried (132 of two,
        528 of three), then values next to solutions beyond limits. `tolerance` is that of `solve`. `BadValueError` for a wrong target or limits; an error of
        the kind `unsupported` for a solver that is not redundant.
        """
    def any_within_batch(
        self,
        targets: _Target,
        *,
        limits: _Limits | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> WithinBatch:
        """Same as `any_within` for N targets, on all processors. Invalid targets are reported in `status`; with `strict` they raise an exception."""
    def arcs(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Arcs:
        """Returns all arcs of solutions of a redundant solver within limits. Arguments and errors are those of `any_within`; an error of the kind `unsupported`
        with scanned joints.
        """
    def best(
        self,
        target: _Target,
        criterion: _Criterion = "margin",
        *,
        q0: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        joint: str | int | None = None,
        value: float | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> Best | None:
        """Returns the best solution of a redundant solver within limits; None if there is none.

        Criteria: `margin`, the greatest least distance of a joint to its limits [rad]; `relative_margin`, the same divided by half of the range; `nearest`, the
        least distance to `q0` (joints,) with `weights` (joints,) of the squares; `manipulability`, the greatest one; `change`, the least difference of `joint`
        (name or index) from `value`. Lengths in margins and in the manipulability are divided by the characteristic length. With scanned joints, it is the best
        of the samples, refined by golden section search, and the manipulability is that of the other joints. Other arguments and errors are those of
        `any_within`.
        """
    def best_batch(
        self,
        targets: _Target,
        criterion: _Criterion = "margin",
        *,
        q0: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        joint: str | int | None = None,
        value: float | None = None,
        limits: _Limits | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> BestBatch:
        """Same as `best` for N targets, on all processors. `q0` has the shape (joints,) or (N, joints). Invalid targets are reported in `status`; with `strict`
        they raise an exception.
        """
    def optima(
        self,
        target: _Target,
        criterion: _Criterion = "margin",
        *,
        q0: npt.ArrayLike | None = None,
        weights: npt.ArrayLike | None = None,
        joint: str | int | None = None,
        value: float | None = None,
        limits: _Limits | None = None,
        tolerance: float | None = None,
    ) -> list[Best]:
        """Returns the local optima on all arcs, ends included, the best ones first, at most 128. Arguments and errors are those of `best`; an error of the kind
        `unsupported` with scanned joints.
        """

@final
class Robot:
    """A robot: a tree of links and joints with inertial parameters.

    Metres, kilograms, seconds, radians. Methods take one state, such as q of shape (freedoms,), or many, (N, freedoms). For many states the result has an
    additional first axis. On a `floating` base q begins with the root's position and quaternion x, y, z, w in the world frame. Velocities then begin with the
    root's linear and angular velocity in its own frame.

    >>> nao = groebot.Robot.named("nao")
    >>> nao.mass_matrix(np.zeros(len(nao.joints))).shape == (len(nao.joints), len(nao.joints))
    True
    """
    @staticmethod
    def from_urdf(
        path_or_text: _File,
        base: str | None = None,
        tip: str | None = None,
        *,
        floating: bool = False,
        gravity: npt.ArrayLike | None = None,
    ) -> Robot:
        """Reads a URDF: a path, or the text itself.

        `base` and `tip` are the end links of the chain that `derive` uses. By default they are the root and the only leaf link, else the only link named
        `tool0`, `flange`, `tcp` or `ee_link`, in that order. Faults of parts outside this chain are in `notes`; dynamics refuse them.
        """
    @staticmethod
    def load(
        path: _File,
        base: str | None = None,
        tip: str | None = None,
        *,
        floating: bool = False,
        gravity: npt.ArrayLike | None = None,
        packages: Mapping[str, _File] | None = None,
        arguments: Mapping[str, str] | None = None,
    ) -> Robot:
        """Reads a file of any robot format: URDF, xacro, MJCF, SDF or TOML, or the YAML calibration of an arm of Universal Robots.

        `packages` has the folders of packages by name, for xacro and meshes. Others are searched in `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`. `arguments` has the
        values of xacro's arguments by name. The other arguments are those of `from_urdf`. A DH table has no links: `derive` takes its path.
        """
    @staticmethod
    def named(
        name: str,
        base: str | None = None,
        tip: str | None = None,
        *,
        floating: bool = False,
        gravity: npt.ArrayLike | None = None,
    ) -> Robot:
        """Returns a robot by name, such as nao or ur10e.

        >>> nao = groebot.Robot.named("nao")
        >>> "l_sole" in nao.links
        True
        """
    def to_urdf(self) -> str:
        """Converts the robot to URDF."""
    @property
    def name(self) -> str:
        """The robot's name."""
    @property
    def links(self) -> list[str]:
        """The names of the links, in the order of the description."""
    @property
    def base(self) -> str:
        """The base link of the chain that `derive` uses: `base`, by default the root."""
    @property
    def tip(self) -> str | None:
        """The tip link of the chain that `derive` uses: `tip`, else the default. `None` if there is no default, because the robot has several tips."""
    @property
    def tips(self) -> list[str]:
        """The possible tip links of a chain from `base`, the likeliest first: leaf links that move. If there is a default tip, it is the first one.

        >>> "l_sole" in groebot.Robot.named("nao").tips
        True
        """
    @property
    def joints(self) -> list[str]:
        """The names of the independent joints, in the order of a configuration."""
    @property
    def notes(self) -> list[str]:
        """Parts of the description that were ignored, such as faults of parts outside the chain between `base` and `tip`, and other remarks."""
    @property
    def mass(self) -> float:
        """The mass of all links [kg]."""
    def inverse_dynamics(self, q: npt.ArrayLike, v: npt.ArrayLike, a: npt.ArrayLike) -> _Floats:
        """Inverse dynamics (RNEA): the torques [N m, N] for the accelerations `a` in the state `q`, `v`, with friction and rotors."""
    def forward_dynamics(self, q: npt.ArrayLike, v: npt.ArrayLike, tau: npt.ArrayLike) -> _Floats:
        """Forward dynamics (ABA): the accelerations for the torques `tau` in the state `q`, `v`."""
    def mass_matrix(self, q: npt.ArrayLike) -> _Floats:
        """The mass matrix (CRBA), (freedoms, freedoms)."""
    def coriolis_matrix(self, q: npt.ArrayLike, v: npt.ArrayLike) -> _Floats:
        """The Coriolis matrix with Christoffel symbols, (freedoms, freedoms)."""
    def gravity_torques(self, q: npt.ArrayLike) -> _Floats:
        """The gravity torques: those that hold the robot at rest.

        >>> nao = groebot.Robot.named("nao")
        >>> q = np.zeros(len(nao.joints))
        >>> np.allclose(nao.gravity_torques(q), nao.inverse_dynamics(q, q, q))
        True
        """
    def center_of_mass(self, q: npt.ArrayLike) -> _Floats:
        """The centre of mass in the world frame; for a fixed base, in its frame, (3,)."""
    def energy(self, q: npt.ArrayLike, v: npt.ArrayLike) -> _Floats:
        """The kinetic and the potential energy [J], (2,)."""
    def link_pose(self, q: npt.ArrayLike, link: str) -> _Floats:
        """The pose of a link in the world frame; for a fixed base, in its frame, (4, 4).

        >>> nao = groebot.Robot.named("nao")
        >>> nao.link_pose(np.zeros(len(nao.joints)), "l_sole").shape
        (4, 4)
        """
    def link_jacobian(self, q: npt.ArrayLike, link: str) -> _Floats:
        """The Jacobian of a link, (6, freedoms): the linear velocity of its origin in the first three rows, then its angular velocity, along the axes of the
        world frame.
        """

def derive(
    robot: Robot | _File,
    task: str | None = None,
    given: str | Sequence[str] | None = None,
    *,
    plane: Literal["xy", "xz", "yz"] | None = None,
    axis: Literal["x", "y", "z"] | None = None,
    direction: npt.ArrayLike | None = None,
    name: str | None = None,
    snap: float | None = None,
    time: float | None = None,
    progress: _Progress | None = None,
    threads: int | None = None,
) -> Solver:
    """Derives the solver of a robot between its links `base` and `tip`, with a proof.

    `robot` is a `Robot`, or the path of a description: URDF, chain, DH table, equations, or the folder of a mechanism. `task` is pose, position, ray,
    direction, rotation, position_pitch_roll, position_yaw, planar_position or planar_pose. The last two need `plane`: xy, xz or yz of the base. `direction` is
    the direction in the tip frame for ray, direction and position_yaw. `axis` (x, y, z) is the base axis of the angle of position_yaw. `given` are the names of
    joints whose values are inputs of the solver. If the chain has too many joints and none is given, the planner chooses them. `snap` is the tolerance of the
    idealisation; 0 uses every digit. `time` [s] is a budget. `progress(stage, done, open)` is called periodically. A keyboard interrupt ends the work.

    >>> leg = groebot.derive(groebot.Robot.named("nao", tip="l_sole"))
    >>> leg.solutions
    8
    """
@final
class Stabilizer:
    """Feedback for a planned walk of nao, rh0, teo or a described robot: joint targets from the measured state (docs/walking.md)."""
    def __new__(
        cls, robot: str, walk: str, *, stiffness: float | None = None, heading: float | None = None
    ) -> Stabilizer: ...
    @property
    def joints(self) -> list[str]:
        """The names of the joints, in the order of `q` and of the targets."""
    def step(
        self,
        time: float,
        q: npt.ArrayLike,
        orientation: npt.ArrayLike,
        angular_velocity: npt.ArrayLike,
        soles: npt.ArrayLike,
    ) -> tuple[_Floats, _Floats]:
        """The targets of the joints at a state: positions [rad] and feed-forward velocities [rad/s], each of shape (joints,).

        `time` is the time since the start of the walk [s], `q` has shape (joints,) [rad]. `orientation` is the quaternion (x, y, z, w) from the base to a world
        with a vertical z axis, `angular_velocity` that of the base in its own frame, shape (3,) [rad/s]. `soles` has shape (2, 6): for the left and the right
        sole force [N] and moment [N m] in the frame of the sole. Times must not decrease from call to call.
        """

def navigate(
    robot: str,
    map: _File | npt.NDArray[np.bool_],
    goal: Sequence[float],
    start: Sequence[float] | None = None,
    *,
    gait: Literal["preview", "osg", "rh0", "rh0-sim", "rh0-real"] | None = None,
    crouched: bool = False,
    method: Literal["exact", "fmm", "m3r", "potential"] = "exact",
    body: Sequence[float] | None = None,
    furniture: Mapping[str, Sequence[float] | None] | None = None,
    resolution: float = 0.05,
    unknown_free: bool = False,
    apart: float = 0.02,
    progress: _Progress | None = None,
) -> Walk:
    """Plans the walk of a humanoid over a map to a goal and checks every sample: see `groebot.Walk`.

    `robot` is nao, rh0 or teo, or the path of a URDF or TOML, whose legs are derived first. `map` is a file (ROS YAML, PGM, PNG, text, a room in TOML), the name
    of a room (living-room, encirclement), or an array of booleans. The array has the shape (rows, columns), begins at y = 0 and is true where there is an
    obstacle; `resolution` is the size of its cells [m]. `start` and `goal` are (x, y) or (x, y, heading) [m, rad]. A room has a default start.
    `furniture` moves pieces of a room: their names with (x, y) or (x, y, yaw) [m, rad], or None, which removes the piece. `unknown_free` treats unknown cells
    as free.

    `gait` is preview, which does not rest between the steps and is the default, or one by one step goal, which rests after each: osg, or of rh0 also rh0, rh0-sim,
    rh0-real. Where no walk without rests is feasible, the robot rests after each step, and `Walk.notes` has the reason. With `crouched` it starts and ends in the
    crouch. `method` is exact, fmm, m3r or potential. `body` is the length and the width of the body [m], by default those of its shapes. `apart` is the distance
    of the body from obstacles [m]. If there is no path, it raises `NoPathError`, which has the cells that enclose the start or the goal.
    """
def _run(arguments: Sequence[str]) -> int: ...
def _any_within(solver: Solver | PlacedSolver, target: _Target, limits: _Limits | None, tolerance: float | None) -> Within: ...
def _any_within_batch(
    solver: Solver | PlacedSolver, targets: _Target, limits: _Limits | None, threads: int | None, strict: bool, tolerance: float | None
) -> tuple[_Floats, npt.NDArray[np.uint8], npt.NDArray[np.uint32], npt.NDArray[np.bool_]]: ...
def _arcs(solver: Solver | PlacedSolver, target: _Target, limits: _Limits | None, tolerance: float | None) -> Arcs: ...
def _best(
    solver: Solver | PlacedSolver, target: _Target, limits: _Limits | None, criterion: _PassedCriterion, tolerance: float | None
) -> Best | None: ...
def _optima(
    solver: Solver | PlacedSolver, target: _Target, limits: _Limits | None, criterion: _PassedCriterion, tolerance: float | None
) -> list[Best]: ...
def _best_batch(
    solver: Solver | PlacedSolver,
    targets: _Target,
    limits: _Limits | None,
    criterion: _PassedCriterion,
    threads: int | None,
    strict: bool,
    tolerance: float | None,
) -> tuple[
    _Floats, npt.NDArray[np.uint8], npt.NDArray[np.uint32], npt.NDArray[np.bool_], _Floats, npt.NDArray[np.int64], _Floats
]: ...

def _reach(
    solver: Solver,
    axes: Sequence[tuple[float, float, int]],
    orientations: int,
    measure: str,
    limits: _Limits | None,
    given: Sequence[float],
    seed: int | None,
    start: int,
    stop: int | None,
    threads: int | None,
    progress: _Progress | None,
) -> dict[str, Any]: ...
def _reach_as(text: str, format: str, across: int | None = None) -> str: ...
def _solution(q: Sequence[float], residual: float, branch: int, free: int, chosen: bool, settled: bool) -> Solution: ...
