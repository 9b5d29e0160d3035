//! Shapes on the floor: circles and polygons. Main type: [`Shape`].

use nalgebra::{Point2, Vector2};

use crate::{Error, ErrorKind, Result};

/// An outline on the floor \[m\].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A circle.
    Circle {
        /// Its centre.
        centre: Point2<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A polygon by its corners. It need not be convex; its sides do not cross.
    Polygon(Vec<Point2<f64>>),
}

/// The least penetration with which a shape touches a cell, in cells. Rounding errors are smaller, and no measurement
/// is so accurate.
const LEAST_DEPTH: f64 = 1e-9;

impl Shape {
    /// A rectangle: its centre, length, width \[m\] and anticlockwise rotation \[rad\].
    pub fn rectangle(centre: Point2<f64>, length: f64, width: f64, yaw: f64) -> Self {
        let (sine, cosine) = yaw.sin_cos();
        let corner = |(ahead, aside): (f64, f64)| {
            let (x, y) = (ahead * length / 2.0, aside * width / 2.0);
            centre + Vector2::new(cosine * x - sine * y, sine * x + cosine * y)
        };
        Shape::Polygon([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(corner).to_vec())
    }

    /// Checks that the shape is valid.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for numbers that are not finite, a radius below zero, fewer than three corners.
    pub fn check(&self) -> Result<()> {
        let finite = |point: &Point2<f64>| point.iter().all(|x| x.is_finite());
        let text = match self {
            Shape::Circle { centre, radius } if !(finite(centre) && radius.is_finite() && *radius >= 0.0) => {
                format!(
                    "a circle about ({}, {}) of radius {radius}: give finite numbers, the radius not below zero",
                    centre.x, centre.y
                )
            }
            Shape::Polygon(corners) if corners.len() < 3 => {
                format!("a polygon of {} corners: give at least three", corners.len())
            }
            Shape::Polygon(corners) if !corners.iter().all(finite) => {
                "a corner of a polygon is not finite; give finite numbers".to_owned()
            }
            _ => return Ok(()),
        };
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The shape after a rigid transformation and a scaling by `scale`.
    pub(super) fn moved(&self, place: &dyn Fn(&Point2<f64>) -> Point2<f64>, scale: f64) -> Self {
        match self {
            Shape::Circle { centre, radius } => Shape::Circle { centre: place(centre), radius: radius * scale },
            Shape::Polygon(corners) => Shape::Polygon(corners.iter().map(place).collect()),
        }
    }

    /// Its least and greatest coordinates.
    pub(super) fn bounds(&self) -> (Point2<f64>, Point2<f64>) {
        match self {
            Shape::Circle { centre, radius } => {
                let reach = Vector2::repeat(*radius);
                (centre - reach, centre + reach)
            }
            Shape::Polygon(corners) => {
                let fold = |pick: fn(f64, f64) -> f64| {
                    let all = corners.iter().copied();
                    all.reduce(|a, b| Point2::new(pick(a.x, b.x), pick(a.y, b.y))).unwrap_or_default()
                };
                (fold(f64::min), fold(f64::max))
            }
        }
    }

    /// Whether a point is inside.
    pub fn holds(&self, point: &Point2<f64>) -> bool {
        match self {
            Shape::Circle { centre, radius } => (point - centre).norm_squared() <= radius * radius,
            Shape::Polygon(_) => {
                // A ray to the right crosses the outline an odd number of times.
                let crosses = |(a, b): (Point2<f64>, Point2<f64>)| {
                    (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
                };
                self.sides().filter(|side| crosses(*side)).count() % 2 == 1
            }
        }
    }

    fn sides(&self) -> impl Iterator<Item = (Point2<f64>, Point2<f64>)> + '_ {
        let corners: &[Point2<f64>] = if let Shape::Polygon(corners) = self { corners } else { &[] };
        corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
    }

    /// Whether it has points inside the unit square with this lower left corner, farther from the sides than the
    /// tolerance.
    pub(super) fn touches(&self, corner: &Point2<f64>) -> bool {
        match self {
            Shape::Circle { centre, radius } => {
                let near = |value: f64, low: f64| value.clamp(low + LEAST_DEPTH, low + 1.0 - LEAST_DEPTH);
                let nearest = Point2::new(near(centre.x, corner.x), near(centre.y, corner.y));
                (nearest - centre).norm_squared() < radius * radius
            }
            Shape::Polygon(_) => {
                self.holds(&(corner + Vector2::repeat(0.5))) || self.sides().any(|side| enters(side, corner))
            }
        }
    }
}

/// Twice the signed area of a polygon, positive where its corners are anticlockwise.
pub(crate) fn signed_area(corners: &[Point2<f64>]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum()
}

/// Whether a side has points inside the unit square with this lower left corner, farther from its sides than the
/// tolerance (W. Liang and B. Barsky, ACM Transactions on Graphics 3, 1984).
fn enters((a, b): (Point2<f64>, Point2<f64>), corner: &Point2<f64>) -> bool {
    let offset = b - a;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (axis, low) in [(0, corner.x), (1, corner.y)] {
        let (from, along, size) = (a[axis] - low - LEAST_DEPTH, offset[axis], 1.0 - 2.0 * LEAST_DEPTH);
        if along == 0.0 {
            if from <= 0.0 || from >= size {
                return false;
            }
            continue;
        }
        let (into, out) = (-from / along, (size - from) / along);
        (first, last) = (first.max(into.min(out)), last.min(into.max(out)));
    }
    first < last
}
