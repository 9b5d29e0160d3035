//! The footsteps of a plan without rests between them. Main function: [`Plan::blended`].

use super::floor::Floor;
use super::pilot::Pilot;
use super::plan::Plan;
use super::refusal::{Reason, met};
use crate::gait::{Action, Gait, GaitDefaults, Request, Route, Walk, plan, plan_actions};
use crate::{Error, ErrorKind, Result, Watch};

/// The factors on the durations of all phases that are tried in order: a slower walk is nearer to the one with rests.
const SLOWER: [f64; 3] = [1.0, 1.4, 2.0];

impl Plan {
    /// Walks the footsteps of this plan by a gait that does not rest between them, such as preview control. Each sample
    /// is checked as in a [`super::Journey`]: joints, zero moment point, soles and body. A walk that fails is tried more
    /// slowly. Returns the reason against the first trial when none succeeds.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a gait without hip heights; [`Watch::check`].
    pub fn blended<'w>(
        &self,
        pilot: &Pilot,
        floor: &Floor,
        gait: &GaitDefaults,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Walk, Reason>> {
        let watch = Watch::or_none(watch);
        let mut first = None;
        for factor in SLOWER {
            for height in gait.hip_heights.iter() {
                let reason = match self.walked(pilot, gait, (*height, factor), watch) {
                    Err(error) if error.kind() == ErrorKind::BadValue => Reason::Gait(error.message().to_owned()),
                    walk => {
                        let walk = walk?;
                        match met(pilot, floor, &walk)? {
                            None => return Ok(Ok(walk)),
                            Some((obstacle, at)) => Reason::Obstacle(obstacle, at),
                        }
                    }
                };
                let is_obstacle = matches!(reason, Reason::Obstacle(..));
                first.get_or_insert(reason);
                if is_obstacle {
                    // Another height of the hip keeps the path of the body.
                    break;
                }
            }
        }
        first.map(Err).ok_or_else(|| Error::new(ErrorKind::BadValue, "the gait has no hip height"))
    }

    /// The walk with the hips at a height \[m\] and all phases longer by a factor. An upright walker lowers its trunk
    /// before and rises after it.
    fn walked(&self, pilot: &Pilot, gait: &GaitDefaults, (height, factor): (f64, f64), watch: &Watch) -> Result<Walk> {
        let walker = pilot.walker();
        let (biped, legs) = (&walker.biped, &walker.legs);
        let mut request = gait.request(biped, self.walk.schedule.route.clone(), height);
        request.durations.shift *= factor;
        request.durations.swing *= factor;
        let walk = plan(biped, legs, &request, watch)?;
        let Gait::OneStep(one_step) = pilot.defaults().gait else { return Ok(walk) };
        if one_step.upright.is_none() {
            return Ok(walk);
        }
        let stand = |feet, action| {
            let durations = pilot.defaults().durations();
            let own =
                Request { gait: Gait::OneStep(one_step), durations, route: Route::at_rest(feet), ..request.clone() };
            plan_actions(biped, legs, &own, &[action], watch)
        };
        let route = &walk.schedule.route;
        let (start, end) = (route.start, route.end());
        let mut whole = stand(start, Action::Lower)?;
        whole.append(walk)?;
        whole.append(stand(end, Action::Rise)?)?;
        whole.request = Request { route: whole.schedule.route.clone(), ..request };
        Ok(whole)
    }
}
