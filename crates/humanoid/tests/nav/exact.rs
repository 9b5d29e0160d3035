//! Shortest paths, compared with the visibility graph of all corners. The graph tests every pair of corners against every obstacle.

use groebot_humanoid::nav::{Distances, Field, Guide, Map, Method, Shortest};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;

use super::{Random, random_map};

/// Number of parts of a cell: all comparisons of the graph use integers of this unit.
pub(super) const PARTS: i64 = 1 << 20;

type Spot = (i64, i64);

/// The map in the brute-force search: which cells are obstacles, with a border around them.
struct Floor<'a> {
    map: &'a Map,
}

impl Floor<'_> {
    fn is_free(&self, x: i64, y: i64) -> bool {
        let is_on = (0..self.map.columns() as i64).contains(&x) && (0..self.map.rows() as i64).contains(&y);
        is_on && self.map.is_free(y as usize * self.map.columns() + x as usize)
    }

    /// Whether the cells around a lattice point are free: lower left, lower right, upper left, upper right.
    fn about(&self, x: i64, y: i64) -> [bool; 4] {
        [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)].map(|(x, y)| self.is_free(x, y))
    }

    fn points(&self) -> impl Iterator<Item = Spot> + use<> {
        let (columns, rows) = (self.map.columns() as i64, self.map.rows() as i64);
        (0..=rows).flat_map(move |y| (0..=columns).map(move |x| (x, y)))
    }

    fn corners(&self) -> Vec<Spot> {
        let is_corner = |(x, y): &Spot| self.about(*x, *y).iter().filter(|free| !**free).count() == 1;
        self.points().filter(is_corner).map(|(x, y)| (x * PARTS, y * PARTS)).collect()
    }

    /// Lattice points at which two obstacles meet diagonally.
    fn pinches(&self) -> Vec<Spot> {
        let is_pinch = |(x, y): &Spot| {
            let about = self.about(*x, *y);
            about == [true, false, false, true] || about == [false, true, true, false]
        };
        self.points().filter(is_pinch).map(|(x, y)| (x * PARTS, y * PARTS)).collect()
    }

    /// Whether two points are visible from each other: no interior of an obstacle, and no side or corner shared by two obstacles, is between them.
    fn sees(&self, a: Spot, b: Spot, pinches: &[Spot]) -> bool {
        let (low, high) = ((a.0.min(b.0), a.1.min(b.1)), (a.0.max(b.0), a.1.max(b.1)));
        let cells = |low: i64, high: i64| low.div_euclid(PARTS) - 1..=high.div_euclid(PARTS) + 1;
        let obstacles = cells(low.1, high.1).flat_map(|y| cells(low.0, high.0).map(move |x| (x, y)));
        let is_hit = obstacles.filter(|(x, y)| !self.is_free(*x, *y)).any(|cell| enters(a, b, cell));
        !is_hit && !self.is_between_walls(a, b) && !pinches.iter().any(|pinch| self.slips(a, b, *pinch))
    }

    /// Whether the segment is along a side that two obstacles share.
    fn is_between_walls(&self, a: Spot, b: Spot) -> bool {
        let along = |from: i64, to: i64| from.min(to).div_euclid(PARTS)..(from.max(to) + PARTS - 1).div_euclid(PARTS);
        let (x, y) = (a.0.div_euclid(PARTS), a.1.div_euclid(PARTS));
        let on_row = a.1 == b.1 && a.1 % PARTS == 0;
        let on_column = a.0 == b.0 && a.0 % PARTS == 0;
        (on_row && along(a.0, b.0).any(|x| !self.is_free(x, y) && !self.is_free(x, y - 1)))
            || (on_column && along(a.1, b.1).any(|y| !self.is_free(x, y) && !self.is_free(x - 1, y)))
    }

    /// Whether the segment passes through a pinch point, or starts at one and enters the cell to which that point does not belong: it belongs to the upper
    /// right one.
    fn slips(&self, a: Spot, b: Spot, pinch: Spot) -> bool {
        if a == b || cross(a, b, pinch) != 0 {
            return false;
        }
        let leaves = |from: Spot, to: Spot| to.0 <= from.0 && to.1 <= from.1;
        if pinch == a || pinch == b {
            return (pinch == a && leaves(a, b)) || (pinch == b && leaves(b, a));
        }
        let within = |x: i64, a: i64, b: i64| (a.min(b)..=a.max(b)).contains(&x);
        within(pinch.0, a.0, b.0) && within(pinch.1, a.1, b.1)
    }

    /// The length of the shortest path, in cells (E. W. Dijkstra, Numerische Mathematik 1, 1959).
    fn shortest(&self, start: Spot, goal: Spot) -> f64 {
        let pinches = self.pinches();
        let spots: Vec<Spot> = [start, goal].into_iter().chain(self.corners()).collect();
        let mut lengths = vec![f64::INFINITY; spots.len()];
        let mut is_done = vec![false; spots.len()];
        lengths[0] = 0.0;
        loop {
            let open = (0..spots.len()).filter(|spot| !is_done[*spot] && lengths[*spot].is_finite());
            let Some(next) = open.min_by(|a, b| lengths[*a].total_cmp(&lengths[*b])) else { return lengths[1] };
            if next == 1 {
                return lengths[1];
            }
            is_done[next] = true;
            for other in (0..spots.len()).filter(|other| !is_done[*other]).collect::<Vec<_>>() {
                let away = |a: i64, b: i64| (a - b) as f64 / PARTS as f64;
                let (a, b) = (spots[next], spots[other]);
                let length = lengths[next] + away(a.0, b.0).hypot(away(a.1, b.1));
                if length < lengths[other] && self.sees(a, b, &pinches) {
                    lengths[other] = length;
                }
            }
        }
    }
}

