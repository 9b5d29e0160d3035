//! The equations of a task at a target ([`Goal`]).

use super::arm::{Arm, Target, Task};
use super::elimination::Rows;
use crate::arithmetic::Arithmetic;
use crate::six_axes::vector::{cross, dot, scale, sub};
use crate::six_axes::{Rigid, Vector};
use crate::trigonometry::{cosine, sine};

/// The equations: coordinates of the position, a rotation, and scalar products of a vector that is fixed in the base with one that is fixed on the tip. Lengths
/// are relative to [`Arm::length`].
#[derive(Clone, Copy)]
pub(super) struct Goal {
    position: Vector,
    /// The coordinates that are compared, and their number.
    coordinates: [usize; 3],
    positions: usize,
    /// The columns of the rotation.
    columns: [Vector; 3],
    has_rotation: bool,
    /// The most frequent case: the equations are three coordinates and a rotation.
    is_pose: bool,
    fixed: [Vector; 2],
    moving: [Vector; 2],
    products: usize,
    /// A vector that is fixed in the base, and the one that is fixed on the tip and has this image at solutions. The equations also hold for the opposite image.
    toward: Option<[Vector; 2]>,
}

const NONE: Goal = Goal {
    position: [0.0; 3],
    coordinates: [0, 1, 2],
    positions: 0,
    columns: [[0.0; 3]; 3],
    has_rotation: false,
    is_pose: false,
    fixed: [[0.0; 3]; 2],
    moving: [[0.0; 3]; 2],
    products: 0,
    toward: None,
};

const AXES: [Vector; 3] = Rigid::NONE.rotation;

/// Two unit vectors that are orthogonal to a unit vector and to each other.
pub(super) fn across(v: &Vector) -> [Vector; 2] {
    let mut least = 0;
    for k in 1..3 {
        if v[k].abs() < v[least].abs() {
            least = k;
        }
    }
    let first = cross(v, &AXES[least]);
    let first = scale(&first, 1.0 / Arithmetic::sqrt(dot(&first, &first)));
    [first, cross(v, &first)]
}

impl Goal {
    /// The equations of the arm's task at a target.
    pub fn new(arm: &Arm, target: &Target) -> Goal {
        let mut goal = NONE;
        let point = scale(&[target[0], target[1], target[2]], 1.0 / arm.length);
        let after = [target[3], target[4], target[5]];
        match arm.task {
            Task::Pose => {
                goal.place(point, 3);
                goal.rotate(&target[3..]);
                goal.is_pose = true;
            }
            Task::Position => goal.place(point, 3),
            Task::Rotation => goal.rotate(target),
            Task::Ray { direction } => {
                goal.place(point, 3);
                goal.aim(across(&after), [direction; 2], 2);
                goal.toward = Some([after, direction]);
            }
            Task::Direction { direction } => {
                let image = [target[0], target[1], target[2]];
                goal.aim(across(&image), [direction; 2], 2);
                goal.toward = Some([image, direction]);
            }
            Task::PositionPitchRoll => {
                goal.place(point, 3);
                let [pitch, roll] = [after[0], after[1]];
                let up = [-sine(pitch), cosine(pitch) * sine(roll), cosine(pitch) * cosine(roll)];
                goal.aim([AXES[2]; 2], across(&up), 2);
                goal.toward = Some([AXES[2], up]);
            }
            Task::PositionYaw { axis, direction } => {
                goal.place(point, 3);
                goal.turn(axis, after[0], direction);
            }
            Task::PlanarPosition { coordinates: [a, b] } => {
                goal.place(plane_point(point, a, b), 2);
                goal.coordinates = [a, b, 3 - a - b];
            }
            Task::PlanarPose { coordinates: [a, b] } => {
                goal.place(plane_point(point, a, b), 2);
                goal.coordinates = [a, b, 3 - a - b];
                let normal = 3 - a - b;
                goal.turn(normal, target[2], arm.tip.inverse().turned(&AXES[(normal + 1) % 3]));
            }
        }
        goal
    }

    fn place(&mut self, position: Vector, count: usize) {
        self.position = position;
        self.positions = count;
    }

    /// Compares the rotation, given by rows.
    fn rotate(&mut self, rows: &[f64]) {
        for k in 0..3 {
            self.columns[k] = [rows[k], rows[3 + k], rows[6 + k]];
        }
        self.has_rotation = true;
    }

