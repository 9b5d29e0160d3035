//! How far a chain gets: [`Chain::ball`].

use nalgebra::{Point3, Unit, Vector3};

use super::{Chain, JointKind};

/// How often each point is moved; the way over them then shrinks no more.
const SWEEPS: usize = 200;

impl Chain {
    /// A ball that the tip never leaves while prismatic joints stand at zero: its middle and its radius in the chain's length unit.
    ///
    /// A point of an axis and one of the next axis stay as far apart as they are, whatever the joints do: the way from the first axis over one point of each to the tip is never shorter than the tip is away. The points are moved along their axes until that way is short. It is never longer than [`Chain::reach`].
    pub fn ball(&self) -> (Point3<f64>, f64) {
        let turns = self.joints().iter().filter(|joint| joint.kind == JointKind::Revolute);
        let axes: Vec<(Point3<f64>, Unit<Vector3<f64>>)> =
            turns.map(|joint| (joint.location(), joint.direction())).collect();
        let mut points: Vec<Point3<f64>> = axes.iter().map(|(point, _)| *point).collect();
        points.push(Point3::from(self.base_from_tip().translation.vector));
        for _ in 0..SWEEPS {
            for (place, (point, direction)) in axes.iter().enumerate() {
                let next = foot(point, direction, &points[place + 1]);
                let before = place.checked_sub(1).map(|before| foot(point, direction, &points[before]));
                points[place] = point + direction.scale(before.map_or(next.0, |before| between(before, next)));
            }
        }
        let length = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        (points[0], length)
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
