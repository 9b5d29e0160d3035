//! Taut and smooth paths, checked by their definitions against the cells of the map.

use groebot_humanoid::Watch;
use groebot_humanoid::nav::{Field, Map, Method, Part, Path};
use nalgebra::{Point2, Vector2};

use super::random_map;

/// Paths over the middles of cells, on random maps.
fn paths() -> Vec<(Map, Path)> {
    let mut all = vec![];
    for (seed, share) in [(1, 0.05), (2, 0.15), (3, 0.25), (4, 0.35)] {
        let map = random_map(50, 45, share, 6000 + seed);
        let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
        let goal = map.centre(free[free.len() / 2]);
        let field = Field::new(&map, &[goal], Method::FastMarching(1), &Watch::none()).unwrap();
        for start in free.iter().step_by(199) {
            if let Ok(path) = field.descend(&map, &map.centre(*start)).unwrap() {
                all.push((map.clone(), path));
            }
        }
    }
    assert!(all.len() > 20);
    all
}

fn is_free(map: &Map, x: f64, y: f64) -> bool {
    let is_on = (0.0..map.columns() as f64).contains(&x) && (0.0..map.rows() as f64).contains(&y);
    is_on && map.is_free(y as usize * map.columns() + x as usize)
}

/// Whether a place \[m\] is in the closure of the free cells.
fn is_clear(map: &Map, place: &Point2<f64>) -> bool {
    let own = map.in_map(place);
    let near = |x: f64| [x - 1e-6, x + 1e-6];
    near(own.x).iter().any(|x| near(own.y).iter().any(|y| is_free(map, *x, *y)))
}

/// A taut path turns only at convex corners, around their obstacles: no string nearby is shorter.
#[test]
fn a_taut_path_bends_around_corners_only() {
    let mut bends = 0;
    for (map, path) in paths() {
        let taut = path.taut(&map, &Watch::none()).unwrap();
        assert!(taut.length() <= path.length() + 1e-12 && taut.time(&map).is_some());
        assert_eq!((taut.points[0], taut.points.last()), (path.points[0], path.points.last()));
        let [start, goal] = [taut.points[0], *taut.points.last().unwrap()];
        let shortest = map.shortest_path(&start, &goal, &Default::default(), &Watch::none()).unwrap().unwrap();
        assert!(shortest.path.length() <= taut.length() + 1e-12);
        let again = shortest.path.taut(&map, &Watch::none()).unwrap();
        assert!((again.length() - shortest.path.length()).abs() < 1e-12, "{again:?} {shortest:?}");
        for three in taut.points.windows(3) {
            let [into, out] = [three[1] - three[0], three[2] - three[1]];
            let corner = map.in_map(&three[1]);
            assert!((corner - corner.map(f64::round)).norm() < 1e-9, "{corner}");
            let inwards = out.normalize() - into.normalize();
            let about = [(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)].map(|(x, y)| Vector2::new(x, y));
            let taken: Vec<_> =
                about.iter().filter(|away| !is_free(&map, corner.x + away.x, corner.y + away.y)).collect();
            assert!(taken.len() == 1 && taken[0].dot(&inwards) > 0.0, "{taken:?} {inwards}");
            bends += 1;
        }
    }
    assert!(bends > 100, "{bends}");
}

/// Arcs have the requested radius. Each segment continues where the one before ends, in its direction except at the reported sharp corners. The path is clear
/// of obstacles.
#[test]
fn a_smooth_path_has_a_continuous_direction() {
    let (mut arcs, mut sharp) = (0, 0);
    for (map, path) in paths() {
        let taut = path.taut(&map, &Watch::none()).unwrap();
        for radius in [0.01, 0.04, 0.15] {
            let smooth = taut.smoothed(&map, radius).unwrap();
            arcs += smooth.parts.iter().filter(|part| matches!(part, Part::Arc { .. })).count();
            sharp += smooth.sharp.len();
            assert!(smooth.parts.iter().all(|part| !matches!(part, Part::Arc { radius: own, .. } if *own < radius)));
            for pair in smooth.parts.windows(2) {
                let ((end, before), (begin, after)) = (pair[0].pose(1.0), pair[1].pose(0.0));
                assert!((end - begin).norm() < 1e-9, "{pair:?}");
                let turn = (after - before).sin().abs().max(1.0 - (after - before).cos());
                let is_reported = smooth.sharp.iter().any(|corner| (corner - end).norm() < 1e-9);
                let is_short = pair.iter().any(|part| part.length() < 1e-6);
                assert!(turn < 1e-6 || is_reported || is_short, "{turn} {pair:?}");
            }
            let poses = smooth.poses(0.001).unwrap();
            assert!((poses[0].0 - taut.points[0]).norm() < 1e-12);
            assert!((poses[poses.len() - 1].0 - *taut.points.last().unwrap()).norm() < 1e-12);
            assert!(poses.iter().all(|(place, _)| is_clear(&map, place)));
            assert!(poses.windows(2).all(|pair| (pair[1].0 - pair[0].0).norm() <= 0.001 + 1e-12));
        }
    }
    assert!(arcs > 100 && sharp > 10, "{arcs} {sharp}");
}

/// A right angle without obstacles, computed by hand: the arc begins one radius before the corner and saves `2 - pi / 2` radii.
#[test]
fn a_right_angle_is_a_quarter_of_a_circle() {
    let map = Map::new(40, 40, 0.1).unwrap();
    let points = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
    let path = Path { points };
    let smooth = path.smoothed(&map, 0.5).unwrap();
    assert!(
        (smooth.length() - (4.0 - 0.5 * (2.0 - std::f64::consts::FRAC_PI_2))).abs() < 1e-12 && smooth.sharp.is_empty()
    );
    let [_, Part::Arc { centre, turn, .. }, _] = smooth.parts[..] else { panic!("{:?}", smooth.parts) };
    assert!((centre - Point2::new(2.5, 1.5)).norm() < 1e-12 && (turn - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    // An obstacle at the corner's inner side: the arc passes around it.
    let wall = map.with(&[groebot_humanoid::nav::Shape::rectangle(Point2::new(2.5, 1.5), 0.98, 0.98, 0.0)]).unwrap();
    let around = path.smoothed(&wall, 0.5).unwrap();
    assert!(around.sharp.is_empty() && around.length() > smooth.length());
    // A radius that exceeds the adjacent segments leaves the corner sharp.
    assert_eq!(path.smoothed(&map, 2.5).unwrap().sharp, vec![Point2::new(3.0, 1.0)]);
}

#[test]
fn what_cannot_be_pulled_or_rounded_is_refused() {
    let map = Map::from_text("...\n.#.\n...\n", 1.0).unwrap();
    let path = Path { points: vec![Point2::new(0.5, 0.5), Point2::new(2.5, 2.5)] };
    let error = path.taut(&map, &Watch::none()).unwrap_err();
    assert!(error.message().contains("crosses an obstacle between (0.5, 0.5)"), "{error}");
    assert!(path.smoothed(&map, 0.1).is_err());
    let none = Path { points: vec![] };
    assert!(none.taut(&map, &Watch::none()).is_err() && none.smoothed(&map, 0.1).is_err());
    let clear = Path { points: vec![Point2::new(0.5, 0.5)] };
    assert!(clear.smoothed(&map, 0.0).is_err() && clear.smoothed(&map, f64::NAN).is_err());
    assert_eq!(clear.taut(&map, &Watch::none()).unwrap(), clear);
    let smooth = clear.smoothed(&map, 0.1).unwrap();
    assert!(smooth.length() == 0.0 && smooth.poses(0.0).is_err());
}
