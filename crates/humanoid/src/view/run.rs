//! The request for a run of the simulator in a page. Main type: [`RunRequest`].

use super::data::Run;
use crate::gait::Footprint;
use crate::nav::Room;
use crate::sim::{self, Interior, Start};
use crate::task::Goal;
use crate::{Result, Watch};

/// The parameters of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunRequest<'a> {
    /// The name of a walking robot of this crate: `nao`, `rh0` or `teo`.
    pub robot: &'a str,
    /// The room, as [`Room::from_toml`] reads it.
    pub room: &'a str,
    /// The initial position of the middle of its feet, and its heading \[m, rad\].
    pub start: [f64; 3],
    /// The goal, with the final heading if one is requested \[m, rad\].
    pub goal: &'a [f64],
    /// The least distance of the body from obstacles \[m\].
    pub apart: f64,
}

/// The run and its room.
///
/// # Errors
/// As [`super::Page::with_run`].
pub fn run(request: &RunRequest<'_>) -> Result<Run> {
    let RunRequest { robot, room: text, start, goal, apart } = request;
    let room = Room::from_toml(text)?;
    let [x, y, yaw] = *start;
    let begun = Start::of_robot(robot, room.clone(), Footprint { x, y, yaw }, Goal::of(goal)?.into(), *apart)?;
    sim::Run::new(begun, &Watch::none())?;
    let scene = Interior::of(&room);
    let (robot, room) = ((*robot).to_owned(), (*text).to_owned());
    Ok(Run { robot, room, start: *start, goal: goal.to_vec(), apart: *apart, scene })
}
