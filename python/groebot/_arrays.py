"""Conversion of objects with numbers to arrays of doubles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import BadValueError


def numbers(given: Any) -> tuple[npt.NDArray[np.float64], float]:
    """Converts `given` to a contiguous array of doubles. Also returns the precision of a rotation with numbers of its type, 0 for doubles.

    Rotation and RigidTransform of scipy, SE3 and SO3 of spatialmath are converted to matrices. Pairs of a position and a rotation (a matrix, a quaternion x, y,
    z, w, or a Rotation) are converted to matrices or to rows of seven numbers.
    """
    given = _matrices(given)
    pair = _pair(*given) if isinstance(given, tuple) and len(given) == 2 else None
    arrays = (np.asarray(given),) if pair is None else pair
    for array in arrays:
        if array.dtype.kind not in "fiu":
            raise BadValueError(f"an array of {array.dtype} has no real numbers; give floats", "bad_value")
    joined = arrays[0] if pair is None else _joined(*pair)
    return np.require(joined, np.float64, ["C", "A"]), max(map(_precision, arrays))


def plain_limits(limits: Any) -> list[list[float]] | dict[str, list[float]] | bool | None:
    """Converts limits to values that JSON can represent: those of an array (joints, 2), or of a dict of joint names and pairs."""
    if isinstance(limits, (bool, np.bool_, type(None))):
        return None if limits is None else bool(limits)
    if isinstance(limits, Mapping):
        return {joint: np.asarray(pair, np.float64).tolist() for joint, pair in limits.items()}
    plain: list[list[float]] = np.asarray(limits, np.float64).tolist()
    return plain


def _matrices(given: Any) -> Any:
    package = type(given).__module__.partition(".")[0]
    if package == "scipy" and hasattr(given, "as_matrix"):
        return given.as_matrix()
    if package == "spatialmath" and hasattr(given, "A"):
        return given.A
    return given


def _precision(array: npt.NDArray[Any]) -> float:
    """The deviation of a rotation whose entries were rounded to the type of the array, with a margin for a few products; 0 for doubles and integers."""
    return 8 * float(np.finfo(array.dtype).eps) if array.dtype.kind == "f" and array.dtype.itemsize < 8 else 0.0


def _pair(first: Any, second: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any]] | None:
    """The positions (..., 3) and the rotations (..., 3, 3) or (..., 4) of a pair; None for other tuples."""
    places, turns = np.asarray(first), np.asarray(_matrices(second))
    if places.shape[-1:] != (3,) or not (turns.shape[-2:] == (3, 3) or turns.shape[-1:] == (4,)):
        return None
    many = turns.shape[:-2] if turns.shape[-2:] == (3, 3) and places.ndim == turns.ndim - 1 else turns.shape[:-1]
    if places.shape[:-1] == many:
        return places, turns
    if places.shape == turns.shape:
        return None
    raise BadValueError(f"positions {places.shape} do not fit to rotations {turns.shape}; give (3,) and (3, 3) or (4,), or N of them", "bad_value")


def _joined(places: npt.NDArray[Any], turns: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Matrices (..., 4, 4), or rows (..., 7) with a quaternion."""
    if turns.shape[-1] == 4:
        return np.concatenate([places, turns], -1, dtype=np.float64)
    poses = np.zeros((*places.shape[:-1], 4, 4))
    poses[..., :3, :3], poses[..., :3, 3], poses[..., 3, 3] = turns, places, 1.0
    return poses
