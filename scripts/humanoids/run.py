"""Plans the same walk of each humanoid of humanoids.toml: 2 m ahead and a turn of 90 degrees, without other options; writes a table.

    python run.py [--only ID,...] [--physics] [--cases] [--time SECONDS] [--csv FILE] [--markdown FILE] [--groebot FILE]

With --physics each planned walk is simulated in MuJoCo (GROEBOT_PYTHON) with feedback on a level floor, with --cases also in the cases of physics.py. The
files are written after each simulation, so that an ended run keeps its rows. The exit status is 0; the table has the failures. See README.md.
"""

import argparse
import csv
import json
import math
import os
import re
import sys
import tempfile
import tomllib
from dataclasses import asdict, dataclass, fields
from importlib import metadata
from pathlib import Path

from physics import called, cases, mid_swing, simulated

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts/real_robots"))
from robots import locate  # noqa: E402

GOAL = (2.0, 0.0, 90.0)
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
    off_mm: str = ""
    turn_off_deg: str = ""
    cases: str = ""
    cases_run: str = ""
    fallen: str = ""
    note: str = ""


class Table:
    """The rows, in files that are written after each change."""

    def __init__(self, args: argparse.Namespace, robots: list[str]):
        self.csv, self.markdown, self.order, self.rows = args.csv, args.markdown, robots, {}
        self.remarks = ""
        if args.keep and args.csv and args.csv.exists():
            lines = args.csv.read_text().splitlines(keepends=True)
            self.remarks = "".join(line for line in lines if line.startswith("#"))
            for row in csv.DictReader(line for line in lines if not line.startswith("#")):
                self.rows[row["id"]] = Row(**{name: value for name, value in row.items() if name in Row.__annotations__})

    def put(self, row: Row) -> None:
        self.rows[row.id] = row
        rows = [self.rows[robot] for robot in self.order if robot in self.rows]
        names = [field.name for field in fields(Row)]
        if self.csv:
            with self.csv.open("w", newline="") as file:
                file.write(self.remarks)
                writer = csv.DictWriter(file, names, lineterminator="\n")
                writer.writeheader()
                writer.writerows(asdict(row) for row in rows)
        if self.markdown:
            table = [names, ["---"] * len(names), *(list(asdict(row).values()) for row in rows)]
            self.markdown.write_text("".join(f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |\n" for cells in table))


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="ID,...", help="these robots of humanoids.toml (default: all)")
    parser.add_argument("--goal", default=",".join(f"{value:g}" for value in GOAL), metavar="X,Y,DEGREES", help="another goal (default: 2,0,90)")
    parser.add_argument("--physics", action="store_true", help="simulate each planned walk on a level floor")
    parser.add_argument("--cases", nargs="?", const="all", metavar="NAME,...", help="if it stands there, also simulate it in all cases, or in those whose names begin so")
    parser.add_argument("--time", type=float, default=600, metavar="SECONDS", help="limit of each command (default: 600)")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write the table as CSV")
    parser.add_argument("--keep", action="store_true", help="keep the remarks and the other rows of that file")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write the table as Markdown")
    parser.add_argument("--groebot", type=Path, default=Path(os.environ.get("GROEBOT", ROOT / "target/release/groebot")))
    return parser.parse_args()


def lines(text: str, kind: str) -> str:
    found = [line.split(": ", 1)[1] for line in text.splitlines() if line.startswith(f"{kind}: ")]
    # The folders are those of this machine.
    return re.sub(r"(?<![\w.])/(?:[^/\s(]+/)+", "", "; ".join(found))[:LONGEST_REASON]


def measured(robot: dict, args: argparse.Namespace, table: Table, folder: Path) -> Row:
    """Plans the walk of a robot, and simulates it if requested."""
    row = Row(robot["id"], robot["name"], note=robot.get("missing", ""))
    if row.note:
        return row
    what = robot["id"]
    if "package" in robot:
        row.package, row.version, row.file = robot["package"], metadata.version(robot["package"]), robot.get("urdf") or robot["mjcf"]
        what = locate(robot["package"], row.file)
    if "mjcf" in robot:
        source, what = what, folder / f"{row.id}.urdf"
        python = os.environ.get("GROEBOT_PYTHON", "python3")
        status, _, errors, _ = called([python, "-B", HERE / "mjcf.py", source, what], args.time)
        if status != 0:
            row.plan, row.note = "refused", " ".join(errors.split())[:LONGEST_REASON]
            return row
    walk = folder / f"{row.id}.json"
    status, _, errors, seconds = called([args.groebot, "walk", what, f"--goal={args.goal}", "-o", walk], args.time)
    row.seconds = f"{seconds:.1f}"
    row.note = lines(errors, "error" if status else "note")
    if status != 0:
        row.plan = "late" if status is None else "refused"
        return row
    plan = json.loads(walk.read_text())
    summary = plan["walk"]["summary"]
    row.gait, row.steps, row.duration_s = summary["gait"], str(summary["steps"]), f"{summary['duration']:.1f}"
    distance, turn = summary["distance"], math.degrees(summary["turn"])
    row.distance_m, row.turn_deg, row.margin_mm = f"{distance:.3f}", f"{turn:.1f}", f"{1e3 * summary['margin']['value']:.1f}"
    goal = [float(value) for value in args.goal.split(",")]
    arrives = abs(distance - math.hypot(*goal[:2])) <= ARRIVED[0] and abs(turn - goal[2]) <= ARRIVED[1]
    row.plan = "walks" if arrives else "astray"
    if args.physics or args.cases:
        table.put(row)
        in_physics(row, args, table, (what, walk, mid_swing(plan)))
    return row


def in_physics(row: Row, args: argparse.Namespace, table: Table, robot: tuple) -> None:
    """Simulates a walk on a level floor, then in the requested cases. `robot` is its model, its walk, and the time of the pushes."""
    model, walk, middle = robot
    level = simulated(args.groebot, walk, model, [], args.time)
    row.physics = level.fate
    if level.fate in ("stands", "falls"):
        row.off_mm, row.turn_off_deg = f"{1e3 * level.off:.0f}", f"{level.turned:.1f}"
        row.fell_s = "" if level.fell is None else f"{level.fell:.1f}"
    else:
        row.note = "; ".join(part for part in (lines(level.errors, "error"), row.note) if part)
    print(f"{row.id:16} level: {row.physics} {row.fell_s} ({level.seconds:.0f} s)", flush=True)
    if not args.cases or level.fate != "stands":
        return
    starts = ("",) if args.cases == "all" else tuple(args.cases.split(","))
    wanted = {name: options for name, options in cases(level.mass, middle).items() if name.startswith(starts)}
    stood, fallen = 0, []
    for done, (name, options) in enumerate(wanted.items(), 1):
        run = simulated(args.groebot, walk, model, options, args.time)
        stood += run.fate == "stands"
        if run.fate != "stands":
            fallen.append(name if run.fell is None else f"{name} at {run.fell:.1f} s")
        row.cases, row.cases_run, row.fallen = str(stood), str(done), "; ".join(fallen)
        table.put(row)
        print(f"{row.id:16} {name}: {run.fate} {'' if run.fell is None else f'{run.fell:.1f}'} ({run.seconds:.0f} s)", flush=True)


def main() -> int:
    args = arguments()
    args.groebot = args.groebot.resolve()
    robots = tomllib.loads((HERE / "humanoids.toml").read_text())["robot"]
    order = [robot["id"] for robot in robots]
    wanted = args.only.split(",") if args.only else order
    table, rows = Table(args, order), []
    with tempfile.TemporaryDirectory() as folder:
        for robot in (robot for robot in robots if robot["id"] in wanted):
            row = measured(robot, args, table, Path(folder))
            rows.append(row)
            table.put(row)
            print(f"{row.id:16} {row.plan:8} {row.seconds:>6} s  {row.physics:8} {row.note}", flush=True)
    print(
        f"{sum(row.plan == 'walks' for row in rows)} of {len(rows)} plans arrive; {sum(row.physics == 'stands' for row in rows)} stand in MuJoCo; "
        f"{sum(row.cases != '' and row.cases == row.cases_run for row in rows)} in all cases that were run"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
