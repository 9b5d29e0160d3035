//! Maps and places for the commands that plan paths.

use std::path::Path;

use nalgebra::Point2;
use serde_json::{Value, json};

use super::moving::ends;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_humanoid::gait::Footprint;
use groebot_humanoid::nav::{Enclosure, Map, Path as FloorPath, Room};
use groebot_humanoid::sim;
use groebot_humanoid::task::Goal;
use groebot_robot::document::{TEXT_LIMIT, read_text};

/// Options for reading a map and for moving its furniture.
#[derive(clap::Args)]
pub struct FloorArguments {
    /// The side of a cell for a map file without a resolution [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.05, allow_hyphen_values = true)]
    resolution: f64,
    /// Treat unknown cells as free
    #[arg(long)]
    unknown_free: bool,
    /// Move a piece of furniture of a room [m, degrees], or remove it
    #[arg(long, value_name = "NAME=X,Y[,YAW] or NAME=none")]
    furniture: Vec<String>,
}

impl FloorArguments {
    /// Reads the map of a file, and the start of a room.
    ///
    /// # Errors
    /// As [`Map::read`] and [`Room::with_moved`]; [`ErrorKind::BadValue`] for furniture of a map that is not a room.
    pub fn map(&self, file: &Path) -> Result<(Map, Option<[f64; 3]>)> {
        let (map, start) = if ends(file, "toml") || known(file).is_some() {
            let room = refurnished(read_room(file)?, &self.furniture)?;
            (room.map().map_err(|error| error.in_file(file))?, room.start)
        } else if self.furniture.is_empty() {
            (Map::read(file, self.resolution)?, None)
        } else {
            return Err(bad("--furniture needs a room; give one in TOML").in_file(file));
        };
        Ok((if self.unknown_free { map.with_unknown_free() } else { map }, start))
    }
}

/// The text of a built-in room; a file of that name has priority.
fn known(file: &Path) -> Option<&'static str> {
    file.to_str().and_then(sim::room).filter(|_| !file.exists())
}

/// The text of a room: that of the built-in one of that name, else of the file.
///
/// # Errors
/// As [`read_text`].
pub fn room_text(file: &Path) -> Result<String> {
    known(file).map_or_else(|| read_text(file, TEXT_LIMIT), |text| Ok(text.to_owned()))
}

/// The room after the requested changes of its furniture.
///
/// # Errors
/// As [`moved`], [`Room::with_moved`] and [`Room::without`].
pub fn read_room(file: &Path) -> Result<Room> {
    Room::from_toml(&room_text(file)?).map_err(|error| error.in_file(file))
}

/// The room with its furniture moved as requested.
///
/// # Errors
/// As [`moved`], [`Room::with_moved`] and [`Room::without`].
pub fn refurnished(room: Room, furniture: &[String]) -> Result<Room> {
    furniture.iter().try_fold(room, |room, option| match moved(option)? {
        (name, Some(at)) => room.with_moved(name, at.point(), at.yaw),
        (name, None) => room.without(name),
    })
}

/// A piece of furniture with its new position and anticlockwise rotation \[m, rad\], or its removal: `NAME=X,Y`,
/// `NAME=X,Y,YAW` in degrees, `NAME=none`.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another text.
pub fn moved(option: &str) -> Result<(&str, Option<Footprint>)> {
    let wrong = || bad(&format!("{option}: give NAME=X,Y or NAME=X,Y,YAW or NAME=none for a piece of furniture"));
    let (name, place) = option.split_once('=').ok_or_else(wrong)?;
    if place == "none" {
        return Ok((name, None));
    }
    let numbers: Option<Vec<f64>> = place.split(',').map(|word| limits::number(word).ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y]) => Ok((name, Some(Footprint { x, y, yaw: 0.0 }))),
        Some(&[x, y, yaw]) => Ok((name, Some(Footprint { x, y, yaw: yaw.to_radians() }))),
        _ => Err(wrong()),
    }
}

/// The start and the goal of a walk.
#[derive(clap::Args)]
pub struct PlaceArguments {
    /// The initial middle of the feet and heading [m, degrees] (default: the start of the room, else 0,0)
    #[arg(long, value_name = "X,Y[,HEADING]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    start: Option<Vec<f64>>,
    /// The goal for the middle of the feet, with an optional final heading [m, degrees]
    #[arg(long, value_name = "X,Y[,HEADING]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    goal: Vec<f64>,
    /// The least distance of the body from obstacles [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.02, allow_hyphen_values = true)]
    pub apart: f64,
}

impl PlaceArguments {
    /// The initial pose of the middle of the feet; by default that of the room.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a number of values other than two or three.
    pub fn start(&self, default: Option<[f64; 3]>) -> Result<Footprint> {
        let [x, y, yaw] = default.unwrap_or_default();
        self.start.as_deref().map_or(Ok(Footprint { x, y, yaw }), start_at)
    }

    /// The goal.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a number of values other than two or three.
    pub fn goal(&self) -> Result<Goal> {
        goal_at(&self.goal)
    }
}

/// A start from its numbers \[m, degrees\].
///
/// # Errors
/// [`ErrorKind::BadValue`] for a number of values other than two or three.
pub fn start_at(numbers: &[f64]) -> Result<Footprint> {
    match *numbers {
        [x, y] => Ok(Footprint { x, y, yaw: 0.0 }),
        [x, y, heading] => Ok(Footprint { x, y, yaw: heading.to_radians() }),
        _ => Err(bad("--start takes two or three numbers: --start 0,0,90")),
    }
}

/// A goal from its numbers \[m, degrees\].
///
/// # Errors
/// [`ErrorKind::BadValue`] for a number of values other than two or three.
pub fn goal_at(numbers: &[f64]) -> Result<Goal> {
    match *numbers {
        [x, y] => Ok(Goal { place: Point2::new(x, y), heading: None }),
        [x, y, heading] => Ok(Goal { place: Point2::new(x, y), heading: Some(heading.to_radians()) }),
        _ => Err(bad("--goal takes two or three numbers: --goal 3.2,1.5 or --goal 3.2,1.5,90")),
    }
}

/// The corners of a path \[m\].
pub fn points(path: &FloorPath) -> Value {
    path.points.iter().map(|point| json!([point.x, point.y])).collect()
}

/// The centres of the cells that no path leaves \[m\].
pub fn enclosure(map: &Map, enclosure: &Enclosure) -> Value {
    let middle = |cell: &usize| {
        let at = map.centre(*cell);
        json!([at.x, at.y])
    };
    enclosure.cells.iter().map(middle).collect()
}

fn bad(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
