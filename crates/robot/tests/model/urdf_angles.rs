//! Multiples of 45 and 30 degrees in robot descriptions: directions, sums and relations of axes are exact.

use groebot_robot::kinematics::{Chain, Geometry};
use groebot_robot::model::Robot;
use groebot_robot::spatial::line::Relation;
use proptest::prelude::*;

use super::exact;

/// A serial robot: xyz and rpy of each joint, each about its own z. The last entry is the tip's.
fn serial(places: &[([String; 3], [String; 3])]) -> Chain {
    let mut text = "<robot name=\"r\"><link name=\"l0\"/>".to_owned();
    for (i, (xyz, rpy)) in places.iter().enumerate() {
        let kind = if i + 1 < places.len() { "continuous" } else { "fixed" };
        text += &format!(
            "<link name=\"l{}\"/><joint name=\"j{i}\" type=\"{kind}\"><parent link=\"l{i}\"/><child link=\"l{}\"/>\
             <origin xyz=\"{}\" rpy=\"{}\"/><axis xyz=\"0 0 1\"/></joint>",
            i + 1,
            i + 1,
            xyz.join(" "),
            rpy.join(" ")
        );
    }
    meant(&(text + "</robot>"))
}

/// The ideal chain of a URDF, in which rounded multiples of 45 and 30 degrees are exact.
fn meant(text: &str) -> Chain {
    Robot::from_urdf(text).unwrap().chain(None, None).unwrap().ideal().0
}

fn place(xyz: [&str; 3], rpy: [&str; 3]) -> ([String; 3], [String; 3]) {
    (xyz.map(String::from), rpy.map(String::from))
}

/// NAO's hip in reverse: the frame is rotated by 45 degrees and back.
#[test]
fn a_hip_at_45_degrees_is_exact() {
    let chain = serial(&[
        place(["0", "0.05", "-0.085"], ["0.785398", "0", "0"]),
        place(["0", "0", "0"], ["-0.7854", "0", "0"]),
        place(["0", "0", "-0.1"], ["0", "1.570796", "0"]),
        place(["0", "0", "0"], ["0", "-1.570796", "0"]),
    ]);
    assert_eq!(chain.joints()[0].axis, ["0", "-1", "1"].map(exact));
    assert_eq!(chain.joints()[1].axis, ["0", "0", "1"].map(exact));
    assert_eq!(chain.joints()[1].point, ["0", "0.05", "-0.085"].map(exact));
    assert_eq!(chain.joints()[2].axis, ["1", "0", "0"].map(exact));
    let identity = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]].map(|row| row.map(exact));
    assert_eq!((&chain.tip().rotation, &chain.tip().point), (&identity, &["0", "0.05", "-0.185"].map(exact)));
}

/// A wrist of three axes at 60 degrees, as in Kinova's arms: its points are irrational, and its parallel axes stay
/// parallel.
#[test]
fn a_wrist_at_60_degrees_keeps_its_relations() {
    let chain = serial(&[
        place(["0", "0", "0.2"], ["0", "0", "0"]),
        place(["0", "0", "0.07"], ["1.0472", "0", "0"]),
        place(["0", "0", "0.07"], ["-1.0471975512", "0", "0"]),
        place(["0", "0", "0.1"], ["0.5236", "0", "0"]),
    ]);
    let geometry = Geometry::of(&chain);
    assert!(chain.ideal_within(1e-3).unwrap().1.is_same());
    assert_eq!(geometry.meeting.len(), 2);
    assert_eq!(chain.joints()[0].axis, chain.joints()[2].axis);
    assert!((chain.joints()[1].location() - nalgebra::Point3::new(0.0, 0.0, 0.27)).norm() < 1e-15);
    let height = 0.27 + 0.035;
    let aside = -0.07 * 0.75_f64.sqrt();
    assert!((chain.joints()[2].location() - nalgebra::Point3::new(0.0, aside, height)).norm() < 1e-15);
    assert!((geometry.neighbours[0].angle - 60f64.to_radians()).abs() < 1e-15);
}

/// An axis at 30 degrees given by decimals, and one given by an angle of its frame: exactly parallel.
#[test]
fn an_axis_of_decimals_is_the_unit_vector() {
    let text = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>
<joint name='one' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0.866025 0 0.5'/></joint>
<joint name='two' type='continuous'><parent link='b'/><child link='c'/><origin xyz='0 1 0' rpy='0 -0.523599 0'/><axis xyz='1 0 0'/></joint>
<joint name='three' type='continuous'><parent link='c'/><child link='d'/><origin rpy='0 0.5236 0'/><axis xyz='0.866 0 0.5'/></joint></robot>";
    let chain = meant(text);
    let directions: Vec<_> = chain.joints().iter().map(|joint| joint.direction().into_inner()).collect();
    assert_eq!(Geometry::of(&chain).parallel.first(), Some(&(0..2)));
    assert_eq!(chain.joints()[0].axis, chain.joints()[1].axis);
    // The described robot differs by more, so solutions are polished. The ideal direction has integers within a
    // thousandth of the tolerance.
    assert!((directions[0] - nalgebra::Vector3::new(0.75f64.sqrt(), 0.0, 0.5)).norm() < 1e-9);
    // Three decimal places are too few.
    assert!((directions[2] - directions[0]).norm() > 1e-6);
}

/// A decimal angle, a general one or one of the known ones.
fn angle() -> impl Strategy<Value = String> {
    let known = ["0", "0.785398", "-0.7853982", "0.5236", "1.0472", "-2.0944", "1.5708", "3.14159", "2.35619"];
    prop_oneof![2 => prop::sample::select(known.to_vec()).prop_map(String::from), 1 => (-30i32..30).prop_map(|n| format!("{:.1}", f64::from(n) / 10.0))]
}

proptest! {
    #![proptest_config(crate::cases(24))]

    /// Each joint is on the axis of the previous joint, so neighbours exactly intersect, are parallel or coaxial.
    #[test]
    fn axes_that_meet_meet_exactly(places in prop::collection::vec((prop::array::uniform3(angle()), -9i32..9), 3..8)) {
        let places: Vec<_> = places.iter().map(|(rpy, d)| (["0".into(), "0".into(), format!("0.{}", d + 11)], rpy.clone())).collect();
        let chain = serial(&places);
        let report = chain.ideal_within(1e-7).unwrap().1;
        prop_assert!(report.is_same(), "{}", report);
        for pair in Geometry::of(&chain).neighbours {
            prop_assert!(matches!(pair.relation, Some(Relation::Intersecting { .. } | Relation::Coincident)), "{pair:?}");
        }
    }
}
