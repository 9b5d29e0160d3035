//! Robots in TOML: the documented example, shapes, and what is refused.

use groebot_robot::ErrorKind;
use groebot_robot::model::{Robot, Solid};
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, Vector3};
use num_traits::ToPrimitive;

use super::exact;

fn documented() -> String {
    let page = include_str!("../../../../docs/robot_toml.md");
    page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap().to_owned()
}

#[test]
fn the_documented_example_is_read() {
    let robot = Robot::from_toml(&documented()).unwrap();
    assert_eq!((robot.root(), robot.leaves()), ("palm", vec!["fingertip"]));
    let knuckle = &robot.joints()[0];
    assert_eq!(knuckle.origin.placement.origin, ["0", "0.02", "0.0451"].map(exact), "millimetres, exactly");
    assert!((knuckle.origin.pose().rotation.scaled_axis() - Vector3::z() * std::f64::consts::FRAC_PI_2).norm() < 1e-15);
    assert_eq!(knuckle.limits, Some((-10f64.to_radians(), 80f64.to_radians())));
    assert_eq!((knuckle.speed, knuckle.effort), (Some(2.0), Some(1.0)));
    let phalanx = &robot.links()[1];
    assert_eq!(phalanx.mass.as_ref().unwrap().mass.to_f64(), Some(0.05));
    assert_eq!(phalanx.inertia().centre_of_mass(), Point3::new(0.0, 0.0, 0.018));
    assert_eq!(phalanx.inertia().rotational()[(2, 2)], 4e-7);
    let Solid::Capsule { radius, length } = phalanx.collisions[0].solid else { panic!("a capsule") };
    assert_eq!((radius, length), (0.008, 0.038));
    assert_eq!(phalanx.collisions[0].pose(), Pose::translation(0.0, 0.0, 0.019));
    let tip = robot.chain(None, None).unwrap();
    assert_eq!(tip.tip().point, ["0", "0.02", "0.0831"].map(exact));
}

/// `rpy` in radians is read as that of a URDF: any angle, and 1.5708 as a quarter turn with the number kept.
#[test]
fn angles_in_radians_are_those_of_a_urdf() {
    let toml = |origin: &str| {
        Robot::from_toml(&format!(
            "name = \"r\"\n[[link]]\nname = \"a\"\n[[frame]]\nname = \"b\"\non = \"a\"\norigin = {origin}"
        ))
    };
    for rpy in [["1.5708", "0", "-0.3"], ["0.1", "-2.25", "3.14159"], ["0", "0", "1.5707963267948966"]] {
        let urdf = format!(
            "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/>\
             <child link=\"b\"/><origin xyz=\"1 2 3\" rpy=\"{}\"/></joint></robot>",
            rpy.join(" ")
        );
        let read = toml(&format!("{{ xyz = [1, 2, 3], rpy = [{}] }}", rpy.join(", "))).unwrap();
        assert_eq!(read.joints()[0].origin, Robot::from_urdf(&urdf).unwrap().joints()[0].origin, "{rpy:?}");
    }
    let both = toml("{ rpy = [0, 0, 0.5], rpy_deg = [0, 0, 90] }").unwrap_err();
    assert_eq!((both.kind(), both.place().line), (ErrorKind::BadValue, Some(7)));
}

/// A capsule between two points has its ends there, in any direction.
#[test]
fn a_capsule_is_between_its_ends() {
    for (from, to) in
        [([1.0, 2.0, 3.0], [2.0, 0.0, 2.5]), ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]), ([0.0; 3], [0.0, 0.3, 0.0])]
    {
        let text = format!(
            "name = \"r\"\n[[link]]\nname = \"a\"\ncollision = [{{ capsule = {{ radius = 0.1, from = {from:?}, to = {to:?} }} }}]"
        );
        let shape = Robot::from_toml(&text).unwrap().links()[0].collisions[0].clone();
        let Solid::Capsule { length, .. } = shape.solid else { panic!("a capsule") };
        let ends = [-0.5, 0.5].map(|share| shape.pose() * Point3::new(0.0, 0.0, share * length));
        assert!((ends[0] - Point3::from(from)).norm() < 1e-14 && (ends[1] - Point3::from(to)).norm() < 1e-14);
    }
}

#[test]
fn mistakes_have_a_line() {
    use ErrorKind::*;
    let cases = [
        ("mass = 0.05", "mas = 0.05", UnknownKey, "unknown key `mas`"),
        ("type = \"revolute\"", "type = \"revolve\"", BadValue, "joint `knuckle`"),
        ("parent = \"palm\"", "parent = \"plam\"", UnknownName, "did you mean `palm`"),
        ("axis = [0, 1, 0]", "", MissingKey, "joint `knuckle`"),
        ("axis = [0, 1, 0]", "axis = [0, 0, 0]", BadValue, "no direction"),
        ("limits = [-10, 80]", "", BadValue, "needs limits"),
        ("on = \"phalanx\"", "on = \"thumb\"", UnknownName, "`thumb` is not a link"),
        ("radius = 8, ", "", MissingKey, "radius"),
        ("capsule = {", "ball = {", UnknownKey, "ball"),
        ("name = \"palm\"", "name = \"phalanx\"", DuplicateName, "phalanx"),
    ];
    for (from, to, kind, words) in cases {
        let error = Robot::from_toml(&documented().replacen(from, to, 1)).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.message().contains(words), "{error}");
        assert!(error.place().line.is_some(), "{error}");
    }
    let two = documented() + "[[actuator]]\nname = \"m\"\njoints = [\"knuckle\"]\nratios = [1, 2]\n";
    assert!(Robot::from_toml(&two).unwrap_err().message().contains("2 ratios are given for 1 joints"));
}
