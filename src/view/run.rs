//! A run of the simulator as a page asks for it. Main type: [`Asked`].

use super::data::{Piece, Run, Scene};
use crate::document::shown;
use crate::nav::{self, Room, Shape};
use crate::robots::{self, Outline};
use crate::{Error, ErrorKind, Result};

/// So many corners has a circle.
const CORNERS: usize = 48;

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
    if robots::walker(robot, Outline::Measured).is_none() {
        let text = format!("`{}` does not walk in the page; give nao, rh0 or teo", shown(robot));
        return Err(Error::new(ErrorKind::UnknownName, text));
    }
    let room = Room::from_toml(text)?;
    room.map()?;
    let scene = Scene {
        size: room.size,
        wall: room.wall,
        origin: room.origin,
        pieces: room.pieces.iter().map(piece).collect(),
    };
    let (robot, room) = ((*robot).to_owned(), (*text).to_owned());
    Ok(Run { robot, room, start: *start, goal: goal.to_vec(), apart: *apart, scene })
}

fn piece(own: &nav::Piece) -> Piece {
    let outline = match &own.outline {
        Shape::Polygon(corners) => corners.iter().map(|corner| [corner.x, corner.y]).collect(),
        Shape::Circle { centre, radius } => {
            let corner = |place: usize| {
                let (sine, cosine) = (std::f64::consts::TAU * place as f64 / CORNERS as f64).sin_cos();
                [centre.x + radius * cosine, centre.y + radius * sine]
            };
            (0..CORNERS).map(corner).collect()
        }
    };
    let at = [own.place.x, own.place.y, own.yaw];
    Piece { name: own.name.clone(), outline, height: own.height, at }
}
