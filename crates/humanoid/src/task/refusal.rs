//! Reasons against a step, and collisions of a walk with its floor. Main type: [`Refusal`].

use std::fmt;

use nalgebra::{Point2, Point3};

use super::floor::Floor;
use super::pilot::Pilot;
use crate::Result;
use crate::gait::{Footstep, Polygon, Side, Walk};
use groebot_robot::spatial::Pose;

/// The part that collides with an obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The sole of that side.
    Sole(Side),
    /// The body.
    Body,
}

/// The reason why a step is not taken.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// It is infeasible: a joint's limit or rate, a sole out of reach, the balance.
    Gait(String),
    /// It would collide with an obstacle, at a point of the floor \[m\].
    Obstacle(Obstacle, Point2<f64>),
}

/// A step that was planned and is not taken.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Refusal {
    /// The number of the planned step, from 1.
    pub step: usize,
    /// The foot and its planned landing pose.
    pub footstep: Footstep,
    /// The reason.
    pub reason: Reason,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Footstep { side, print } = &self.footstep;
        write!(f, "step {}, {} foot to ({:.3}, {:.3}): {}", self.step, side.name(), print.x, print.y, self.reason)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Gait(text) => write!(f, "{text}"),
            Reason::Obstacle(Obstacle::Body, at) => {
                write!(f, "the body collides with an obstacle at ({:.3}, {:.3})", at.x, at.y)
            }
            Reason::Obstacle(Obstacle::Sole(side), at) => {
                write!(f, "the {} sole collides with an obstacle at ({:.3}, {:.3})", side.name(), at.x, at.y)
            }
        }
    }
}

/// The first collision of a walk with an obstacle: soles and body are swept from sample to sample.
///
/// # Errors
/// As [`groebot_robot::dynamics::Model::place`].
pub(super) fn met(pilot: &Pilot, floor: &Floor, walk: &Walk) -> Result<Option<(Obstacle, Point2<f64>)>> {
    let biped = &pilot.walker().biped;
    for (sample, (reference, posture)) in walk.references.iter().zip(&walk.motion.postures).enumerate() {
        let before = sample.saturating_sub(1);
        for side in [Side::Left, Side::Right] {
            let poses = [before, sample].map(|sample| walk.references[sample].world_from_soles[side as usize]);
            let stood = sample > 0 && reference.stands[side as usize];
            let middle: Point2<f64> = poses[1].translation.vector.xy().into();
            if stood || floor.is_far(&middle, pilot.sole_reach(side)) {
                continue;
            }
            if let Some(at) = floor.under_sole(&both(poses.map(|pose| sole(pilot, side, &pose)))) {
                return Ok(Some((Obstacle::Sole(side), at)));
            }
        }
        let placed = biped.model.place(&posture.world_from_torso, &posture.q)?;
        let middle: Point2<f64> = posture.world_from_torso.translation.vector.xy().into();
        if floor.is_far(&middle, pilot.body().reach(&placed, &middle)) {
            continue;
        }
        let outline = |sample: usize| pilot.body().outline(biped, &walk.motion.postures[sample]);
        if let Some(at) = floor.beside_body(&both([outline(before)?, outline(sample)?])) {
            return Ok(Some((Obstacle::Body, at)));
        }
    }
    Ok(None)
}

/// The convex hull of two outlines.
fn both(outlines: [Polygon; 2]) -> Polygon {
    Polygon::hull(&outlines.iter().flat_map(|outline| outline.corners()).copied().collect::<Vec<_>>())
}

/// The outline of a sole, seen from above.
fn sole(pilot: &Pilot, side: Side, world_from_sole: &Pose) -> Polygon {
    let corners = &pilot.walker().biped.feet[side as usize].corners;
    let at = |corner: &Point2<f64>| (world_from_sole * Point3::new(corner.x, corner.y, 0.0)).xy();
    Polygon::hull(&corners.iter().map(at).collect::<Vec<_>>())
}
