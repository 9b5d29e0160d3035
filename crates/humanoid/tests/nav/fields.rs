//! Arrival-time fields: M3R of the thesis compared with shortest paths, fast marching compared with distances and with its own equation.

use groebot_humanoid::nav::{Field, Map, Method, Shape};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;

use super::random_map;

fn field(map: &Map, goals: &[usize], method: Method) -> Field {
    let goals: Vec<Point2<f64>> = goals.iter().map(|goal| map.centre(*goal)).collect();
    Field::new(map, &goals, method, &Watch::none()).unwrap()
}

/// Free neighbours of a cell.
fn beside(map: &Map, cell: usize) -> Vec<usize> {
    map.beside(cell).filter(|cell| map.is_free(*cell)).collect()
}

/// A map with lower speeds on half of the floor and on a disc.
fn with_speeds(map: Map) -> Map {
    let reach = map.columns() as f64 * map.resolution();
    let half = Shape::rectangle(Point2::origin(), reach, 100.0, 0.0);
    let disc = Shape::Circle { centre: Point2::new(0.6 * reach, 0.3 * reach), radius: 0.2 * reach };
    map.with_speed(&half, 0.3).unwrap().with_speed(&disc, 2.7).unwrap()
}

/// Bellman-Ford iterations until nothing changes: T = min(T_nb + G / F).
fn shortest(map: &Map, goals: &[usize]) -> Vec<f64> {
    let mut times = vec![f64::INFINITY; map.cells().len()];
    goals.iter().for_each(|goal| times[*goal] = 0.0);
    loop {
        let before = times.clone();
        for cell in (0..times.len()).filter(|cell| map.is_free(*cell)) {
            let cost = map.resolution() / map.speeds().map_or(1.0, |speeds| f64::from(speeds[cell]));
            for other in beside(map, cell) {
                times[cell] = times[cell].min(times[other] + cost);
            }
        }
        if times == before {
            return times;
        }
    }
}

#[test]
fn m3r_is_the_shortest_path_over_four_neighbours() {
    for (share, seed) in [(0.0, 1), (0.2, 2), (0.35, 3)] {
        for map in [random_map(41, 29, share, seed), with_speeds(random_map(41, 29, share, seed))] {
            let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
            let goals = [free[3], free[free.len() / 2]];
            let found = field(&map, &goals, Method::M3r);
            for (found, expected) in found.times().iter().zip(shortest(&map, &goals)) {
                assert!(*found == expected || (found - expected).abs() < 1e-12 * expected, "{found} {expected}");
            }
        }
    }
}

/// RH0 (4-17) does not converge to the distance with smaller cells: along a diagonal the ratio stays 1.41.
#[test]
fn m3r_is_the_distance_along_rows_and_columns() {
    for cells in [21, 81, 161] {
        let map = Map::new(cells, cells, 1.0 / cells as f64).unwrap();
        let found = field(&map, &[0], Method::M3r);
        let corner = cells * cells - 1;
        let distance = (map.centre(corner) - map.centre(0)).norm();
        assert!((found.times()[corner] / distance - 2f64.sqrt()).abs() < 1e-9);
        assert!((found.times()[cells - 1] - (map.centre(cells - 1) - map.centre(0)).norm()).abs() < 1e-9);
    }
}

/// Fast marching converges to the distance with smaller cells, faster with the second order.
#[test]
fn fast_marching_comes_near_to_the_distance() {
    let worst = |cells: usize, order: u8| {
        let map = Map::new(cells, cells, 1.0 / cells as f64).unwrap();
        let goal = cells / 2 * cells + cells / 2;
        let found = field(&map, &[goal], Method::FastMarching(order));
        let miss = |(cell, time): (usize, &f64)| (time - (map.centre(cell) - map.centre(goal)).norm()).abs();
        found.times().iter().enumerate().map(miss).fold(0.0, f64::max)
    };
    let [first, second] = [1, 2].map(|order| [worst(41, order), worst(161, order)]);
    assert!(first[1] < 0.45 * first[0] && first[1] < 0.02, "{first:?}");
    assert!(second[1] < 0.3 * second[0] && second[1] < 0.4 * first[1], "{second:?}");
}

/// T of the first order solves (4-15) in every cell.
#[test]
fn fast_marching_solves_its_equation() {
    for map in [random_map(37, 33, 0.2, 5), with_speeds(random_map(37, 33, 0.25, 6))] {
        let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
        let goal = free[free.len() / 3];
        let found = field(&map, &[goal], Method::FastMarching(1));
        let times = found.times();
        let shortest = shortest(&map, &[goal]);
        for cell in 0..times.len() {
            assert_eq!(times[cell].is_finite(), shortest[cell].is_finite());
            if cell == goal || !times[cell].is_finite() {
                continue;
            }
            let cost = map.resolution() / map.speeds().map_or(1.0, |speeds| f64::from(speeds[cell]));
            let of = |columns: bool| {
                let near = beside(&map, cell).into_iter().filter(|other| (other.abs_diff(cell) == 1) == columns);
                near.map(|other| (times[cell] - times[other]).max(0.0)).fold(0.0, f64::max)
            };
            let slope = of(true).hypot(of(false));
            assert!((slope / cost - 1.0).abs() < 1e-9, "{cell}: {slope} {cost}");
            assert!(times[cell] <= shortest[cell] + 1e-12);
        }
    }
}

