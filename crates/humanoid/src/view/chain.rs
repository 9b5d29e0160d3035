//! A chain in the format of a page: its axes in order, with a link between each two.

use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};

use super::bytes;
use super::data::{Follows, Joint, Limb, Link, Robot};
use super::robot::frame;
use groebot_robot::kinematics::{Chain, JointKind};
use groebot_robot::spatial::{Pose, Screw};

/// The chain with a link for its base, one after each joint, and one for its tip; lengths are in metres.
pub fn described(chain: &Chain) -> Robot {
    let metres = chain.length_unit().metres();
    let link = |name: String| Link { name, shapes: Vec::new(), hidden: false };
    let count = chain.joints().len();
    let links = (0..=count).map(|place| link(if place == 0 { "base".into() } else { format!("link {place}") }));
    let mut joints = Vec::new();
    let mut last = Point3::origin();
    for (place, (own, screw)) in chain.joints().iter().zip(chain.screws()).enumerate() {
        let (axis, at) = axis(screw, &last);
        let scale = if own.kind == JointKind::Prismatic { metres } else { 1.0 };
        joints.push(Joint {
            name: own.name.clone(),
            kind: match own.kind {
                JointKind::Prismatic => "prismatic",
                JointKind::Revolute if own.limits.is_some() => "revolute",
                JointKind::Revolute => "continuous",
            },
            parent: place,
            child: place + 1,
            origin: frame(&Pose::from_parts(Translation3::from((at - last) * metres), UnitQuaternion::identity())),
            axis: axis.into(),
            limits: own.limits.map(|(low, high)| (low * scale, high * scale)),
            speed: None,
            follows: chain.leader(place).map(|(joint, mimic)| {
                let [factor, offset] = mimic.law();
                Follows { joint, factor, offset: offset * scale }
            }),
        });
        last = at;
    }
    let tip = chain.base_from_tip();
    joints.push(Joint {
        name: "tip".to_owned(),
        kind: "fixed",
        parent: count,
        child: count + 1,
        origin: frame(&Pose::from_parts(
            Translation3::from((tip.translation.vector - last.coords) * metres),
            tip.rotation,
        )),
        axis: [0.0, 0.0, 1.0],
        limits: None,
        speed: None,
        follows: None,
    });
    let links = links.chain([link("tip".to_owned())]).collect();
    Robot { name: chain.name().to_owned(), base: 0, links, joints, notes: Vec::new() }
}

/// The chain as a limb whose solutions are shown, with the text of its solver.
pub fn limb(chain: &Chain, program: &str, certificate: Option<String>) -> Limb {
    Limb {
        name: chain.name().to_owned(),
        base: 0,
        tip: chain.joints().len() + 1,
        joints: (0..chain.joints().len()).collect(),
        metres: chain.length_unit().metres(),
        program: bytes::file(program.as_bytes()),
        certificate,
    }
}

/// The direction of a joint's axis and the origin of its link: the foot of the perpendicular from the last origin. For
/// a prismatic joint it is the last origin.
fn axis(screw: &Screw, last: &Point3<f64>) -> (Vector3<f64>, Point3<f64>) {
    match screw {
        Screw::Revolute(line) => {
            let (direction, point) = (line.direction(), line.point());
            let along = direction.dot(&(last - point));
            (direction.into_inner(), point + direction.scale(along))
        }
        Screw::Prismatic(direction) => (direction.into_inner(), *last),
    }
}
