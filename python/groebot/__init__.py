"""Closed-form inverse kinematics that is complete and proven.

A `Solver` computes all joint values that move the tip of a chain to a target. `Solver.named("ur5")` returns a solver of the package.
`derive(Robot.from_urdf(path))` derives one with a proof. `Solver.load(folder)` reads a derived one. Units are metres and radians; quaternions are x, y, z, w. A
pose of shape (4, 4) is that of the tip in the frame of the chain's base.
"""

from ._batch import Batch, PaddedBatch, Status
from ._errors import BadValueError, GroebotError, NoPathError
from ._groebot import PlacedSolver, Robot, Solution, Solver, __version__, derive, navigate
from ._reach import ReachMap, reach_map
from ._records import Check, Closest, Explanation, Jump, Path, Walk
from ._view import View, view

__all__ = [
    "BadValueError",
    "Batch",
    "Check",
    "Closest",
    "Explanation",
    "GroebotError",
    "Jump",
    "NoPathError",
    "PaddedBatch",
    "Path",
    "PlacedSolver",
    "ReachMap",
    "Robot",
    "Solution",
    "Solver",
    "Status",
    "View",
    "Walk",
    "__version__",
    "derive",
    "navigate",
    "reach_map",
]

# The other methods of `Solver` are compiled.
setattr(Solver, "view", view)
del view
