//! Inertia and Coriolis matrices against the motion of point masses.

mod clearance;
mod coriolis;
mod equations;
mod exact;
mod identify;
mod lagrange;
mod pinocchio;
mod placed;
pub mod samples;

use groebot::dynamics::Model;
use groebot::kinematics::{ExactRotation, Placement};
use groebot::model::{Joint, JointType, Link, Mass, Robot, RobotParts};
use groebot::number::BigRational;
use groebot::spatial::{Inertia, Pose, Screw};
use nalgebra::{DVector, Matrix3, Point3, Vector3};
use proptest::prelude::*;

use crate::kinematics::jacobian::screw;
use crate::spatial::{pose, vector};

/// A rigid body as point masses: (mass \[kg\], place in the link's frame \[m\]).
#[derive(Clone, Debug)]
pub struct Cloud(pub Vec<(f64, Vector3<f64>)>);

impl Cloud {
    pub fn mass(&self) -> f64 {
        self.0.iter().map(|(mass, _)| mass).sum()
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.0.iter().map(|(mass, place)| place * *mass).sum::<Vector3<f64>>() / self.mass()
    }

    /// Sum of `m (d.d 1 - d d')` over the masses, `d` from the centre.
    pub fn tensor(&self) -> Matrix3<f64> {
        let terms = self.0.iter().map(|(mass, place)| {
            let d = place - self.centre();
            (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * *mass
        });
        terms.sum()
    }

    pub fn inertia(&self) -> Inertia {
        Inertia::new(self.mass(), Point3::from(self.centre()), self.tensor()).unwrap()
    }
}

pub fn cloud() -> impl Strategy<Value = Cloud> {
    prop::collection::vec((0.1..2.0_f64, vector(0.5)), 4..7).prop_map(Cloud)
}

/// A body behind a joint.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// The part that carries it; the base where there is none.
    pub parent: Option<usize>,
    /// The joint, in the base frame at the zero configuration.
    pub screw: Screw,
    /// The frame of the body in the base frame at the zero configuration.
    pub base_from_link: Pose,
    /// What it weighs, in that frame.
    pub inertia: Inertia,
}

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

fn placement(pose: &Pose) -> Placement {
    let [x, y, z, w] = [0, 1, 2, 3].map(|i| exact(pose.rotation.coords[i]));
    let origin = [0, 1, 2].map(|i| exact(pose.translation.vector[i]));
    Placement { rotation: ExactRotation::from_quaternion(&[x, y, z, w]).unwrap(), meant: None, origin }
}

fn weighing(name: &str, inertia: &Inertia) -> Link {
    let centre = Pose::translation(inertia.centre_of_mass().x, inertia.centre_of_mass().y, inertia.centre_of_mass().z);
    let tensor = inertia.rotational();
    let moments = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| exact(tensor[at]));
    Link {
        mass: Some(Mass { mass: exact(inertia.mass()), origin: placement(&centre).into(), moments }),
        ..Link::new(name)
    }
}

/// The model of a robot with these parts: each has a link at its joint's axis, and the body fixed to that.
pub fn model(base: Option<&Inertia>, parts: &[Part]) -> Model {
    let mut robot = RobotParts { name: "parts".into(), ..RobotParts::default() };
    robot.links.push(base.map_or(Link::new("base"), |inertia| weighing("base", inertia)));
    let at = |part: &Part| match part.screw {
        Screw::Revolute(axis) => Pose::translation(axis.point().x, axis.point().y, axis.point().z),
        Screw::Prismatic(_) => Pose::identity(),
    };
    for (place, part) in parts.iter().enumerate() {
        let [arm, body] = ["arm", "body"].map(|name| format!("{name}{place}"));
        let (parent, base_from_parent) = match part.parent {
            Some(parent) => (format!("arm{parent}"), at(&parts[parent])),
            None => ("base".to_owned(), Pose::identity()),
        };
        let (kind, direction) = match part.screw {
            Screw::Revolute(axis) => (JointType::Continuous, axis.direction()),
            Screw::Prismatic(direction) => (JointType::Prismatic, direction),
        };
        robot.joints.push(Joint {
            origin: placement(&base_from_parent.inv_mul(&at(part))).into(),
            axis: [0, 1, 2].map(|i| exact(direction[i])),
            limits: Some((-9.0, 9.0)),
            ..Joint::new(&format!("q{place}"), kind, &parent, &arm)
        });
        let fixed = placement(&at(part).inv_mul(&part.base_from_link)).into();
        robot
            .joints
            .push(Joint { origin: fixed, ..Joint::new(&format!("fixed{place}"), JointType::Fixed, &arm, &body) });
        robot.links.extend([Link::new(&arm), weighing(&body, &part.inertia)]);
    }
    Model::new(&Robot::new(robot).unwrap()).unwrap()
}

/// A manipulator, the masses of its bodies, and a state.
#[derive(Clone, Debug)]
pub struct Case {
    arm: Model,
    parts: Vec<Part>,
    clouds: Vec<Cloud>,
    q: Vec<f64>,
    velocity: Vec<f64>,
}

impl Case {
    /// The joint values after the time `t` at constant velocity.
    fn after(&self, t: f64) -> Vec<f64> {
        self.q.iter().zip(&self.velocity).map(|(q, rate)| q + t * rate).collect()
    }

    fn rates(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.velocity)
    }

    fn base_from_link(&self, link: usize, q: &[f64]) -> Pose {
        let zero = self.parts[link].base_from_link;
        self.parts[..=link].iter().zip(q).rev().fold(zero, |pose, (part, q)| part.screw.exp(*q) * pose)
    }

    /// Half the sum of mass times squared velocity over the points of `link`, the velocities by differences.
    fn kinetic_energy_of(&self, link: usize) -> f64 {
        let place = |point: &Vector3<f64>, t| (self.base_from_link(link, &self.after(t)) * Point3::from(*point)).coords;
        let points = self.clouds[link].0.iter();
        points
            .map(|(mass, point)| crate::kinematics::jacobian::slope(|t| place(point, t)).norm_squared() * mass / 2.0)
            .sum()
    }
}

/// Manipulators of up to four joints.
pub fn case() -> impl Strategy<Value = Case> {
    (1..5_usize).prop_flat_map(|n| {
        let links = prop::collection::vec((screw(), pose(), cloud()), n);
        let numbers = || prop::collection::vec(-2.0..2.0_f64, n);
        (links, numbers(), numbers()).prop_map(|(links, q, velocity)| {
            let part = |(place, (screw, base_from_link, cloud)): (usize, &(Screw, Pose, Cloud))| Part {
                parent: place.checked_sub(1),
                screw: *screw,
                base_from_link: *base_from_link,
                inertia: cloud.inertia(),
            };
            let parts: Vec<Part> = links.iter().enumerate().map(part).collect();
            let clouds = links.into_iter().map(|(.., cloud)| cloud).collect();
            Case { arm: model(None, &parts), parts, clouds, q, velocity }
        })
    })
}