    fn aim(&mut self, fixed: [Vector; 2], moving: [Vector; 2], count: usize) {
        self.fixed = fixed;
        self.moving = moving;
        self.products = count;
    }

    /// Compares the angle of a direction about a coordinate axis.
    fn turn(&mut self, axis: usize, angle: f64, direction: Vector) {
        let mut normal = [0.0; 3];
        normal[(axis + 1) % 3] = -sine(angle);
        normal[(axis + 2) % 3] = cosine(angle);
        self.aim([normal; 2], [direction; 2], 1);
        let mut image = [0.0; 3];
        image[(axis + 1) % 3] = cosine(angle);
        image[(axis + 2) % 3] = sine(angle);
        self.toward = Some([image, direction]);
    }

    /// The number of equations.
    pub fn rows(&self) -> usize {
        self.positions + if self.has_rotation { 3 } else { 0 } + self.products
    }

    /// The values of the equations at a pose of the tip. Near the target, those of the rotation are the components of the rotation vector.
    pub fn values(&self, tip: &Rigid) -> Rows {
        let mut values = [0.0; 6];
        for k in 0..self.positions {
            let c = self.coordinates[k];
            values[k] = tip.translation[c] - self.position[c];
        }
        if self.has_rotation {
            let [x, y, z] = &tip.rotation;
            for k in 0..3 {
                let turned = cross(&self.columns[k], &[x[k], y[k], z[k]]);
                for c in 0..3 {
                    values[self.positions + c] += 0.5 * turned[c];
                }
            }
        }
        for k in 0..self.products {
            values[self.positions + k] = dot(&self.fixed[k], &tip.turned(&self.moving[k]));
        }
        values
    }

    /// Whether a tip where the equations hold has the target's orientation, and not one that is turned by half a turn.
    pub fn is_toward(&self, tip: &Rigid) -> bool {
        let mut along = 1.0;
        if self.has_rotation {
            along = 0.0;
            for k in 0..3 {
                for c in 0..3 {
                    along += self.columns[k][c] * tip.rotation[c][k];
                }
            }
        }
        if let Some([image, direction]) = &self.toward {
            along = dot(image, &tip.turned(direction));
        }
        along > 0.0
    }

    /// The images of the vectors that are fixed on the tip.
    pub fn images(&self, tip: &Rigid) -> [Vector; 2] {
        let mut images = [[0.0; 3]; 2];
        for k in 0..self.products {
            images[k] = tip.turned(&self.moving[k]);
        }
        images
    }

    /// The rates of the equations for a linear velocity of the tip's origin and an angular velocity.
    #[inline(always)]
    pub fn rates(&self, images: &[Vector; 2], linear: &Vector, angular: &Vector) -> Rows {
        if self.is_pose {
            return [linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]];
        }
        let mut rates = [0.0; 6];
        for k in 0..self.positions {
            rates[k] = linear[self.coordinates[k]];
        }
        if self.has_rotation {
            for k in 0..3 {
                rates[self.positions + k] = angular[k];
            }
        }
        for k in 0..self.products {
            rates[self.positions + k] = dot(&self.fixed[k], &cross(angular, &images[k]));
        }
        rates
    }

    /// The second derivatives of the equations for the accelerations and the angular velocity of the tip.
    pub fn accelerations(&self, images: &[Vector; 2], linear: &Vector, angular: &Vector, velocity: &Vector) -> Rows {
        let mut rates = self.rates(images, linear, angular);
        for k in 0..self.products {
            let centripetal = cross(velocity, &cross(velocity, &images[k]));
            rates[self.positions + k] += dot(&self.fixed[k], &centripetal);
        }
        rates
    }
}

/// The point whose coordinates `a` and `b` are the first two numbers.
fn plane_point(numbers: Vector, a: usize, b: usize) -> Vector {
    let mut point = [0.0; 3];
    point[a] = numbers[0];
    point[b] = numbers[1];
    point
}

/// The centripetal and tangential acceleration of a point at `r` from another one of its body.
pub(super) fn carried(r: &Vector, angular: &Vector, velocity: &Vector) -> Vector {
    let tangential = cross(angular, r);
    let inward = cross(velocity, &cross(velocity, r));
    sub(&tangential, &scale(&inward, -1.0))
}
