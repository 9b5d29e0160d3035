//! Navigation with the settings that the command and Python share. Main type: [`Navigator`].

use super::body::Body;
use super::course::{Blocked, Search};
use super::floor::Floor;
use super::pilot::Pilot;
use super::plan::Plan;
use crate::gait::{Footprint, GaitDefaults, Walker};
use crate::{Error, ErrorKind, Result, Watch};

/// The gait of the walk, unless another one is requested.
const USUAL: &str = "preview";

/// A walker that plans its path. Footsteps are planned one by one; then a gait without rests between them walks them.
#[derive(Clone, Debug)]
pub struct Navigator {
    pilot: Pilot,
    /// The gait without rests, unless one by one step goal is requested.
    blended: Option<GaitDefaults>,
}

impl Navigator {
    /// Makes the navigator of a walker. `gait` is the name of its gait: preview by default, which does not rest between
    /// the steps, or one by one step goal, which rests after each. With `is_upright` it stands upright before the first
    /// and after the last step.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a gait that the walker does not have, and for another one; as [`Pilot::new`].
    pub fn new<'w>(
        walker: Walker,
        gait: Option<&str>,
        body: Body,
        is_upright: bool,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Self> {
        let wanted = walker.gait(gait.unwrap_or(USUAL))?.clone();
        let is_one_step = wanted.gait.is_one_step();
        if !is_one_step && gait.is_some_and(|gait| gait != USUAL) {
            return Err(no_steps());
        }
        let first = || walker.gaits.iter().map(|(_, defaults)| defaults).find(|defaults| defaults.gait.is_one_step());
        let steps = if is_one_step { wanted.clone() } else { first().ok_or_else(no_steps)?.clone() };
        let pilot = Pilot::new(walker, steps, body, is_upright, watch)?;
        Ok(match is_one_step {
            true => Navigator { pilot, blended: None },
            false => Navigator { pilot: pilot.for_gait(&wanted), blended: Some(wanted) },
        })
    }

    /// Its pilot.
    pub fn pilot(&self) -> &Pilot {
        &self.pilot
    }

    /// Plans the walk from `start` of the middle of the feet to a goal; returns the proof where no path exists. Where no
    /// walk without rests is feasible, the robot rests after each step, and [`Plan::notes`] has the reason.
    ///
    /// # Errors
    /// As [`Plan::find`] and [`Plan::blended`].
    pub fn plan<'w>(
        &self,
        floor: &Floor,
        start: &Footprint,
        search: impl Into<Search>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Plan, Blocked>> {
        let (watch, feet) = (Watch::or_none(watch), start.feet(self.pilot.half_width()));
        let mut found = Plan::find(&self.pilot, floor, feet, search, watch)?;
        if let (Ok(plan), Some(gait)) = (&mut found, &self.blended)
            && !plan.walk.schedule.route.steps.is_empty()
        {
            match plan.blended(&self.pilot, floor, gait, watch)? {
                Ok(walk) => plan.walk = walk,
                Err(reason) => plan.unblended = Some(reason),
            }
        }
        Ok(found)
    }
}

fn no_steps() -> Error {
    let text = "a path needs a gait by one step goal; give --gait osg, rh0, rh0-sim or rh0-real, if this robot has it";
    Error::new(ErrorKind::BadValue, text)
}
