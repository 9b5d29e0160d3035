//! Paths over eight neighbours, compared with iterations over all cells until nothing changes.

use groebot_humanoid::Watch;
use groebot_humanoid::nav::{Guide, Map};
use nalgebra::Vector2;

use super::random_map;

/// Path lengths from a cell, in cells, by Bellman-Ford iterations.
fn lengths(map: &Map, start: usize) -> Vec<f64> {
    let (columns, rows) = (map.columns() as i64, map.rows() as i64);
    let free =
        |x: i64, y: i64| (0..columns).contains(&x) && (0..rows).contains(&y) && map.is_free((y * columns + x) as usize);
    let mut lengths = vec![f64::INFINITY; map.cells().len()];
    lengths[start] = 0.0;
    loop {
        let before = lengths.clone();
        for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).filter(|(x, y)| free(*x, *y)) {
            for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
                if free(x + i, y + j) && free(x + i, y) && free(x, y + j) {
                    let new = lengths[((y + j) * columns + x + i) as usize] + f64::from((i * i + j * j) as i32).sqrt();
                    let own = &mut lengths[(y * columns + x) as usize];
                    *own = own.min(new);
                }
            }
        }
        if lengths == before {
            return lengths;
        }
    }
}

#[test]
fn octile_paths_are_shortest_and_cut_no_corner() {
    let mut reached = 0;
    for (seed, share) in [(1, 0.0), (2, 0.1), (3, 0.2), (4, 0.3), (5, 0.4)] {
        let map = random_map(67, 31, share, seed);
        let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
        let goal = free[free.len() / 3];
        let expected = lengths(&map, goal);
        for start in free.iter().copied().step_by(13) {
            let [from, to] = [start, goal].map(|cell| map.centre(cell) + Vector2::new(0.01, -0.02));
            let Ok(path) = map.octile_path(&from, &to, &Watch::none()).unwrap() else {
                assert!(expected[start].is_infinite());
                continue;
            };
            assert!((path.length() / map.resolution() - expected[start]).abs() < 1e-9);
            assert!(path.points[0] == map.centre(start) && *path.points.last().unwrap() == map.centre(goal));
            check_steps(&map, &path.points);
            let exact = map.shortest_path(&map.centre(start), &map.centre(goal), &Guide::default(), &Watch::none());
            assert!(exact.unwrap().unwrap().path.length() <= path.length() + 1e-12);
            reached += 1;
        }
    }
    assert!(reached > 400, "{reached}");
}

/// Each move is along a row, a column or a diagonal over free cells; for a diagonal the cells on both sides are free.
fn check_steps(map: &Map, points: &[nalgebra::Point2<f64>]) {
    for pair in points.windows(2) {
        let away = (pair[1] - pair[0]) / map.resolution();
        let count = away.amax().round();
        let step = away / count;
        assert!(step.iter().all(|x| (x - x.round()).abs() < 1e-9 && x.abs() < 1.5));
        for place in 0..count as i32 {
            let from = pair[0] + step * f64::from(place) * map.resolution();
            for part in [Vector2::new(step.x, 0.0), Vector2::new(0.0, step.y), step] {
                assert!(map.is_free(map.cell_at(&(from + part * map.resolution())).unwrap()));
            }
        }
    }
}

#[test]
fn without_an_octile_path_there_is_an_enclosure() {
    let map = Map::from_text(".#.\n#..\n...\n", 1.0).unwrap();
    let [start, goal] = [6, 2].map(|cell| map.centre(cell));
    let enclosure = map.octile_path(&start, &goal, &Watch::none()).unwrap().unwrap_err();
    assert!(enclosure.cells == [6] && enclosure.parts(&map, 6, 2));
    assert!(map.octile_path(&map.centre(3), &goal, &Watch::none()).is_err());
    assert_eq!(map.octile_path(&goal, &goal, &Watch::none()).unwrap().unwrap().length(), 0.0);
}
