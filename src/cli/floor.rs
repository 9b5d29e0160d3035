//! Maps of the commands that find ways.

use std::path::Path;

use nalgebra::Point2;
use serde_json::{Value, json};

use crate::document::{TEXT_LIMIT, read_text};
use crate::nav::{Enclosure, Map, Room, Way};
use crate::{Error, ErrorKind, Result};

/// How a map is read, and what of its furniture is moved.
#[derive(clap::Args)]
pub struct FloorArguments {
    /// The side of a cell of a map that does not tell it [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.05, allow_hyphen_values = true)]
    resolution: f64,
    /// Take cells that have not been seen to be free
    #[arg(long)]
    unknown_free: bool,
    /// Put a piece of furniture of a room elsewhere [m, degrees], or take it away
    #[arg(long, value_name = "NAME=X,Y[,YAW] or NAME=none")]
    furniture: Vec<String>,
}

impl FloorArguments {
    /// The map of a file.
    ///
    /// # Errors
    /// As [`Map::read`] and [`Room::with_moved`]; [`ErrorKind::BadValue`] for furniture of what is no room.
    pub fn map(&self, file: &Path) -> Result<Map> {
        let is_room = file.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"));
        let map = if is_room {
            self.room(file)?.map().map_err(|error| error.in_file(file))?
        } else if self.furniture.is_empty() {
            Map::read(file, self.resolution)?
        } else {
            return Err(bad("--furniture is for rooms; give one in TOML").in_file(file));
        };
        Ok(if self.unknown_free { map.with_unknown_free() } else { map })
    }

    fn room(&self, file: &Path) -> Result<Room> {
        let room = Room::from_toml(&read_text(file, TEXT_LIMIT)?).map_err(|error| error.in_file(file))?;
        self.furniture.iter().try_fold(room, |room, told| {
            let wrong = || bad(&format!("--furniture {told}: give NAME=X,Y or NAME=X,Y,YAW or NAME=none"));
            let (name, place) = told.split_once('=').ok_or_else(wrong)?;
            if place == "none" {
                return room.without(name);
            }
            let numbers: Option<Vec<f64>> = place.split(',').map(|word| word.trim().parse().ok()).collect();
            match numbers.as_deref() {
                Some(&[x, y]) => room.with_moved(name, Point2::new(x, y), 0.0),
                Some(&[x, y, yaw]) => room.with_moved(name, Point2::new(x, y), yaw.to_radians()),
                _ => Err(wrong()),
            }
        })
    }
}

/// The corners of a way \[m\].
pub fn points(way: &Way) -> Value {
    way.points.iter().map(|point| json!([point.x, point.y])).collect()
}

/// The middles of the cells that no way leaves \[m\].
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
