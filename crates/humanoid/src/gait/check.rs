//! Faults that make a motion infeasible: margins, joint limits, joint rates, feet that collide. Main type: [`Fault`].

use nalgebra::Vector3;

use super::balance::Balance;
use super::biped::{Biped, Foot};
use super::footprint::{Footprint, Side};
use super::legs::Posture;
use super::motion::{Motion, Samples};
use super::polygon::Polygon;
use super::reference::Reference;
use super::schedule::{Action, Schedule};
use groebot_robot::motion::{beyond_limit, too_fast};

/// The least distance between the two feet, seen from above \[m\].
pub(crate) const FEET_APART: f64 = 0.004;

/// The greatest angle between a supporting sole and the floor \[rad\]: the margins are those of level soles.
pub(super) const MOST_TILT: f64 = 0.04;

/// A fault at a sample.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// The projection of the centre of mass is too near to the border of the support polygon. No slower walk removes
    /// this fault.
    Static {
        /// Its signed distance from the border \[m\], negative outside.
        margin: f64,
    },
    /// The zero moment point is too near to the border of the support polygon. A slower walk may remove this fault.
    Dynamic {
        /// Its signed distance from the border \[m\], negative outside.
        margin: f64,
    },
    /// A joint exceeds its limits.
    Limit {
        /// The joint.
        joint: usize,
        /// Its value \[rad\].
        value: f64,
    },
    /// A joint exceeds its greatest rate.
    Speed {
        /// The joint.
        joint: usize,
        /// Its rate \[rad/s\].
        rate: f64,
    },
    /// The feet collide, seen from above.
    Feet {
        /// The distance between them \[m\].
        apart: f64,
    },
    /// A supporting sole would touch the floor with an edge only: its leg of five joints leaves a rotation free.
    Tilt {
        /// The angle between the sole and the floor \[rad\].
        angle: f64,
    },
}

/// A fault with its sample and phase.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Found {
    /// The index of the sample.
    pub sample: usize,
    /// The index of the phase.
    pub phase: usize,
    /// The fault.
    pub fault: Fault,
}

/// Requirements on a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Demand {
    /// The least margin of the zero moment point \[m\].
    pub margin: f64,
    /// Whether the centre of mass must keep that margin too, as in a walk that can stop at any time.
    pub statically: bool,
    /// Whether the path of the centre of mass does not depend on the speed of the walk. If it is too near to the
    /// border, no slower walk helps.
    pub keeps_path: bool,
    /// The greatest permitted joint rate, as a fraction of the joint's own limit.
    pub speed_share: f64,
}

/// All faults of a motion in the order of time, at most one of each kind for a sample.
pub(crate) fn faults(
    biped: &Biped,
    samples: &Samples<'_>,
    motion: &Motion,
    balances: &[Balance],
    demand: &Demand,
) -> Vec<Found> {
    let (references, tick) = (samples.references, samples.tick);
    let mut found = Vec::new();
    let may_tilt = biped.feet.iter().any(|foot| foot.joints.len() < 6);
    for (sample, (reference, balance)) in references.iter().zip(balances).enumerate() {
        let mut add = |fault: Fault| found.push(Found { sample, phase: reference.phase, fault });
        let limits = biped.joints.iter().map(|range| Some(range.limits));
        if let Some((joint, value)) = beyond_limit(limits, &motion.postures[sample].q) {
            add(Fault::Limit { joint, value });
        }
        if may_tilt {
            let angle = tilt(biped, &motion.postures[sample], &reference.stands);
            if angle > MOST_TILT {
                add(Fault::Tilt { angle });
            }
        }
        let (falls, leans) = (balance.margin < demand.margin, balance.static_margin < demand.margin);
        if leans && (demand.statically || demand.keeps_path && falls) {
            add(Fault::Static { margin: balance.static_margin });
        } else if falls {
            add(Fault::Dynamic { margin: balance.margin });
        }
        if sample > 0 {
            let [before, now] = [sample - 1, sample].map(|sample| &motion.postures[sample].q);
            let speeds = biped.joints.iter().map(|range| Some(range.speed * demand.speed_share));
            if let Some((joint, rate)) = too_fast(speeds, before, now, tick) {
                add(Fault::Speed { joint, rate });
            }
        }
    }
    found
}

/// The greatest angle between a supporting sole and the floor \[rad\].
pub(super) fn tilt(biped: &Biped, posture: &Posture, stands: &[bool; 2]) -> f64 {
    let Ok(placed) = biped.model.place(&posture.world_from_torso, &posture.q) else { return 0.0 };
    let tilted = |(foot, stands): (&Foot, &bool)| {
        let up = placed.motion(foot.body).rotation * foot.torso_from_sole.rotation * Vector3::z();
        if *stands { up.xy().norm().atan2(up.z) } else { 0.0 }
    };
    biped.feet.iter().zip(stands).map(tilted).fold(0.0, f64::max)
}

/// Finds the first step of a schedule at which the feet come too near to each other, seen from above. The time is in
/// samples.
pub(crate) fn feet_meet(biped: &Biped, schedule: &Schedule, references: &[Reference]) -> Option<Found> {
    references.iter().enumerate().find_map(|(sample, reference)| {
        let swings = matches!(schedule.phases[reference.phase].action, Action::Swing(_));
        if sample > 0 && !swings {
            return None;
        }
        let [left, right] = [Side::Left, Side::Right].map(|side| outline(biped, side, reference));
        let apart = left.distance_to(&right);
        (apart < FEET_APART).then_some(Found { sample, phase: reference.phase, fault: Fault::Feet { apart } })
    })
}

fn outline(biped: &Biped, side: Side, reference: &Reference) -> Polygon {
    let pose = reference.world_from_soles[side as usize];
    let (at, turn) = (pose.translation.vector, pose.rotation.euler_angles().2);
    biped.sole_at(side, &Footprint { x: at.x, y: at.y, yaw: turn })
}
