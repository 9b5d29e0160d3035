"""Reports, line by line, the time that other programs need for a distance field. A line of standard input is `file side goal`. The response is the processor
time in nanoseconds of scikit-fmm (order 1) and that of scikit-image. A file has one byte per cell, 1 where it is free, then its speed, a float32 per cell.
"""

import sys
import time

import numpy as np
import skfmm
from skimage.graph import MCP_Geometric


def timed(run):
    start = time.process_time_ns()
    run()
    return time.process_time_ns() - start


for line in sys.stdin:
    file, side, goal = line.split()
    side, goal = int(side), int(goal)
    data = np.fromfile(file, dtype=np.uint8)
    free = data[: side * side].reshape(side, side) == 1
    speeds = data[side * side :].view(np.float32).reshape(side, side).astype(np.float64)
    start = divmod(goal, side)
    zero = np.ones((side, side))
    zero[start] = 0.0
    phi = np.ma.MaskedArray(zero, ~free)
    costs = np.where(free, 0.05 / speeds, -1.0)
    print(
        timed(lambda: skfmm.travel_time(phi, speeds, dx=0.05, order=1)),
        timed(lambda: MCP_Geometric(costs).find_costs([start])),
        flush=True,
    )
