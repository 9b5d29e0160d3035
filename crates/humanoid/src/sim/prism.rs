//! Objects on a floor as convex prisms. Main type: [`Prism`].

use std::fmt;

use nalgebra::Point2;

use super::interior::corners;
use crate::nav::{Room, Shape, signed_area};

/// The height of the walls of a room \[m\].
pub(crate) const WALL_HEIGHT: f64 = 2.5;

/// An object that a link may collide with.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Thing {
    /// Furniture of that name.
    Furniture(String),
    /// A wall of the room.
    Wall,
    /// The floor; feet are excluded.
    Floor,
}

impl fmt::Display for Thing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Thing::Furniture(name) => f.write_str(name),
            Thing::Wall => f.write_str("wall"),
            Thing::Floor => f.write_str("floor"),
        }
    }
}

/// A vertical prism from the floor up to a height \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    /// Its corners, anticlockwise.
    pub corners: Vec<Point2<f64>>,
    /// Its height.
    pub height: f64,
}

/// The objects of a room, furniture first, then its walls: each as prisms that cover it.
pub fn prisms(room: &Room) -> Vec<(Thing, Vec<Prism>)> {
    let furniture = room.pieces.iter().map(|piece| (Thing::Furniture(piece.name.clone()), piece.shape(), piece.height));
    let walls = room.walls().into_iter().map(|shape| (Thing::Wall, shape, WALL_HEIGHT));
    let covered = |(thing, shape, height): (Thing, Shape, f64)| {
        let mut open = corners(&shape);
        if signed_area(&open) < 0.0 {
            open.reverse();
        }
        let parts = triangles(open).into_iter().map(|corners| Prism { corners, height });
        (thing, parts.collect())
    };
    furniture.chain(walls).map(covered).collect()
}

/// Cuts ears off a simple polygon, anticlockwise, until the rest is convex (G. Meisters, American Mathematical Monthly
/// 82, 1975).
fn triangles(mut open: Vec<Point2<f64>>) -> Vec<Vec<Point2<f64>>> {
    let mut parts = Vec::new();
    loop {
        let count = open.len();
        let around = |at: usize| [(at + count - 1) % count, at, (at + 1) % count];
        let turn = |at: usize| signed_area(&around(at).map(|corner| open[corner]));
        if (0..count).all(|at| turn(at) >= 0.0) {
            parts.push(open);
            return parts;
        }
        let is_ear = |at: &usize| {
            let own = around(*at);
            let triangle = own.map(|corner| open[corner]);
            let is_inside = |point: &Point2<f64>| {
                (0..3).all(|side| signed_area(&[triangle[side], triangle[(side + 1) % 3], *point]) >= 0.0)
            };
            turn(*at) > 0.0 && (0..count).all(|other| own.contains(&other) || !is_inside(&open[other]))
        };
        // A polygon whose sides do not cross has an ear; any other one is covered by its convex hull.
        let Some(ear) = (0..count).find(is_ear) else {
            parts.push(crate::gait::Polygon::hull(&open).corners().to_vec());
            return parts;
        };
        parts.push(around(ear).map(|corner| open[corner]).to_vec());
        open.remove(ear);
    }
}
