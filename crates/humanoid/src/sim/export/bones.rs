//! Bones between joints, as `viewer/src/body.ts` draws them. Thin bones connect shapes; a robot without shapes is drawn
//! with thick bones and its axes.

use nalgebra::{Unit, UnitQuaternion, Vector3};

use super::{Body, Material, Part};
use groebot_robot::model::{Joint, Robot, Solid};
use groebot_robot::spatial::Pose;
use groebot_robot::spatial::exact::normalized;

/// A smaller robot is at one point \[m\].
const APART: f64 = 1e-6;
/// The radius of a bone without and with shapes, as a fraction of the robot's size.
const THICK: f64 = 0.016;
const THIN: f64 = 0.008;
/// Shorter bones are omitted; as a fraction of the robot's size.
const SHORT: f64 = 1e-3;

/// The visible parts of a link.
#[derive(Clone, Default)]
pub struct Seen {
    pub parts: Vec<Part>,
    /// Whether it has a shape that is not shown.
    pub hidden: bool,
}

/// Adds the bones of the robot, and the axes of its joints where it has no shapes.
pub fn add(robot: &Robot, seen: &mut [Seen]) {
    let is_bare = seen.iter().all(|link| link.parts.is_empty());
    let has_meshes = seen.iter().flat_map(|link| &link.parts).any(|part| matches!(part.body, Body::Surface(_)));
    let span = span(robot, seen);
    if span <= APART {
        return;
    }
    let radius = span * if is_bare { THICK } else { THIN };
    let matters = mattering(robot, seen);
    let had: Vec<bool> = seen.iter().map(|link| !link.parts.is_empty()).collect();
    for joint in robot.limb_by_limb() {
        let ((parent, child), own) = (robot.ends(joint), &robot.joints()[joint]);
        if (!is_bare && !matters[joint]) || (has_meshes && had[parent]) {
            continue;
        }
        let offset = own.origin.pose().translation.vector;
        if offset.norm() > SHORT * span {
            seen[parent].parts.push(bone(&offset, radius));
        }
        if is_bare && own.kind.is_single() {
            seen[child].parts.push(axle(own, radius));
        }
    }
}

fn bone(offset: &Vector3<f64>, radius: f64) -> Part {
    let pose = Pose::from_parts((offset / 2.0).into(), from_z(Unit::new_normalize(*offset)));
    let material = Material { diffuse: [0.45, 0.5, 0.56], ..Material::default() };
    Part { pose, body: Body::Solid(Solid::Capsule { radius, length: offset.norm() }), material }
}

fn axle(joint: &Joint, radius: f64) -> Part {
    let pose = Pose::from_parts(Vector3::zeros().into(), from_z(normalized(&joint.axis)));
    let material = Material { diffuse: [0.78, 0.8, 0.84], ..Material::default() };
    Part { pose, body: Body::Solid(Solid::Cylinder { radius: 1.9 * radius, length: 4.5 * radius }), material }
}

/// A rotation from z to a direction.
fn from_z(to: Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    let half_turn = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), &to).unwrap_or_else(half_turn)
}

/// The diagonal of the bounding box of all shapes and joints, with all joints at zero \[m\].
fn span(robot: &Robot, seen: &[Seen]) -> f64 {
    let mut frames = vec![Pose::identity(); robot.links().len()];
    for joint in robot.order() {
        let (parent, child) = robot.ends(*joint);
        frames[child] = frames[parent] * robot.joints()[*joint].origin.pose();
    }
    let shapes = frames.iter().zip(seen).flat_map(|(frame, link)| link.parts.iter().map(move |part| (frame, part)));
    let corners = shapes.flat_map(|(frame, part)| {
        let points = part.body.points().into_iter();
        points.map(move |point| (frame * part.pose * point).coords)
    });
    let all = frames.iter().map(|frame| frame.translation.vector).chain(corners);
    let box_of = all.map(|at| (at, at)).reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1)));
    box_of.map_or(0.0, |(low, high)| (high - low).norm())
}

/// The joints that move, or carry a shape or another such joint.
fn mattering(robot: &Robot, seen: &[Seen]) -> Vec<bool> {
    let (mut matters, mut links) = (vec![false; robot.joints().len()], vec![false; robot.links().len()]);
    for joint in robot.order().iter().rev() {
        let (parent, child) = robot.ends(*joint);
        let is_shown = !seen[child].parts.is_empty() || seen[child].hidden;
        if robot.joints()[*joint].kind.is_single() || is_shown || links[child] {
            matters[*joint] = true;
            links[parent] = true;
        }
    }
    matters
}
