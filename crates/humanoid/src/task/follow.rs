//! Footsteps along a path: forward as far as the legs reach, and turns on the spot where the path bends by more than a
//! step can turn.

use super::course::Course;
use super::pilot::Pilot;
use super::reach::bearing;
use crate::gait::Footprint;
use groebot_robot::spatial::angle;

/// The distance from a corner of a path at which its next segment begins \[m\].
const REACHED: f64 = 1e-3;
/// The tolerance of a heading \[rad\].
const TURNED: f64 = 1e-6;
/// Factors that shorten steps, tried in order where they are infeasible at full length.
const EASED: [f64; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];

/// The next action of a walker that follows a path.
pub(super) enum Next {
    /// One of these steps, the best first: the middle of the feet after both are side by side.
    Lead(Vec<Footprint>),
    /// Only the feet must be closed.
    Close,
}

/// The next steps from a place on a path; `corner` is the index of the next corner.
pub(super) fn next(pilot: &Pilot, lead: &Footprint, course: &Course, corner: &mut usize) -> Next {
    let points = &course.path.points;
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

/// The turn and the distance forward to a place at a bearing and a distance. A turn by the greatest angle is on the
/// spot.
fn towards(pilot: &Pilot, bearing: f64, distance: f64) -> (f64, f64) {
    let reach = pilot.reach();
    let turn = bearing.clamp(-reach.turn, reach.turn);
    if turn != bearing {
        return (turn, 0.0);
    }
    let left = (1.0 - (turn / reach.turn).powi(2)).max(0.0).sqrt();
    (turn, distance.min(reach.ahead * left))
}
