"""Reach maps of a solver over a grid."""

from __future__ import annotations

import json
import operator
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ._arrays import plain_limits
from ._errors import BadValueError
from ._files import replacing
from ._groebot import Solver, _reach, _reach_as
from ._view import View, view

if TYPE_CHECKING:
    import pyarrow as arrow

    from ._groebot import _Limits

Measure = Literal["count", "limits", "manipulability"]
AxisLike = float | tuple[float, float, int] | npt.ArrayLike
Grid = Mapping[str, AxisLike] | Sequence[AxisLike]
_COLUMNS = ("reached", "answers", "open", "best", "mean")


class Axis(NamedTuple):
    """Evenly spaced grid points on an axis."""

    start: float
    """The first point, in the solver's unit of length."""
    stop: float
    """The last point."""
    num: int
    """Number of points."""

    @property
    def places(self) -> npt.NDArray[np.float64]:
        """The coordinates of the points, (count,)."""
        share = np.arange(self.num) / max(self.num - 1, 1)
        return self.start * (1 - share) + self.stop * share


@dataclass(frozen=True)
class Ask:
    """The arguments of `reach_map`, as values that JSON can represent."""

    axes: tuple[Axis, Axis, Axis]
    orientations: int
    measure: Measure = "count"
    limits: list[list[float]] | dict[str, list[float]] | bool | None = None
    given: list[float] = field(default_factory=list)
    seed: int | None = None

    @property
    def places(self) -> int:
        """Number of grid points."""
        x, y, z = (axis.num for axis in self.axes)
        return x * y * z

    def columns(
        self,
        solver: Solver,
        start: int = 0,
        stop: int | None = None,
        threads: int | None = None,
        progress: Callable[[str, int, int], object] | None = None,
    ) -> dict[str, Any]:
        """The columns of the grid points from `start` to before `stop`, and the number of orientations."""
        limits: _Limits | None = np.asarray(self.limits, np.float64) if isinstance(self.limits, list) else self.limits
        given = list(self.given)
        return _reach(solver, self.axes, self.orientations, self.measure, limits, given, self.seed, start, stop, threads, progress)


def requested(
    grid: Grid,
    orientations: int,
    measure: Measure,
    limits: _Limits | None,
    given: npt.ArrayLike | None,
    seed: int | None,
) -> Ask:
    """Converts the arguments to plain numbers. `BadValueError` for an invalid grid."""
    if isinstance(grid, Mapping):
        if unknown := set(grid) - {"x", "y", "z"}:
            raise BadValueError(f"a grid has the axes x, y and z; {min(unknown)!r} is none of them", "bad_value")
        grid = [grid.get(name, 0.0) for name in "xyz"]
    if len(grid) != 3:
        raise BadValueError(f"a grid has three axes, x, y and z; {len(grid)} are given", "bad_value")
    x, y, z = (_axis(name, axis) for name, axis in zip("xyz", grid))
    numbers = [] if given is None else np.atleast_1d(np.asarray(given, np.float64)).tolist()
    count, own = _whole("orientations", orientations), None if seed is None else _whole("seed", seed)
    return Ask((x, y, z), count, measure, plain_limits(limits), numbers, own)


def _whole(name: str, number: Any) -> int:
    try:
        whole = operator.index(number)
    except TypeError:
        whole = -1
    if not 0 <= whole < 1 << 64:
        raise BadValueError(f"{name}: {number!r} is no whole number from 0 to 2^64 - 1", "bad_value")
    return whole


def _axis(name: str, axis: AxisLike) -> Axis:
    if isinstance(axis, tuple) and len(axis) == 3 and isinstance(axis[2], (int, np.integer)):
        return Axis(float(axis[0]), float(axis[1]), _whole(f"the places of {name}", axis[2]))
    places = np.atleast_1d(np.asarray(axis, np.float64))
    if not np.isfinite(places).all():
        raise BadValueError(f"{name}: give finite places", "bad_value")
    if places.ndim != 1 or not len(places):
        raise BadValueError(f"{name}: an axis of shape {places.shape} has no places in a row; give (from, to, count), a number, or places", "bad_value")
    made = Axis(float(places[0]), float(places[-1]), len(places))
    if not np.allclose(places, made.places, rtol=0, atol=1e-9 * max(np.ptp(places), 1e-300)):
        raise BadValueError(f"{name}: these places are not evenly spaced; a map has one step an axis", "bad_value")
    return made


