//! Each robot compared with matrices multiplied link by link, from the numbers in its source: Denavit-Hartenberg rows,
//! or offsets and coordinate axes. The chains are products of exponentials.

use std::f64::consts::FRAC_PI_2;

use groebot_robot::kinematics::{Chain, JointKind};
use groebot_robot::robots;
use nalgebra::{Matrix4, Rotation3, Unit, Vector3};
use proptest::prelude::*;

type Matrix = Matrix4<f64>;

fn shift(x: f64, y: f64, z: f64) -> Matrix {
    Matrix::new_translation(&Vector3::new(x, y, z))
}

fn turn(axis: [f64; 3], angle: f64) -> Matrix {
    Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle).to_homogeneous()
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// One row of a Denavit-Hartenberg table, standard convention: Rz(theta) Tz(d) Tx(a) Rx(alpha).
fn dh(theta: f64, d: f64, a: f64, alpha: f64) -> Matrix {
    turn(Z, theta) * shift(0.0, 0.0, d) * shift(a, 0.0, 0.0) * turn(X, alpha)
}

/// Offset and rotation of each joint, then the offset of the tip, all in millimetres.
fn links(joints: &[([f64; 3], [f64; 3])], tip: [f64; 3], q: &[f64]) -> Matrix {
    let millimetres = |[x, y, z]: [f64; 3]| shift(x / 1e3, y / 1e3, z / 1e3);
    let steps = joints.iter().zip(q).map(|((offset, axis), angle)| millimetres(*offset) * turn(*axis, *angle));
    steps.product::<Matrix>() * millimetres(tip)
}

fn ur5(q: &[f64]) -> Matrix {
    let h = FRAC_PI_2;
    dh(q[0], 0.089159, 0.0, h)
        * dh(q[1], 0.0, -0.425, 0.0)
        * dh(q[2], 0.0, -0.39225, 0.0)
        * dh(q[3], 0.10915, 0.0, h)
        * dh(q[4], 0.09465, 0.0, -h)
        * dh(q[5], 0.0823, 0.0, 0.0)
}

/// The manufacturer's csv files. The last factor gives the tip the root's axes.
fn teo(q: &[f64]) -> Matrix {
    let h = FRAC_PI_2;
    let leg = dh(h, -0.092, 0.146, 0.0)
        * dh(q[0], 0.0, 0.0, h)
        * dh(h + q[1], 0.0, 0.0, h)
        * dh(q[2], 0.0, -0.330, 0.0)
        * dh(q[3], -0.0175, -0.300, 0.0)
        * dh(q[4], 0.0, 0.0, -h)
        * dh(q[5], 0.0, -0.123005, 0.0);
    leg * Matrix::new(0., 0., 1., 0., 0., -1., 0., 0., 1., 0., 0., 0., 0., 0., 0., 1.)
}

/// ABB's IRB 120 by Denavit-Hartenberg rows. In its own zero configuration the forearm's and the tool's axes are
/// aligned; in ours the tool points down.
fn irb120(q: &[f64]) -> Matrix {
    let h = FRAC_PI_2;
    let hand = dh(q[0], 0.29, 0.0, -h)
        * dh(q[1] - h, 0.0, 0.27, 0.0)
        * dh(q[2], 0.0, 0.07, -h)
        * dh(q[3], 0.302, 0.0, h)
        * dh(q[4] + h, 0.0, 0.0, -h)
        * dh(q[5], 0.16, 0.0, 0.0);
    let at_zero = Matrix::new(-1., 0., 0., 0.302, 0., 1., 0., 0., 0., 0., -1., 0.47, 0., 0., 0., 1.);
    hand * irb120_flange().try_inverse().unwrap() * at_zero
}

/// The orientation of the last frame of these rows at zero, without the position.
fn irb120_flange() -> Matrix {
    let h = FRAC_PI_2;
    let rows = [(0.0, -h), (-h, 0.0), (0.0, -h), (0.0, h), (h, -h), (0.0, 0.0)];
    let turned: Matrix = rows.iter().map(|(theta, alpha)| dh(*theta, 0.0, 0.0, *alpha)).product();
    shift(0.302, 0.0, 0.47) * turned
}

fn nao_leg(side: f64, q: &[f64]) -> Matrix {
    let o = [0.0; 3];
    let hip = [0.0, side * 50.0, -85.0];
    let joints = [(hip, [0.0, 1.0, -side]), (o, X), (o, Y), ([0.0, 0.0, -100.0], Y), ([0.0, 0.0, -102.9], Y), (o, X)];
    links(&joints, [0.0, 0.0, -45.19], q)
}

fn nao_arm(side: f64, q: &[f64]) -> Matrix {
    let o = [0.0; 3];
    let (shoulder, elbow) = ([0.0, side * 98.0, 100.0], [105.0, side * 15.0, 0.0]);
    let joints = [(shoulder, Y), (o, Z), (elbow, X), (o, Z), ([55.95, 0.0, 0.0], X)];
    links(&joints, [57.75, 0.0, -12.31], q)
}

fn nao_head(q: &[f64]) -> Matrix {
    links(&[([0.0, 0.0, 126.5], Z), ([0.0; 3], Y)], [0.0; 3], q)
}

