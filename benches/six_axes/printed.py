#!/usr/bin/env python3
"""Measures generated solvers in Rust and C at random targets, and counts lost joint values. By default they are those with six axes.

    cargo build --release
    python3 benches/six_axes/printed.py [--poses 100000] [--folders general_6r,crx_like,/tmp/mine] [--groebot PROGRAM] > record.csv

Needs rustc and cc, which compile the output of `groebot codegen --single-file`. A folder is one of `derivations`, or a path. Each target is reached by random
joint values (angles in (-pi, pi], displacements in [-1, 1] lengths). It is lost if no solution is within 1e-6 of them. `us_mean` is the processor time of all
calls divided by the number of targets. Other processes affect it only through the caches. The percentiles are wall time.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = "general_6r general_5r1p general_4r2p crx_like xarm6_like jaco_like booster_leg_like ur5_calibrated".split()
HERE = pathlib.Path(__file__).resolve().parent


def sliding(printed):
    """The indices of the prismatic joints of a C solver."""
    joints = re.findall(r"GB_(ANGLE|LENGTH)\(", re.search(r"#define GB_JOINT_LIST (.*)", printed)[1])
    return [index for index, kind in enumerate(joints) if kind == "LENGTH"]


def build(name, work, groebot):
    """Builds the two programs that measure a folder's solver: language, bytes of the solver, path."""
    folder = ROOT / "derivations" / name
    rust, c = work / f"{folder.name}_solver.rs", work / f"{folder.name}_solver.c"
    for language, file in (("rust", rust), ("c", c)):
        subprocess.run([groebot, "codegen", folder, "--lang", language, "--single-file", "-o", file], check=True, capture_output=True)
    printed = c.read_text()
    name = re.search(r"#define GB_ROBOT (\w+)", printed)[1]
    slides = sum(1 << joint for joint in sliding(printed))
    main = (HERE / "printed.rs").read_text().replace("SOLVER", str(rust)).replace("SLIDES", str(slides))
    (work / f"{name}.rs").write_text(main)
    subprocess.run(["rustc", "--edition", "2024", "-O", "-A", "warnings", f"{name}.rs", "-o", f"{name}_rust"], cwd=work, check=True)
    flags = ["-O2", f"-DNAME={name}", f"-DCAPACITY={name.upper()}_CAPACITY", f"-DSLIDES={slides}", f'-DSOLVER="{c}"']
    subprocess.run(["cc", "-std=c99", "-D_POSIX_C_SOURCE=199309L", *flags, HERE / "printed.c", "-o", f"{name}_c", "-lm"], cwd=work, check=True)
    return [("C99 -O2", c.stat().st_size, work / f"{name}_c"), ("Rust -O", rust.stat().st_size, work / f"{name}_rust")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=100_000)
    parser.add_argument("--folders", type=lambda text: text.split(","), default=FOLDERS)
    parser.add_argument("--groebot", type=pathlib.Path, default=ROOT / "target/release/groebot")
    arguments = parser.parse_args()
    print("solver,language,bytes,poses,lost,answers_per_pose,us_mean,us_p10,us_p50,us_p90,us_p99.9")
    with tempfile.TemporaryDirectory() as work:
        for name in arguments.folders:
            for language, size, program in build(name, pathlib.Path(work), arguments.groebot.resolve()):
                output = subprocess.run([program, str(arguments.poses)], check=True, capture_output=True, text=True)
                sys.stderr.write(output.stderr)
                print(f"{name},{language},{size},{arguments.poses},{output.stdout.strip()}", flush=True)


if __name__ == "__main__":
    main()
