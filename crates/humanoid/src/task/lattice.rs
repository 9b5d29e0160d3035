//! How many steps a walker is away from a goal, over places and headings of its stance. Main type: [`Lattice`].

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::floor::Floor;
use super::reach::Reach;
use super::stance::{HEADINGS, Stances, yaw};
use crate::gait::Footprint;
use crate::{Result, Watch};

/// The cells around one, by columns and rows.
const AROUND: [[i64; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
/// States are looked at until they are so many times, and so many steps, farther from the goal than the walker is.
const BEYOND: (f32, f32) = (1.2, 6.0);

/// The least counts of steps to a goal, nearly, by cell and heading: an own Dijkstra search (1959) over stances with the feet side by side, which go to the cells around them or turn.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    steps: Vec<f32>,
}

impl Lattice {
    /// Those within half a step of `goal`, and all that lead there and are not much farther away than where a walker stands.
    ///
    /// # Errors
    /// [`Watch::check`].
    pub(super) fn new(stances: &Stances<'_>, goal: &Point2<f64>, from: &Footprint, watch: &Watch) -> Result<Self> {
        let (pilot, floor) = (stances.pilot, stances.floor);
        let map = floor.map();
        let (columns, rows) = (map.columns() as i64, map.rows() as i64);
        let costs = Costs::new(pilot.reach(), map.resolution(), map.yaw());
        let count = map.cells().len() * HEADINGS;
        watch.check_memory(count * (size_of::<f32>() + size_of::<Option<bool>>()))?;
        let mut lattice = Lattice { steps: vec![f32::INFINITY; count] };
        let mut stands = Stands { stances, known: vec![None; count] };
        let mut waiting = BinaryHeap::new();
        let near = |cell: &usize| (map.centre(*cell) - goal).norm() < pilot.reach().ahead / 2.0;
        for state in (0..map.cells().len()).filter(near).flat_map(|cell| states(cell, 0..HEADINGS)) {
            if stands.at(state) {
                lattice.steps[state] = 0.0;
                waiting.push(Reverse((0, state)));
            }
        }
        let (own, mut farthest, mut looked) = (lattice.around(floor, from), f32::INFINITY, 0u32);
        // Bits of numbers that are not below nought have their order.
        while let Some(Reverse((bits, state))) = waiting.pop() {
            let steps = f32::from_bits(bits);
            if steps > lattice.steps[state] {
                continue;
            }
            if steps > farthest {
                break;
            }
            if farthest.is_infinite() && own.contains(&state) {
                farthest = BEYOND.0 * steps + BEYOND.1;
            }
            looked += 1;
            if looked.is_multiple_of(4096) {
                watch.check()?;
            }
            let (cell, heading) = (state / HEADINGS, state % HEADINGS);
            let (column, row) = (cell as i64 % columns, cell as i64 / columns);
            let mut reach = |from: usize, cost: f32| {
                let all = steps + cost;
                if all < lattice.steps[from] && stands.at(from) {
                    lattice.steps[from] = all;
                    waiting.push(Reverse((all.to_bits(), from)));
                }
            };
            for turn in [1, HEADINGS - 1] {
                reach(cell * HEADINGS + (heading + turn) % HEADINGS, costs.turn);
            }
            for (way, cost) in AROUND.iter().zip(&costs.ways[heading]) {
                // It comes from there.
                let [column, row] = [column - way[0], row - way[1]];
                if (0..columns).contains(&column) && (0..rows).contains(&row) {
                    reach((row * columns + column) as usize * HEADINGS + heading, *cost);
                }
            }
        }
        Ok(lattice)
    }

    /// How many steps are left where the middle of the feet is there; `None` where it gets not to the goal.
    pub(super) fn left(&self, floor: &Floor, middle: &Footprint) -> Option<f64> {
        let steps = self.around(floor, middle).into_iter().map(|state| self.steps[state]);
        Some(f64::from(steps.fold(f32::INFINITY, f32::min))).filter(|steps| steps.is_finite())
    }

    /// The states beside a place: of its cell and those around it, at the headings beside its own.
    fn around(&self, floor: &Floor, middle: &Footprint) -> Vec<usize> {
        let map = floor.map();
        let Ok(cell) = map.cell_at(&middle.point()) else { return Vec::new() };
        let turned = (middle.yaw / TAU * HEADINGS as f64).floor().rem_euclid(HEADINGS as f64) as usize;
        let headings = [turned % HEADINGS, (turned + 1) % HEADINGS];
        let own = states(cell, headings);
        if own.clone().any(|state| self.steps[state].is_finite()) {
            return own.collect();
        }
        let (column, row) = ((cell % map.columns()) as i64, (cell / map.columns()) as i64);
        let beside = AROUND
            .iter()
            .map(|way| [column + way[0], row + way[1]])
            .filter(|[column, row]| (0..map.columns() as i64).contains(column) && (0..map.rows() as i64).contains(row));
        let cells = beside.map(|[column, row]| row as usize * map.columns() + column as usize);
        own.clone().chain(cells.flat_map(|cell| states(cell, headings))).collect()
    }
}

/// What a move costs in steps.
struct Costs {
    /// To the next heading.
    turn: f32,
    /// To each of the cells around, by heading.
    ways: Vec<[f32; 8]>,
}

impl Costs {
    /// On cells of a side \[m\], whose rows are turned \[rad\]; sideways each foot steps once.
    fn new(reach: &Reach, side: f64, turned: f64) -> Self {
        let cost = |heading: usize, way: &[i64; 2]| {
            let own =
                nalgebra::Rotation2::new(turned - yaw(heading)) * Vector2::new(way[0] as f64, way[1] as f64) * side;
            let along = if own.x < 0.0 { -own.x / reach.back } else { own.x / reach.ahead };
            along.hypot(2.0 * own.y / reach.aside) as f32
        };
        let ways = (0..HEADINGS).map(|heading| AROUND.each_ref().map(|way| cost(heading, way))).collect();
        Costs { turn: (TAU / HEADINGS as f64 / reach.turn) as f32, ways }
    }
}

/// At which states there is room, looked at once.
struct Stands<'a> {
    stances: &'a Stances<'a>,
    known: Vec<Option<bool>>,
}

impl Stands<'_> {
    fn at(&mut self, state: usize) -> bool {
        *self.known[state].get_or_insert_with(|| self.stances.stands(state / HEADINGS, state % HEADINGS))
    }
}

fn states(cell: usize, headings: impl IntoIterator<Item = usize> + Clone) -> impl Iterator<Item = usize> + Clone {
    headings.into_iter().map(move |heading| cell * HEADINGS + heading).collect::<Vec<_>>().into_iter()
}
