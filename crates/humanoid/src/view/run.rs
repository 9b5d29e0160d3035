//! A run of the simulator as a page asks for it. Main type: [`Asked`].

use super::data::Run;
use crate::gait::Footprint;
use crate::nav::Room;
use crate::sim::{self, Interior, Start};
use crate::task::Goal;
use crate::{Result, Watch};

/// What runs where.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked<'a> {
    /// A robot of this crate that walks: `nao`, `rh0` or `teo`.
    pub robot: &'a str,
    /// The room, as [`Room::from_toml`] reads it.
    pub room: &'a str,
    /// Where the middle of its feet is at first, and where it looks \[m, rad\].
    pub start: [f64; 3],
    /// Where it is to get, and where it is to look there if that is asked for.
    pub goal: &'a [f64],
    /// How far the body keeps away from obstacles \[m\].
    pub apart: f64,
}

/// The run and its room.
///
/// # Errors
/// As [`super::Page::with_run`].
pub fn run(asked: &Asked<'_>) -> Result<Run> {
    let Asked { robot, room: text, start, goal, apart } = asked;
    let room = Room::from_toml(text)?;
    let [x, y, yaw] = *start;
    let begun = Start::of_robot(robot, room.clone(), Footprint { x, y, yaw }, Goal::of(goal)?.into(), *apart)?;
    sim::Run::new(begun, &Watch::none())?;
    let scene = Interior::of(&room);
    let (robot, room) = ((*robot).to_owned(), (*text).to_owned());
    Ok(Run { robot, room, start: *start, goal: goal.to_vec(), apart: *apart, scene })
}
