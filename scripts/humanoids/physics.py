"""Simulations of a planned walk in MuJoCo with feedback: on a level floor, and in harder cases."""

import json
import math
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

# A push changes the velocity of the whole robot by this much [m/s], in this time [s].
PUSHED = 0.15
PUSH_TIME = 0.1
# The directions of pushes [degrees from ahead to the left].
DIRECTIONS = (0, 90, 180, 270)
FALLS = 5


def mid_swing(walk: dict) -> float:
    """The middle of the swing that is nearest to half of the walk, a trajectory in JSON [s]."""
    times, middles = walk["time"], []
    for contact in walk["contacts"]:
        lifted = None
        for instant, stands in zip(times, contact["stands"]):
            if stands and lifted is not None:
                middles.append((lifted + instant) / 2)
            lifted = None if stands else (instant if lifted is None else lifted)
    half = (times[0] + times[-1]) / 2
    return min(middles, key=lambda middle: abs(middle - half))


def cases(mass: float, middle: float) -> dict[str, list[str]]:
    """The options of `groebot simulate` of each case, by its name. `mass` is that of the robot [kg], `middle` the time of the pushes [s]."""
    slopes = {"left up": "3,0", "right up": "-3,0", "front down": "0,3", "front up": "0,-3"}
    found = {f"slope {name}": [f"--slope={slope}"] for name, slope in slopes.items()}
    found |= {"friction 0.4": ["--friction=0.4"], "mass 0.8": ["--mass=0.8"], "mass 1.2": ["--mass=1.2"]}
    found |= {"delay 20 ms": ["--latency=0.02"]}
    force, start = PUSHED * mass / PUSH_TIME, middle - PUSH_TIME / 2
    for direction in DIRECTIONS:
        found[f"push {direction}"] = [f"--push={start:.3f},{force:.2f},{PUSH_TIME},{direction}"]
    return found


@dataclass(frozen=True)
class Run:
    """A simulation. `fate` is `stands`, `falls`, `refused` or `late`; the other figures are of runs that end."""

    fate: str
    seconds: float
    fell: float | None = None
    mass: float = 0.0
    off: float = 0.0
    turned: float = 0.0
    errors: str = ""


def called(command: list, limit: float) -> tuple[int | None, str, str, float]:
    """The exit status (None after the limit), the output, the errors, and the seconds of a command."""
    begun = time.monotonic()
    try:
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, "", "", time.monotonic() - begun
    return done.returncode, done.stdout, done.stderr, time.monotonic() - begun


def simulated(groebot: Path, walk: Path, model: str | Path, options: list[str], limit: float) -> Run:
    """Simulates a walk with feedback. Distances from its planned end are in metres, turns in degrees."""
    command = [groebot, "simulate", walk, "--model", model, "--json", *options]
    status, output, errors, seconds = called(command, limit)
    if status not in (0, FALLS) or not output:
        return Run("late" if status is None else "refused", seconds, errors=errors)
    told = json.loads(output)
    planned, walked = told["comparison"]["planned"], told["comparison"]["simulated"]
    off = math.hypot(walked["forward"] - planned["forward"], walked["left"] - planned["left"])
    turned = math.degrees(math.remainder(walked["turn"] - planned["turn"], math.tau))
    fell = told["run"]["fall_time"]
    return Run("stands" if fell is None else "falls", seconds, fell, told["run"]["mass"], off, turned)