@dataclass(frozen=True)
class ReachMap:
    """Reach map of a solver: for each grid point, the number of orientations with a solution and the number of solutions. Columns have the shape (x, y, z)."""

    solver: str
    """The solver's name."""
    task: str
    unit: str
    """The unit of the grid: m or mm."""
    axes: tuple[Axis, Axis, Axis]
    orientations: int
    """Number of orientations at each grid point."""
    seed: int | None
    measure: Measure
    limited: bool
    """Whether only solutions within limits are counted."""
    reached: npt.NDArray[np.uint32]
    """Number of orientations with a counted solution."""
    answers: npt.NDArray[np.uint32]
    """Number of counted solutions; `reached` for a redundant solver without `given`."""
    open: npt.NDArray[np.uint32]
    """Number of orientations on strata that could not be derived, or at which a redundant solver may have missed a solution. They count as orientations without
    a solution."""
    best: npt.NDArray[np.float32] | None = None
    """The largest manipulability of a solution (Yoshikawa's, metres and radians), if measured."""
    mean: npt.NDArray[np.float32] | None = None
    """The mean over the reached orientations of the largest manipulability of each, if measured."""

    @staticmethod
    def of(solver: Solver, ask: Ask, columns: Mapping[str, Any]) -> ReachMap:
        """Builds the map from the columns of all grid points."""
        shape = tuple(axis.num for axis in ask.axes)
        own = {name: columns[name].reshape(shape) for name in _COLUMNS if name in columns}
        limited = bool(ask.limits) or ask.measure == "limits"
        unit = solver.length_unit
        return ReachMap(solver.name, solver.task, unit, ask.axes, columns["orientations"], ask.seed, ask.measure, limited, **own)

    @property
    def index(self) -> npt.NDArray[np.float64]:
        """The reachability index: the fraction of reached orientations, (x, y, z)."""
        return self.reached / self.orientations

    @property
    def x(self) -> npt.NDArray[np.float64]:
        return self.axes[0].places

    @property
    def y(self) -> npt.NDArray[np.float64]:
        return self.axes[1].places

    @property
    def z(self) -> npt.NDArray[np.float64]:
        return self.axes[2].places

    def __repr__(self) -> str:
        x, y, z = self.reached.shape
        share = self.reached.sum(dtype=np.int64) / (self.reached.size * self.orientations)
        return f"<groebot.ReachMap {self.solver}: {x} x {y} x {z} places, {self.orientations} orientations, {100 * share:.1f} % reached>"

    def to_json(self) -> str:
        """Converts the map to the JSON of `groebot reach`, which `groebot view` shows."""
        head = {"format": 1, "solver": self.solver, "task": self.task, "unit": self.unit}
        axes = {name: {"from": axis.start, "to": axis.stop, "count": axis.num} for name, axis in zip("xyz", self.axes)}
        seed = {} if self.seed is None else {"seed": self.seed}
        counted = {"orientations": self.orientations, "measure": self.measure, "limited": self.limited}
        numbers = {name: column.ravel().tolist() for name in _COLUMNS if (column := getattr(self, name)) is not None}
        if not self.open.any():
            del numbers["open"]
        return _reach_as(json.dumps({**head, **axes, **seed, **counted, **numbers}), "json")

    @staticmethod
    def from_json(text: str) -> ReachMap:
        """Reads the JSON of `to_json` or `groebot reach`. `BadValueError` for other text."""
        data = json.loads(_reach_as(text, "json"))
        axes = tuple(Axis(data[name]["from"], data[name]["to"], data[name]["count"]) for name in "xyz")
        shape = tuple(axis.num for axis in axes)
        kinds = {"best": np.float32, "mean": np.float32}
        own = {name: np.array(data[name], kinds.get(name, np.uint32)).reshape(shape) for name in _COLUMNS if name in data}
        own.setdefault("open", np.zeros(shape, np.uint32))
        same = {name: data[name] for name in ("solver", "task", "unit", "orientations", "measure", "limited")}
        return ReachMap(axes=axes, seed=data.get("seed"), **same, **own)  # type: ignore[arg-type]

    def table(self) -> arrow.Table:
        """Converts the map to a pyarrow table: x, y, z and the columns, one row per grid point."""
        import pyarrow as arrow

        places = np.meshgrid(self.x, self.y, self.z, indexing="ij")
        columns = {name: column.ravel() for name, column in zip("xyz", places)}
        columns |= {name: column.ravel() for name in _COLUMNS if (column := getattr(self, name)) is not None}
        return arrow.table(columns)

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the map: `.json`, `.csv`, `.svg` (slices across z), `.npz` (all columns and axes) or `.parquet` (one row per grid point). If that fails, such as
        on a full disk, a file that existed before is unchanged."""
        form = Path(path).suffix
        if form not in (".json", ".csv", ".svg", ".npz", ".parquet"):
            raise BadValueError(f"{path}: a map is written as .json, .csv, .svg, .npz or .parquet", "bad_value")
        with replacing(path) as file:
            self._write(file, form)

    def _write(self, file: Path, form: str) -> None:
        if form == ".npz":
            columns = {name: column for name in _COLUMNS if (column := getattr(self, name)) is not None}
            with open(file, "wb") as out:
                np.savez_compressed(out, x=self.x, y=self.y, z=self.z, orientations=self.orientations, **columns)
        elif form == ".parquet":
            import pyarrow.parquet as parquet

            parquet.write_table(self.table(), file)
        else:
            file.write_text(_reach_as(self.to_json(), form[1:]), encoding="utf-8")

    def slices(self, across: Literal["x", "y", "z"] | None = None) -> Picture:
        """Draws at most twelve slices across an axis. Their colour is the fraction of reached orientations, or the mean manipulability if measured."""
        if across not in (None, "x", "y", "z"):
            raise BadValueError(f"slices are across x, y or z; not {across!r}", "bad_value")
        return Picture(_reach_as(self.to_json(), "svg", None if across is None else "xyz".index(across)))

    def _repr_svg_(self) -> str:
        return self.slices().svg

    def view(self, solver: Solver, path: str | PathLike[str] | None = None, *, open: bool | None = None, height: int = 600) -> View:
        """Shows the page of the solver with this map, as `Solver.view`."""
        with tempfile.TemporaryDirectory(prefix="groebot-reach-") as folder:
            file = Path(folder, "map.json")
            file.write_text(self.to_json(), encoding="utf-8")
            return view(solver, path, open=open, height=height, reach=file)


@dataclass(frozen=True)
class Picture:
    """A picture that notebooks display."""

    svg: str

    def _repr_svg_(self) -> str:
        return self.svg


def reach_map(
    solver: Solver,
    grid: Grid,
    orientations: int = 100,
    measure: Measure = "count",
    *,
    limits: _Limits | None = None,
    given: npt.ArrayLike | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Callable[[str, int, int], object] | None = None,
) -> ReachMap:
    """Computes a reach map: the number of solutions at each point of a grid.

    `grid` gives x, y and z in the solver's unit of length, each as (from, to, count), as a number, or as evenly spaced values. A mapping omits axes that are
    not part of the task. At each grid point there are `orientations`, evenly spread over those that the task distinguishes. With `seed`, those of each grid
    point are rotated at random. `measure` is count, limits (only solutions within the limits of the description) or manipulability. `limits` as in
    `Solver.solve_batch` restrict the solutions. `given` are the values of given joints. `threads` is by default the number of processors.

    A redundant solver needs no `given` with the measure limits: an orientation counts if `Solver.any_within` has a solution, and `limits` narrow the described
    ones. Other measures without `given` raise an error of the kind `unsupported`. With scanned joints, completeness is that of the scan.

    `progress(stage, done, open)` is called periodically. Poses are generated while they are counted: the map uses 20 bytes per grid point, and its columns use
    the same amount.
    """
    ask = requested(grid, orientations, measure, limits, given, seed)
    return ReachMap.of(solver, ask, ask.columns(solver, threads=threads, progress=progress))