/// Fast marching in Sethian's form: the least of all trial values is accepted, and only accepted values are used.
fn tidy(map: &Map, goals: &[usize]) -> Vec<f64> {
    let mut times = vec![f64::INFINITY; map.cells().len()];
    let mut open: Vec<usize> = goals.to_vec();
    let mut is_accepted = vec![false; times.len()];
    goals.iter().for_each(|goal| times[*goal] = 0.0);
    while let Some(at) = (0..open.len()).min_by(|a, b| times[open[*a]].total_cmp(&times[open[*b]])) {
        let cell = open.swap_remove(at);
        if std::mem::replace(&mut is_accepted[cell], true) {
            continue;
        }
        for other in beside(map, cell).into_iter().filter(|other| !is_accepted[*other]) {
            let cost = map.resolution() / map.speeds().map_or(1.0, |speeds| f64::from(speeds[other]));
            let nearest = |columns: bool| {
                let known = beside(map, other).into_iter().filter(|near| is_accepted[*near]);
                let along = known.filter(|near| (near.abs_diff(other) == 1) == columns);
                along.map(|near| times[near]).fold(f64::INFINITY, f64::min)
            };
            let (a, b) = (nearest(true), nearest(false));
            let both = 0.5 * (a + b + (2.0 * cost * cost - (a - b).powi(2)).sqrt());
            times[other] = if (a - b).abs() < cost { both } else { a.min(b) + cost };
            open.push(other);
        }
    }
    times
}

/// The result does not depend on the order in which cells are processed: it equals that of an ordered front, for any ratio of speeds.
#[test]
fn fast_marching_ends_where_a_tidy_front_does() {
    let extreme = |map: Map, speeds: [f64; 2]| {
        let disc = |x: f64, radius: f64| Shape::Circle { centre: Point2::new(x, 0.8), radius };
        map.with_speed(&disc(0.5, 0.4), speeds[0]).unwrap().with_speed(&disc(1.5, 0.3), speeds[1]).unwrap()
    };
    for seed in 0..12 {
        let share = 0.05 * (seed % 8) as f64;
        let even = random_map(43, 31, share, seed);
        let fast = extreme(even.clone(), [1e-3, 1e6]);
        for map in [with_speeds(even.clone()), fast, even] {
            let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
            let goals = [free[free.len() / 4], free[free.len() - 3]];
            let found = field(&map, &goals, Method::FastMarching(1));
            for (cell, (found, expected)) in found.times().iter().zip(tidy(&map, &goals)).enumerate() {
                assert!(
                    *found == expected || (found - expected).abs() <= 1e-12 * expected,
                    "{cell}: {found} {expected}"
                );
            }
            let along = field(&map, &goals, Method::M3r);
            for (found, expected) in along.times().iter().zip(shortest(&map, &goals)) {
                assert!(*found == expected || (found - expected).abs() <= 1e-12 * expected, "{found} {expected}");
            }
        }
    }
}

#[test]
fn what_has_no_field_is_refused() {
    let map = Map::from_text("..#\n...\n", 1.0).unwrap();
    let new = |goals: &[Point2<f64>], method| Field::new(&map, goals, method, &Watch::none());
    let error = new(&[Point2::new(2.5, 1.5)], Method::M3r).unwrap_err();
    assert!(error.kind() == ErrorKind::BadValue && error.message().contains("occupied"), "{error}");
    assert!(new(&[], Method::M3r).is_err());
    assert!(new(&[Point2::new(0.5, 0.5)], Method::FastMarching(3)).is_err());
    let found = new(&[Point2::new(0.5, 0.5)], Method::FastMarching(2)).unwrap();
    assert_eq!((found.goals(), found.columns(), found.method()), (&[0][..], 3, Method::FastMarching(2)));
    assert_eq!(found.times()[5], f64::INFINITY);
}

/// A field has no local minima except its goals: the descent from every reached cell ends at one, with the expected length.
#[test]
fn every_descent_ends_in_a_goal() {
    for method in [Method::M3r, Method::FastMarching(1), Method::FastMarching(2)] {
        let map = random_map(33, 27, 0.25, 9);
        let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
        let goals = [free[10], free[free.len() - 20]];
        let found = field(&map, &goals, method);
        let mut enclosed = 0;
        for start in free.iter().copied() {
            match found.descend(&map, &map.centre(start)).unwrap() {
                Ok(path) => {
                    let last = map.cell_at(path.points.last().unwrap()).unwrap();
                    assert!(goals.contains(&last) && found.times()[start].is_finite());
                    let cells: Vec<usize> = path.points.iter().map(|point| map.cell_at(point).unwrap()).collect();
                    assert!(cells.windows(2).all(|pair| found.times()[pair[1]] < found.times()[pair[0]]));
                    // No path is shorter than the straight distance.
                    assert!(path.length() >= (path.points[0] - path.points[path.points.len() - 1]).norm() - 1e-12);
                }
                Err(enclosure) => {
                    enclosed += 1;
                    let is_in = enclosure.cells.contains(&start);
                    let goal = goals[0];
                    let (inside, outside) = if is_in { (start, goal) } else { (goal, start) };
                    assert!(enclosure.parts(&map, inside, outside));
                    // A set from which a cell is removed is no enclosure.
                    if enclosure.cells.len() > 1 {
                        let mut less = enclosure.clone();
                        less.cells.remove(0);
                        assert!(!less.parts(&map, inside, outside) || !is_in || enclosure.cells[0] == start);
                    }
                }
            }
        }
        assert!(enclosed > 0);
    }
}
