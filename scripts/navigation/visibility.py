"""Shortest paths of crates/humanoid/tests/nav/shortest_paths.csv, by a visibility graph of all corners in shapely.

    python3 -m venv /tmp/navigation && /tmp/navigation/bin/pip install -r scripts/navigation/requirements.txt
    /tmp/navigation/bin/python scripts/navigation/visibility.py

A path is in the closure of the free cells. It does not pass between two obstacles with a common corner. The script fails if a length differs by more than 1e-7
cells.
"""

import csv
import heapq
from pathlib import Path

import shapely
from shapely import LineString, Point, box

TABLE = Path(__file__).resolve().parents[2] / "crates/humanoid/tests/nav/shortest_paths.csv"
# Obstacles are shrunk by this number of cells, so that a path that touches them does not intersect them.
LESS = 1e-9


class Floor:
    def __init__(self, rows):
        self.rows = rows
        width, height = len(rows[0]), len(rows)
        cells = [(x, y) for y in range(-1, height + 1) for x in range(-1, width + 1) if not self.free(x, y)]
        walls = shapely.unary_union([box(x, y, x + 1, y + 1) for x, y in cells])
        self.walls = walls.buffer(-LESS, join_style="mitre")
        shapely.prepare(self.walls)
        points = [(x, y) for x in range(width + 1) for y in range(height + 1)]
        self.corners = [point for point in points if sum(self.about(point)) == 3]
        self.pinches = [p for p in points if sum(self.about(p)) == 2 and self.about(p)[0] == self.about(p)[3]]

    def free(self, x, y):
        return 0 <= y < len(self.rows) and 0 <= x < len(self.rows[0]) and self.rows[y][x] == "."

    def about(self, point):
        x, y = point
        return [self.free(x + i, y + j) for j in (-1, 0) for i in (-1, 0)]

    def slips(self, a, b):
        line = LineString([a, b])
        for pinch in self.pinches:
            if line.distance(Point(pinch)) > 1e-7:
                continue
            ends = [(a, b)] * (a == pinch) + [(b, a)] * (b == pinch)
            # An end point there belongs to the upper right cell.
            if not ends or any(there[0] <= here[0] and there[1] <= here[1] for here, there in ends):
                return True
        return False

    def sees(self, a, b):
        return a == b or not (self.walls.intersects(LineString([a, b])) or self.slips(a, b))

    def shortest(self, start, goal):
        spots = [start, goal, *self.corners]
        known, queue = {}, [(0.0, 0)]
        while queue:
            length, spot = heapq.heappop(queue)
            if spot in known:
                continue
            known[spot] = length
            if spot == 1:
                return length
            for other in range(len(spots)):
                if other not in known and self.sees(spots[spot], spots[other]):
                    heapq.heappush(queue, (length + Point(spots[spot]).distance(Point(spots[other])), other))
        return None


def main():
    worst, reached, enclosed = 0.0, 0, 0
    with TABLE.open() as file:
        for row in csv.DictReader(file):
            ends = [(float(row[f"{end}_x"]), float(row[f"{end}_y"])) for end in ("start", "goal")]
            found = Floor(row["rows"].split("/")).shortest(*ends)
            if row["length"] == "none":
                assert found is None, row
                enclosed += 1
                continue
            assert found is not None, row
            worst = max(worst, abs(found - float(row["length"])))
            reached += 1
    assert worst < 1e-7, worst
    print(f"{reached} ways as long as ours, {enclosed} times none; worst difference {worst:.1e} cells")


if __name__ == "__main__":
    main()
