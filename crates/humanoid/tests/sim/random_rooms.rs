//! Rooms from seeds. In each, the robot does its task with all checks. Otherwise an independent search over positions and headings of its footprint proves that
//! no path exists.

use std::collections::{BinaryHeap, HashSet};
use std::f64::consts::TAU;

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Footprint, Side};
use groebot_humanoid::nav::{Map, Piece, Room, Shape};
use groebot_humanoid::sim::{Checks, perform};
use groebot_humanoid::task::{Floor, Pilot};
use groebot_robot::model::Meshes;
use groebot_robot::robots;
use nalgebra::{Point2, Vector2};

use super::{APART, goal, run_in};

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    /// A random number in \[low, high).
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A room of 5 to 8 m by 4 to 6 m with four to eleven boxes, discs and polygons.
fn room(random: &mut Random) -> Room {
    let size = [random.between(5.0, 8.0), random.between(4.0, 6.0)].map(|side| (20.0 * side).round() / 20.0);
    let piece = |count: usize, random: &mut Random| {
        let [a, b] = [random.between(0.3, 1.8), random.between(0.3, 1.2)];
        let outline = match random.between(0.0, 4.0) as usize {
            0 => Shape::Circle { centre: Point2::origin(), radius: 0.5 * b },
            1 => {
                let corners = [(0.0, 0.0), (a, 0.0), (a, 0.25), (0.25, 0.25), (0.25, b), (0.0, b)];
                Shape::Polygon(corners.map(|(x, y)| Point2::new(x, y)).to_vec())
            }
            _ => Shape::rectangle(Point2::origin(), a, b, 0.0),
        };
        let place = Point2::new(random.between(0.3, size[0] - 0.3), random.between(0.3, size[1] - 0.3));
        Piece {
            name: format!("piece {count}"),
            outline,
            place,
            yaw: random.between(0.0, TAU),
            height: random.between(0.3, 1.5),
        }
    };
    let count = random.between(4.0, 12.0) as usize;
    let pieces = (0..count).map(|count| piece(count, random)).collect();
    Room { pieces, ..Room::from_toml(&format!("size = [{:?}, {:?}]\nwall = 0.1\n", size[0], size[1])).unwrap() }
}

/// A place at which the robot has room at every heading.
fn place(random: &mut Random, room: &Room, free: &Map) -> Option<Point2<f64>> {
    let at = |random: &mut Random| Point2::new(random.between(0.0, room.size[0]), random.between(0.0, room.size[1]));
    (0..200).map(|_| at(random)).find(|at| free.cell_at(at).is_ok_and(|cell| free.is_free(cell)))
}

/// Number of headings in the search.
const HEADINGS: usize = 16;

/// Whether a path exists for the footprint: body, and soles side by side. It is an A* search over the middles of cells and headings, with moves to the eight
/// neighbouring cells and turns to the next heading.
fn has_path(pilot: &Pilot, floor: &Floor, from: &Footprint, to: &Point2<f64>) -> bool {
    let map = floor.map();
    let [start, goal] = [from.point(), *to].map(|at| map.cell_at(&at).unwrap());
    let columns = map.columns();
    let heading = |yaw: f64| (yaw / TAU * HEADINGS as f64).round().rem_euclid(HEADINGS as f64) as usize;
    let has_room = |cell: usize, heading: usize| {
        let at = map.centre(cell);
        let yaw = TAU * heading as f64 / HEADINGS as f64;
        let middle = Footprint { x: at.x, y: at.y, yaw };
        let feet = middle.feet(pilot.half_width());
        let sole = |side: Side| pilot.walker().biped.sole_at(side, &feet[side as usize]);
        floor.beside_body(&pilot.outline_at(&middle)).is_none()
            && [Side::Left, Side::Right].iter().all(|side| floor.under_sole(&sole(*side)).is_none())
    };
    let rest = |cell: usize| ((map.centre(cell) - map.centre(goal)).norm() * 1e6) as u64;
    let mut open = BinaryHeap::from([(std::cmp::Reverse(rest(start)), 0u64, start, heading(from.yaw))]);
    let mut seen = HashSet::new();
    while let Some((_, cost, cell, turned)) = open.pop() {
        if cell == goal {
            return true;
        }
        if !seen.insert((cell, turned)) || !has_room(cell, turned) {
            continue;
        }
        let (row, column) = (cell / columns, cell % columns);
        let mut go = |cell: usize, turned: usize, length: f64| {
            if cell < map.cells().len() && !seen.contains(&(cell, turned)) {
                let cost = cost + (length * map.resolution() * 1e6) as u64;
                open.push((std::cmp::Reverse(cost + rest(cell)), cost, cell, turned));
            }
        };
        go(cell, (turned + 1) % HEADINGS, 0.5);
        go(cell, (turned + HEADINGS - 1) % HEADINGS, 0.5);
        for offset in [(0, 1), (1, 0), (1, 1), (1, -1), (0, -1), (-1, 0), (-1, -1), (-1, 1)] {
            let at = Vector2::new(column as i64 + offset.1, row as i64 + offset.0);
            if at.x >= 0 && at.y >= 0 && at.x < columns as i64 && at.y < map.rows() as i64 {
                go(
                    at.y as usize * columns + at.x as usize,
                    turned,
                    f64::from(offset.0 as i32).hypot(f64::from(offset.1 as i32)),
                );
            }
        }
    }
    false
}

