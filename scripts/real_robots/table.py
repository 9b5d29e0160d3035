"""The results as the Markdown page docs/robots.md."""

import datetime
import statistics

from measure import Row

HEAD = """# Real robots

Look up whether a real robot has a solver, how long the derivation takes, and how many of {poses:,} poses it finds. The descriptions come with public Python
packages. This page was made on {date} by

    {command}

The command derives each chain with `groebot derive URDF --base LINK --tip LINK --task TASK` on one core. Pinocchio (the package `pin`) computes the poses from joint
values drawn uniformly within their limits, and checks every answer ([scripts/real_robots](../scripts/real_robots/README.md)).

| column | meaning |
| --- | --- |
| joints | those between base and tip. If the planner chose a joint whose value is given with each target, the task names it |
| seconds | processor time of the whole derivation: reading, deriving, proving, checking, printing |
| solutions | the greatest number of answers to one of the poses, and the number of complex solutions |
| found | poses whose drawn joint values are among the answers, modulo 2 pi, within 1e-6 for ordinary poses, else within 1e-4. Parentheses: how many of the ordinary ones |
| residual | the greatest difference of a coordinate (metres, entries of a rotation) between an answer's pose and the target |
| C, Rust | the generated solvers, in kilobytes |
| exit | the exit status of `derive`. 3: the solver was written, and its check (`6_check.csv`, 240 targets) failed at singular targets, which are listed below the table |

A pose is ordinary if no singular value of the Jacobian (lengths over the chain's reach) is below 1e-3.
Some of these descriptions differ from the maker's robot, as the names say. Descriptions with checked numbers: [named_robots.md](named_robots.md).
"""

COLUMNS = ("robot", "chain", "joints", "task", "seconds", "solutions", "found", "residual", "C", "Rust", "exit")
RULE = "| --- | --- | --: | --- | --: | --: | --: | --: | --: | --: | --: |"


def page(rows: list[Row], command: str) -> str:
    """The whole page."""
    poses = max((row.poses for row in rows), default=0)
    head = HEAD.format(poses=poses, date=datetime.date.today().isoformat(), command=command)
    return "\n".join([head, _cells(COLUMNS), RULE, *map(_line, rows), "", *_totals(rows), ""])


def _cells(cells) -> str:
    return f"| {' | '.join(cells)} |"


def _line(row: Row) -> str:
    task = row.task + (f", `{row.given}` given" if row.given else "")
    seconds = f"{row.cpu:.2f}" if row.cpu == row.cpu else ""
    start = [row.robot, f"`{row.id}`", str(row.joints), task, seconds]
    if row.status != "derived":
        return _cells([*start, "", f"{row.status}: {shortened(row.reason)}", "", "", "", str(row.exit)])
    sizes = [f"{size / 1000:.0f}" for size in (row.c_bytes, row.rust_bytes)]
    return _cells([*start, f"{row.most} of {row.complex_solutions}", found(row), f"{row.residual:.0e}", *sizes, str(row.exit)])


def found(row: Row) -> str:
    """Such as 1000, or 998 (997 of 999)."""
    return str(row.found) + ("" if row.found == row.poses else f" ({row.ordinary_found} of {row.ordinary})")


def shortened(reason: str, most: int = 15) -> str:
    """The first words of a reason, without characters that would break a table."""
    words = reason.replace("|", "/").split()
    return " ".join(words[:most]) + (" ..." if len(words) > most else "")


def _totals(rows: list[Row]) -> list[str]:
    """Sums and medians, one sentence each."""
    derived, robots = [row for row in rows if row.status == "derived"], len({row.robot for row in rows})
    lines = [f"* {len(rows)} chains of {robots} robots: {len(derived)} derived, {len(rows) - len(derived)} not."]
    if not derived:
        return lines
    seconds, sizes = [row.cpu for row in derived], [row.c_bytes / 1000 for row in derived]
    return [
        *lines,
        f"* {sum(row.found == row.poses for row in derived)} chains find all their poses; all together {_share(derived, 'found', 'poses')}, "
        f"of ordinary poses {_share(derived, 'ordinary_found', 'ordinary')}.",
        f"* A derivation takes {statistics.median(seconds):.2f} s in the median, {max(seconds):.1f} s at most. A solver in C has "
        f"{statistics.median(sizes):.0f} KB in the median, {max(sizes):.0f} KB at most.",
        *_weak([row for row in derived if row.weak]),
        f"* The largest residual is {max(row.residual for row in derived):.0e}; {sum(row.doubles for row in derived)} answers are duplicates.",
    ]


def _weak(rows: list[Row]) -> list[str]:
    """The number of derivations with status 3, and the failing targets of each."""
    return [f"* {len(rows)} derivations end with status 3" + (":" if rows else "."), *(f"  * `{row.id}`: {row.weak}" for row in rows)]


def _share(rows: list[Row], part: str, whole: str) -> str:
    return f"{sum(getattr(row, part) for row in rows):,} of {sum(getattr(row, whole) for row in rows):,}"
