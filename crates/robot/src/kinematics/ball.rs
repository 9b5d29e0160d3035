//! How far a chain gets: [`Ball`].

use nalgebra::{Point3, Unit, Vector3};

use super::{Chain, JointKind};

/// How often each point is moved; the way over them then shrinks no more.
const SWEEPS: usize = 200;

/// What a point of a chain's tip never leaves while prismatic joints are at zero, in the chain's length unit.
///
/// A point of an axis and one of the next axis stay as far apart as they are, whatever the joints do: the way from the first axis over one point of each is never shorter than its ends are apart. The points are moved along their axes until that way is short.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The point, in the frame of the tip.
    pub point: Point3<f64>,
    /// The middle of the ball, in the frame of the base.
    pub middle: Point3<f64>,
    /// The radius.
    pub radius: f64,
}

impl Ball {
    /// Whether a place in the frame of the base is within.
    pub fn holds(&self, place: &Point3<f64>) -> bool {
        (place - self.middle).norm() <= self.radius
    }
}

impl Chain {
    /// The ball of the tip itself; its radius is never more than [`Chain::reach`].
    pub fn ball(&self) -> Ball {
        let tip = Point3::from(self.base_from_tip().translation.vector);
        self.ball_of(Some(tip))
    }

    /// The ball of the point of the last joint's axis whose ball is the smallest: the tip may be near enough while its orientation asks too much. `None` where nothing turns.
    pub fn wrist_ball(&self) -> Option<Ball> {
        self.turning().next().map(|_| self.ball_of(None))
    }

    /// The axes of the joints that turn.
    fn turning(&self) -> impl Iterator<Item = (Point3<f64>, Unit<Vector3<f64>>)> {
        let turns = self.joints().iter().filter(|joint| joint.kind == JointKind::Revolute);
        turns.map(|joint| (joint.location(), joint.direction()))
    }

    /// The ball of a point that stands at `end` at zero, or of one of the last axis.
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

/// Where the foot of a point on an axis is, along it, and how far the point is from there.
fn foot(on_axis: &Point3<f64>, direction: &Vector3<f64>, point: &Point3<f64>) -> (f64, f64) {
    let along = direction.dot(&(point - on_axis));
    (along, (point - on_axis - direction * along).norm())
}

/// The place of an axis over which the way between two points, by their feet, is the shortest: as for a mirror.
fn between(a: (f64, f64), b: (f64, f64)) -> f64 {
    let across = a.1 + b.1;
    if across > 0.0 { (a.0 * b.1 + b.0 * a.1) / across } else { (a.0 + b.0) / 2.0 }
}
