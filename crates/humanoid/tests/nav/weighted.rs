//! Quickest paths, compared with Snell's law, solved by minimisation over the points at which borders are crossed.

use groebot_humanoid::nav::{Map, Path, Quickest, Shape};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;

use super::{Random, random_map};

fn quickest(map: &Map, start: Point2<f64>, goal: Point2<f64>) -> Quickest {
    let found = map.quickest_path(&start, &goal, None, &Watch::none()).unwrap().unwrap();
    assert!((found.path.time(map).unwrap() - found.time).abs() < 1e-9 * found.time);
    assert!(found.path.points[0] == start && *found.path.points.last().unwrap() == goal);
    assert!(found.bound <= found.time);
    found
}

/// The minimum of a convex function.
fn least(low: f64, high: f64, of: &dyn Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..200 {
        let third = (high - low) / 3.0;
        if of(low + third) < of(high - third) { high -= third } else { low += third }
    }
    of(low)
}

/// A floor of 4 m x 3 m in cells of 5 cm, with a lower speed left of `x`.
fn floor() -> Map {
    Map::new(80, 60, 0.05).unwrap()
}

#[test]
fn two_half_planes_bend_a_path_by_snells_law() {
    for speed in [0.2, 0.5, 0.8, 3.0] {
        let map = floor().with_speed(&Shape::rectangle(Point2::new(0.0, 1.5), 4.0, 10.0, 0.0), speed).unwrap();
        for (start, goal) in [((0.33, 0.21), (3.71, 2.8)), ((1.9, 0.1), (2.6, 2.9)), ((0.5, 2.0), (3.5, 2.0))] {
            let time = |y: f64| (2.0f64 - start.0).hypot(y - start.1) / speed + (goal.0 - 2.0f64).hypot(goal.1 - y);
            // Speeds of the map are single precision.
            let expected = least(0.0, 3.0, &time);
            let found = quickest(&map, Point2::new(start.0, start.1), Point2::new(goal.0, goal.1));
            assert!((found.time / expected - 1.0).abs() < 1e-5, "{speed} {start:?}: {} {expected}", found.time);
            // Where the path is along the border, the bound by layers is less tight.
            assert!(found.bound <= expected * (1.0 + 1e-6) && found.bound > 0.75 * expected, "{found:?} {expected}");
        }
    }
}

#[test]
fn a_strip_bends_a_path_twice() {
    for speed in [0.3, 0.6, 2.5] {
        let map = floor().with_speed(&Shape::rectangle(Point2::new(2.0, 1.5), 1.0, 10.0, 0.0), speed).unwrap();
        for (start, goal) in [((0.2, 0.3), (3.8, 2.7)), ((1.0, 0.1), (3.0, 2.9))] {
            let expected = least(0.0, 3.0, &|y: f64| {
                let rest = |z: f64| 1.0f64.hypot(z - y) / speed + (goal.0 - 2.5f64).hypot(goal.1 - z);
                (1.5f64 - start.0).hypot(y - start.1) + least(0.0, 3.0, &rest)
            });
            let found = quickest(&map, Point2::new(start.0, start.1), Point2::new(goal.0, goal.1));
            assert!((found.time / expected - 1.0).abs() < 1e-5, "{speed}: {} {expected}", found.time);
            assert!(found.bound > 0.99 * expected && found.bound <= expected * (1.0 + 1e-6), "{found:?} {expected}");
        }
    }
}

/// A path along a fast road at the lower wall leaves and enters it at the critical angle: `sin a = v / v_road`.
#[test]
fn a_road_is_worth_a_detour() {
    let map = floor().with_speed(&Shape::rectangle(Point2::new(2.0, 0.0), 10.0, 1.0, 0.0), 4.0).unwrap();
    let (start, goal) = (Point2::new(0.3, 1.1), Point2::new(3.7, 1.1));
    let found = quickest(&map, start, goal);
    let (depth, width) = (0.6f64, 3.4f64);
    let expected = 2.0 * depth * (1.0 - 1.0 / 16.0f64).sqrt() + width / 4.0;
    assert!((found.time / expected - 1.0).abs() < 1e-5, "{} {expected}", found.time);
    assert!(found.time < 0.7 * width);
}

