//! The area of the floor that a walker's body covers, seen from above. Main type: [`Body`].

use nalgebra::{Point2, Point3, Vector2};

use crate::gait::{Biped, Polygon, Posture};
use crate::{Error, ErrorKind, Result};
use groebot_robot::dynamics::Placed;
use groebot_robot::model::{Meshes, Robot, Solid};
use groebot_robot::spatial::Pose;

/// The number of sides of the polygon around a circle.
const SIDES: usize = 12;

/// All collision shapes of a walker, except those fixed to its soles.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    parts: Vec<Part>,
}

/// All points within a radius of a convex hull, in the torso frame at the zero configuration; it moves with a body of
/// the model.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    body: usize,
    points: Vec<Point3<f64>>,
    radius: f64,
}

impl Body {
    /// Makes the body of `robot`. Spheres and capsules are exact, boxes are given by their corners, cylinders and
    /// meshes by their bounding boxes.
    ///
    /// # Errors
    /// Those of [`Meshes::points`]; [`ErrorKind::BadValue`] where only the soles have a shape.
    pub fn new(robot: &Robot, biped: &Biped, meshes: &Meshes) -> Result<Self> {
        let soles = [biped.feet[0].body, biped.feet[1].body];
        let mut parts = Vec::new();
        for (link, described) in robot.links().iter().enumerate() {
            let (body, torso_from_link) = biped.model.link(link);
            for shape in described.collisions.iter().filter(|_| !soles.contains(&body)) {
                let torso_from_shape = torso_from_link * shape.pose();
                let (points, radius) = corners(&shape.solid, meshes)?;
                parts.push(Part {
                    body,
                    points: points.iter().map(|point| torso_from_shape * point).collect(),
                    radius,
                });
            }
        }
        if parts.is_empty() {
            let text = format!("{}: only the soles have a shape; give the body's size (--body)", robot.name());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Body { parts })
    }

    /// A box about the torso's vertical axis, with its length forward and its width \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a size that is not finite and positive.
    pub fn of_size(length: f64, width: f64) -> Result<Self> {
        if ![length, width].iter().all(|size| size.is_finite() && *size > 0.0) {
            let text = format!("a body {length} m long and {width} m wide; give positive numbers");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let corner = |(x, y): (f64, f64)| Point3::new(x * length / 2.0, y * width / 2.0, 0.0);
        let points = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(corner).to_vec();
        Ok(Body { parts: vec![Part { body: 0, points, radius: 0.0 }] })
    }

    /// Its outline in a posture: the convex hull of all shapes, seen from above.
    ///
    /// # Errors
    /// As [`groebot_robot::dynamics::Model::place`].
    pub(crate) fn outline(&self, biped: &Biped, posture: &Posture) -> Result<Polygon> {
        let placed = biped.model.place(&posture.world_from_torso, &posture.q)?;
        let corners: Vec<Point2<f64>> = self.seen(&placed).flat_map(|(point, radius)| around(point, radius)).collect();
        Ok(Polygon::hull(&corners))
    }

    /// The greatest distance of the body from a point, seen from above \[m\].
    pub(super) fn reach(&self, placed: &Placed<'_>, from: &Point2<f64>) -> f64 {
        self.seen(placed).map(|(point, radius)| (point - from).norm() + radius).fold(0.0, f64::max)
    }

    /// Its points seen from above, each with its radius.
    fn seen<'a>(&'a self, placed: &'a Placed<'_>) -> impl Iterator<Item = (Point2<f64>, f64)> + 'a {
        self.parts.iter().flat_map(|part| {
            let motion: Pose = placed.motion(part.body);
            part.points.iter().map(move |point| ((motion * point).xy(), part.radius))
        })
    }
}

/// A polygon around a circle.
pub(super) fn around(middle: Point2<f64>, radius: f64) -> impl Iterator<Item = Point2<f64>> {
    let (count, half) = if radius > 0.0 { (SIDES, std::f64::consts::PI / SIDES as f64) } else { (1, 0.0) };
    let corner = radius / half.cos();
    (0..count).map(move |side| {
        let (sine, cosine) = (2.0 * half * side as f64).sin_cos();
        middle + Vector2::new(cosine, sine) * corner
    })
}

/// Points and a radius whose hull contains a solid, in its frame.
fn corners(solid: &Solid, meshes: &Meshes) -> Result<(Vec<Point3<f64>>, f64)> {
    let ends = |half: f64| vec![Point3::new(0.0, 0.0, -half), Point3::new(0.0, 0.0, half)];
    match solid {
        Solid::Sphere { radius } => Ok((vec![Point3::origin()], *radius)),
        Solid::Capsule { radius, length } => Ok((ends(length / 2.0), *radius)),
        Solid::Box { .. } => Ok((solid.points(), 0.0)),
        Solid::Cylinder { radius, length } => {
            let size = [2.0 * radius, 2.0 * radius, *length];
            Ok((Solid::Box { size }.points(), 0.0))
        }
        Solid::Mesh { .. } => {
            let points = meshes.points(solid).map_err(|error| {
                let text = format!("{error}; or give the body's size (--body)");
                Error::new(error.kind(), text)
            })?;
            let bound = |pick: fn(f64, f64) -> f64, from: f64| {
                points.iter().fold(Point3::new(from, from, from), |own, point| {
                    Point3::new(pick(own.x, point.x), pick(own.y, point.y), pick(own.z, point.z))
                })
            };
            let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
            let size = (high - low).into();
            let middle = nalgebra::center(&low, &high).coords;
            Ok((Solid::Box { size }.points().into_iter().map(|point| point + middle).collect(), 0.0))
        }
    }
}
