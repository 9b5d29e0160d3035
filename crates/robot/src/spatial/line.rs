//! Relation of two axes: parallel, intersecting or skew, with the points where they are nearest.

use nalgebra::Point3;

use super::Axis;

/// Maximum angle \[rad\] between directions that count as parallel.
pub(crate) const PARALLEL: f64 = 1e-9;

/// Relation of two lines. Lengths in the unit of the axes' points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relation {
    /// Coaxial; the directions may be opposite.
    Coincident,
    /// Parallel or antiparallel, `distance` apart.
    Parallel {
        /// The distance of the two lines.
        distance: f64,
    },
    /// They intersect in one point.
    Intersecting {
        /// The point of intersection.
        point: Point3<f64>,
    },
    /// Neither parallel nor intersecting.
    Skew {
        /// The smallest distance of the two lines.
        distance: f64,
        /// The angle between their directions, in (0, pi) \[rad\].
        angle: f64,
    },
}

impl Axis {
    /// Whether the two lines are parallel or antiparallel, to [`PARALLEL`].
    pub(crate) fn is_parallel(&self, other: &Axis) -> bool {
        self.direction().cross(&other.direction()).norm() <= PARALLEL
    }

    /// The distance of `p` from the line.
    pub fn distance_to(&self, p: &Point3<f64>) -> f64 {
        (p - self.foot(p)).norm()
    }

    /// The points of this line and of `other` where the two are nearest; `None` when they are parallel.
    pub fn nearest_points(&self, other: &Axis) -> Option<(Point3<f64>, Point3<f64>)> {
        if self.is_parallel(other) {
            return None;
        }
        let (w1, w2) = (self.direction(), other.direction());
        let (normal, apart) = (w1.cross(&w2), other.point() - self.point());
        let scale = normal.norm_squared();
        let along = |w: &nalgebra::Vector3<f64>| apart.cross(w).dot(&normal) / scale;
        Some((self.point() + w1.scale(along(&w2)), other.point() + w2.scale(along(&w1))))
    }

    /// The relation of the lines. Distances up to `tolerance` count as zero, angles up to [`PARALLEL`] as parallel.
    pub(crate) fn relation(&self, other: &Axis, tolerance: f64) -> Relation {
        match self.nearest_points(other) {
            None => match self.distance_to(&other.point()) {
                distance if distance <= tolerance => Relation::Coincident,
                distance => Relation::Parallel { distance },
            },
            Some((a, b)) => match (b - a).norm() {
                distance if distance <= tolerance => Relation::Intersecting { point: nalgebra::center(&a, &b) },
                distance => {
                    let (w1, w2) = (self.direction(), other.direction());
                    Relation::Skew { distance, angle: w1.cross(&w2).norm().atan2(w1.dot(&w2)) }
                }
            },
        }
    }
}
