//! The examples of the thesis: two media (Fig. 4-11), the trap (4-12, 4-13), ten starts in one field (4-14), and its claims about M3R.

use groebot_humanoid::nav::{Field, Forces, Map, Method, Path, Potential, Shape};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;

use super::{Random, random_map};

fn field(map: &Map, goal: &Point2<f64>, method: Method) -> Field {
    Field::new(map, &[*goal], method, &Watch::none()).unwrap()
}

/// Asserts that a path leads from cell to cell, over free cells only, to a goal.
fn assert_leads(map: &Map, path: &Path, start: &Point2<f64>, goal: &Point2<f64>) {
    let cells: Vec<usize> = path.points.iter().map(|point| map.free_cell_at(point).unwrap()).collect();
    assert_eq!((cells[0], cells[cells.len() - 1]), (map.cell_at(start).unwrap(), map.cell_at(goal).unwrap()));
    assert!(path.points.windows(2).all(|pair| (pair[1] - pair[0]).norm() < 1.5 * map.resolution()));
}

/// The duration of a path; half of each move is in each of the two cells.
fn duration(map: &Map, path: &Path) -> f64 {
    let slowness = |point: &Point2<f64>| 1.0 / f64::from(map.speeds().unwrap()[map.cell_at(point).unwrap()]);
    let step = |pair: &[Point2<f64>]| (pair[1] - pair[0]).norm() * 0.5 * (slowness(&pair[0]) + slowness(&pair[1]));
    path.points.windows(2).map(step).sum()
}

/// Snow on the left, a dry floor on the right.
fn two_media() -> (Map, Point2<f64>, Point2<f64>) {
    let snow = Shape::rectangle(Point2::new(1.0, 2.0), 2.0, 4.0, 0.0);
    let map = Map::new(100, 100, 0.04).unwrap().with_speed(&snow, 0.25).unwrap();
    (map, Point2::new(0.62, 0.42), Point2::new(3.38, 3.58))
}