/// RH0 with x to the left: `side` is 1 for the left leg. The tip is above the base's origin at zero.
fn rh0_leg(side: f64, q: &[f64]) -> Matrix {
    let o = [0.0; 3];
    let joints =
        [([side * 112.0, 0.0, 0.0], Z), (o, X), ([0.0, 280.0, 0.0], X), ([0.0, 280.0, 0.0], X), (o, Z), (o, Y)];
    links(&joints, [-side * 112.0, 26.5, 0.0], q)
}

fn puma(q: &[f64]) -> Matrix {
    let o = [0.0; 3];
    let joints = [([0.0, 660.0, 0.0], Y), (o, X), ([0.0, 432.0, 0.0], X), ([0.0, 432.0, 0.0], Y), (o, X), (o, Z)];
    links(&joints, [0.0, 0.0, 150.0], q)
}

fn stanford(q: &[f64]) -> Matrix {
    let arm = shift(0.0, 0.66, 0.0) * turn(Y, q[0]) * turn(X, q[1]) * shift(0.0, 0.2 + q[2], 0.0);
    arm * turn(Y, q[3]) * turn(X, q[4]) * turn(Z, q[5]) * shift(0.0, 0.0, 0.2)
}

/// RH0 (2-63)-(2-65): height, yaw, pitch, length.
fn polar(q: &[f64]) -> Matrix {
    shift(0.0, 0.66, 0.0) * turn(Y, q[0]) * turn(Z, q[1]) * shift(0.2 + q[2], 0.0, 0.0)
}

fn by_links(name: &str, q: &[f64]) -> Matrix {
    match name {
        "ur5" => ur5(q),
        "teo_leg" => teo(q),
        "irb120" => irb120(q),
        "puma" => puma(q),
        "stanford" => stanford(q),
        "polar" => polar(q),
        "rh0_left_leg" => rh0_leg(1.0, q),
        "rh0_right_leg" => rh0_leg(-1.0, q),
        "nao_left_leg" => nao_leg(1.0, q),
        "nao_right_leg" => nao_leg(-1.0, q),
        "nao_left_arm" => nao_arm(1.0, q),
        "nao_right_arm" => nao_arm(-1.0, q),
        "nao_head" => nao_head(q),
        _ => panic!("state the figures of {name} a second time"),
    }
}

proptest! {
    #![proptest_config(crate::cases(64))]

    #[test]
    fn chains_are_the_robots_of_their_sources(q in prop::array::uniform6(-4.0..4.0f64)) {
        for robot in robots::ALL {
            let chain = robot.chain();
            let q = &q[..chain.joints().len()];
            let pose = chain.forward(q).unwrap().to_homogeneous();
            let error = (pose - by_links(robot.name(), q)).norm();
            prop_assert!(error < 1e-13, "{} at {q:?}: off by {error}", robot.name());
        }
    }
}

fn mirrored(left: &Chain, right: &Chain, across: usize) {
    for (a, b) in left.joints().iter().zip(right.joints()) {
        let (p, r) = (a.location(), b.location());
        assert!((0..3).all(|i| p[i] == if i == across { -r[i] } else { r[i] }), "{}", a.name);
        assert_eq!(
            (a.name.trim_start_matches('L'), a.kind),
            (b.name.trim_start_matches('R'), b.kind),
            "names but for their side"
        );
    }
}

#[test]
fn left_and_right_are_mirror_images() {
    mirrored(&robots::nao_left_leg(), &robots::nao_right_leg(), 1);
    mirrored(&robots::nao_left_arm(), &robots::nao_right_arm(), 1);
    mirrored(&robots::rh0_left_leg(), &robots::rh0_right_leg(), 0);
}

#[test]
fn limits_hold_a_posture_that_the_robot_takes() {
    for robot in robots::ALL {
        for joint in robot.chain().joints() {
            let Some((low, high)) = joint.limits else { continue };
            // Industrial arms turn by up to 400 degrees to both sides.
            let widest = if ["ur5", "irb120"].contains(&robot.name()) { 14.0 } else { 4.2 };
            assert!(
                joint.kind == JointKind::Revolute && low < high && high - low < widest,
                "{} {}",
                robot.name(),
                joint.name
            );
        }
    }
    let degrees = |name: &str, joint: usize| robots::by_name(name).unwrap().joints()[joint].limits.unwrap();
    assert_eq!(degrees("nao_left_leg", 3), (-5.29_f64.to_radians(), 121.04_f64.to_radians()));
    assert_eq!(degrees("nao_right_arm", 3), (2.0_f64.to_radians(), 88.5_f64.to_radians()));
}

/// RH0 Fig. 5-16: knee -3.902 and ankle and hip 1.951 degrees at 0.180 s, feet at 0.112 m, no roll: the trunk is level,
/// above the middle, and lower by less than a millimetre.
#[test]
fn rh0_crouches_as_in_its_table() {
    let q = [0.0, 1.951, -3.902, 1.951, 0.0, 0.0].map(f64::to_radians);
    for chain in [robots::rh0_left_leg(), robots::rh0_right_leg()] {
        let pose = chain.forward(&q).unwrap();
        let p = pose.translation.vector;
        assert!(p.x.abs() < 1e-15 && p.z.abs() < 1e-15 && pose.rotation.angle() < 1e-8);
        assert!((0.5865 - p.y - 2.0 * 0.280 * 4.0 * 1.44909e-4).abs() < 1e-6, "{p}");
    }
}
