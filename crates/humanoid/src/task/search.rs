//! Footstep search, for places where following a path fails.
//!
//! A* over the steps of a walker. The heuristic is a field's arrival time, or the number of steps of a [`Lattice`] (A.
//! Hornung, A. Dornbush, M. Likhachev and M. Bennewitz, Anytime search-based footstep planning with suboptimality
//! bounds, Humanoids 2012).

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

use nalgebra::Point2;

use super::lattice::Lattice;
use super::pilot::Pilot;
use super::reach::Reach;
use super::stance::Stances;
use crate::gait::{Footprint, Footstep, Side};
use crate::nav::{Field, Map};
use crate::{Result, Watch};
use groebot_robot::spatial::angle::difference;

/// The greatest number of footprints that are expanded, with a field and with a lattice.
const MOST: [usize; 2] = [10_000, 60_000];
/// The weight of a lattice's heuristic relative to the steps taken: it includes narrow passages.
const LATTICE_WEIGHT: f64 = 1.5;
/// The number of parts of a step and of a turn that distinguish two footprints.
const PARTS: f64 = 6.0;
/// Steps and turns above this fraction of the greatest ones are strides.
const STRIDE: f64 = 0.5;
/// The cost of the greatest turn, added to that of a step forward.
const TURN_COST: f64 = 0.2;

/// The key of a footprint: the foot, and its place and heading in parts of a step.
pub(super) type Key = (usize, i64, i64, i64);

/// Steps that are excluded from the search.
#[derive(Clone, Debug, Default)]
pub(super) struct Refused {
    /// Pairs of footprints between which there is an obstacle.
    pub(super) pairs: HashSet<(Key, Key)>,
    /// Steps that are infeasible anywhere: start and landing in the frame of the supporting foot.
    pub(super) steps: HashSet<(Key, Key)>,
}

/// A search for steps to a place near a goal.
pub(super) struct Search<'a> {
    stances: &'a Stances<'a>,
    pilot: &'a Pilot,
    goal: Point2<f64>,
    guide: Guide<'a>,
    refused: &'a Refused,
}

/// The heuristic of the search.
#[derive(Clone, Copy)]
pub(super) enum Guide<'a> {
    /// The arrival times on a map of positions for the body's middle.
    Field(&'a Map, &'a Field),
    /// The number of steps of stances.
    Lattice(&'a Lattice),
}

/// A landed foot: both footprints, the predecessor, and the numbers of steps taken and remaining.
struct Node {
    feet: [Footprint; 2],
    landed: Side,
    from: Option<usize>,
    steps: f64,
}

impl<'a> Search<'a> {
    /// A search with a heuristic to the goal.
    pub(super) fn new(stances: &'a Stances<'a>, goal: Point2<f64>, guide: Guide<'a>, refused: &'a Refused) -> Self {
        Search { stances, pilot: stances.pilot, goal, guide, refused }
    }

    /// The steps; `None` where none were found among all reachable footprints, or the first [`MOST`] of them.
    ///
    /// # Errors
    /// [`Watch::check`].
    pub(super) fn steps(&self, feet: [Footprint; 2], first: Side, watch: &Watch) -> Result<Option<Vec<Footstep>>> {
        let most = MOST[usize::from(matches!(self.guide, Guide::Lattice(_)))];
        let mut nodes = vec![Node { feet, landed: first.other(), from: None, steps: 0.0 }];
        let mut best: HashMap<Key, f64> = HashMap::new();
        // The bits of numbers that are not negative sort correctly.
        let mut waiting = BinaryHeap::from([Reverse((0, 0))]);
        while let Some(Reverse((_, node))) = waiting.pop() {
            let own = key(self.pilot, nodes[node].landed, &nodes[node].feet[nodes[node].landed as usize]);
            if node > 0 && best.get(&own).is_some_and(|steps| *steps < nodes[node].steps) {
                continue;
            }
            if (middle(&nodes[node].feet).point() - self.goal).norm() < self.pilot.reach().ahead / 2.0 {
                return Ok(Some(steps_to(&nodes, node)));
            }
            if node.is_multiple_of(64) {
                watch.check()?;
            }
            if nodes.len() > most {
                return Ok(None);
            }
            for (next, cost) in self.beside(&nodes[node], own) {
                let key = key(self.pilot, next.landed, &next.feet[next.landed as usize]);
                let Some(left) = self.left(&next.feet) else { continue };
                let steps = nodes[node].steps + cost;
                if best.get(&key).is_some_and(|known| *known <= steps) {
                    continue;
                }
                best.insert(key, steps);
                waiting.push(Reverse(((steps + left).to_bits(), nodes.len())));
                nodes.push(Node { from: Some(node), steps, ..next });
            }
        }
        Ok(None)
    }

