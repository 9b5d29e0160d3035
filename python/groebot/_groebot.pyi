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
    @property
    def q(self) -> _Floats: ...
    @property
    def residual(self) -> float: ...
    @property
    def branch(self) -> int: ...
    @property
    def free(self) -> tuple[int, ...]: ...
    @property
    def chosen(self) -> bool: ...
    @property
    def settled(self) -> bool: ...
    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]: ...

@final
class Arc:
    @property
    def start(self) -> ArcEnd: ...
    @property
    def end(self) -> ArcEnd: ...
    @property
    def length(self) -> float: ...
    @property
    def is_closed(self) -> bool: ...
    @property
    def is_unsure(self) -> bool: ...
    def at(self, s: npt.ArrayLike) -> _Floats: ...
    def sample(self, n: int) -> _Floats: ...

@final
class Solver:
    @staticmethod
    def named(name: str) -> Solver: ...
    @staticmethod
    def names() -> list[str]: ...
    @staticmethod
    def load(path: _File) -> Solver: ...
    @staticmethod
    def from_json(text: str) -> Solver: ...
    def to_json(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def task(self) -> str: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def inputs(self) -> list[str]: ...
    @property
    def given(self) -> list[str]: ...
    @property
    def length_unit(self) -> str: ...
    @property
    def limits(self) -> _Floats: ...
    @property
    def is_redundant(self) -> bool: ...
    @property
    def scanned(self) -> list[str]: ...
    @property
    def solutions(self) -> int | None: ...
    @property
    def compiled(self) -> bool: ...
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
    ) -> list[Solution]: ...
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
    ) -> Solution | None: ...
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
    ) -> Batch: ...
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
    ) -> Closest: ...
    def forward(self, q: npt.ArrayLike) -> _Floats: ...
    def jacobian(self, q: npt.ArrayLike, frame: Literal["base", "tip", "spatial"] = "base") -> _Floats: ...
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
    ) -> Path: ...
    def any_within(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Within: ...
    def any_within_batch(
        self,
        targets: _Target,
        *,
        limits: _Limits | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> WithinBatch: ...
    def arcs(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Arcs: ...
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
    ) -> Best | None: ...
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
    ) -> BestBatch: ...
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
    ) -> list[Best]: ...
    def placed(self, *, base: _Target | None = None, tool: _Target | None = None, tolerance: float | None = None) -> PlacedSolver: ...
    def check(self, *, progress: _Progress | None = None, threads: int | None = None) -> Check: ...
    def explain(self, *, progress: _Progress | None = None, threads: int | None = None) -> Explanation: ...
    def c_source(self, *, single: bool = False) -> str: ...
    def rust_source(self, *, alone: bool = True) -> str: ...
    def view(self, path: _File | None = None, *, open: bool | None = None, height: int = 600, reach: _File | None = None) -> View: ...

@final
class PlacedSolver:
    @property
    def base(self) -> _Floats: ...
    @property
    def tool(self) -> _Floats: ...
    @property
    def name(self) -> str: ...
    @property
    def task(self) -> str: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def inputs(self) -> list[str]: ...
    @property
    def given(self) -> list[str]: ...
    @property
    def limits(self) -> _Floats: ...
    @property
    def is_redundant(self) -> bool: ...
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
    ) -> list[Solution]: ...
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
    ) -> Solution | None: ...
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
    ) -> Batch: ...
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
    ) -> Closest: ...
    def forward(self, q: npt.ArrayLike) -> _Floats: ...
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
    ) -> Path: ...
    def any_within(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Within: ...
    def any_within_batch(
        self,
        targets: _Target,
        *,
        limits: _Limits | None = None,
        threads: int | None = None,
        strict: bool = False,
        tolerance: float | None = None,
    ) -> WithinBatch: ...
    def arcs(self, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Arcs: ...
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
    ) -> Best | None: ...
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
    ) -> BestBatch: ...
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
    ) -> list[Best]: ...

@final
class Robot:
    @staticmethod
    def from_urdf(
        path_or_text: _File,
        base: str | None = None,
        tip: str | None = None,
        *,
        floating: bool = False,
        gravity: npt.ArrayLike | None = None,
    ) -> Robot: ...
    @staticmethod
    def load(
        path: _File,
        base: str | None = None,
        tip: str | None = None,
        *,
        floating: bool = False,
        gravity: npt.ArrayLike | None = None,
    ) -> Robot: ...
    @staticmethod
    def named(
        name: str,
        base: str | None = None,
        tip: str | None = None,
        *,
        floating: bool = False,
        gravity: npt.ArrayLike | None = None,
    ) -> Robot: ...
    def to_urdf(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def links(self) -> list[str]: ...
    @property
    def base(self) -> str: ...
    @property
    def tip(self) -> str | None: ...
    @property
    def tips(self) -> list[str]: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def mass(self) -> float: ...
    def inverse_dynamics(self, q: npt.ArrayLike, v: npt.ArrayLike, a: npt.ArrayLike) -> _Floats: ...
    def forward_dynamics(self, q: npt.ArrayLike, v: npt.ArrayLike, tau: npt.ArrayLike) -> _Floats: ...
    def mass_matrix(self, q: npt.ArrayLike) -> _Floats: ...
    def coriolis_matrix(self, q: npt.ArrayLike, v: npt.ArrayLike) -> _Floats: ...
    def gravity_torques(self, q: npt.ArrayLike) -> _Floats: ...
    def center_of_mass(self, q: npt.ArrayLike) -> _Floats: ...
    def energy(self, q: npt.ArrayLike, v: npt.ArrayLike) -> _Floats: ...
    def link_pose(self, q: npt.ArrayLike, link: str) -> _Floats: ...
    def link_jacobian(self, q: npt.ArrayLike, link: str) -> _Floats: ...

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
) -> Solver: ...
@final
class Stabilizer:
    def __new__(
        cls, robot: str, walk: str, *, stiffness: float | None = None, heading: float | None = None
    ) -> Stabilizer: ...
    @property
    def joints(self) -> list[str]: ...
    def step(
        self,
        time: float,
        q: npt.ArrayLike,
        orientation: npt.ArrayLike,
        angular_velocity: npt.ArrayLike,
        soles: npt.ArrayLike,
    ) -> tuple[_Floats, _Floats]: ...

def navigate(
    robot: str,
    map: _File | npt.NDArray[np.bool_],
    goal: Sequence[float],
    start: Sequence[float] | None = None,
    *,
    method: Literal["exact", "fmm", "m3r", "potential"] = "exact",
    resolution: float = 0.05,
    apart: float = 0.02,
    progress: _Progress | None = None,
) -> Walk: ...
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
