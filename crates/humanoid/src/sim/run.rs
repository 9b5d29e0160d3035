//! A run of the simulator. Main type: [`Run`].

use std::ops::Range;

use nalgebra::Point2;

use super::destination::Destination;
use super::figures::Figures;
use crate::gait::{Footprint, GaitDefaults, Side, Walk, Walker};
use crate::nav::Room;
use crate::task::{Blocked, Body, Course, Floor, Journey, Method, Pilot};
use crate::walkers::{self, Outline};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::shown;
use groebot_robot::model::Meshes;
use groebot_robot::robots;

/// The initial state of a run.
#[derive(Clone, Debug)]
pub struct Start {
    /// The walker, by one step goal.
    pub walker: Walker,
    /// The area of the floor that it covers.
    pub body: Body,
    /// The room.
    pub room: Room,
    /// The least distance of the body from obstacles \[m\].
    pub apart: f64,
    /// The initial pose of the middle of the feet.
    pub middle: Footprint,
    /// The destination.
    pub goal: Destination,
    /// The method that finds its paths.
    pub method: Method,
}

/// The result of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// A step: the new samples of the walk.
    Step(Range<usize>),
    /// The robot is at the goal.
    Arrived,
}

/// A robot that walks through a room.
#[derive(Clone, Debug)]
pub struct Run {
    start: Start,
    /// The gait before any parameter was changed.
    defaults: GaitDefaults,
    figures: Figures,
    floor: Floor,
    course: std::result::Result<Course, Blocked>,
    journey: Journey<'static>,
}

impl Start {
    /// The start of a robot of this crate, by its name, on shortest paths.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for another name; as [`Body::new`].
    pub fn of_robot(name: &str, room: Room, middle: Footprint, goal: Destination, apart: f64) -> Result<Self> {
        let unknown = || {
            let text = format!("there is no walking robot `{}`; give nao, rh0 or teo", shown(name));
            Error::new(ErrorKind::UnknownName, text)
        };
        let (walker, robot) = (walkers::walker(name, Outline::Measured), robots::robot(name));
        let (walker, robot) = (walker.ok_or_else(unknown)??, robot.ok_or_else(unknown)?);
        let body = Body::new(&robot, &walker.biped, &Meshes::default())?;
        Ok(Start { walker, body, room, apart, middle, goal, method: Method::Exact })
    }

    /// The path from a place.
    fn course(
        &self,
        pilot: &Pilot,
        floor: &Floor,
        from: &Footprint,
        watch: &Watch,
    ) -> Result<std::result::Result<Course, Blocked>> {
        let goal = self.goal.goal(&self.room, pilot, floor, &from.point(), watch)?;
        Course::find(pilot, floor, from, goal.by(self.method), watch)
    }
}

