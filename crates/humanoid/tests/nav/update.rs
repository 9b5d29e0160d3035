//! Fields that are updated incrementally, compared with fields computed anew.

use groebot_humanoid::nav::{Cell, Field, Map, Method, Shape, Window};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;

use super::{Random, random_map};

const METHODS: [Method; 2] = [Method::M3r, Method::FastMarching(1)];

fn new(map: &Map, goals: &[usize], method: Method) -> Field {
    let goals: Vec<Point2<f64>> = goals.iter().map(|goal| map.centre(*goal)).collect();
    Field::new(map, &goals, method, &Watch::none()).unwrap()
}

fn assert_same(found: &Field, expected: &Field) {
    for (cell, (found, expected)) in found.times().iter().zip(expected.times()).enumerate() {
        assert!(found == expected || (found - expected).abs() <= 1e-12 * expected, "{cell}: {found} {expected}");
    }
}

/// The map with some cells changed and, if it has speeds, with another disc of them.
fn changed(map: &Map, goals: &[usize], random: &mut Random) -> Map {
    let mut cells = map.cells().to_vec();
    for _ in 0..1 + random.below(8) {
        let cell = random.below(cells.len());
        if !goals.contains(&cell) {
            cells[cell] = if cells[cell] == Cell::Free { Cell::Occupied } else { Cell::Free };
        }
    }
    Map::of_cells(map.columns(), map.rows(), map.resolution(), cells).unwrap()
}

fn slower(map: Map, random: &mut Random) -> Map {
    let reach = map.columns() as f64 * map.resolution();
    let centre = Point2::new(reach * random.number(), reach * random.number());
    map.with_speed(&Shape::Circle { centre, radius: 0.2 * reach }, 0.2 + 2.0 * random.number()).unwrap()
}

#[test]
fn what_changed_is_marched_again() {
    for seed in 0..60 {
        let mut random = Random(seed);
        let has_speeds = seed % 3 == 0;
        let mut map = random_map(37, 29, 0.3 * random.number(), seed);
        let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
        let goals = [free[random.below(free.len())], free[random.below(free.len())]];
        let mut fields = METHODS.map(|method| new(&map, &goals, method));
        for _ in 0..6 {
            map = changed(&map, &goals, &mut random);
            if has_speeds {
                map = slower(map, &mut random);
            }
            fields = fields.map(|field| {
                let method = field.method();
                let again = field.after(&map, &Watch::none()).unwrap();
                assert_same(&again.field, &new(&map, &goals, method));
                again.field
            });
        }
    }
}

/// A door far from the goal changes few cells, and without a change no cell is updated.
#[test]
fn only_what_changed_is_marched() {
    let map = Map::new(120, 120, 0.05).unwrap();
    let wall = Shape::rectangle(Point2::new(4.5, 1.0), 0.1, 1.0, 0.0);
    for method in METHODS {
        let field = new(&map, &[0], method);
        let same = field.clone().after(&map, &Watch::none()).unwrap();
        assert!(same.marched == 0 && same.field == field);
        let walled = map.with(std::slice::from_ref(&wall)).unwrap();
        let again = field.after(&walled, &Watch::none()).unwrap();
        assert_same(&again.field, &new(&walled, &[0], method));
        assert!(again.marched < 120 * 120 / 3, "{method:?} {}", again.marched);
        let back = again.field.after(&map, &Watch::none()).unwrap();
        assert_same(&back.field, &new(&map, &[0], method));
    }
}

#[test]
fn a_window_of_a_field_is_the_field() {
    for seed in 0..40 {
        let mut random = Random(seed);
        let mut map = random_map(31, 43, 0.25, seed);
        if seed % 2 == 0 {
            map = slower(map, &mut random);
        }
        let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
        let goal = free[random.below(free.len())];
        let window = Window::around(&map, random.below(map.cells().len()), random.below(12));
        for method in METHODS {
            let field = new(&map, &[goal], method);
            let found = field.clone().within(&map, &window, &Watch::none()).unwrap();
            assert_same(&found, &field);
        }
    }
}

/// With a new obstacle in the window: the equation holds inside, and the values outside are unchanged.
#[test]
fn a_window_sees_a_new_obstacle() {
    let map = Map::new(60, 60, 0.05).unwrap();
    let chair = Shape::rectangle(Point2::new(1.5, 1.5), 0.5, 0.1, 0.4);
    let walled = map.with(&[chair]).unwrap();
    let window = Window { columns: 20..40, rows: 20..40 };
    for method in METHODS {
        let field = new(&map, &[5 * 60 + 30], method);
        let found = field.clone().within(&walled, &window, &Watch::none()).unwrap();
        for cell in 0..3600 {
            let (time, before) = (found.times()[cell], field.times()[cell]);
            if !window.holds(&map, cell) {
                assert_eq!(time, before);
            } else if !walled.is_free(cell) {
                assert_eq!(time, f64::INFINITY);
            } else {
                // The value of each cell follows from its two nearest neighbours by (4-15) or (4-17).
                let near = |across: bool| {
                    let own = walled
                        .beside(cell)
                        .filter(|other| walled.is_free(*other) && (cell.abs_diff(*other) > 1) == across);
                    own.map(|other| found.times()[other]).fold(f64::INFINITY, f64::min)
                };
                let (low, high) = (near(false).min(near(true)), near(false).max(near(true)));
                let expected = if method == Method::M3r || high - low >= 0.05 {
                    low + 0.05
                } else {
                    0.5 * (low + high + (2.0f64 * 0.05 * 0.05 - (high - low).powi(2)).sqrt())
                };
                assert!((time - expected).abs() < 1e-12, "{cell} {time} {expected}");
                assert!(time >= before - 1e-12);
            }
        }
        assert!(found != field);
    }
}

#[test]
fn what_cannot_be_marched_again_is_refused() {
    let map = Map::from_text("...\n...\n", 1.0).unwrap();
    let field = new(&map, &[0], Method::FastMarching(1));
    let bad = |result: groebot_humanoid::Result<()>, words: &str| {
        let error = result.unwrap_err();
        assert!(error.kind() == ErrorKind::BadValue && error.message().contains(words), "{error}");
    };
    let watch = Watch::none();
    let other = Map::from_text("..\n..\n..\n", 1.0).unwrap();
    bad(field.clone().after(&other, &watch).map(drop), "both must be equal");
    let without = Map::from_text("...\n#..\n", 1.0).unwrap();
    bad(field.clone().after(&without, &watch).map(drop), "occupied");
    for window in [Window { columns: 0..4, rows: 0..1 }, Window { columns: 1..1, rows: 0..1 }] {
        bad(field.clone().within(&map, &window, &watch).map(drop), "not empty within 0..3 and 0..2");
    }
    let second = new(&map, &[0], Method::FastMarching(2));
    bad(second.clone().within(&map, &Window::of(&map), &watch).map(drop), "first order");
    let walled = Map::from_text(".#.\n...\n", 1.0).unwrap();
    let again = second.after(&walled, &watch).unwrap();
    assert_eq!((again.field, again.marched), (new(&walled, &[0], Method::FastMarching(2)), 5));
    // The whole map is a valid window.
    assert_same(&field.clone().within(&map, &Window::of(&map), &watch).unwrap(), &field);
}
