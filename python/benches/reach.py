"""Time and memory of a reach map of a UR5: writes lines of benches/record/DATE-reach.csv to standard output.

`python benches/reach.py [POSES]`, by default a thousand million: a cube around the reach, a hundred orientations at each place. Poses beyond the chain's length
are excluded by their position. The number of solved poses is values.
"""

import resource
import sys
import time

import groebot


def main(poses: int) -> None:
    orientations = 100
    side = round((poses / orientations) ** (1 / 3))
    print("solver,measure,threads,poses,reached,answers,seconds,processor seconds,MiB")
    for name, measure, threads, count in [
        ("ur5", "count", 2, side),
        ("ur5", "count", 1, side // 4),
        ("ur5", "limits", 2, side // 4),
        ("ur5", "manipulability", 2, side // 8),
        ("puma", "count", 2, side // 4),
    ]:
        solver = groebot.Solver.named(name)
        axis = (-0.95, 0.95, count)
        limits = [[-3.2, 3.2]] * 6 if measure == "limits" else None
        start, spent = time.perf_counter(), time.process_time()
        made = groebot.reach_map(solver, [axis] * 3, orientations, measure, limits=limits, threads=threads)
        end = time.perf_counter()
        used = time.process_time() - spent
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        values = [name, measure, threads, made.reached.size * orientations, made.reached.sum(dtype="int64"), made.answers.sum(dtype="int64")]
        print(*values, f"{end - start:.2f}", f"{used:.2f}", f"{memory:.0f}", sep=",", flush=True)


if __name__ == "__main__":
    main(int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000_000)