impl Run {
    /// Finds the path, lowers the trunk and waits for the first step.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a walker without a gait by one step goal; as [`Pilot::new`], [`Room::map`],
    /// [`Floor::new`], [`Destination::goal`], [`Course::find`] and [`Journey::new`].
    pub fn new<'w>(start: Start, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let defaults = start.walker.gaits.iter().find(|(_, defaults)| defaults.gait.is_one_step());
        let defaults = defaults.map(|(_, defaults)| defaults.clone()).ok_or_else(|| {
            let text = format!("{} has no gait by one step goal", start.walker.biped.name);
            Error::new(ErrorKind::Unsupported, text)
        })?;
        let pilot = Pilot::new(start.walker.clone(), defaults.clone(), start.body.clone(), true, watch)?;
        let pilot = pilot.at_most(defaults.length, defaults.most_turn);
        let figures = Figures::of(&start.walker.biped, &defaults, pilot.reach().hip_height);
        let floor = Floor::new(&start.room.map()?, start.apart)?;
        let course = start.course(&pilot, &floor, &start.middle, watch)?;
        let journey = Journey::new(&pilot, &floor, start.middle.feet(pilot.half_width()), watch)?.into_owned();
        Ok(Run { start, defaults, figures, floor, course, journey })
    }

    /// The parameters of the next step.
    pub fn figures(&self) -> &Figures {
        &self.figures
    }

    /// The current room.
    pub fn room(&self) -> &Room {
        &self.start.room
    }

    /// The path from the place where it was found, or the proof that none exists.
    pub fn course(&self) -> &std::result::Result<Course, Blocked> {
        &self.course
    }

    /// The walk up to now.
    pub fn walk(&self) -> &Walk {
        self.journey.walk()
    }

    /// The current pilot.
    pub fn pilot(&self) -> &Pilot {
        self.journey.pilot()
    }

    /// Takes the next step.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where no path exists; as [`Journey::step`].
    pub fn step<'w>(&mut self, watch: impl Into<Option<&'w Watch>>) -> Result<Next> {
        let watch = Watch::or_none(watch);
        let course = self.course.as_ref().map_err(|blocked| Error::new(ErrorKind::BadValue, blocked.to_string()))?;
        let before = self.journey.walk().references.len();
        let has_stepped = self.journey.step(&self.floor, course, watch)?;
        Ok(if has_stepped { Next::Step(before..self.journey.walk().references.len()) } else { Next::Arrived })
    }

    /// Changes the goal.
    ///
    /// # Errors
    /// As [`Destination::goal`] and [`Course::find`]; then nothing changes.
    pub fn go_to<'w>(&mut self, goal: Destination, watch: impl Into<Option<&'w Watch>>) -> Result<()> {
        let watch = Watch::or_none(watch);
        self.change(self.start.room.clone(), goal, watch)
    }

    /// Changes the room, such as the place of furniture.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where furniture would overlap the robot; as [`Room::map`], [`Destination::goal`] and
    /// [`Course::find`]; then nothing changes.
    pub fn refurnish<'w>(&mut self, room: Room, watch: impl Into<Option<&'w Watch>>) -> Result<()> {
        let watch = Watch::or_none(watch);
        self.change(room, self.start.goal.clone(), watch)
    }

    /// Changes the room and the goal at once.
    ///
    /// # Errors
    /// As [`Run::refurnish`] and [`Run::go_to`]; then nothing changes.
    pub fn change<'w>(&mut self, room: Room, goal: Destination, watch: impl Into<Option<&'w Watch>>) -> Result<()> {
        let watch = Watch::or_none(watch);
        let floor =
            if room == self.start.room { self.floor.clone() } else { Floor::new(&room.map()?, self.start.apart)? };
        if let Some(at) = self.meets(&floor)? {
            let text = format!("furniture would overlap the robot at ({:.3}, {:.3})", at.x, at.y);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let start = Start { room, goal, ..self.start.clone() };
        self.course = start.course(self.pilot(), &floor, &self.journey.middle(), watch)?;
        (self.start, self.floor) = (start, floor);
        self.journey.turn_to_new_course();
        Ok(())
    }

    /// The point where the robot at its current pose collides with an obstacle.
    fn meets(&self, floor: &Floor) -> Result<Option<Point2<f64>>> {
        let (biped, feet) = (&self.pilot().walker().biped, self.journey.feet());
        let on_sole = |side: Side| floor.under_sole(&biped.sole_at(side, &feet[side as usize]));
        if let Some(at) = [Side::Left, Side::Right].into_iter().find_map(on_sole) {
            return Ok(Some(at));
        }
        let Some(posture) = self.walk().motion.postures.last() else { return Ok(None) };
        Ok(floor.beside_body(&self.pilot().body().outline(biped, posture)?))
    }

    /// The destination.
    pub fn goal(&self) -> &Destination {
        &self.start.goal
    }

    /// Sets a parameter of the gait from the next step on. Returns the samples in which the robot takes a new height;
    /// none where it keeps its height.
    ///
    /// # Errors
    /// As [`Figures::with`]; the reason why such a walk is infeasible, as [`Pilot::new`] and [`Pilot::within`]; then
    /// nothing changes.
    pub fn set<'w>(&mut self, name: &str, value: f64, watch: impl Into<Option<&'w Watch>>) -> Result<Range<usize>> {
        let watch = Watch::or_none(watch);
        let figures = self.figures.with(name, value)?;
        let Start { walker, body, .. } = &self.start;
        let defaults = figures.put(&walker.biped, &self.defaults);
        let (length, turn) = (defaults.length, defaults.most_turn);
        let pilot = Pilot::new(walker.clone(), defaults, body.clone(), true, watch)?.within(length, turn, watch)?;
        let (before, mut journey) = (self.walk().references.len(), self.journey.clone());
        journey.walk_as(pilot, watch)?;
        let course = self.start.course(journey.pilot(), &self.floor, &journey.middle(), watch)?;
        (self.figures, self.course, self.journey) = (figures, course, journey);
        Ok(before..self.walk().references.len())
    }

    /// Ends the walk at the current place; an upright walker rises.
    ///
    /// # Errors
    /// As [`Journey::finish`].
    #[cfg(feature = "clearance")]
    pub(crate) fn finish<'w>(self, watch: impl Into<Option<&'w Watch>>) -> Result<Walk> {
        let watch = Watch::or_none(watch);
        self.journey.finish(watch)
    }
}