/// The point at which the quickest path between two places crosses the border of the media, by a search over all points (Fermat), and its duration.
fn fermat(start: &Point2<f64>, goal: &Point2<f64>) -> (f64, f64) {
    let time = |y: f64| {
        let middle = Point2::new(2.0, y);
        ((middle - start).norm() / 0.25 + (goal - middle).norm(), y)
    };
    let (time, y) = (0..=4000).map(|i| time(f64::from(i) * 1e-3)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    (y, time)
}

/// Fig. 4-11, left: the quickest path bends at the border of the media and is not the shortest one.
#[test]
fn a_path_over_two_media_bends() {
    let (map, start, goal) = two_media();
    let (crossing, least) = fermat(&start, &goal);
    let time = |method: Method| field(&map, &goal, method).times()[map.cell_at(&start).unwrap()];
    for (order, bound) in [(1, 0.03), (2, 0.01)] {
        let found = time(Method::FastMarching(order));
        assert!((found / least - 1.0).abs() < bound, "{found} {least}");
    }
    // The time of M3R is between that and sqrt(2) of it.
    let ratio = time(Method::M3r) / least;
    assert!(ratio > 1.0 && ratio < 2f64.sqrt(), "{ratio}");
    let path = field(&map, &goal, Method::FastMarching(2)).descend(&map, &start).unwrap().unwrap();
    assert_leads(&map, &path, &start, &goal);
    let straight = start.y + (goal.y - start.y) * (2.0 - start.x) / (goal.x - start.x);
    let across = path.points.iter().find(|point| point.x > 2.0).unwrap().y;
    assert!((across - crossing).abs() < 0.5 * (straight - crossing).abs(), "{across} {crossing} {straight}");
    // The straight line takes longer than the path, and the path takes at least the optimal time.
    let line = (goal - start).norm();
    let share = (2.0 - start.x) / (goal.x - start.x);
    let straight = line * (share / 0.25 + (1.0 - share));
    let found = duration(&map, &path);
    assert!(path.length() > line && found < straight && found > 0.999 * least, "{found} {straight} {least}");
}

/// Fig. 4-11, right: with obstacles.
#[test]
fn a_path_over_two_media_goes_around_obstacles() {
    let (map, start, goal) = two_media();
    let obstacles = [
        Shape::rectangle(Point2::new(2.4, 1.3), 0.4, 2.2, 0.0),
        Shape::Circle { centre: Point2::new(1.2, 0.7), radius: 0.25 },
    ];
    let with = map.with(&obstacles).unwrap();
    for method in [Method::M3r, Method::FastMarching(1), Method::FastMarching(2)] {
        let found = field(&with, &goal, method);
        let path = found.descend(&with, &start).unwrap().unwrap();
        assert_leads(&with, &path, &start, &goal);
        let cell = map.cell_at(&start).unwrap();
        let without = field(&map, &goal, method).times()[cell];
        // For M3R there are many shortest paths along rows and columns, some of which avoid both obstacles.
        assert!(found.times()[cell] > without || (method == Method::M3r && found.times()[cell] >= without - 1e-9));
        // Above the wall, which extends to y = 2.4.
        assert!(path.points.iter().find(|point| point.x > 2.4).unwrap().y > 2.4);
    }
}

/// Five adjacent cylinders that form a bay, open towards the start.
fn bay() -> (Map, Point2<f64>, Point2<f64>) {
    let cylinder = |angle: f64| {
        let (sine, cosine) = angle.to_radians().sin_cos();
        Shape::Circle { centre: Point2::new(3.0 + 1.1 * cosine, 2.5 + 1.1 * sine), radius: 0.5 }
    };
    let cylinders: Vec<Shape> = [-80.0, -40.0, 0.0, 40.0, 80.0].map(cylinder).to_vec();
    let map = Map::new(120, 100, 0.05).unwrap().with(&cylinders).unwrap();
    (map, Point2::new(0.52, 2.52), Point2::new(5.52, 2.52))
}

const FORCES: Forces = Forces { attraction: 1.0, reach: 1.0, repulsion: 0.02, influence: 0.5 };

/// Fig. 4-12: the descent of the potential field ends in the bay from all starts, which is reported.
#[test]
fn a_potential_field_is_stuck_in_the_bay() {
    let (map, start, goal) = bay();
    let potential = Potential::new(&map, &goal, &FORCES).unwrap();
    let stuck = potential.descend(&map, &start).unwrap().unwrap_err();
    // Between the cylinders, before the goal.
    assert!((stuck.place - Point2::new(3.0, 2.5)).norm() < 1.1, "{}", stuck.place);
    assert_leads(&map, &stuck.path, &start, &stuck.place);
    let text = format!("({:.3}, {:.3})", stuck.place.x, stuck.place.y);
    assert!(stuck.to_string().contains("local minimum") && stuck.to_string().contains(&text), "{stuck}");
    // A local minimum: no neighbour has a lower value.
    let cell = map.cell_at(&stuck.place).unwrap();
    let around = [-121, -120, -119, -1, 1, 119, 120, 121].map(|step: isize| cell.checked_add_signed(step).unwrap());
    assert!(around.iter().all(|other| potential.values()[*other] >= potential.values()[cell]));
    // Without obstacles between it leads to the goal.
    let clear = Point2::new(0.52, 4.72);
    let path = Potential::new(&map, &Point2::new(5.52, 4.72), &FORCES).unwrap().descend(&map, &clear).unwrap().unwrap();
    assert_leads(&map, &path, &clear, &Point2::new(5.52, 4.72));
}

/// Fig. 4-13: a field leads out of the bay.
#[test]
fn m3r_leaves_the_bay() {
    let (map, start, goal) = bay();
    for method in [Method::M3r, Method::FastMarching(1), Method::FastMarching(2)] {
        let found = field(&map, &goal, method);
        let inside = Point2::new(3.02, 2.52);
        for start in [start, inside] {
            let path = found.descend(&map, &start).unwrap().unwrap();
            assert_leads(&map, &path, &start, &goal);
            // Around an end of the bay, which no line through the bay does.
            assert!(path.points.iter().any(|point| (point.y - 2.5).abs() > 1.4));
        }
    }
}

/// The potential has the values of its definition, computed from the distances to all occupied cells.
#[test]
fn a_potential_is_attraction_and_repulsion() {
    let map = random_map(17, 13, 0.1, 3);
    let goal = (0..map.cells().len()).rfind(|cell| map.is_free(*cell)).unwrap();
    let forces = Forces { attraction: 2.0, reach: 0.3, repulsion: 0.001, influence: 0.12 };
    let potential = Potential::new(&map, &map.centre(goal), &forces).unwrap();
    let mut repelled = 0;
    for cell in 0..map.cells().len() {
        let found = potential.values()[cell];
        if !map.is_free(cell) {
            assert_eq!(found, f64::INFINITY);
            continue;
        }
        let beyond = |a: usize, b: usize| (a.abs_diff(b) as f64 - 0.5).max(0.0) * 0.05;
        let away = |other: usize| beyond(cell % 17, other % 17).hypot(beyond(cell / 17, other / 17));
        let clearance = (0..17 * 13).filter(|other| !map.is_free(*other)).map(away).fold(f64::INFINITY, f64::min);
        let distance = (map.centre(cell) - map.centre(goal)).norm();
        let attracting = if distance <= 0.3 { distance * distance } else { 2.0 * 0.3 * distance - 0.09 };
        let repelling = if clearance < 0.12 { 0.0005 * (1.0 / clearance - 1.0 / 0.12).powi(2) } else { 0.0 };
        repelled += usize::from(repelling > 0.0);
        assert!((found - attracting - repelling).abs() < 1e-9 * found.max(1.0), "{cell}");
    }
    assert!(repelled > 20);
    for bad in [0.0, -1.0, f64::NAN] {
        let error = Potential::new(&map, &map.centre(goal), &Forces { reach: bad, ..forces }).unwrap_err();
        assert!(error.kind() == ErrorKind::BadValue && error.message().contains("positive"), "{error}");
    }
}

/// Fig. 4-14: ten starts in one field, among round, hollow and irregular obstacles.
#[test]
fn ten_starts_have_paths_in_one_field() {
    let polygon = |corners: &[(f64, f64)]| Shape::Polygon(corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect());
    let obstacles = [
        Shape::Circle { centre: Point2::new(3.0, 7.0), radius: 0.8 },
        Shape::rectangle(Point2::new(7.0, 2.0), 2.0, 0.7, 0.5),
        polygon(&[(4.0, 3.0), (6.0, 3.0), (6.0, 6.0), (4.0, 6.0), (4.0, 5.7), (5.7, 5.7), (5.7, 3.3), (4.0, 3.3)]),
        polygon(&[(1.0, 1.0), (2.5, 1.6), (2.0, 2.9), (1.6, 1.9), (0.7, 2.4)]),
        polygon(&[(7.0, 6.0), (9.0, 6.5), (7.9, 7.0), (8.6, 9.0), (7.2, 7.6)]),
    ];
    let map = Map::new(200, 200, 0.05).unwrap().with(&obstacles).unwrap();
    let goal = Point2::new(5.02, 4.52);
    let mut random = Random(14);
    let mut place = || Point2::new(10.0 * random.number(), 10.0 * random.number());
    let starts: Vec<Point2<f64>> =
        std::iter::from_fn(|| Some(place())).filter(|place| map.free_cell_at(place).is_ok()).take(10).collect();
    for method in [Method::M3r, Method::FastMarching(1), Method::FastMarching(2)] {
        let found = field(&map, &goal, method);
        for start in &starts {
            let path = found.descend(&map, start).unwrap().unwrap();
            assert_leads(&map, &path, start, &goal);
            let time = found.times()[map.cell_at(start).unwrap()];
            assert!(path.length() >= (goal - start).norm() - 0.1 && time >= (goal - start).norm() - 0.2);
        }
    }
}

/// The thesis presents RH0 (4-17) as an approximation of (4-11). In fact it is the distance along rows and columns: up to sqrt(2) times the distance, for cells
/// of any size.
#[test]
fn m3r_does_not_converge() {
    let worst = |cells: usize| {
        let map = Map::new(cells, cells, 4.0 / cells as f64).unwrap();
        let goal = map.centre(0);
        let [along, near] = [Method::M3r, Method::FastMarching(2)].map(|method| field(&map, &goal, method));
        // Away from the goal, where the error of the second order applies.
        let far = (0..cells * cells).filter(|cell| (map.centre(*cell) - goal).norm() > 0.5);
        let ratio = |cell: usize| {
            let distance = (map.centre(cell) - goal).norm();
            (along.times()[cell] / distance, near.times()[cell] / distance)
        };
        let (least, most, missed) =
            far.map(ratio).fold((f64::INFINITY, 0.0_f64, 0.0_f64), |(least, most, missed), (m3r, order)| {
                (least.min(m3r), most.max(m3r), missed.max((order - 1.0).abs()))
            });
        assert!(least > 1.0 - 1e-12 && (most - 2f64.sqrt()).abs() < 1e-9);
        missed
    };
    let missed = [50, 100, 200].map(worst);
    assert!(missed[0] < 0.1 && missed[1] < 0.6 * missed[0] && missed[2] < 0.6 * missed[1], "{missed:?}");
}
