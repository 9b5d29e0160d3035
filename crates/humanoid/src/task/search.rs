//! Steps where following a way fails: a search over footprints.
//!
//! A* over the steps of a walker with a field's time of arrival as heuristic, or the steps that a [`Lattice`] has left (A. Hornung, A. Dornbush, M. Likhachev and M. Bennewitz, Anytime search-based footstep planning with suboptimality bounds, Humanoids 2012).

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

/// The most footprints that are looked at, by a field and by a lattice.
const MOST: [usize; 2] = [10_000, 60_000];
/// By so much what a lattice has left counts more than what was stepped: it knows where no walker gets through.
const GREED: f64 = 1.5;
/// Into how many parts a step and a turn are cut to tell two footprints apart.
const PARTS: f64 = 6.0;
/// Steps and turns that are a greater share of the greatest ones are strides.
const STRIDE: f64 = 0.5;
/// What a turn by the whole reach costs beside a step ahead.
const TURNING: f64 = 0.2;

/// A footprint that tells others apart from itself: the foot and its place in parts of a step.
pub(super) type Key = (usize, i64, i64, i64);

/// Steps that are not searched.
#[derive(Clone, Debug, Default)]
pub(super) struct Refused {
    /// Pairs of footprints between which something is in the way.
    pub(super) pairs: HashSet<(Key, Key)>,
    /// Steps that cannot be walked anywhere: from where the foot leaves to where it lands, seen from the one that stands.
    pub(super) steps: HashSet<(Key, Key)>,
}

/// Steps from feet to a place near a goal.
pub(super) struct Search<'a> {
    stances: &'a Stances<'a>,
    pilot: &'a Pilot,
    goal: Point2<f64>,
    guide: Guide<'a>,
    refused: &'a Refused,
}

/// What tells how far it is to the goal.
#[derive(Clone, Copy)]
pub(super) enum Guide<'a> {
    /// The times of arrival on a map that holds the places of the body's middle.
    Field(&'a Map, &'a Field),
    /// The steps of stances.
    Lattice(&'a Lattice),
}

/// A foot that has landed: where it and the other one stand, how it got there, and how many steps it took and will take.
struct Node {
    feet: [Footprint; 2],
    landed: Side,
    from: Option<usize>,
    steps: f64,
}

impl<'a> Search<'a> {
    /// A search by a guide to the goal.
    pub(super) fn new(stances: &'a Stances<'a>, goal: Point2<f64>, guide: Guide<'a>, refused: &'a Refused) -> Self {
        Search { stances, pilot: stances.pilot, goal, guide, refused }
    }

    /// The steps; `None` where none were found among all that can be stepped to, or the first [`MOST`] of them.
    ///
    /// # Errors
    /// [`Watch::check`].
    pub(super) fn steps(&self, feet: [Footprint; 2], first: Side, watch: &Watch) -> Result<Option<Vec<Footstep>>> {
        let most = MOST[usize::from(matches!(self.guide, Guide::Lattice(_)))];
        let mut nodes = vec![Node { feet, landed: first.other(), from: None, steps: 0.0 }];
        let mut best: HashMap<Key, f64> = HashMap::new();
        // Bits of numbers that are not below nought have their order.
        let mut waiting = BinaryHeap::from([Reverse((0, 0))]);
        while let Some(Reverse((_, node))) = waiting.pop() {
            let own = key(self.pilot, nodes[node].landed, &nodes[node].feet[nodes[node].landed as usize]);
            if node > 0 && best.get(&own).is_some_and(|steps| *steps < nodes[node].steps) {
                continue;
            }
            if (middle(&nodes[node].feet).point() - self.goal).norm() < self.pilot.reach().ahead / 2.0 {
                return Ok(Some(way_to(&nodes, node)));
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

    /// How many steps are left at least, nearly.
    fn left(&self, feet: &[Footprint; 2]) -> Option<f64> {
        match self.guide {
            Guide::Field(map, field) => {
                let cell = map.cell_at(&middle(feet).point()).ok()?;
                Some(field.times()[cell] / self.pilot.reach().ahead).filter(|steps| steps.is_finite())
            }
            Guide::Lattice(lattice) => lattice.left(self.stances.floor, &middle(feet)).map(|steps| GREED * steps),
        }
    }

    /// The steps of the other foot that the floor has room for, with their costs.
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

/// Steps of the lead seen from where it is, outwards for y, with their costs in steps.
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
        is_within.then_some((step, 1.0 + TURNING * f64::abs(turn)))
    })
}

/// The parts of a step that a footprint is in.
pub(super) fn key(pilot: &Pilot, side: Side, print: &Footprint) -> Key {
    let (part, turn) = (pilot.reach().ahead / PARTS, pilot.reach().turn / PARTS);
    let whole = |value: f64, part: f64| (value / part).round() as i64;
    (side as usize, whole(print.x, part), whole(print.y, part), whole(print.yaw, turn))
}

/// The parts that the foot of `side` steps from and to, seen from the one that stands.
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

fn way_to(nodes: &[Node], last: usize) -> Vec<Footstep> {
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
