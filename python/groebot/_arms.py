"""Arms with one joint more than their task determines: all solutions within limits.

The solutions of a target are curves. Their parts within the limits are arcs. The functions below are methods of `Solver` and `PlacedSolver`.

Of an arm with two to four joints more, the ranges of some joints are scanned (`Solver.scanned`). `any_within` and `best` then search the samples of the scan,
and miss narrow ranges of solutions. There are no arcs, optima and batches: these methods raise an error of the kind `unsupported`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from ._arrays import numbers
from ._batch import Floats, Status
from ._errors import BadValueError
from ._groebot import Arc, PlacedSolver, Solution, Solver, _any_within, _any_within_batch, _arcs, _best, _best_batch, _optima

if TYPE_CHECKING:
    from ._groebot import _Criterion, _Limits, _Target

_OPTIONS: dict[str, set[str]] = {
    "margin": set(),
    "relative_margin": set(),
    "nearest": {"q0", "weights"},
    "manipulability": set(),
    "change": {"joint", "value"},
}


@dataclass(frozen=True)
class Reason:
    """The reason why a target has no solution within limits; `str` is its text."""

    status: Status
    """`Status.UNREACHABLE` or `Status.BEYOND_LIMITS`."""
    joints: tuple[str, ...]
    """The joints that exceed their limits in the solution that exceeds limits least; empty for an unreachable target."""

    def __str__(self) -> str:
        if self.status != Status.BEYOND_LIMITS:
            return self.status.name.lower().replace("_", " ")
        return "reachable, but beyond the limits of " + ", ".join(self.joints) if self.joints else "reachable, but only beyond limits"


class Solutions(list[Solution]):
    """Solutions of a redundant solver, the best of each arc: a list with the reason if it is empty."""

    reason: Reason | None
    """The reason why there is no solution within limits."""
    is_unsure: bool
    """Whether other arcs may exist, or an arc is unsure. With scanned joints, it is true."""

    def __init__(self, solutions: Iterable[Solution] = (), reason: Reason | None = None, is_unsure: bool = False) -> None:
        super().__init__(solutions)
        self.reason, self.is_unsure = reason, is_unsure


@dataclass(frozen=True, eq=False)
class Within:
    """One solution within limits, or the reason why there is none."""

    q: npt.NDArray[np.float64] | None
    """The joint values, (joints,)."""
    reason: Reason | None
    """None with a solution."""
    is_unsure: bool
    """Whether a solution may have been missed, as far as it is known; false with a solution. With scanned joints, it is true without a solution."""


@dataclass(frozen=True, eq=False)
class ArcEnd:
    """An end of an arc."""

    q: npt.NDArray[np.float64]
    """The joint values, (joints,)."""
    joint: str | None
    """The joint at its limit, the first of several. None for a closed curve, and for a curve that could not be followed."""
    limit: Literal["lower", "upper"] | None
    """The limit of this joint."""


@dataclass(frozen=True, eq=False)
class Arcs(Sequence[Arc]):
    """All arcs of solutions within limits: a sequence of `Arc`."""

    arcs: tuple[Arc, ...]
    """The arcs."""
    reason: Reason | None
    """The reason why there is no arc; None with arcs."""
    is_unsure: bool
    """Whether arcs may be missing, or an arc is unsure. Closed curves that the grid misses are not detected."""
    is_surface: bool
    """Whether the solutions are a surface. The only arc is then one solution within limits, if one was found."""
    closed: int
    """The number of closed curves."""

    def __len__(self) -> int:
        return len(self.arcs)

    @overload
    def __getitem__(self, index: int) -> Arc: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Arc, ...]: ...
    def __getitem__(self, index: int | slice) -> Arc | tuple[Arc, ...]:
        return self.arcs[index]

    def __iter__(self) -> Iterator[Arc]:
        return iter(self.arcs)


@dataclass(frozen=True, eq=False)
class Best:
    """A solution that is optimal by a criterion."""

    q: npt.NDArray[np.float64]
    """The joint values, (joints,)."""
    value: float
    """The value of the criterion: a margin, the manipulability, a distance, or a difference. A margin is infinite if no joint is limited."""
    arc: int
    """The index of its arc among those of `Solver.arcs`; -1 with scanned joints."""
    s: float
    """Its distance from the start of the arc, in the unit of `Arc.length`; NaN with scanned joints."""


@dataclass(frozen=True, eq=False)
class WithinBatch:
    """One solution within limits of each of N targets."""

    q: Floats
    """The joint values, (N, joints); NaN without a solution."""
    status: npt.NDArray[np.uint8]
    """The `Status` of each row, (N,)."""
    beyond: npt.NDArray[np.uint32]
    """Bit j is set if joint j is beyond its limits in the solution that exceeds limits least, (N,)."""
    unsure: npt.NDArray[np.bool_]
    """Whether solutions of a row may have been missed, or an arc is unsure, (N,)."""
    joints: tuple[str, ...]
    """The names of the joints."""

    def __len__(self) -> int:
        return len(self.status)

    def reason(self, row: int) -> Reason | None:
        """The reason why a row has no solution; None with a solution."""
        status, beyond = Status(self.status[row]), int(self.beyond[row])
        names = tuple(name for joint, name in enumerate(self.joints) if beyond >> joint & 1)
        return None if status == Status.SOLVED else Reason(status, names)


@dataclass(frozen=True, eq=False)
class BestBatch(WithinBatch):
    """The best solution of each of N targets by a criterion."""

    value: Floats
    """The value of the criterion, (N,); NaN without a solution."""
    arc: npt.NDArray[np.int64]
    """The index of the arc, (N,); -1 without a solution."""
    s: Floats
    """The distance from the start of the arc, (N,); NaN without a solution."""


def any_within(self: Solver | PlacedSolver, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Within:
    """Returns one solution of a redundant solver within limits, by no criterion, or the reason why there is none.

    `target` is that of `solve`, without the value of the given joint. Solutions are within the described limits. `limits` can only narrow them: an array
    (joints, 2), or a dict of joint names and pairs. With scanned joints, completeness is that of the scan: 33 values of one joint are tried (132 of two, 528 of
    three), then values next to solutions beyond limits. `tolerance` is that of `solve`. `BadValueError` for a wrong target or limits; an error of the kind `unsupported` for a solver that is
    not redundant.
    """
    return _any_within(self, target, limits, tolerance)


def any_within_batch(
    self: Solver | PlacedSolver,
    targets: _Target,
    *,
    limits: _Limits | None = None,
    threads: int | None = None,
    strict: bool = False,
    tolerance: float | None = None,
) -> WithinBatch:
    """Same as `any_within` for N targets, on all processors. Invalid targets are reported in `status`; with `strict` they raise an exception."""
    return WithinBatch(*_any_within_batch(self, targets, limits, threads, strict, tolerance), tuple(self.joints))


def arcs(self: Solver | PlacedSolver, target: _Target, *, limits: _Limits | None = None, tolerance: float | None = None) -> Arcs:
    """Returns all arcs of solutions of a redundant solver within limits. Arguments and errors are those of `any_within`; an error of the kind `unsupported`
    with scanned joints."""
    return _arcs(self, target, limits, tolerance)


def best(
    self: Solver | PlacedSolver,
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
    least distance to `q0` (joints,) with `weights` (joints,) of the squares; `manipulability`, the greatest one; `change`, the least difference of `joint` (name
    or index) from `value`. Lengths in margins and in the manipulability are divided by the characteristic length. With scanned joints, it is the best of the
    samples, refined by golden section search, and the manipulability is that of the other joints. Other arguments and errors are those of `any_within`.
    """
    options = {"q0": q0, "weights": weights, "joint": joint, "value": value}
    return _best(self, target, limits, _passed(self.joints, criterion, options, False), tolerance)


