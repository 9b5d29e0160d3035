//! A furnished room for pictures and distances: prisms on a floor. Main type: [`Interior`].

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use crate::nav::{self, Room, Shape};

/// The number of sides of the polygon around a circle.
const SIDES: usize = 48;

/// A room \[m, rad\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Interior {
    /// Its dimensions along x and y.
    pub size: [f64; 2],
    /// The thickness of its walls, which are inside its borders.
    pub wall: f64,
    /// The position of its lower left corner, and its anticlockwise rotation.
    pub origin: [f64; 3],
    /// The furniture.
    pub pieces: Vec<Piece>,
}

/// A piece of furniture \[m, rad\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Piece {
    /// Its name.
    pub name: String,
    /// Its corners in its own frame.
    pub outline: Vec<[f64; 2]>,
    /// Its height.
    pub height: f64,
    /// Its position and its anticlockwise rotation.
    pub at: [f64; 3],
}

impl Interior {
    /// The interior of a room.
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
