"""Conversion of objects with numbers to arrays of doubles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import BadValueError


def numbers(given: Any) -> tuple[npt.NDArray[np.float64], bool]:
    """Converts `given` to a contiguous array of doubles. Also returns whether it has single precision.

    Rotation and RigidTransform of scipy, SE3 and SO3 of spatialmath, and pairs (position, Rotation) are converted to matrices.
    """
    array = np.asarray(_matrices(given))
    if array.dtype.kind not in "fiu":
        raise BadValueError(f"an array of {array.dtype} has no real numbers; give floats", "bad_value")
    single = array.dtype.kind == "f" and array.dtype.itemsize < 8
    return np.require(array, np.float64, ["C", "A"]), single


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
    if isinstance(given, tuple) and len(given) == 2 and hasattr(given[1], "as_matrix"):
        return _poses(given[0], given[1].as_matrix())
    return given


def _poses(positions: Any, rotations: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    places = np.asarray(positions, np.float64)
    if places.shape != rotations.shape[:-1]:
        raise BadValueError(f"positions {places.shape} do not fit to rotations {rotations.shape}", "bad_value")
    poses = np.zeros((*rotations.shape[:-2], 4, 4))
    poses[..., :3, :3], poses[..., :3, 3], poses[..., 3, 3] = rotations, places, 1.0
    return poses
