//! Forward kinematics compared with hand formulas and with the product of frames.

use std::fmt::Write;

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{Ball, Chain, JointKind};
use groebot_robot::model::Robot;
use groebot_robot::spatial::Pose;
use nalgebra::{Matrix3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::documented_example;
use crate::errors::assert_error;

#[test]
fn the_zero_configuration_is_the_tip() {
    let leg = Chain::from_toml(&documented_example()).unwrap();
    assert_eq!(leg.forward(&[0.0, 0.0]).unwrap().translation.vector, Vector3::new(0.0, 0.0, 202.9));
    assert!((leg.reach() - 202.9).abs() < 1e-12);
}

#[test]
fn joint_values_are_checked() {
    let leg = Chain::from_toml(&documented_example()).unwrap();
    assert_error(&leg.forward(&[0.0]).unwrap_err(), ErrorKind::BadValue, None, "the chain has 2 joints");
    assert_error(&leg.forward(&[0.0, f64::NAN]).unwrap_err(), ErrorKind::BadValue, None, "joint `KneePitch`");
}

#[test]
fn axes_of_any_length_have_a_direction() {
    for length in ["1e-400", "1e400", "1/3"] {
        let text = documented_example().replace("axis = [0, 1, 0]", &format!("axis = [0, '{length}', 0]"));
        let leg = Chain::from_toml(&text).unwrap();
        assert_eq!(leg.joints()[0].direction(), Vector3::y_axis());
    }
}

#[test]
fn the_ball_of_an_arm_is_what_it_reaches() {
    let urdf = include_str!("../../../../tests/corpus/urdf/ur5.urdf");
    let ur5 = Robot::from_urdf(urdf).unwrap().chain(None, None).unwrap();
    assert!(ur5.ball().radius < ur5.reach() && ur5.wrist_ball().unwrap().radius < ur5.ball().radius);
    for ball in [ur5.ball(), ur5.wrist_ball().unwrap()] {
        let farthest = farthest(&ur5, &ball);
        assert!((1.0 - farthest / ball.radius).abs() < 1e-9, "{farthest} of {}", ball.radius);
    }
}

/// The largest distance of a point of the tip when one joint after the other is moved to its maximum.
fn farthest(chain: &Chain, ball: &Ball) -> f64 {
    let away = |q: &[f64]| (chain.forward(q).unwrap() * ball.point - ball.middle).norm();
    let mut q = [0.0, -0.4, 0.3, 0.5, 0.9, 0.0];
    for step in (0..24).map(|halved| 0.5f64.powi(halved)) {
        for joint in (0..q.len()).cycle().take(60) {
            let moved = |by: f64| {
                let mut q = q;
                q[joint] += by;
                q
            };
            let tried = [q, moved(step), moved(-step)];
            q = tried.into_iter().max_by(|a, b| away(a).total_cmp(&away(b))).unwrap();
        }
    }
    away(&q)
}

/// One joint of a random chain in form B.
#[derive(Clone, Debug)]
struct Link {
    revolute: bool,
    axis: [i32; 3],
    xyz: [i32; 3],
    quarters: [i32; 3],
    q: f64,
}

fn link() -> impl Strategy<Value = Link> {
    let small = || prop::array::uniform3(-3i32..4);
    let axis = small().prop_filter("an axis has a direction", |axis| *axis != [0; 3]);
    (any::<bool>(), axis, small(), prop::array::uniform3(-5i32..6), -3.0..3.0)
        .prop_map(|(revolute, axis, xyz, quarters, q)| Link { revolute, axis, xyz, quarters, q })
}

fn frame(link: &Link) -> Pose {
    let [roll, pitch, yaw] = link.quarters.map(|n| f64::from(n).to_radians() * 90.0);
    Pose::from_parts(Translation3::from(vector(link.xyz)), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}

fn vector(entries: [i32; 3]) -> Vector3<f64> {
    Vector3::from(entries.map(f64::from))
}

fn motion(link: &Link) -> Pose {
    let axis = Unit::new_normalize(vector(link.axis));
    if link.revolute {
        return Pose::from_parts(Translation3::identity(), UnitQuaternion::from_axis_angle(&axis, link.q));
    }
    Pose::from_parts(Translation3::from(axis.into_inner() * link.q), UnitQuaternion::identity())
}

const HEAD: &str = "name = 'random'\ntask.kind = 'pose'\n";

fn kind(link: &Link) -> &str {
    if link.revolute { "revolute" } else { "prismatic" }
}

fn form_b(links: &[Link], tip: &Link) -> String {
    let origin = |link: &Link| format!("{{ xyz = {:?}, rpy_deg = {:?} }}", link.xyz, link.quarters.map(|n| 90 * n));
    let mut text = format!("{HEAD}tip.origin = {}\n", origin(tip));
    for (i, link) in links.iter().enumerate() {
        let (kind, axis, origin) = (kind(link), link.axis, origin(link));
        write!(text, "[[joint]]\nname = 'j{i}'\ntype = '{kind}'\naxis = {axis:?}\norigin = {origin}\n").unwrap();
    }
    text
}

fn rounded(vector: &Vector3<f64>) -> [i64; 3] {
    [vector.x, vector.y, vector.z].map(|x| x.round() as i64)
}

/// Same chain, but in form A: the frames at zero, rounded, because all coordinates are integers.
fn form_a(links: &[Link]) -> String {
    let (mut text, mut base_from_joint) = (String::new(), Pose::identity());
    for (i, link) in links.iter().enumerate() {
        base_from_joint *= frame(link);
        let axis = rounded(&(base_from_joint.rotation * vector(link.axis)));
        let (kind, point) = (kind(link), rounded(&base_from_joint.translation.vector));
        write!(text, "[[joint]]\nname = 'j{i}'\ntype = '{kind}'\naxis = {axis:?}\npoint = {point:?}\n").unwrap();
    }
    text
}

/// Quarter turns of roll, pitch and yaw, found by trying all.
fn quarters_of(pose: &Pose) -> [i32; 3] {
    let all = (0..64).map(|n| [n % 4, n / 4 % 4, n / 16]);
    let candidate =
        |quarters: &[i32; 3]| frame(&Link { revolute: true, axis: [0; 3], xyz: [0; 3], quarters: *quarters, q: 0.0 });
    all.into_iter().find(|quarters| candidate(quarters).rotation.angle_to(&pose.rotation) < 1e-3).unwrap()
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn the_two_link_leg_obeys_the_hand_formulas(q3 in -4.0..4.0f64, q4 in -4.0..4.0f64) {
        let pose = Chain::from_toml(&documented_example()).unwrap().forward(&[q3, q4]).unwrap();
        let x = 100.0 * q3.sin() + 102.9 * (q3 + q4).sin();
        let z = 100.0 * q3.cos() + 102.9 * (q3 + q4).cos();
        prop_assert!((pose.translation.vector - Vector3::new(x, 0.0, z)).norm() < 1e-11);
        let about_y = Rotation3::from_axis_angle(&Vector3::y_axis(), q3 + q4);
        prop_assert!((pose.rotation.to_rotation_matrix().matrix() - about_y.matrix()).norm() < 1e-13);
    }

    #[test]
    fn a_chain_of_frames_is_a_product_of_exponentials(links in prop::collection::vec(link(), 1..8), tip in link()) {
        let chain = Chain::from_toml(&form_b(&links, &tip)).unwrap();
        let q: Vec<f64> = links.iter().map(|link| link.q).collect();
        let pose = chain.forward(&q).unwrap();
        let moved = links.iter().fold(Pose::identity(), |pose, link| pose * frame(link) * motion(link)) * frame(&tip);
        prop_assert!((pose.translation.vector - moved.translation.vector).norm() < 1e-11);
        prop_assert!(pose.rotation.angle_to(&moved.rotation) < 1e-6);
        let matrix = pose.rotation.to_rotation_matrix().into_inner();
        prop_assert!((matrix - moved.rotation.to_rotation_matrix().into_inner()).norm() < 1e-12);
        prop_assert!((matrix * matrix.transpose() - Matrix3::identity()).norm() < 1e-13);
        prop_assert!((matrix.determinant() - 1.0).abs() < 1e-13);
    }

    #[test]
    fn forms_a_and_b_are_the_same_chain(links in prop::collection::vec(link(), 1..8), tip in link()) {
        let b = Chain::from_toml(&form_b(&links, &tip)).unwrap();
        let at_zero = links.iter().fold(Pose::identity(), |pose, link| pose * frame(link)) * frame(&tip);
        let degrees = quarters_of(&at_zero).map(|n| 90 * n);
        let point = rounded(&at_zero.translation.vector);
        let a = Chain::from_toml(&format!("{HEAD}tip = {{ point = {point:?}, rpy_deg = {degrees:?} }}\n{}", form_a(&links))).unwrap();
        prop_assert_eq!(a.joints(), b.joints());
        prop_assert_eq!(&a.tip().point, &b.tip().point);
        prop_assert_eq!(&a, &b);
    }

    #[test]
    fn the_tip_stays_within_reach(links in prop::collection::vec(link(), 1..8), tip in link()) {
        let chain = Chain::from_toml(&form_b(&links, &tip)).unwrap();
        let q: Vec<f64> = links.iter().map(|link| if link.revolute { link.q } else { 0.0 }).collect();
        let position = chain.forward(&q).unwrap().translation.vector;
        prop_assert!((position - chain.joints()[0].location().coords).norm() <= chain.reach() + 1e-11);
        let ball = chain.ball();
        prop_assert!((position - ball.middle.coords).norm() <= ball.radius + 1e-11 && ball.radius <= chain.reach() + 1e-11);
        if let Some(wrist) = chain.wrist_ball() {
            let place = chain.forward(&q).unwrap() * wrist.point;
            prop_assert!((place - wrist.middle).norm() <= wrist.radius + 1e-11);
            let before = chain.base_from_tip() * wrist.point;
            let last = chain.joints().iter().rfind(|joint| joint.kind == JointKind::Revolute).unwrap();
            prop_assert!((before - last.location()).cross(&last.direction()).norm() < 1e-11);
        }
    }
}