/// Without speeds the quickest path is the shortest one. With speeds it does not cross obstacles.
#[test]
fn no_obstacle_is_passed() {
    let mut numbers = Random(3);
    let mut reached = 0;
    for seed in 0..12 {
        let map = random_map(40, 40, 0.2, 5000 + seed);
        let disc = Shape::Circle { centre: Point2::new(1.0, 0.8), radius: 0.5 };
        let slow = map.clone().with_speed(&disc, 0.4).unwrap();
        let free: Vec<usize> = (0..1600).filter(|cell| map.is_free(*cell)).collect();
        let [start, goal] = [(); 2].map(|()| map.centre(free[(numbers.number() * free.len() as f64) as usize]));
        let shortest = match map.shortest_path(&start, &goal, &Default::default(), &Watch::none()).unwrap() {
            Ok(shortest) => shortest.path,
            Err(enclosure) => {
                let found = slow.quickest_path(&start, &goal, None, &Watch::none()).unwrap();
                assert_eq!(found.unwrap_err(), enclosure);
                continue;
            }
        };
        let even = quickest(&map, start, goal);
        assert!((even.time - shortest.length()).abs() < 1e-6 && even.bound > 0.999_999 * even.time, "{even:?}");
        let found = quickest(&slow, start, goal);
        assert!(found.time <= shortest.time(&slow).unwrap() + 1e-9 && found.bound >= shortest.length() * (1.0 - 1e-6));
        samples_are_free(&map, &found.path);
        reached += 1;
    }
    assert!(reached > 8);
}

fn samples_are_free(map: &Map, path: &Path) {
    for pair in path.points.windows(2) {
        for part in 0..=1000 {
            let own = map.in_map(&(pair[0] + (pair[1] - pair[0]) * (f64::from(part) / 1000.0)));
            // On a border at least one of the adjacent cells is free.
            let near = |x: f64| [(x - 1e-6).floor(), (x + 1e-6).floor()];
            let is_free = |x: f64, y: f64| {
                let is_on = (0.0..map.columns() as f64).contains(&x) && (0.0..map.rows() as f64).contains(&y);
                is_on && map.is_free(y as usize * map.columns() + x as usize)
            };
            assert!(near(own.x).iter().any(|x| near(own.y).iter().any(|y| is_free(*x, *y))), "{own}");
        }
    }
}

#[test]
fn times_are_integrals_over_cells() {
    let map = Map::from_text("..#\n...\n", 2.0).unwrap();
    let map = map.with_speed(&Shape::rectangle(Point2::new(1.0, 1.0), 2.0, 2.0, 0.0), 0.5).unwrap();
    let time =
        |points: &[(f64, f64)]| Path { points: points.iter().map(|(x, y)| Point2::new(*x, *y)).collect() }.time(&map);
    assert_eq!(time(&[(0.0, 1.0), (6.0, 1.0)]), Some(2.0 / 0.5 + 4.0));
    // Along the border of the slow cell the higher speed counts.
    assert_eq!(time(&[(0.0, 2.0), (2.0, 2.0)]), Some(2.0));
    assert_eq!(time(&[(1.0, 1.0), (5.0, 3.0)]), None);
    // It may touch an obstacle, but not pass between two that meet at a corner.
    assert_eq!(time(&[(3.0, 2.0), (6.0, 2.0)]), Some(3.0));
    let pinched = Map::from_text("#.\n.#\n", 1.0).unwrap();
    let through = Path { points: vec![Point2::new(0.5, 0.5), Point2::new(1.5, 1.5)] };
    let bent = Path { points: vec![Point2::new(0.5, 0.5), Point2::new(1.0, 1.0), Point2::new(1.5, 1.5)] };
    assert!(through.time(&pinched).is_none() && bent.time(&pinched).is_none());
    let error = map.quickest_path(&Point2::new(5.0, 3.0), &Point2::new(0.5, 0.5), None, &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
}
