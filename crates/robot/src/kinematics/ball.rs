//! Bounds of a chain's reach: [`Ball`].

use nalgebra::{Point3, Unit, Vector3};

use super::{Chain, JointKind};

/// Number of sweeps over the points. After these the path does not shrink further.
const SWEEPS: usize = 200;

/// A ball that a point of the tip never leaves while prismatic joints are at zero, in the chain's length unit.
///
/// A point of an axis and a point of the next axis keep their distance for all joint values. So the path from the first
/// axis over one point of each axis bounds the distance of its ends. The points are moved along their axes until the
/// path is short.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The point, in the tip frame.
    pub point: Point3<f64>,
    /// The centre of the ball, in the base frame.
    pub middle: Point3<f64>,
    /// The radius.
    pub radius: f64,
}

impl Ball {
    /// Whether the ball contains a point of the base frame.
    pub fn holds(&self, place: &Point3<f64>) -> bool {
        (place - self.middle).norm() <= self.radius
    }
}

impl Chain {
    /// The ball of the tip itself. Its radius is at most [`Chain::reach`].
    #[doc(hidden)]
    pub fn ball(&self) -> Ball {
        let tip = Point3::from(self.base_from_tip().translation.vector);
        self.ball_of(Some(tip))
    }

    /// The smallest ball of a point of the last joint's axis. It excludes poses whose position is within reach but
    /// whose orientation is not. `None` without a revolute joint.
    #[doc(hidden)]
    pub fn wrist_ball(&self) -> Option<Ball> {
        self.turning().next().map(|_| self.ball_of(None))
    }

    /// The axes of the revolute joints.
    fn turning(&self) -> impl Iterator<Item = (Point3<f64>, Unit<Vector3<f64>>)> {
        let turns = self.joints().iter().filter(|joint| joint.kind == JointKind::Revolute);
        turns.map(|joint| (joint.location(), joint.direction()))
    }

    /// The ball of the point `end` of the tip at the zero configuration, or of a point of the last axis.
    fn ball_of(&self, end: Option<Point3<f64>>) -> Ball {
        let axes: Vec<_> = self.turning().collect();
        let mut points: Vec<Point3<f64>> = axes.iter().map(|(point, _)| *point).chain(end).collect();
        for _ in 0..SWEEPS {
            for (place, (point, direction)) in axes.iter().enumerate() {
                let foot = |other: usize| points.get(other).map(|other| foot(point, direction, other));
                let along = match (place.checked_sub(1).and_then(foot), foot(place + 1)) {
                    (Some(before), Some(next)) => between(before, next),
                    (Some((along, _)), None) | (None, Some((along, _))) => along,
                    (None, None) => 0.0,
                };
                points[place] = point + direction.scale(along);
            }
        }
        let radius = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let [middle, point] = [points.first(), points.last()].map(|end| end.copied().unwrap_or_default());
        Ball { point: self.base_from_tip().inverse() * point, middle, radius }
    }
}

/// The position along an axis of the foot of a point, and the point's distance from it.
fn foot(on_axis: &Point3<f64>, direction: &Vector3<f64>, point: &Point3<f64>) -> (f64, f64) {
    let along = direction.dot(&(point - on_axis));
    (along, (point - on_axis - direction * along).norm())
}

/// The position on an axis with the shortest path between two points, given by their feet and distances (reflection
/// principle).
fn between(a: (f64, f64), b: (f64, f64)) -> f64 {
    let across = a.1 + b.1;
    if across > 0.0 { (a.0 * b.1 + b.0 * a.1) / across } else { (a.0 + b.0) / 2.0 }
}
