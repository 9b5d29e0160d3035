"""Plans the same walk of each humanoid of humanoids.toml: 2 m ahead and a turn of 90 degrees, without other options; writes a table.

    python run.py [--only ID,...] [--physics] [--time SECONDS] [--csv FILE] [--markdown FILE] [--groebot FILE]

With --physics each planned walk is simulated in MuJoCo (GROEBOT_PYTHON). The exit status is 0; the table has the failures. See README.md.
"""

import argparse
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import asdict, dataclass, fields
from importlib import metadata
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts/real_robots"))
from robots import locate  # noqa: E402

GOAL = (2.0, 0.0, 90.0)
WALK = ["--goal", ",".join(f"{value:g}" for value in GOAL)]
# The options of each simulation.
SIMULATE: list[str] = []
# Within these a plan has arrived [m, degrees]: the distance of the plan's middle is rounded to 1 mm by the route.
ARRIVED = (0.002, 0.1)
LONGEST_REASON = 300


@dataclass
class Row:
    """One robot. `plan` is `walks`, `astray`, `refused`, `late` or `missing`; `physics` is `stands`, `falls`, `refused`, `late` or empty."""

    id: str
    name: str
    package: str = ""
    version: str = ""
    file: str = ""
    plan: str = "missing"
    seconds: str = ""
    gait: str = ""
    steps: str = ""
    duration_s: str = ""
    distance_m: str = ""
    turn_deg: str = ""
    margin_mm: str = ""
    physics: str = ""
    fell_s: str = ""
    note: str = ""


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="ID,...", help="these robots of humanoids.toml (default: all)")
    parser.add_argument("--physics", action="store_true", help="simulate each planned walk")
    parser.add_argument("--time", type=float, default=300, metavar="SECONDS", help="limit of each command (default: 300)")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write the table as CSV")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write the table as Markdown")
    parser.add_argument("--groebot", type=Path, default=Path(os.environ.get("GROEBOT", ROOT / "target/release/groebot")))
    return parser.parse_args()


def called(command: list, limit: float) -> tuple[int | None, str, str, float]:
    """The exit status (None after the limit), the output, the errors, and the seconds of a command."""
    begun = time.monotonic()
    try:
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, "", "", time.monotonic() - begun
    return done.returncode, done.stdout, done.stderr, time.monotonic() - begun


def lines(text: str, kind: str) -> str:
    found = [line.split(": ", 1)[1] for line in text.splitlines() if line.startswith(f"{kind}: ")]
    # The folders are those of this machine.
    return re.sub(r"(?<![\w.])/(?:[^/\s(]+/)+", "", "; ".join(found))[:LONGEST_REASON]


def measured(robot: dict, args: argparse.Namespace, folder: Path) -> Row:
    """Plans the walk of a robot, and simulates it if requested."""
    row = Row(robot["id"], robot["name"], note=robot.get("missing", ""))
    if row.note:
        return row
    what = robot["id"]
    if "package" in robot:
        row.package, row.version, row.file = robot["package"], metadata.version(robot["package"]), robot["urdf"]
        what = locate(robot["package"], robot["urdf"])
    walk = folder / f"{row.id}.json"
    status, _, errors, seconds = called([args.groebot, "walk", what, *WALK, "-o", walk], args.time)
    row.seconds = f"{seconds:.1f}"
    row.note = lines(errors, "error" if status else "note")
    if status != 0:
        row.plan = "late" if status is None else "refused"
        return row
    summary = json.loads(walk.read_text())["walk"]["summary"]
    row.gait, row.steps, row.duration_s = summary["gait"], str(summary["steps"]), f"{summary['duration']:.1f}"
    distance, turn = summary["distance"], math.degrees(summary["turn"])
    row.distance_m, row.turn_deg, row.margin_mm = f"{distance:.3f}", f"{turn:.1f}", f"{1e3 * summary['margin']['value']:.1f}"
    arrives = abs(distance - GOAL[0]) <= ARRIVED[0] and abs(turn - GOAL[2]) <= ARRIVED[1]
    row.plan = "walks" if arrives else "astray"
    if args.physics:
        simulated(row, [args.groebot, "simulate", walk, "--model", what, "--json", *SIMULATE], args.time)
    return row


def simulated(row: Row, command: list, limit: float) -> None:
    """Simulates a walk. The exit status is 5 if the robot falls."""
    status, output, errors, _ = called(command, limit)
    if status not in (0, 5) or not output:
        row.physics = "late" if status is None else "refused"
        row.note = "; ".join(part for part in (row.note, lines(errors, "error")) if part)
        return
    fell = json.loads(output)["run"]["fell"]
    row.physics, row.fell_s = ("stands", "") if fell is None else ("falls", f"{fell:.1f}")


def markdown(rows: list[Row]) -> str:
    """The table as Markdown."""
    names = [field.name for field in fields(Row)]
    table = [names, ["---"] * len(names), *(list(asdict(row).values()) for row in rows)]
    return "".join(f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |\n" for cells in table)


def main() -> int:
    args = arguments()
    args.groebot = args.groebot.resolve()
    robots = tomllib.loads((HERE / "humanoids.toml").read_text())["robot"]
    wanted = args.only.split(",") if args.only else [robot["id"] for robot in robots]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for robot in (robot for robot in robots if robot["id"] in wanted):
            row = measured(robot, args, Path(folder))
            rows.append(row)
            print(f"{row.id:16} {row.plan:8} {row.seconds:>6} s  {row.physics:8} {row.note}", flush=True)
    if args.csv:
        with args.csv.open("w", newline="") as file:
            writer = csv.DictWriter(file, [field.name for field in fields(Row)], lineterminator="\n")
            writer.writeheader()
            writer.writerows(asdict(row) for row in rows)
    if args.markdown:
        args.markdown.write_text(markdown(rows))
    print(f"{sum(row.plan == 'walks' for row in rows)} of {len(rows)} plans arrive; {sum(row.physics == 'stands' for row in rows)} stand in MuJoCo")
    return 0


if __name__ == "__main__":
    sys.exit(main())
