"""Starts two workers and solves targets. `test_dask.py` kills this process. Arguments: targets, folder, rows of a block."""

import sys

from distributed import Client, LocalCluster

import groebot
from groebot.dask import solve_parquet

if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        done = solve_parquet(client, groebot.Solver.named("ur5"), sys.argv[1], sys.argv[2], int(sys.argv[3]))
    print(done.written, done.found)
