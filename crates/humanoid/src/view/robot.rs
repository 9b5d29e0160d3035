//! A robot in the format of a page.

use super::bytes;
use super::data::{Follows, Frame, Joint, Link, Robot, Shape, Solid};
use crate::Result;
use groebot_robot::model;
use groebot_robot::model::Meshes;
use groebot_robot::spatial::Pose;
use groebot_robot::spatial::exact::normalized;

/// Points within this distance are at the same place \[m\].
const APART: f64 = 1e-6;

/// The robot with its visible shapes: the visual shapes of each link, else its collision shapes.
///
/// # Errors
/// As [`model::Robot::check`]; [`ErrorKind::BadValue`] for a robot without anything visible.
pub fn described(robot: &model::Robot, meshes: Option<&Meshes>) -> Result<Robot> {
    robot.check()?;
    let mut notes = Vec::new();
    let links: Vec<Link> = robot.links().iter().map(|own| link(own, meshes, &mut notes)).collect();
    let hidden = links.iter().filter(|link| link.hidden).count();
    if meshes.is_none() && hidden > 0 {
        notes.push(format!("Meshes of {hidden} links are not included; --meshes includes them."));
    }
    let order = robot.limb_by_limb();
    let joints: Vec<Joint> = order.iter().map(|place| joint(robot, &order, *place)).collect();
    let is_apart = |joint: &Joint| [3, 7, 11].iter().any(|place| joint.origin[*place].abs() > APART);
    if links.iter().all(|link| link.shapes.is_empty()) && !joints.iter().any(is_apart) {
        return Err(robot.unseen(&notes));
    }
    Ok(Robot { name: robot.name().to_owned(), base: robot.root_place(), links, joints, notes })
}

/// The rows of the matrix of a pose.
pub fn frame(pose: &Pose) -> Frame {
    let (r, p) = (pose.rotation.to_rotation_matrix(), pose.translation.vector);
    let entry = |place: usize| if place % 4 == 3 { p[place / 4] } else { r[(place / 4, place % 4)] };
    std::array::from_fn(entry)
}

fn link(own: &model::Link, meshes: Option<&Meshes>, notes: &mut Vec<String>) -> Link {
    let (shapes, hidden) = own.drawn(|own| shape(own, meshes, notes));
    Link { name: own.name.clone(), shapes, hidden }
}

/// The shape, unless it is a mesh that is not requested or cannot be read.
fn shape(own: &model::Shape, meshes: Option<&Meshes>, notes: &mut Vec<String>) -> Option<Shape> {
    let solid = match own.solid.clone() {
        model::Solid::Box { size } => Solid::Box { size },
        model::Solid::Cylinder { radius, length } => Solid::Cylinder { radius, length },
        model::Solid::Sphere { radius } => Solid::Sphere { radius },
        model::Solid::Capsule { radius, length } => Solid::Capsule { radius, length },
        mesh @ model::Solid::Mesh { .. } => {
            let surface = meshes?.triangles_or_note(&mesh, notes)?;
            Solid::Mesh {
                positions: bytes::singles(surface.points.iter().flat_map(|p| [p.x as f32, p.y as f32, p.z as f32])),
                triangles: bytes::wholes(surface.triangles.iter().flatten().copied()),
            }
        }
    };
    Some(Shape { pose: frame(&own.pose()), solid, colour: own.colour })
}

fn joint(robot: &model::Robot, order: &[usize], place: usize) -> Joint {
    let own = &robot.joints()[place];
    let (parent, child) = robot.ends(place);
    let law = robot.law(own);
    let [factor, offset] = law.law();
    let leader = order.iter().position(|other| robot.joints()[*other].name == law.leader);
    Joint {
        name: own.name.clone(),
        kind: own.kind.name(),
        parent,
        child,
        origin: frame(&own.origin.pose()),
        axis: if own.kind.has_axis() { normalized(&own.axis).into_inner().into() } else { [1.0, 0.0, 0.0] },
        limits: own.limits,
        speed: own.speed.filter(|speed| speed.is_finite()),
        follows: leader.filter(|_| law.leader != own.name).map(|joint| Follows { joint, factor, offset }),
    }
}
