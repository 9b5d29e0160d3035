//! Shortest paths compared with published lengths, and their times.
//!
//!     cargo run --release > ../record/YYYY-MM-DD-navigation-paths.csv
//!
//! It fails if an octile length differs from Moving AI's, or an exact length from Polyanya's, or if an exact length exceeds the octile one. The published
//! lengths have six digits; Polyanya's are f32. `difference` is the largest difference from them. `bound` is the worst proved bound as a fraction of the
//! length. Times are those of whole calls without a distance field.

mod maps;
mod packages;
mod problems;

use std::time::Instant;

use groebot::Watch;
use groebot::nav::{Distances, Field, Guide, Map, Method, Path};
use nalgebra::Point2;

use maps::Numbers;
use problems::Problem;

/// Number of problems of each generated map.
const COUNT: usize = 40;
/// Maximum number of steps of a bounded proof.
const EFFORT: usize = 8000;

fn main() {
    println!("map,engine,problems,proved,bound,difference,median_ms,slowest_ms");
    let (moving, polyanya) = (packages::folder("movingai"), packages::folder("polyanya"));
    let text = |path: std::path::PathBuf| std::fs::read_to_string(path).expect("a file of the package");
    for name in ["arena", "maze512-32-9"] {
        let map = Map::read(&moving.join(format!("tests/{name}.map")), 1.0).expect("a map");
        octile(name, &map, &problems::scenario(&text(moving.join(format!("tests/{name}.map.scen"))), Some(map.rows())));
    }
    for (name, columns, rows, tests) in
        [("arena", 49, 49, "tests/arena.rs"), ("aurora", 1024, 768, "examples/tests-aurora.rs")]
    {
        let map = problems::mesh(&polyanya.join(format!("meshes/v2/{name}.mesh")), columns, rows);
        octile(name, &map, &problems::scenario(&text(polyanya.join(format!("scenarios/{name}.scen"))), None));
        let mut results = Results::default();
        for problem in problems::tests(&text(polyanya.join(tests))) {
            let length = results.exact(&map, &problem.start, &problem.goal, &Guide::default()).length();
            results.compare(length, problem.length, 1e-3);
        }
        results.print(name, "exact beside polyanya");
    }
    for side in [25, 50, 100] {
        own(&format!("rooms of {side}"), &maps::rooms(side));
    }
    for percent in [10, 20, 30] {
        own(&format!("{percent} % at random"), &maps::random(f64::from(percent) / 100.0));
    }
}

/// Octile paths compared with published ones, and exact paths that must not be longer.
fn octile(name: &str, map: &Map, problems: &[Problem]) {
    let [mut octile, mut exact] = [(); 2].map(|()| Results::default());
    for problem in problems {
        let path = octile.time(|| map.octile_path(&problem.start, &problem.goal, &Watch::none()));
        let length = path.expect("free places").expect("a path").length();
        octile.compare(length, problem.length, 1e-5 * problem.length);
        let shorter = exact.exact(map, &problem.start, &problem.goal, &Guide::default()).length();
        assert!(shorter <= length + 1e-9, "{shorter} {length}");
    }
    octile.print(name, "octile beside Moving AI");
    exact.print(name, "exact");
}

/// A generated map, without and with a distance field.
fn own(name: &str, map: &Map) {
    let free: Vec<usize> = (0..map.cells().len()).filter(|cell| map.is_free(*cell)).collect();
    let mut numbers = Numbers(5);
    let [mut exact, mut guided, mut octile, mut made, mut known] = [(); 5].map(|()| Results::default());
    while exact.times.len() < COUNT {
        let [start, goal] = [(); 2].map(|()| map.centre(free[numbers.below(free.len())]));
        let watch = Watch::none();
        if map.octile_path(&start, &goal, &watch).expect("free places").is_err() {
            continue;
        }
        octile.time(|| map.octile_path(&start, &goal, &watch)).expect("free places").expect("a path");
        let length = exact.exact(map, &start, &goal, &Guide::default()).length();
        let field = Field::new(map, &[goal], Method::FastMarching(2), &watch).expect("a free goal");
        let guide = Guide { field: Some(&field), effort: Some(EFFORT) };
        let near = guided.exact(map, &start, &goal, &guide).length();
        guided.compare(near, length, 0.1 * length);
        let distances = made.time(|| Distances::new(map, &goal, &watch)).expect("a free goal");
        let path = known.time(|| distances.path(map, &start, &watch)).expect("free places").expect("a path");
        known.compare(path.path.length(), length, 1e-9 * length);
    }
    exact.print(name, "exact");
    guided.print(name, &format!("exact by a field and {EFFORT} steps"));
    made.print(name, "distances of all corners");
    known.print(name, "exact by distances");
    octile.print(name, "octile");
}

/// Results of the problems of a map.
#[derive(Default)]
struct Results {
    times: Vec<f64>,
    proved: usize,
    bound: Option<f64>,
    difference: Option<f64>,
}

impl Results {
    fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.times.push(start.elapsed().as_secs_f64() * 1e3);
        result
    }

    fn exact(&mut self, map: &Map, start: &Point2<f64>, goal: &Point2<f64>, guide: &Guide) -> Path {
        let found = self.time(|| map.shortest_path(start, goal, guide, &Watch::none()));
        let found = found.expect("free places").expect("a path");
        self.proved += usize::from(found.is_proved());
        let share = found.bound / found.path.length();
        self.bound = Some(self.bound.unwrap_or(1.0).min(if share.is_nan() { 1.0 } else { share }));
        found.path
    }

    fn compare(&mut self, found: f64, expected: f64, most: f64) {
        assert!((found - expected).abs() <= most, "{found} instead of the published {expected}");
        self.difference = Some(self.difference.unwrap_or(0.0).max((found - expected).abs()));
    }

    fn print(mut self, map: &str, engine: &str) {
        self.times.sort_by(f64::total_cmp);
        let [median, slowest] = [self.times.len() / 2, self.times.len() - 1].map(|place| self.times[place]);
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.4e}"));
        let (proved, bound) = match self.bound {
            Some(bound) => (self.proved.to_string(), format!("{bound:.4}")),
            None => Default::default(),
        };
        let (count, difference) = (self.times.len(), number(self.difference));
        println!("{map},{engine},{count},{proved},{bound},{difference},{median:.3},{slowest:.3}");
    }
}
