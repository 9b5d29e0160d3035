"""Derives chains of real robots, solves poses computed by Pinocchio, and writes a table of both.

    python run.py [--ci | --only ID,...] [--json results.json] [--table docs/robots.md]

The exit status is 0 if every chain is derived, finds all its ordinary poses and has no wrong solution. See README.md.
"""

import argparse
import json
import os
import shlex
import sys
import tempfile
from pathlib import Path

from measure import Row, row
from robots import chosen
from table import found, page, shortened

ROOT = Path(__file__).resolve().parents[2]
MOST_RESIDUAL = 1e-9


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--only", default="", metavar="ID,...", help="these chains of robots.toml (default: all)")
    which.add_argument("--ci", action="store_true", help="the chains that .ci/run derives")
    parser.add_argument("--poses", type=int, default=1000, metavar="N", help="poses for each chain (default: 1000)")
    parser.add_argument("--time", type=float, default=120, metavar="SECONDS", help="budget of a derivation (default: 120)")
    parser.add_argument("--out", type=Path, metavar="DIR", help="keep the derivations in this folder")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures, after each chain")
    parser.add_argument("--table", type=Path, metavar="FILE", help="write the Markdown page")
    parser.add_argument("--groebot", type=Path, default=Path(os.environ.get("GROEBOT", ROOT / "target/release/groebot")))
    return parser.parse_args()


def right(result: Row) -> bool:
    """Whether a chain meets the requirements."""
    return result.status == "derived" and result.ordinary_found == result.ordinary and result.residual <= MOST_RESIDUAL


def report(result: Row) -> None:
    """One line on the terminal."""
    what = f"{found(result)} of {result.poses} found, residual {result.residual:.0e}" if result.status == "derived" else ""
    what = what or f"{result.status}: {shortened(result.reason, 25)}"
    print(f"{result.id:24} {result.joints:2} joints  {result.cpu:7.2f} s  {what}", flush=True)


def main() -> int:
    args = arguments()
    with tempfile.TemporaryDirectory() as passing:
        return measured(args, args.out or Path(passing))


def measured(args: argparse.Namespace, out: Path) -> int:
    """Measures the requested chains and writes their derivations to `out`. Returns whether one fails."""
    out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    for chain in chosen(args.only, args.ci):
        rows.append(row(chain, args.groebot.resolve(), out, args.time, args.poses))
        report(rows[-1])
        if args.json:
            args.json.write_text(json.dumps([result.json() for result in rows], indent=1) + "\n")
    if args.table:
        args.table.write_text(page(rows, shlex.join(["scripts/real_robots/run", *sys.argv[1:]])))
    wrong = [result.id for result in rows if not right(result)]
    print(f"{len(rows) - len(wrong)} of {len(rows)} chains are right" + (f"; not {', '.join(wrong)}" if wrong else ""))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
