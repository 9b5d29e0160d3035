//! Robots made of bodies with given screws and inertias.

use groebot_algebra::number::BigRational;
use groebot_robot::dynamics::Model;
use groebot_robot::kinematics::{ExactRotation, Placement};
use groebot_robot::model::{Joint, JointType, Link, Mass, Robot, RobotParts};
use groebot_robot::spatial::{Inertia, Pose, Screw};

/// A body with its joint.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// The parent part; `None` for the base.
    pub parent: Option<usize>,
    /// The joint, in the base frame at the zero configuration.
    pub screw: Screw,
    /// The frame of the body in the base frame at the zero configuration.
    pub base_from_link: Pose,
    /// Its inertia, in this frame.
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
