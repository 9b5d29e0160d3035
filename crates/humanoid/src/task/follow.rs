//! Steps along a way: ahead as far as the legs reach, on the spot where the way bends by more than they turn.

use super::course::Course;
use super::pilot::Pilot;
use super::reach::bearing;
use crate::gait::Footprint;
use groebot_robot::spatial::angle;

/// How near to a corner of a way its next piece begins \[m\].
const REACHED: f64 = 1e-3;
/// How near to a heading counts as there \[rad\].
const TURNED: f64 = 1e-6;
/// How far steps are shortened in turn where they cannot be walked as they are wanted.
const EASED: [f64; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];

/// What a walker does next to follow a way.
pub(super) enum Next {
    /// One of these steps, the best first: where the middle of the feet would be if both stood side by side.
    Lead(Vec<Footprint>),
    /// It has only to bring its feet side by side.
    Close,
}

/// The next steps from a place on a way; `corner` is the corner that it goes to.
pub(super) fn next(pilot: &Pilot, lead: &Footprint, course: &Course, corner: &mut usize) -> Next {
    let points = &course.way.points;
    while points.get(*corner).is_some_and(|point| (point - lead.point()).norm() < REACHED) {
        *corner += 1;
    }
    let (turn, advance) = match points.get(*corner) {
        Some(point) => towards(pilot, bearing(lead, point), (point - lead.point()).norm()),
        None => {
            let left = course.goal.heading.map_or(0.0, |heading| angle::difference(heading, lead.yaw));
            if left.abs() < TURNED {
                return Next::Close;
            }
            (left.clamp(-pilot.reach().turn, pilot.reach().turn), 0.0)
        }
    };
    let step = |(turn, advance): (f64, f64)| {
        let turned = lead.then(&Footprint { yaw: turn, ..Footprint::default() });
        turned.then(&Footprint { x: advance, ..Footprint::default() })
    };
    let mut wanted: Vec<(f64, f64)> = EASED.iter().map(|share| (turn * share, advance * share)).collect();
    if turn != 0.0 && advance != 0.0 {
        wanted.extend(EASED.iter().map(|share| (turn * share, 0.0)));
    }
    Next::Lead(wanted.into_iter().map(step).collect())
}

/// How far to turn and to go ahead to a place in that direction and so far away: who turns as far as the legs let it does so on the spot.
fn towards(pilot: &Pilot, bearing: f64, distance: f64) -> (f64, f64) {
    let reach = pilot.reach();
    let turn = bearing.clamp(-reach.turn, reach.turn);
    if turn != bearing {
        return (turn, 0.0);
    }
    let left = (1.0 - (turn / reach.turn).powi(2)).max(0.0).sqrt();
    (turn, distance.min(reach.ahead * left))
}
