//! Contact areas of soles: from the shapes of a description, or assumed from the length of the leg.

use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

use super::polygon::Polygon;
use crate::{Error, Result};
use groebot_robot::dynamics::Model;
use groebot_robot::model::{Meshes, Robot, Shape};

/// Points within this height of a sole's lowest point touch a slightly compliant floor \[m\].
const FLAT: f64 = 2e-3;
/// The assumed length and width of a sole, and its length behind the ankle, as fractions of the leg's length: those of
/// NAO, TALOS and iCub are 0.24..0.35, 0.13..0.22 and 0.08..0.12.
const ASSUMED: [f64; 3] = [0.26, 0.14, 0.09];
/// The assumed height of an ankle above the floor, as a fraction of the leg's length: 0.12..0.22 in the same robots.
const ASSUMED_ANKLE: f64 = 0.12;

/// The greatest pitch of a sole at the zero configuration \[rad\]: 20 degrees.
const MOST_PITCH: f64 = 0.35;
/// The least horizontal distance between two points that give a sole its pitch \[m\].
const APART: f64 = 0.02;

/// The contact area of a sole.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    /// The rotation of the sole about the torso's y axis at the zero configuration \[rad\]; negative with the toes up.
    pub pitch: f64,
    /// The distance of the sole's plane from its link's origin, along the normal of the sole \[m\].
    pub height: f64,
    /// The corners, from the link's origin, in the axes of the torso turned by the pitch \[m\].
    pub corners: Vec<Point2<f64>>,
}

impl Outline {
    /// A contact area that is level at the zero configuration.
    pub fn level((height, corners): (f64, Vec<Point2<f64>>)) -> Self {
        Outline { pitch: 0.0, height, corners }
    }

    /// The axes of the sole in those of the torso at the zero configuration.
    pub fn axes(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.pitch)
    }
}

/// The points of all collision shapes of the rigid body of `link`, or of its visual shapes if it has no collision
/// shape, in the axes of the torso at the zero configuration, from the link's origin. Also the errors of meshes that
/// cannot be read.
pub(super) fn points(robot: &Robot, model: &Model, link: usize, meshes: &Meshes) -> (Vec<Point3<f64>>, Vec<Error>) {
    let (body, torso_from_sole) = model.link(link);
    let at = torso_from_sole.translation.vector;
    let (mut points, mut errors) = (Vec::new(), Vec::new());
    let own = || (0..robot.links().len()).filter(|place| model.link(*place).0 == body);
    let has_collisions = own().any(|place| !robot.links()[place].collisions.is_empty());
    for place in own() {
        let torso_from_link = model.link(place).1;
        let link = &robot.links()[place];
        let shapes: &[Shape] = if has_collisions { &link.collisions } else { &link.visuals };
        for shape in shapes {
            let torso_from_shape = torso_from_link * shape.pose();
            match meshes.points(&shape.solid) {
                Ok(own) => points.extend(own.into_iter().map(|point| torso_from_shape * point - at)),
                Err(error) => errors.push(error),
            }
        }
    }
    (points, errors)
}

/// The contact area of the lowest points. Where these have no area, because the sole is not level at the zero
/// configuration, it is that of the face next to them with the least pitch.
pub(super) fn lowest(points: &[Point3<f64>]) -> Outline {
    let level = Outline::level(touched(points));
    if level.corners.len() >= 3 {
        return level;
    }
    let pitched = |pitch: f64| {
        let sole_from_torso = Outline { pitch, ..level.clone() }.axes().inverse();
        let turned: Vec<Point3<f64>> = points.iter().map(|point| sole_from_torso * point).collect();
        let (height, corners) = touched(&turned);
        Outline { pitch, height, corners }
    };
    let mut pitches = pitches(points);
    pitches.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let found = pitches.into_iter().map(pitched).find(|outline| outline.corners.len() >= 3);
    found.unwrap_or(level)
}

/// The pitches of the faces that meet at the lowest point, forward and backward of it \[rad\].
fn pitches(points: &[Point3<f64>]) -> Vec<f64> {
    let Some(lowest) = points.iter().min_by(|a, b| a.z.total_cmp(&b.z)) else { return Vec::new() };
    let slope = |ahead: f64| {
        let other = points.iter().map(|point| (ahead * (point.x - lowest.x), point.z - lowest.z));
        let slopes = other.filter(|(away, _)| *away >= APART).map(|(away, higher)| higher.atan2(away));
        -ahead * slopes.fold(f64::INFINITY, f64::min)
    };
    [slope(1.0), slope(-1.0)].into_iter().filter(|pitch| pitch.abs() <= MOST_PITCH).collect()
}

/// The height of the lowest points, and their convex hull.
fn touched(points: &[Point3<f64>]) -> (f64, Vec<Point2<f64>>) {
    let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    let touching: Vec<Point2<f64>> = points.iter().filter(|point| point.z <= lowest + FLAT).map(Point3::xy).collect();
    let height = if lowest.is_finite() { lowest } else { 0.0 };
    (height, Polygon::hull(&touching).corners().to_vec())
}

/// The contact area of a link by its shapes.
///
/// # Errors
/// Those of [`Meshes::points`].
pub(super) fn touching(robot: &Robot, model: &Model, link: usize, meshes: &Meshes) -> Result<Outline> {
    let (points, errors) = points(robot, model, link, meshes);
    match errors.into_iter().next() {
        None => Ok(lowest(&points)),
        Some(error) => {
            let text = format!("{error}; or give the outline of the soles (--outline)");
            Err(Error::new(error.kind(), text))
        }
    }
}

/// A rectangular contact area by the length of the leg. `ankle` is the position of the ankle from the link's origin in
/// the axes of the torso: a link below its ankle is in the plane of the sole.
pub(super) fn assumed(length: f64, ankle: &Point3<f64>) -> Outline {
    let [long, wide, behind] = ASSUMED.map(|share| share * length);
    let is_sole = ankle.z > 0.25 * ASSUMED_ANKLE * length;
    let height = if is_sole { 0.0 } else { ankle.z - ASSUMED_ANKLE * length };
    let corner = |x: f64, y: f64| Point2::new(ankle.x + x, ankle.y + y);
    let (front, side) = (long - behind, wide / 2.0);
    let corners = vec![corner(-behind, -side), corner(front, -side), corner(front, side), corner(-behind, side)];
    Outline::level((height, corners))
}

/// The least and the greatest coordinates of a contact area.
pub(super) fn bounds(corners: &[Point2<f64>]) -> (Point2<f64>, Point2<f64>) {
    let start = (Point2::new(f64::INFINITY, f64::INFINITY), Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    corners.iter().fold(start, |(low, high), corner| (low.inf(corner), high.sup(corner)))
}