fn cross(a: Spot, b: Spot, c: Spot) -> i64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

/// Whether a straight segment intersects the interior of a cell: no axis of either separates them.
fn enters(a: Spot, b: Spot, (x, y): Spot) -> bool {
    let (low, high) = ((x * PARTS, y * PARTS), ((x + 1) * PARTS, (y + 1) * PARTS));
    let apart = |a: i64, b: i64, low: i64, high: i64| a.max(b) <= low || a.min(b) >= high;
    let sides = [low, (high.0, low.1), high, (low.0, high.1)].map(|corner| cross(a, b, corner).signum());
    let parts = a != b && (sides.iter().all(|side| *side >= 0) || sides.iter().all(|side| *side <= 0));
    !apart(a.0, b.0, low.0, high.0) && !apart(a.1, b.1, low.1, high.1) && !parts
}

/// A random point of a free cell: anywhere, in eighths, on its border or at its lower left corner.
pub(super) fn place(map: &Map, numbers: &mut Random) -> Spot {
    let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
    let cell = free[(numbers.number() * free.len() as f64) as usize];
    let kind = (numbers.number() * 4.0) as i64;
    let mut part = || match kind {
        0 => (numbers.number() * PARTS as f64) as i64,
        1 => (numbers.number() * 8.0) as i64 * PARTS / 8,
        2 => (numbers.number() * 2.0) as i64 * PARTS / 2,
        _ => 0,
    };
    let (column, row) = (cell % map.columns(), cell / map.columns());
    (column as i64 * PARTS + part(), row as i64 * PARTS + part())
}

pub(super) fn point(map: &Map, spot: Spot) -> Point2<f64> {
    map.in_world(&Point2::new(spot.0 as f64 / PARTS as f64, spot.1 as f64 / PARTS as f64))
}

fn shortest(map: &Map, ends: [Spot; 2], guide: &Guide) -> Option<Shortest> {
    let [start, goal] = ends.map(|end| point(map, end));
    let cells = [&start, &goal].map(|end| map.free_cell_at(end).unwrap());
    match map.shortest_path(&start, &goal, guide, &Watch::none()).unwrap() {
        Ok(found) => {
            assert!(found.path.points[0] == start && *found.path.points.last().unwrap() == goal);
            Some(found)
        }
        Err(enclosure) => {
            let is_in = enclosure.cells.contains(&cells[0]);
            let [inside, outside] = if is_in { cells } else { [cells[1], cells[0]] };
            assert!(enclosure.parts(map, inside, outside));
            None
        }
    }
}

/// Compares one path with brute force. Returns whether there is one.
fn agrees(map: &Map, ends: [Spot; 2], guide: &Guide) -> bool {
    let expected = Floor { map }.shortest(ends[0], ends[1]) * map.resolution();
    let Some(found) = shortest(map, ends, guide) else {
        assert!(expected.is_infinite(), "{ends:?}: a path of {expected}");
        return false;
    };
    let length = found.path.length();
    assert!((length - expected).abs() < 1e-9, "{ends:?}: {length} {expected} {:?}", found.path);
    assert!(found.is_proved() && found.bound == length);
    true
}

#[test]
fn paths_agree_with_the_visibility_graph() {
    let mut numbers = Random(7);
    let (mut reached, mut enclosed) = (0, 0);
    for seed in 0..240 {
        let share = [0.05, 0.15, 0.25, 0.35, 0.45, 0.55][seed as usize % 6];
        let [columns, rows] = [(); 2].map(|()| 1 + (numbers.number() * 22.0) as usize);
        let map = random_map(columns, rows, share, 1000 + seed);
        if !(0..columns * rows).any(|cell| map.is_free(cell)) {
            continue;
        }
        for _ in 0..6 {
            let ends = [(); 2].map(|()| place(&map, &mut numbers));
            if agrees(&map, ends, &Guide::default()) { reached += 1 } else { enclosed += 1 }
        }
    }
    assert!(reached > 500 && enclosed > 100, "{reached} {enclosed}");
}

