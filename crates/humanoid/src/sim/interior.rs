//! A furnished room as pictures and distances have it: prisms on a floor. Main type: [`Interior`].

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use crate::nav::{self, Room, Shape};

/// A circle is drawn as a polygon of so many sides around it.
const SIDES: usize = 48;

/// A room \[m, rad\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interior {
    /// How long it is along x and y.
    pub size: [f64; 2],
    /// How thick its walls are, which stand inside of its borders.
    pub wall: f64,
    /// Its lower left corner, and how it is turned anticlockwise.
    pub origin: [f64; 3],
    /// The furniture.
    pub pieces: Vec<Piece>,
}

/// A piece of furniture \[m, rad\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Its name.
    pub name: String,
    /// Corners about its own origin.
    pub outline: Vec<[f64; 2]>,
    /// How high it is.
    pub height: f64,
    /// Its place and how it is turned anticlockwise.
    pub at: [f64; 3],
}

impl Interior {
    /// That of a room.
    pub fn of(room: &Room) -> Self {
        Interior {
            size: room.size,
            wall: room.wall,
            origin: room.origin,
            pieces: room.pieces.iter().map(piece).collect(),
        }
    }
}

fn piece(own: &nav::Piece) -> Piece {
    let outline = corners(&own.outline).iter().map(|corner| [corner.x, corner.y]).collect();
    Piece { name: own.name.clone(), outline, height: own.height, at: [own.place.x, own.place.y, own.yaw] }
}

/// The corners of a shape, or of a polygon around it.
pub(super) fn corners(shape: &Shape) -> Vec<Point2<f64>> {
    match shape {
        Shape::Polygon(corners) => corners.clone(),
        Shape::Circle { centre, radius } => {
            let half = std::f64::consts::PI / SIDES as f64;
            let corner = |side: usize| {
                let (sine, cosine) = (2.0 * half * side as f64).sin_cos();
                centre + nalgebra::Vector2::new(cosine, sine) * (radius / half.cos())
            };
            (0..SIDES).map(corner).collect()
        }
    }
}