    /// The approximate least number of remaining steps.
    fn left(&self, feet: &[Footprint; 2]) -> Option<f64> {
        match self.guide {
            Guide::Field(map, field) => {
                let cell = map.cell_at(&middle(feet).point()).ok()?;
                Some(field.times()[cell] / self.pilot.reach().ahead).filter(|steps| steps.is_finite())
            }
            Guide::Lattice(lattice) => {
                lattice.left(self.stances.floor, &middle(feet)).map(|steps| LATTICE_WEIGHT * steps)
            }
        }
    }

    /// The steps of the other foot that have room on the floor, with their costs.
    fn beside(&self, node: &Node, own: Key) -> impl Iterator<Item = (Node, f64)> + '_ {
        let (before, side) = (node.feet, node.landed.other());
        let stance = before[node.landed as usize];
        moves(self.pilot).filter_map(move |(step, cost)| {
            let half = self.pilot.half_width();
            let aside = Footprint { y: side.sign() * half, ..Footprint::default() };
            let lead = stance.then(&aside).then(&Footprint { y: step.y * side.sign(), ..step });
            let mut feet = before;
            feet[side as usize] = lead.then(&aside);
            let Reach { ahead, turn, .. } = *self.pilot.reach();
            let strides = step.x.abs() > STRIDE * ahead || step.yaw.abs() > STRIDE * turn;
            let print = feet[side as usize];
            let is_allowed = !self.refused.pairs.contains(&(own, key(self.pilot, side, &print)))
                && !self.refused.steps.contains(&step_key(self.pilot, &before, side, &print));
            let node = Node { feet, landed: side, from: None, steps: 0.0 };
            (is_allowed && self.stances.fits(&feet, side, strides)).then_some((node, cost))
        })
    }
}

/// Steps of the lead in its own frame, with y outwards, and their costs in steps.
fn moves(pilot: &Pilot) -> impl Iterator<Item = (Footprint, f64)> {
    let reach = *pilot.reach();
    let turns = [0.0, 0.5, -0.5, 1.0, -1.0];
    let ahead = [1.0, 0.6, 0.25, 0.0].map(|share| share * reach.ahead);
    let along = ahead.into_iter().chain([-0.25, -0.6].map(|share| share * reach.back));
    let turning = along.flat_map(move |x| turns.map(|turn| (x, 0.0, turn)));
    let sideways = [0.5, 1.0].map(|share| (0.0, share * reach.aside, 0.0));
    turning.chain(sideways).filter_map(move |(x, y, turn)| {
        let share: f64 = if x < 0.0 { x / reach.back } else { x / reach.ahead };
        let is_within = share * share + turn * turn <= 1.0 + 1e-9;
        let step = Footprint { x, y, yaw: turn * reach.turn };
        is_within.then_some((step, 1.0 + TURN_COST * f64::abs(turn)))
    })
}

/// The key of a footprint.
pub(super) fn key(pilot: &Pilot, side: Side, print: &Footprint) -> Key {
    let (part, turn) = (pilot.reach().ahead / PARTS, pilot.reach().turn / PARTS);
    let whole = |value: f64, part: f64| (value / part).round() as i64;
    (side as usize, whole(print.x, part), whole(print.y, part), whole(print.yaw, turn))
}

/// The keys of a step's start and landing, in the frame of the supporting foot.
pub(super) fn step_key(pilot: &Pilot, feet: &[Footprint; 2], side: Side, print: &Footprint) -> (Key, Key) {
    let stance = &feet[side.other() as usize];
    let seen = |print: &Footprint| {
        let at = stance.seen(&print.point());
        key(pilot, side, &Footprint { x: at.x, y: at.y, yaw: difference(print.yaw, stance.yaw) })
    };
    (seen(&feet[side as usize]), seen(print))
}

fn middle(feet: &[Footprint; 2]) -> Footprint {
    feet[0].middle(&feet[1])
}

fn steps_to(nodes: &[Node], last: usize) -> Vec<Footstep> {
    let mut steps = Vec::new();
    let mut at = last;
    while let Some(from) = nodes[at].from {
        let side = nodes[at].landed;
        steps.push(Footstep { side, print: nodes[at].feet[side as usize] });
        at = from;
    }
    steps.reverse();
    steps
}
