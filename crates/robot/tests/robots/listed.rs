//! The list of robots by name.

use std::collections::BTreeSet;

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{JointKind, LengthUnit};
use groebot_robot::model::Robot;
use groebot_robot::robots::{self, Kind, LISTED};

#[test]
fn names_are_unique_words_in_lower_case() {
    let names: BTreeSet<&str> = LISTED.iter().map(|robot| robot.name()).collect();
    assert_eq!(names.len(), LISTED.len());
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    for name in names {
        assert!(name.chars().all(is_plain) && name.starts_with(|c: char| c.is_ascii_lowercase()), "{name}");
    }
}

#[test]
fn every_robot_has_a_vendor_a_model_and_a_source() {
    for robot in LISTED {
        for text in [robot.vendor(), robot.model(), robot.source()] {
            assert!(!text.trim().is_empty(), "{}", robot.name());
        }
    }
}

#[test]
fn every_description_is_read() {
    for robot in LISTED {
        let Some(chain) = robot.chain() else {
            assert_eq!(robot.kind(), Kind::Robot, "{}", robot.name());
            Robot::from_toml(robot.text()).unwrap();
            continue;
        };
        assert_eq!(chain.length_unit(), LengthUnit::Metre, "{}", robot.name());
        let least = if robot.kind() == Kind::Chain { 0.0 } else { 0.01 };
        assert!((least..20.0).contains(&chain.reach()), "{}: {}", robot.name(), chain.reach());
        assert_eq!(robots::by_name(robot.name()).map(|chain| chain.joints().len()), Some(chain.joints().len()));
    }
}

#[test]
fn limits_are_in_radians() {
    for chain in LISTED.iter().filter_map(|robot| robot.chain()) {
        for joint in chain.joints().iter().filter(|joint| joint.kind == JointKind::Revolute) {
            let Some((lower, upper)) = joint.limits else { continue };
            assert!(lower < upper && lower > -13.0 && upper < 13.0, "{}: {}", chain.name(), joint.name);
        }
    }
}

#[test]
fn an_unknown_name_is_refused_with_similar_ones() {
    for (name, near) in [("ur", "`ur10e`"), ("UR-5", "`ur5`"), ("stanferd", "`stanford`")] {
        let error = robots::find(name).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::UnknownName);
        assert!(error.message().contains(near) && error.message().contains("groebot robots"), "{error}");
    }
    assert!(!robots::find("").unwrap_err().message().contains("did you mean"));
    assert_eq!(robots::find("ur5").unwrap().text(), include_str!("../../src/robots/data/ur5.toml"));
}

/// Limits of the arms that are older than the list: the same robot's in another file, with zero at other angles.
#[test]
fn limits_of_the_irb120_are_those_of_its_other_description() {
    let [ours, theirs] = ["irb120", "abb_irb120"].map(|name| robots::by_name(name).unwrap());
    let zero = [0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0];
    let flange_from_tool = |q: [f64; 6]| {
        let other: Vec<f64> = q.iter().zip(zero).map(|(value, zero)| value + zero).collect();
        theirs.forward(&other).unwrap().inverse() * ours.forward(&q).unwrap()
    };
    let mounted = flange_from_tool([0.0; 6]);
    for q in [[0.3, -0.5, 0.7, 1.1, -1.3, 0.9], [-1.2, 0.8, -0.4, -2.0, 0.2, 3.0]] {
        let off = flange_from_tool(q).to_homogeneous() - mounted.to_homogeneous();
        assert!(off.amax() < 1e-12, "{off}");
    }
    for ((own, other), zero) in ours.joints().iter().zip(theirs.joints()).zip(zero) {
        let ((low, high), (other_low, other_high)) = (own.limits.unwrap(), other.limits.unwrap());
        // Theirs have six digits.
        assert!((low + zero - other_low).abs() < 1e-5 && (high + zero - other_high).abs() < 1e-5, "{}", own.name);
    }
}
