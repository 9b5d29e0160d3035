//! Relations of axes, compared with known arms, and in every configuration.

use groebot_robot::kinematics::{Chain, Geometry};
use groebot_robot::model::Robot;
use groebot_robot::spatial::Relation;
use nalgebra::Point3;

const UR5: &str = include_str!("../../../../tests/corpus/urdf/ur5_standard.toml");
const NAO: &str = include_str!("../../../../tests/corpus/urdf/nao.urdf");

fn chain(joints: &[(&str, &str, &str)]) -> Chain {
    let mut text = "name = 'c'\ntask = { kind = 'pose' }\ntip = { point = [0, 0, 2] }\n".to_owned();
    for (index, (kind, axis, point)) in joints.iter().enumerate() {
        text += &format!("[[joint]]\nname = 'j{index}'\ntype = '{kind}'\naxis = {axis}\npoint = {point}\n");
    }
    Chain::from_toml(&text).unwrap()
}

fn nao(tip: &str) -> Geometry {
    Geometry::of(&Robot::from_urdf(NAO).unwrap().chain(Some("torso"), Some(tip)).unwrap())
}

fn near(a: Point3<f64>, b: [f64; 3]) -> bool {
    (a - Point3::from(b)).norm() < 1e-12
}

#[test]
fn ur5_has_three_parallel_axes_and_three_pairs_that_meet() {
    let geometry = Geometry::of(&Chain::from_dh_toml(UR5).unwrap());
    assert_eq!(geometry.parallel, vec![1..4]);
    let meeting: Vec<_> = geometry.meeting.iter().map(|meeting| meeting.joints.clone()).collect();
    assert_eq!(meeting, vec![0..2, 3..5, 4..6]);
    let distances: Vec<f64> = geometry
        .neighbours
        .iter()
        .filter_map(|pair| match pair.relation {
            Some(Relation::Parallel { distance }) => Some(distance),
            _ => None,
        })
        .collect();
    assert!((distances[0] - 0.425).abs() < 1e-15 && (distances[1] - 0.39225).abs() < 1e-15 && distances.len() == 2);
}

#[test]
fn nao_has_a_spherical_hip_and_pairs_elsewhere() {
    let leg = nao("l_sole");
    assert_eq!(leg.parallel, vec![2..5]);
    assert_eq!(leg.meeting.iter().map(|meeting| meeting.joints.clone()).collect::<Vec<_>>(), vec![0..3, 4..6]);
    assert!(near(leg.meeting[0].point, [0.0, 0.05, -0.085]) && near(leg.meeting[1].point, [0.0, 0.05, -0.2879]));
    let arm = nao("r_hand");
    assert_eq!(arm.meeting.iter().map(|meeting| meeting.joints.clone()).collect::<Vec<_>>(), vec![0..2, 2..5]);
    assert!(arm.parallel.is_empty());
    assert!(
        matches!(arm.neighbours[1].relation, Some(Relation::Skew { distance, .. }) if (distance - 0.015).abs() < 1e-15)
    );
    let words = arm.to_string();
    assert!(
        words.contains("2-3  RShoulderRoll, RElbowYaw") && words.contains("skew, perpendicular, 0.015 m apart"),
        "{words}"
    );
    assert!(words.contains("through one point, (0.105, -0.113, 0.1) m"), "{words}");
}

#[test]
fn a_spherical_wrist_and_a_slide() {
    let geometry = Geometry::of(&chain(&[
        ("revolute", "[0, 0, 1]", "[0, 0, 0]"),
        ("prismatic", "[1, 0, 1]", "[5, 5, 5]"),
        ("revolute", "[1, 0, 0]", "[0, 0, 1]"),
        ("revolute", "[0, 1, 0]", "[0, 7, 1]"),
        ("revolute", "[1, 2, 3]", "[1, 2, 4]"),
    ]));
    assert_eq!(geometry.meeting.len(), 1);
    assert_eq!(geometry.meeting[0].joints, 2..5);
    assert!(near(geometry.meeting[0].point, [0.0, 0.0, 1.0]));
    assert!(geometry.neighbours[0].relation.is_none() && geometry.parallel.is_empty());
    assert!((geometry.neighbours[0].angle - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    assert!(geometry.to_string().contains("directions at 45 deg"), "{geometry}");
}

#[test]
fn the_tolerance_is_a_part_of_the_reach() {
    let with = |gap: &str| {
        let point = format!("[{gap}, 0, 1]");
        let joints = [("revolute", "[0, 0, 1]", "[0, 0, 0]"), ("revolute", "[0, 1, 0]", point.as_str())];
        Geometry::of(&chain(&joints)).meeting.len()
    };
    assert_eq!([with("1e-10"), with("1e-8")], [1, 0]);
}

#[test]
fn general_axes_have_no_groups() {
    let geometry = Geometry::of(&chain(&[
        ("revolute", "[0, 0, 1]", "[0, 0, 0]"),
        ("revolute", "[0, 1, 1]", "[1, 0, 0]"),
        ("revolute", "[1, 1, 5]", "[0, 3, 1]"),
    ]));
    assert!(geometry.parallel.is_empty() && geometry.meeting.is_empty());
    assert!(geometry.to_string().contains("none"), "{geometry}");
}