/// With a field a path is found earlier, and with a bounded effort a lower bound remains. The path is never shorter than the optimum, and the bound never
/// longer.
#[test]
fn a_field_and_a_bounded_effort_leave_what_is_true() {
    let mut numbers = Random(8);
    let (mut proved, mut open) = (0, 0);
    for seed in 0..24 {
        let map = random_map(40, 37, [0.1, 0.2, 0.3, 0.4][seed as usize % 4], 2000 + seed);
        let ends = [(); 2].map(|()| place(&map, &mut numbers));
        let goal = point(&map, ends[1]);
        let field = Field::new(&map, &[goal], Method::FastMarching(1), &Watch::none()).unwrap();
        if !agrees(&map, ends, &Guide { field: Some(&field), effort: None }) {
            continue;
        }
        let floor = Floor { map: &map };
        let (expected, pinches) = (floor.shortest(ends[0], ends[1]) * map.resolution(), floor.pinches());
        for (effort, field) in [0, 10, 40].into_iter().flat_map(|effort| [(effort, None), (effort, Some(&field))]) {
            let found = shortest(&map, ends, &Guide { field, effort: Some(effort) }).unwrap();
            assert!(found.bound <= expected + 1e-12 && expected <= found.path.length() + 1e-12);
            if found.is_proved() {
                proved += 1
            } else {
                open += 1
            }
            let spots: Vec<Spot> = found.path.points.iter().map(|point| spot(&map, point)).collect();
            assert!(spots.windows(2).all(|pair| floor.sees(pair[0], pair[1], &pinches)));
        }
    }
    assert!(proved > 20 && open > 20, "{proved} {open}");
}

/// From points all over a map to one goal.
#[test]
fn distances_of_all_corners_give_equal_paths() {
    let mut numbers = Random(11);
    let (mut reached, mut enclosed) = (0, 0);
    for seed in 0..60 {
        let share = [0.02, 0.1, 0.25, 0.4, 0.5][seed as usize % 5];
        let map = random_map(31, 26, share, 4000 + seed);
        let goal = place(&map, &mut numbers);
        let distances = Distances::new(&map, &point(&map, goal), &Watch::none()).unwrap();
        for _ in 0..20 {
            let start = place(&map, &mut numbers);
            let found = distances.path(&map, &point(&map, start), &Watch::none()).unwrap();
            let expected = shortest(&map, [start, goal], &Guide::default());
            let Ok(found) = found else {
                assert!(expected.is_none());
                enclosed += 1;
                continue;
            };
            let length = expected.unwrap().path.length();
            assert!((found.path.length() - length).abs() < 1e-9 && found.is_proved(), "{found:?} {length}");
            assert_eq!(found.path.points[0], point(&map, start));
            assert_eq!(found.path.points.last(), Some(distances.goal()));
            reached += 1;
        }
    }
    assert!(reached > 700 && enclosed > 50, "{reached} {enclosed}");
    let distances = Distances::new(&Map::new(5, 5, 0.1).unwrap(), &Point2::new(0.1, 0.1), &Watch::none()).unwrap();
    let shape = groebot_humanoid::nav::Shape::rectangle(Point2::new(0.35, 0.35), 0.05, 0.05, 0.0);
    for other in [Map::new(4, 5, 0.1).unwrap(), Map::new(5, 5, 0.1).unwrap().with(&[shape]).unwrap()] {
        let error = distances.path(&other, &Point2::new(0.1, 0.1), &Watch::none()).unwrap_err();
        assert!(error.message().contains("other free cells"), "{error}");
    }
}

fn spot(map: &Map, point: &Point2<f64>) -> Spot {
    let own = map.in_map(point);
    ((own.x * PARTS as f64).round() as i64, (own.y * PARTS as f64).round() as i64)
}

/// The pose of a map in the world does not change the lengths of its paths.
#[test]
fn a_rotated_map_has_equal_paths() {
    let map = random_map(30, 20, 0.25, 5);
    let turned = map.clone().placed(Point2::new(3.7, -1.2), 0.6).unwrap();
    let free: Vec<usize> = (0..600).filter(|cell| map.is_free(*cell)).collect();
    let mut reached = 0;
    for pair in free.windows(90).step_by(7) {
        let (start, goal) = (pair[0], pair[89]);
        let path = |map: &Map| {
            map.shortest_path(&map.centre(start), &map.centre(goal), &Guide::default(), &Watch::none()).unwrap()
        };
        let (Ok(one), Ok(other)) = (path(&map), path(&turned)) else { continue };
        assert!((one.path.length() - other.path.length()).abs() < 1e-9);
        reached += 1;
    }
    assert!(reached > 10);
}

