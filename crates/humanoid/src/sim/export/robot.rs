//! A robot as a scene, at rest or moved by a trajectory.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::bones::{self, Seen};
use super::{Body, Material, Node, Part, Scene};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;
use groebot_robot::model::{Joint, JointType, Link, Meshes, Robot, Shape, Solid};
use groebot_robot::motion::{JointTrack, Trajectory};
use groebot_robot::spatial::Pose;
use groebot_robot::spatial::exact::normalized;

/// Readers compute in single precision. Where the base goes further from the origin than this \[m\], a node above it
/// has the position rounded to single precision, and the base has the rest.
const NEAR: f64 = 8.0;

impl Scene {
    /// The robot, moved by `trajectory` or at rest; meshes only where their folders are given. There is a node per
    /// link, below one that rotates the robot's z axis to y.
    ///
    /// # Errors
    /// As [`Robot::check`] and [`Trajectory::check`]; [`ErrorKind::UnknownName`] for a joint that the robot does not
    /// have; [`ErrorKind::BadValue`] for a joint of another type than in the trajectory, no sample, or a robot without
    /// anything visible.
    pub fn of_robot(robot: &Robot, meshes: Option<&Meshes>, trajectory: Option<&Trajectory>) -> Result<Self> {
        robot.check()?;
        let values = values(robot, trajectory)?;
        let mut scene = Scene { title: robot.name().to_owned(), ..Scene::default() };
        let mut link = |own: &Link| {
            let (parts, hidden) = own.drawn(|shape| part(shape, meshes, &mut scene.notes));
            Seen { parts, hidden }
        };
        let mut seen: Vec<Seen> = robot.links().iter().map(&mut link).collect();
        bones::add(robot, &mut seen);
        if seen.iter().all(|link| link.parts.is_empty()) {
            return Err(robot.unseen(&scene.notes));
        }
        if let Some(trajectory) = trajectory {
            scene.times = trajectory.times.iter().map(|time| time - trajectory.times[0]).collect();
        }
        scene.add_base(robot, trajectory.map_or(&[], |trajectory| &trajectory.base));
        let mut places = vec![scene.nodes.len() - 1; robot.links().len()];
        for joint in robot.limb_by_limb() {
            let (parent, child) = robot.ends(joint);
            let (own, origin) = (&robot.joints()[joint], robot.joints()[joint].origin.pose());
            let poses: Vec<Pose> = values[joint].iter().map(|value| origin * motion(own, *value)).collect();
            places[child] = scene.nodes.len();
            scene.nodes.push(Node::moved(&own.child, Some(places[parent]), &poses));
        }
        for (place, link) in places.iter().zip(seen) {
            scene.nodes[*place].parts = link.parts;
        }
        Ok(scene)
    }

    /// Adds the node that rotates the robot's z axis to y, and the robot's root below it.
    fn add_base(&mut self, robot: &Robot, base: &[Pose]) {
        let mut base = if base.is_empty() { vec![Pose::identity()] } else { base.to_vec() };
        if base.iter().any(|pose| pose.translation.vector.amax() > NEAR) {
            let mut far = Vec::with_capacity(base.len());
            for pose in &mut base {
                let single = pose.translation.vector.map(|x| f64::from(x as f32));
                far.push(Pose::from(Translation3::new(single.x, single.z, -single.y)));
                pose.translation.vector -= single;
            }
            self.nodes.push(Node::moved("far base", None, &far));
        }
        let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -FRAC_PI_2);
        let above = self.nodes.len().checked_sub(1);
        self.nodes.push(Node::at("z up", above, Pose::from_parts(Translation3::identity(), upright)));
        self.nodes.push(Node::moved(robot.root(), Some(self.nodes.len() - 1), &base));
    }
}

/// The transformation of a joint at this value, relative to the joint's origin.
fn motion(joint: &Joint, value: f64) -> Pose {
    match joint.kind {
        JointType::Prismatic => Translation3::from(normalized(&joint.axis).into_inner() * value).into(),
        JointType::Revolute | JointType::Continuous => {
            Pose::from_parts(Translation3::identity(), UnitQuaternion::from_axis_angle(&normalized(&joint.axis), value))
        }
        _ => Pose::identity(),
    }
}

/// The values of each joint, one per sample or one for all: those of the trajectory, those of the leader for followers,
/// else the value within limits that is nearest to zero.
fn values(robot: &Robot, trajectory: Option<&Trajectory>) -> Result<Vec<Vec<f64>>> {
    let mut given: Vec<Option<Vec<f64>>> = vec![None; robot.joints().len()];
    if let Some(trajectory) = trajectory {
        trajectory.check()?;
        if trajectory.times.is_empty() {
            return Err(Error::new(ErrorKind::BadValue, "the trajectory has no sample; give at least one"));
        }
        for (column, track) in trajectory.joints.iter().enumerate() {
            given[place(robot, track)?] = Some(trajectory.q.iter().map(|q| q[column]).collect());
        }
    }
    let rest = |joint: &Joint| vec![joint.limits.map_or(0.0, |(low, high)| 0f64.max(low).min(high))];
    let led = |joint: &Joint| {
        let law = robot.law(joint);
        let leader = robot.joints().iter().position(|other| other.name == law.leader && law.leader != joint.name)?;
        let leading = given[leader].clone().unwrap_or_else(|| rest(&robot.joints()[leader]));
        Some(leading.into_iter().map(|value| law.value(value)).collect())
    };
    let value =
        |(place, joint): (usize, &Joint)| given[place].clone().or_else(|| led(joint)).unwrap_or_else(|| rest(joint));
    Ok(robot.joints().iter().enumerate().map(value).collect())
}

/// The index of a track's joint.
fn place(robot: &Robot, track: &JointTrack) -> Result<usize> {
    let place = robot.joint(&track.name)?;
    match (robot.joints()[place].kind, track.slides) {
        (JointType::Prismatic, true) | (JointType::Revolute | JointType::Continuous, false) => Ok(place),
        (kind, _) => {
            let (name, unit, kind) = (shown(&track.name), track.unit(), kind.name());
            let text = format!("joint `{name}`: the trajectory gives it in {unit}, but in the robot it is {kind}");
            Err(Error::new(ErrorKind::BadValue, text))
        }
    }
}

/// The shape, unless it is a mesh that is not requested or cannot be read.
fn part(own: &Shape, meshes: Option<&Meshes>, notes: &mut Vec<String>) -> Option<Part> {
    let body = match &own.solid {
        mesh @ Solid::Mesh { .. } => Body::Surface(meshes?.triangles_or_note(mesh, notes)?),
        solid => Body::Solid(solid.clone()),
    };
    let [red, green, blue, opacity] = own.colour.unwrap_or([0.78, 0.8, 0.84, 1.0]);
    let material = Material { diffuse: [red, green, blue], opacity, ..Material::default() };
    Some(Part { pose: own.pose(), body, material })
}
