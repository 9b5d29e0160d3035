//! Robots with held joints, another root or another contact shape: their forward kinematics is that of the robot.

use groebot_robot::dynamics::Model;
use groebot_robot::model::{Meshes, Robot, Solid};
use groebot_robot::robots;
use groebot_robot::spatial::Pose;
use groebot_robot::spatial::exact::Placement;
use nalgebra::{UnitQuaternion, Vector3};

/// The pose of `link` in the root's frame with the given joint values; all other joints are at zero.
fn pose(robot: &Robot, link: &str, values: &[(&str, f64)]) -> Pose {
    let model = Model::new(robot).unwrap();
    let mut q = vec![0.0; model.joints().len()];
    for (name, value) in values {
        q[model.joint(name).unwrap()] = *value;
    }
    let (body, root_from_link) = model.link(robot.link(link).unwrap());
    model.place(&Pose::identity(), &q).unwrap().motion(body) * root_from_link
}

fn apart(one: &Pose, other: &Pose) -> f64 {
    let moved = one.inv_mul(other);
    moved.translation.vector.norm() + moved.rotation.angle()
}

#[test]
fn held_joints_are_where_they_were() {
    let robot = robots::teo();
    let place = robot.joint("LKneePitch").unwrap();
    let held = robot.with_held(&[(place, 0.7)]).unwrap();
    assert_eq!(held.moving().len(), robot.moving().len() - 1);
    let other = [("LHipPitch", -0.3)];
    let wanted = pose(&robot, "l_sole", &[("LHipPitch", -0.3), ("LKneePitch", 0.7)]);
    assert!(apart(&pose(&held, "l_sole", &other), &wanted) < 1e-12);
}

#[test]
fn joints_that_follow_a_held_one_are_held_too() {
    let text = std::fs::read_to_string("../../tests/corpus/urdf/telescope.urdf").unwrap();
    let robot = Robot::from_urdf(&text).unwrap();
    let followers = robot.joints().iter().filter(|joint| joint.mimic.is_some()).count();
    let leader = robot.joint("first").unwrap();
    let held = robot.with_held(&[(leader, 0.1)]).unwrap();
    held.check().unwrap();
    assert_eq!(held.moving().len(), robot.moving().len() - 1 - followers);
    assert!(robot.with_held(&[(leader, f64::NAN)]).is_err());
}

#[test]
fn another_root_turns_the_whole_robot() {
    let robot = robots::teo();
    let placement = Placement::shifted(2, groebot_algebra::number::BigRational::from_integer(2.into()));
    let moved = robot.with_root("l_sole", placement).unwrap();
    assert_eq!(moved.root(), "l_sole_");
    let values = [("LHipPitch", -0.3), ("LKneePitch", 0.7)];
    let shift = Pose::translation(0.0, 0.0, 2.0);
    assert!(apart(&pose(&moved, "r_sole", &values), &(shift * pose(&robot, "r_sole", &values))) < 1e-12);
    assert_eq!(moved.moving().len(), robot.moving().len());
}

#[test]
fn a_contact_box_is_the_only_shape_of_its_body() {
    let robot = robots::teo();
    let sole = robot.link("l_sole").unwrap();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.4);
    let at = Pose::from_parts(Vector3::new(0.1, 0.0, 0.005).into(), turn);
    let shod = robot.with_contact_box(sole, &at, [0.2, 0.1, 0.01]).unwrap();
    let model = Model::new(&shod).unwrap();
    let body = model.link(sole).0;
    let shapes: Vec<_> = (0..shod.links().len())
        .filter(|link| model.link(*link).0 == body)
        .flat_map(|link| &shod.links()[link].collisions)
        .collect();
    assert_eq!(shapes.len(), 1);
    assert_eq!(shapes[0].solid, Solid::Box { size: [0.2, 0.1, 0.01] });
    assert!(apart(&shapes[0].pose(), &at) < 1e-12);
    let others = |robot: &Robot| robot.links().iter().map(|link| link.collisions.len()).sum::<usize>();
    assert!(others(&robot) >= others(&shod));
    assert!(shod.to_mjcf(&Meshes::default(), &mut Vec::new()).unwrap().contains("size=\"0.1 0.05 0.005\""));
}
