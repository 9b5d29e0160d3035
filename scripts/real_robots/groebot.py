"""Runs `groebot derive` and `groebot solve`, and reads their output."""

import collections
import csv
import json
import os
import re
import resource
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from robots import Chain


@dataclass(frozen=True)
class Run:
    """The result of a command: its status, its output, and its time on one core [s]."""

    status: int
    output: str
    errors: str
    wall: float
    cpu: float


@dataclass(frozen=True)
class Derivation:
    """A derived solver: the names of its inputs and joints, those of the given joints, and the number of complex solutions."""

    folder: Path
    inputs: list[str]
    joints: list[str]
    given: list[str]
    complex_solutions: int

    @classmethod
    def read(cls, folder: Path) -> "Derivation":
        program = json.loads((folder / "5_program.json").read_text())
        inputs, joints = ([item["name"] for item in program[key]] for key in ("inputs", "joints"))
        plan = re.search(r"has (\d+) complex solution", (folder / "2_plan.txt").read_text())
        return cls(folder, inputs, joints, [name for name in inputs if name in joints], int(plan[1]) if plan else 0)

    def size(self, name: str) -> int:
        return (self.folder / name).stat().st_size


@dataclass
class Answers:
    """The solutions of each target, by joint name [rad or m], and the number of joints that were reported as free."""

    solutions: list[list[dict[str, float]]]
    free: int = 0


def _one_core() -> None:
    """Restricts the child process to the last of its available cores."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def run(command: Sequence[str], text: str = "", most: float | None = None) -> Run:
    """Runs a command on one core. The status is 124 if it took longer than `most` seconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    try:
        done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=most, preexec_fn=_one_core)
        status, output, errors = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired:
        status, output, errors = 124, "", f"error: stopped after {most:g} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Run(status, output, errors, time.perf_counter() - start, cpu)


def derive(program: Path, chain: Chain, folder: Path, budget: float) -> Run:
    """Derives a chain into `folder` within `budget` seconds."""
    command = [str(program), "derive", str(chain.path()), "--base", chain.base, "--tip", chain.tip, "--task", chain.task]
    if chain.direction:
        command += ["--direction", chain.direction]
    if chain.given:
        command += ["--given", chain.given]
    return run([*command, "--out", str(folder), "--time", f"{budget:g}"], most=budget + 60)


def solve(program: Path, derivation: Derivation, targets: list[list[float]], most: float = 600) -> tuple[Run, Answers]:
    """All solutions of targets, which are numbers in the order of the derivation's inputs."""
    rows = [",".join(map(repr, target)) for target in targets]
    text = "\n".join([",".join(derivation.inputs), *rows, ""])
    done = run([str(program), "solve", str(derivation.folder)], text, most)
    return done, _answers(done.output, derivation, len(targets))


def _answers(output: str, derivation: Derivation, count: int) -> Answers:
    """Reads the CSV: a row for each solution, or one with an empty branch for a target without any."""
    answers = Answers([[] for _ in range(count)])
    rows = csv.reader(output.splitlines())
    header = next(rows, [])
    if "branch" not in header:
        return answers
    branch, free = header.index("branch"), header.index("free")
    values = slice(branch + 1, branch + 1 + len(derivation.joints))
    for row in rows:
        if row[branch]:
            answers.solutions[int(row[0]) - 1].append(dict(zip(derivation.joints, map(float, row[values]))))
            answers.free += bool(row[free])
    return answers


def weak_spots(derivation: Derivation) -> str:
    """The failing rows of 6_check.csv, by kind of target and fault: such as `3 singular: missing`."""
    with open(derivation.folder / "6_check.csv", newline="") as file:
        failing = [(row["kind"], row["verdict"].removeprefix("FAIL ")) for row in csv.DictReader(file) if row["verdict"].startswith("FAIL")]
    return "; ".join(f"{count} {kind}: {fault}" for (kind, fault), count in collections.Counter(failing).items())


def reason(done: Run) -> str:
    """The reason why a command failed, in one line without paths and without the target's numbers."""
    lines = done.errors.splitlines()
    said = [line for line in lines if line.startswith("error")] or lines[-1:]
    text = said[0].removeprefix("error: ") if said else f"status {done.status}"
    text = re.sub(r"\S*/\S*\.urdf: ", "", text)
    return re.sub(r"-?\d[-\d.e]*(,-?\d[-\d.e]*){2,}", "...", text)