def optima(
    self: Solver | PlacedSolver,
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
    `unsupported` with scanned joints."""
    options = {"q0": q0, "weights": weights, "joint": joint, "value": value}
    return _optima(self, target, limits, _passed(self.joints, criterion, options, False), tolerance)


def best_batch(
    self: Solver | PlacedSolver,
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
    they raise an exception."""
    options = {"q0": q0, "weights": weights, "joint": joint, "value": value}
    passed = _passed(self.joints, criterion, options, True)
    q, status, beyond, unsure, values, arc, s = _best_batch(self, targets, limits, passed, threads, strict, tolerance)
    return BestBatch(q, status, beyond, unsure, tuple(self.joints), values, arc, s)


def reason_of(status: int, joints: list[str]) -> Reason:
    """The reason of a status."""
    return Reason(Status(status), tuple(joints))


def _passed(joints: list[str], criterion: str, options: dict[str, Any], many: bool) -> tuple[str, list[float], list[float], int, float]:
    """A criterion for the compiled functions: its name, rows of joint values, weights, the index of a joint, and its value."""
    if criterion not in _OPTIONS:
        raise BadValueError(f"the criterion `{criterion}` is not known; give {', '.join(_OPTIONS)}", "bad_value")
    given = {name for name, option in options.items() if option is not None}
    if surplus := given - _OPTIONS[criterion]:
        raise BadValueError(f"the criterion `{criterion}` does not use `{min(surplus)}`", "bad_value")
    if missing := _OPTIONS[criterion] - given - {"weights"}:
        raise BadValueError(f"the criterion `{criterion}` needs `{min(missing)}`", "bad_value")
    count = len(joints)
    q0 = [] if options["q0"] is None else _rows("q0", options["q0"], count, many)
    weights = [1.0] * count if options["weights"] is None else _rows("weights", options["weights"], count, False)
    index = 0 if options["joint"] is None else _joint(joints, options["joint"])
    return criterion, q0, weights, index, 0.0 if options["value"] is None else float(options["value"])


def _rows(name: str, given: Any, joints: int, many: bool) -> list[float]:
    array, _ = numbers(given)
    if array.shape != (joints,) and not (many and array.ndim == 2 and array.shape[1] == joints):
        allowed = f"({joints},) or (N, {joints})" if many else f"({joints},)"
        raise BadValueError(f"`{name}` has the shape {array.shape}; give {allowed}", "bad_value")
    rows: list[float] = array.ravel().tolist()
    return rows


def _joint(joints: list[str], given: str | int) -> int:
    if isinstance(given, str):
        if given not in joints:
            raise BadValueError(f"there is no joint `{given}`; the joints are {', '.join(joints)}", "unknown_name")
        return joints.index(given)
    if not 0 <= given < len(joints):
        raise BadValueError(f"there is no joint {given}; give 0 to {len(joints) - 1}, or a name", "bad_value")
    return given
