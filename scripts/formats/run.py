"""Compares groebot's reading of MJCF with MuJoCo's compiled models, robot by robot.

    python run.py [--only ID,...] [--vectors 100] [--csv FILE] [--jobs N]

The exit status is 0 if every robot that is present agrees. See README.md.
"""

import argparse
import csv
import os
import sys
import sysconfig
import tomllib
from pathlib import Path

import mujoco
from compare import Result, compare

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
COLUMNS = ["id", "package", "file", "bodies", "joints", "vectors", "place_m", "turn_rad", "tips", "tip_pose", "limits", "mass_rel", "inertia_rel", "dynamics", "unweighed", "verdict"]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="ID,...", help="these robots of robots.toml (default: all)")
    parser.add_argument("--vectors", type=int, default=100, metavar="N", help="joint vectors for each robot (default: 100)")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write a row for each robot, after each robot")
    parser.add_argument("--packages", type=Path, default=Path(sysconfig.get_paths()["purelib"]), help="the folder of the installed packages")
    parser.add_argument("--groebot", type=Path, default=Path(os.environ.get("GROEBOT", ROOT / "target/release/groebot")))
    return parser.parse_args()


def row(robot: dict, result: Result) -> list:
    shown = [f"{x:.1e}" for x in (result.place, result.turn)]
    verdict = "right" if result.right() else "; ".join(result.faults) or "differs"
    return [
        robot["id"], robot["package"], robot["file"], result.bodies, result.joints, result.vectors, *shown, result.tips, f"{result.tip_place:.1e}",
        f"{result.limits:.1e}", f"{result.mass:.1e}", f"{result.inertia:.1e}", f"{result.dynamics:.1e}", result.unweighed, verdict,
    ]  # fmt: skip


def main() -> int:
    args = arguments()
    wanted = set(filter(None, args.only.split(",")))
    robots = [robot for robot in tomllib.loads((HERE / "robots.toml").read_text())["robot"] if not wanted or robot["id"] in wanted]
    rows, wrong = [], []
    for robot in robots:
        path = args.packages / robot["file"]
        result = compare(robot["id"], path, args.groebot.resolve(), args.vectors) if path.is_file() else Result(robot["id"], faults=["missing"])
        rows.append(row(robot, result))
        if not result.right():
            wrong.append(robot["id"])
        print(*rows[-1][:1], *rows[-1][3:], flush=True)
        if args.csv:
            with args.csv.open("w", newline="") as file:
                file.write(f"# groebot's reading of MJCF compared with MuJoCo {mujoco.__version__}\n")
                csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    print(f"{len(rows) - len(wrong)} of {len(rows)} robots agree" + (f"; not {', '.join(wrong)}" if wrong else ""))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
