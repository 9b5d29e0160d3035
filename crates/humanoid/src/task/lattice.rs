//! The number of steps from a stance to a goal, over cells and headings. Main type: [`Lattice`].

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::floor::Floor;
use super::reach::Reach;
use super::stance::{HEADINGS, Stances, yaw};
use crate::gait::Footprint;
use crate::{Result, Watch};

/// Offsets to the neighbouring cells, by columns and rows.
const AROUND: [[i64; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
/// The search ends at states that are farther from the goal than the walker by this factor, and by this number of
/// steps.
const BEYOND: (f32, f32) = (1.2, 6.0);

/// Approximate least numbers of steps to a goal, by cell and heading. They are from Dijkstra's algorithm (1959) over
/// stances with the feet side by side. A move goes to a neighbouring cell or turns.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    steps: Vec<f32>,
}

impl Lattice {
    /// Computes the states from half a step around `goal` to those not much farther away than a walker at `from`.
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
        let mut stands = RoomCache { stances, known: vec![None; count] };
        let mut waiting = BinaryHeap::new();
        let near = |cell: &usize| (map.centre(*cell) - goal).norm() < pilot.reach().ahead / 2.0;
        for state in (0..map.cells().len()).filter(near).flat_map(|cell| states(cell, 0..HEADINGS)) {
            if stands.at(state) {
                lattice.steps[state] = 0.0;
                waiting.push(Reverse((0, state)));
            }
        }
        let (own, mut farthest, mut looked) = (lattice.around(floor, from), f32::INFINITY, 0u32);
        // The bits of numbers that are not negative sort correctly.
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
            for (neighbour, cost) in AROUND.iter().zip(&costs.moves[heading]) {
                // The predecessor of the state.
                let [column, row] = [column - neighbour[0], row - neighbour[1]];
                if (0..columns).contains(&column) && (0..rows).contains(&row) {
                    reach((row * columns + column) as usize * HEADINGS + heading, *cost);
                }
            }
        }
        Ok(lattice)
    }

    /// The number of remaining steps with the middle of the feet at a place; `None` where the goal cannot be reached
    /// from there.
    pub(super) fn left(&self, floor: &Floor, middle: &Footprint) -> Option<f64> {
        let steps = self.around(floor, middle).into_iter().map(|state| self.steps[state]);
        Some(f64::from(steps.fold(f32::INFINITY, f32::min))).filter(|steps| steps.is_finite())
    }

    /// The states next to a place: of its cell and its neighbours, at the two nearest headings.
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
            .map(|neighbour| [column + neighbour[0], row + neighbour[1]])
            .filter(|[column, row]| (0..map.columns() as i64).contains(column) && (0..map.rows() as i64).contains(row));
        let cells = beside.map(|[column, row]| row as usize * map.columns() + column as usize);
        own.clone().chain(cells.flat_map(|cell| states(cell, headings))).collect()
    }
}

/// The costs of moves in steps.
struct Costs {
    /// To the next heading.
    turn: f32,
    /// To each of the neighbouring cells, by heading.
    moves: Vec<[f32; 8]>,
}

impl Costs {
    /// Computes the costs for cells of a side \[m\] whose rows are rotated \[rad\]; sideways each foot steps once.
    fn new(reach: &Reach, side: f64, turned: f64) -> Self {
        let cost = |heading: usize, neighbour: &[i64; 2]| {
            let own = nalgebra::Rotation2::new(turned - yaw(heading))
                * Vector2::new(neighbour[0] as f64, neighbour[1] as f64)
                * side;
            let along = if own.x < 0.0 { -own.x / reach.back } else { own.x / reach.ahead };
            along.hypot(2.0 * own.y / reach.aside) as f32
        };
        let moves = (0..HEADINGS).map(|heading| AROUND.each_ref().map(|neighbour| cost(heading, neighbour))).collect();
        Costs { turn: (TAU / HEADINGS as f64 / reach.turn) as f32, moves }
    }
}

/// Cache of the states at which there is room.
struct RoomCache<'a> {
    stances: &'a Stances<'a>,
    known: Vec<Option<bool>>,
}

impl RoomCache<'_> {
    fn at(&mut self, state: usize) -> bool {
        *self.known[state].get_or_insert_with(|| self.stances.stands(state / HEADINGS, state % HEADINGS))
    }
}

fn states(cell: usize, headings: impl IntoIterator<Item = usize> + Clone) -> impl Iterator<Item = usize> + Clone {
    headings.into_iter().map(move |heading| cell * HEADINGS + heading).collect::<Vec<_>>().into_iter()
}
