"""Closed-form inverse kinematics that is complete and proven.

A `Solver` computes all joint values that move the tip of a chain to a target. `Solver.named("ur5")` returns a solver of the package.
`derive(Robot.from_urdf(path))` derives one with a proof. `Solver.load(folder)` reads a derived one. Units are metres and radians; quaternions are x, y, z, w. A
pose of shape (4, 4) is that of the tip in the frame of the chain's base.
"""

from . import _arms
from ._arms import ArcEnd, Arcs, Best, BestBatch, Reason, Solutions, Within, WithinBatch
from ._batch import Batch, PaddedBatch, Status
from ._errors import BadValueError, FileError, GroebotError, MissingFileError, NoPathError
from ._groebot import Arc, PlacedSolver, Robot, Solution, Solver, Stabilizer, __version__, derive, navigate
from ._reach import ReachMap, reach_map
from ._records import Check, Closest, Explanation, Jump, Path, Walk
from ._view import View, view

__all__ = [
    "Arc",
    "ArcEnd",
    "Arcs",
    "BadValueError",
    "Batch",
    "Best",
    "BestBatch",
    "Check",
    "Closest",
    "Explanation",
    "FileError",
    "GroebotError",
    "Jump",
    "MissingFileError",
    "NoPathError",
    "PaddedBatch",
    "Path",
    "PlacedSolver",
    "ReachMap",
    "Reason",
    "Robot",
    "Solution",
    "Solutions",
    "Solver",
    "Stabilizer",
    "Status",
    "View",
    "Walk",
    "Within",
    "WithinBatch",
    "__version__",
    "derive",
    "navigate",
    "reach_map",
]

# The other methods of `Solver` are compiled.
setattr(Solver, "view", view)
for _name in ("any_within", "any_within_batch", "arcs", "best", "best_batch", "optima"):
    for _owner in (Solver, PlacedSolver):
        setattr(_owner, _name, getattr(_arms, _name))
del view, _name, _owner