#[test]
fn a_small_enclosure_is_found_from_either_side() {
    let mut map = Map::new(700, 500, 0.1).unwrap();
    let room = [(20.0, 20.0, 3.0, 0.1), (20.0, 23.0, 3.0, 0.1), (18.5, 21.5, 0.1, 3.2), (21.5, 21.5, 0.1, 3.2)];
    for (x, y, length, width) in room {
        map = map.with(&[groebot_humanoid::nav::Shape::rectangle(Point2::new(x, y), length, width, 0.0)]).unwrap();
    }
    let (inside, outside) = (Point2::new(20.0, 21.0), Point2::new(60.0, 40.0));
    for (start, goal) in [(inside, outside), (outside, inside)] {
        // A search that visited the floor outside would query its watch more than once.
        let patience = std::sync::Arc::new(std::sync::atomic::AtomicUsize::new(1));
        let watch = Watch::none().with_patience(patience);
        let enclosure = map.shortest_path(&start, &goal, &Guide::default(), &watch).unwrap().unwrap_err();
        assert!(enclosure.cells.len() < 1000);
        assert!(enclosure.parts(&map, map.cell_at(&inside).unwrap(), map.cell_at(&outside).unwrap()));
    }
}

#[test]
fn invalid_queries_are_refused() {
    let map = Map::from_text("..#\n...\n", 1.0).unwrap();
    let (start, goal) = (Point2::new(0.5, 0.5), Point2::new(1.5, 1.5));
    let ask = |start: &Point2<f64>, guide: &Guide| map.shortest_path(start, &goal, guide, &Watch::none());
    let error = ask(&Point2::new(2.5, 1.5), &Guide::default()).unwrap_err();
    assert!(error.kind() == ErrorKind::BadValue && error.message().contains("occupied"), "{error}");
    assert!(ask(&Point2::new(-1.0, 0.5), &Guide::default()).is_err());
    let field = Field::new(&map, &[start], Method::M3r, &Watch::none()).unwrap();
    let error = ask(&start, &Guide { field: Some(&field), effort: None }).unwrap_err();
    assert!(error.message().contains("the field of the guide"), "{error}");
    let still = ask(&goal, &Guide::default()).unwrap().unwrap();
    assert_eq!((still.path.length(), still.bound), (0.0, 0.0));
    let stopped = Watch::none().with_cancel(std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true)));
    let large = random_map(300, 300, 0.3, 1);
    let free: Vec<usize> = (0..90_000).filter(|cell| large.is_free(*cell)).collect();
    let (first, last) = (large.centre(free[5000]), large.centre(free[free.len() - 5000]));
    let error = large.shortest_path(&first, &last, &Guide::default(), &stopped).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}

/// A record that `scripts/navigation/visibility.py` verifies with an independent geometry.
const RECORD: &str =
    concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/crates/humanoid/tests/nav/shortest_paths.csv");

#[test]
fn the_record_that_python_checks_is_up_to_date() {
    let mut numbers = Random(9);
    let mut table = String::from("rows,start_x,start_y,goal_x,goal_y,length\n");
    for seed in 0..120 {
        let [columns, rows] = [(); 2].map(|()| 4 + (numbers.number() * 12.0) as usize);
        let map = random_map(columns, rows, [0.1, 0.25, 0.4][seed as usize % 3], 3000 + seed);
        let ends = [(); 2].map(|()| {
            let (x, y) = place(&map, &mut numbers);
            // In parts of 64, which are exact in the text.
            (x / 16_384 * 16_384, y / 16_384 * 16_384)
        });
        let length = shortest(&map, ends, &Guide::default()).map(|found| found.path.length() / map.resolution());
        let line = |y: usize| (0..columns).map(move |x| y * columns + x);
        let row = |y| line(y).map(|cell| if map.is_free(cell) { '.' } else { '#' }).collect::<String>();
        table += &(0..rows).map(row).collect::<Vec<_>>().join("/");
        ends.iter().flat_map(|(x, y)| [x, y]).for_each(|x| table += &format!(",{}", *x as f64 / PARTS as f64));
        table += &length.map_or_else(|| ",none\n".to_owned(), |length| format!(",{length:.10}\n"));
    }
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(RECORD, &table).unwrap();
    }
    assert_eq!(std::fs::read_to_string(RECORD).unwrap(), table, "UPDATE_GOLDEN=1 rewrites it");
}