/// The result for a room, as a line of the record. `None` if it has no two places for the robot.
fn outcome(seed: u64) -> Option<(bool, String)> {
    let watch = Watch::none();
    let mut random = Random(seed);
    let room = room(&mut random);
    let (robot, empty) = (robots::robot("rh0").unwrap(), Room { pieces: Vec::new(), ..room.clone() });
    let middle = Footprint { x: empty.size[0] / 2.0, y: empty.size[1] / 2.0, yaw: 0.0 };
    let pilot = run_in(&empty, "rh0", middle, goal(middle.x, middle.y + 0.1).into()).unwrap().pilot().clone();
    let floor = Floor::new(&room.map().unwrap(), APART).unwrap();
    let wide = floor.of_disc(pilot.radius() + 2.0 * floor.map().half_diagonal()).unwrap();
    let [from, to] = [place(&mut random, &room, &wide)?, place(&mut random, &room, &wide)?];
    let start = Footprint { x: from.x, y: from.y, yaw: random.between(0.0, TAU) };
    let found = run_in(&room, "rh0", start, goal(to.x, to.y).into()).and_then(|run| perform(run, &[], &watch));
    Some(match found {
        Ok(Ok(performed)) => {
            let biped = &pilot.walker().biped;
            let checks = Checks::of(&robot, &Meshes::default(), biped, &performed, &watch).unwrap();
            let near = checks.clearances[0].distance;
            let odd = if checks.hold() {
                String::new()
            } else {
                format!(
                    "{:?}; soles off by {:e} and {:e}",
                    checks.findings.first(),
                    checks.soles_off,
                    checks.soles_under
                )
                .replace(',', ";")
            };
            let (stage, steps) = (&performed.stages[0], performed.walk.schedule.route.steps.len());
            let line = format!(
                "{:.3},{steps},{near:.4},{:.4},{:.2},{odd}",
                stage.course.path.length(),
                checks.margin,
                stage.milliseconds
            );
            (checks.hold(), format!("solved,{line}"))
        }
        Ok(Err(_)) => (!has_path(&pilot, &floor, &start, &to), "enclosed,,,,,".to_owned()),
        Err(error) => {
            (!has_path(&pilot, &floor, &start, &to), format!("no steps,,,,,{}", error.message().replace(',', ";")))
        }
    })
}

/// Number of solved rooms for a range of seeds; each result is printed when it is known.
fn tried(seeds: std::ops::Range<u64>) -> usize {
    let (mut solved, mut failed) = (0, Vec::new());
    for seed in seeds {
        let Some((is_well, line)) = outcome(seed) else { continue };
        println!("{seed},{is_well},{line}");
        solved += usize::from(line.starts_with("solved"));
        failed.extend((!is_well).then_some(seed));
    }
    assert!(failed.is_empty(), "{failed:?}");
    solved
}

#[test]
fn some_random_rooms_are_crossed() {
    assert!(tried(0..6) >= 3);
}

/// Writes benches/record/DATE-rooms.csv to standard output: `cargo test --release -- --ignored two_hundred_random_rooms --nocapture`.
#[test]
#[ignore = "some minutes"]
fn two_hundred_random_rooms() {
    println!("seed,well,outcome,way [m],steps,nearest [m],margin [m],planned [ms],reason");
    println!("{} solved", tried(0..200));
}
