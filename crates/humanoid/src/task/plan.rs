//! A complete journey on one floor to one goal. Main type: [`Plan`].

use std::fmt;

use super::course::{Blocked, Course, Search};
use super::floor::Floor;
use super::journey::Journey;
use super::pilot::Pilot;
use super::refusal::{Reason, Refusal};
use crate::gait::{Footprint, Walk};
use crate::{Result, Watch};

/// The result of planning.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The path.
    pub course: Course,
    /// The walk.
    pub walk: Walk,
    /// The steps that were planned and not taken.
    pub refusals: Vec<Refusal>,
    /// Why the robot rests after each step, where a walk without rests was requested.
    pub unblended: Option<Reason>,
}

impl Plan {
    /// Plans from two footprints, left and right, to a goal; returns the proof where no path exists.
    ///
    /// # Errors
    /// As [`Course::find`], [`Journey::new`] and [`Journey::step`].
    pub fn find<'w>(
        pilot: &Pilot,
        floor: &Floor,
        feet: [Footprint; 2],
        search: impl Into<Search>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Self, Blocked>> {
        let watch = Watch::or_none(watch);
        let course = match Course::find(pilot, floor, &feet[0].middle(&feet[1]), search, watch)? {
            Ok(course) => course,
            Err(blocked) => return Ok(Err(blocked)),
        };
        let mut journey = Journey::new(pilot, floor, feet, watch)?;
        while journey.step(floor, &course, watch)? {}
        let refusals = journey.refusals().to_vec();
        Ok(Ok(Plan { course, walk: journey.finish(watch)?, refusals, unblended: None }))
    }

    /// What differs from the requested walk, one line each.
    pub fn notes(&self) -> Vec<String> {
        let text = |reason| format!("the robot rests after each step, because preview control fails: {reason}");
        self.unblended.iter().map(text).collect()
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let room = if self.course.is_wide { "room at every heading" } else { "room for the body's core only" };
        writeln!(f, "  course          {:.3} m, {room}", self.course.path.length())?;
        match self.refusals.as_slice() {
            [] => writeln!(f, "  steps refused   none"),
            [first, ..] => writeln!(f, "  steps refused   {}, the first: {first}", self.refusals.len()),
        }
    }
}
