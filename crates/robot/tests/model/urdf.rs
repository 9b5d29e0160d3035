//! URDF compared with another reader (urdf-rs) and with matrix products; errors; damaged files.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{Chain, JointKind};
use groebot_robot::model::{JointType, Robot};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, UnitVector3, Vector3};
use proptest::prelude::*;

use super::exact;
use super::robot::NAO;

const UR5: &str = include_str!("../../../../tests/corpus/urdf/ur5.urdf");

/// The example of `docs/urdf.md`.
fn example() -> String {
    let page = include_str!("../../../../docs/urdf.md");
    page.split("```xml\n").nth(1).unwrap().split("```").next().unwrap().to_owned()
}

/// The pose of the last link, from the numbers that urdf-rs reads, by URDF's own definition.
fn multiplied_out(text: &str, q: &[f64]) -> Isometry3<f64> {
    let mut values = q.iter();
    let mut pose = Isometry3::identity();
    for joint in urdf_rs::read_from_string(text).unwrap().joints {
        let ([x, y, z], [roll, pitch, yaw]) = (joint.origin.xyz.0, joint.origin.rpy.0);
        pose *= Translation3::new(x, y, z) * UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        let axis = UnitVector3::new_normalize(Vector3::from(joint.axis.xyz.0));
        match joint.joint_type {
            urdf_rs::JointType::Fixed => {}
            urdf_rs::JointType::Prismatic => pose *= Translation3::from(axis.scale(*values.next().unwrap())),
            _ => pose *= UnitQuaternion::from_axis_angle(&axis, *values.next().unwrap()),
        }
    }
    pose
}

/// Neither the text of other files nor that of the description itself is substituted for an entity.
#[test]
fn entities_are_refused() {
    for entity in ["SYSTEM \"file:///etc/hostname\"", "\"text\""] {
        let text = format!("<!DOCTYPE robot [<!ENTITY x {entity}>]>\n<robot name=\"&x;\"><link name=\"a\"/></robot>");
        let error = Robot::from_urdf(&text).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::Syntax, Some(2)), "{error}");
        assert!(error.message().contains("unrecognized entity"), "{error}");
    }
}

#[test]
fn the_documented_example() {
    let tree = Robot::from_urdf(&example()).unwrap();
    assert_eq!((tree.name(), tree.root(), tree.leaves()), ("finger", "palm", vec!["fingertip"]));
    let described = tree.chain(None, None).unwrap();
    let (chain, report) = described.ideal();
    let joint = &chain.joints()[0];
    assert_eq!(joint.point, ["0", "0.02", "0.0451"].map(exact), "exact decimals");
    assert_eq!(joint.axis, ["-1", "0", "0"].map(exact), "y, turned by 1.5708 about z");
    assert_eq!((joint.kind, joint.limits), (JointKind::Revolute, Some((-0.2, 1.4))));
    // Rotated by q about -x, the fingertip moves towards +y.
    let tip = chain.forward(&[0.5]).unwrap().translation.vector;
    let wanted = Vector3::new(0.0, 0.02 + 0.038 * 0.5f64.sin(), 0.0451 + 0.038 * 0.5f64.cos());
    assert!((tip - wanted).norm() < 1e-16);
    // As described, everything is rotated by 1.5708 - pi/2 about z.
    let off = "1.5708".parse::<f64>().unwrap() - std::f64::consts::FRAC_PI_2;
    let turned =
        nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), off) * (wanted - Vector3::new(0.0, 0.02, 0.0451));
    let tip = described.forward(&[0.5]).unwrap().translation.vector - Vector3::new(0.0, 0.02, 0.0451);
    assert!((tip - turned).norm() < 1e-16, "{}", (tip - turned).norm());
    assert!((report.deviation() - off).abs() < 1e-12, "{report}");
    let notes = tree.notes(&tree.path(None, None).unwrap());
    assert_eq!(
        notes,
        ["knuckle: yaw 1.5708 rad is interpreted as 90 deg when a solver is derived; poses use the number"]
    );
}

/// The manufacturer's numbers are used unchanged: a UR5's 1.5708 is not a quarter turn.
#[test]
fn rounded_angles_are_those_of_the_file() {
    let chain = Robot::from_urdf(UR5).unwrap().chain(None, None).unwrap();
    for k in 0..8 {
        let q: Vec<f64> = (0..6).map(|joint| f64::from((7 * k + 5 * joint) % 13) / 2.0 - 3.0).collect();
        let (described, multiplied) = (chain.forward(&q).unwrap(), multiplied_out(UR5, &q));
        let meant = chain.ideal().0.forward(&q).unwrap();
        assert!(close(&described, &multiplied) < 1e-14, "{}", close(&described, &multiplied));
        assert!(close(&meant, &multiplied) > 1e-7, "{}", close(&meant, &multiplied));
    }
}

#[test]
fn another_reader_finds_the_same_links_and_joints() {
    for text in [NAO, UR5, &example()] {
        let (ours, theirs) = (Robot::from_urdf(text).unwrap(), urdf_rs::read_from_string(text).unwrap());
        let names: Vec<&str> = ours.links().iter().map(|link| link.name.as_str()).collect();
        assert_eq!(names, theirs.links.iter().map(|link| link.name.as_str()).collect::<Vec<_>>());
        assert_eq!(ours.joints().len(), theirs.joints.len());
        for (a, b) in ours.joints().iter().zip(&theirs.joints) {
            assert_eq!((&a.name, &a.parent, &a.child), (&b.name, &b.parent.link, &b.child.link));
            assert_eq!(a.origin.placement.origin, b.origin.xyz.0.map(|x| exact(&x.to_string())), "{}", a.name);
            assert_eq!(a.mimic.as_ref().map(|mimic| &mimic.leader), b.mimic.as_ref().map(|mimic| &mimic.joint));
            if a.kind == JointType::Revolute {
                assert_eq!(a.axis, b.axis.xyz.0.map(|x| exact(&x.to_string())), "{}", a.name);
                assert_eq!(a.limits, Some((b.limit.lower, b.limit.upper)), "{}", a.name);
            }
        }
    }
}

#[test]
fn mistakes_have_a_line_and_a_name() {
    use ErrorKind::*;
    let good = example();
    let cases = [
        ("</robot>", "", Syntax, "<robot> of line 1 is not closed"),
        ("</joint>", "</link>", Syntax, "not XML"),
        ("<robot", "junk <robot", Syntax, "outside the root"),
        ("</robot>", "</robot><robot/>", Syntax, "second root"),
        ("name=\"palm\"", "name=\"palm", Syntax, "not XML"),
        ("name=\"palm\"", "name=\"&junk;\"", Syntax, "not XML"),
        ("name=\"palm\"", "name=\"palm\" name=\"b\"", Syntax, "not XML"),
        ("<robot name=\"finger\">", "<robot name=\"finger\"><xacro:macro/>", Unsupported, "xacro"),
        ("name=\"palm\"", "", MissingKey, "<link> has no `name`"),
        ("name=\"palm\"", "name=\"phalanx\"", DuplicateName, "link `phalanx`"),
        ("name=\"nail\"", "name=\"knuckle\"", DuplicateName, "joint `knuckle`"),
        ("type=\"revolute\"", "", MissingKey, "joint `knuckle`: <joint> has no `type`"),
        ("type=\"revolute\"", "type=\"revolut\"", BadValue, "did you mean `revolute`?"),
        ("<axis ", "<axes ", UnknownKey, "<axes> is not an element of a joint (did you mean `axis`?)"),
        ("<parent link=\"palm\"/>", "", MissingKey, "joint `knuckle`: <joint> has no <parent"),
        (
            "<parent link=\"palm\"/>",
            "<parent link=\"plam\"/>",
            UnknownName,
            "joint `knuckle`: its parent `plam` is not a link",
        ),
        ("<parent link=\"palm\"/>", "<parent link=\"fingertip\"/>", BadValue, "loop"),
        ("<link name=\"palm\"/>", "<link name=\"palm\"/><link name=\"thumb\"/>", BadValue, "`palm`, `thumb`"),
        (
            "0 0.02 0.0451",
            "0 0.02",
            BadValue,
            "joint `knuckle`: <origin> has `xyz` = \"0 0.02\": 2 found; give 3 numbers",
        ),
        ("0 0.02 0.0451", "0 x 0.02 0.0451", BadValue, "`x` is not a number"),
        ("0 0.02 0.0451", "0 nan 0.0451", BadValue, "nan is not finite"),
        ("0 0.02 0.0451", "0 1/3 0.0451", BadValue, "`1/3` is not a number"),
        ("0 0 1.5708", "0 0 -inf", BadValue, "not finite"),
        ("0 0 1.5708", "0 0 1e9", BadValue, "joint `knuckle`: <origin> the angle is too large"),
        ("0 1 0", "0 0 0", BadValue, "joint `knuckle`: axis [0, 0, 0] has no direction"),
        ("<axis xyz=\"0 1 0\"/>", "<axis/>", MissingKey, "<axis> has no `xyz`"),
        ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><axis xyz=\"0 1 0\"/>", BadValue, "<axis> is given twice"),
        (
            "<limit lower=\"-0.2\" upper=\"1.4\" effort=\"1\" velocity=\"2\"/>",
            "",
            BadValue,
            "joint `knuckle`: a revolute joint needs limits",
        ),
        ("lower=\"-0.2\"", "lower=\"2\"", BadValue, "joint `knuckle`: the limits 2..1.4 are inverted"),
        ("upper=\"1.4\"", "upper=\"1e999\"", BadValue, "not finite"),
        ("<limit", "<mimic joint=\"thumb\"/><limit", UnknownName, "mimics `thumb`"),
        ("rpy=\"0 0 1.5708\"", "rpy=\"0 0 0\" quat_xyzw=\"0 0 0 1\"", BadValue, "both"),
        ("rpy=\"0 0 1.5708\"", "quat_xyzw=\"0 0 0 0\"", BadValue, "not zero"),
    ];
    for (from, to, kind, words) in cases {
        assert!(good.contains(from), "{from}");
        let read = Robot::from_urdf(&good.replacen(from, to, 1));
        let error = read.and_then(|robot| robot.chain(None, None)).unwrap_err();
        assert_eq!(error.kind(), kind, "{to}: {error}");
        assert!(error.message().contains(words), "{to}: {error}");
        assert!(error.place().line.is_some() && error.message().lines().count() == 1, "{to}: {error}");
    }
    let html = Robot::from_urdf("<html></html>").unwrap_err();
    assert!(html.message().contains("<robot>") && html.place().line == Some(1), "{html}");
}

#[test]
fn lines_are_those_of_the_file() {
    let error = Robot::from_urdf(&example().replace("0 0.02 0.0451", "0 0.02 0,0451")).unwrap().check().unwrap_err();
    assert_eq!(error.place().line, Some(8), "{error}");
    let error =
        Robot::from_urdf(&example().replace("fingertip\"/>\n    <origin", "finger\"/>\n    <origin")).unwrap_err();
    assert_eq!(error.place().line, Some(12), "{error}");
}

#[test]
fn versions_differ_in_limits() {
    let text = example().replace("lower=\"-0.2\"", "");
    assert_eq!(Robot::from_urdf(&text).unwrap().joints()[0].limits, Some((0.0, 1.4)));
    let recent = text.replace("<robot", "<robot version=\"1.2\"");
    assert!(Robot::from_urdf(&recent).unwrap().check().unwrap_err().message().contains("only one"));
}

#[test]
fn quaternions_are_read_too() {
    let text = example().replace("rpy=\"0 0 1.5708\"", "quat_xyzw=\"0 0 0.70710678 0.70710678\"");
    let chain = |text: &str| Robot::from_urdf(text).unwrap().chain(None, None).unwrap().ideal().0;
    assert_eq!(chain(&text), chain(&example()));
}

#[test]
fn what_is_not_kinematics_is_passed_over() {
    let more = "<!-- a comment --><material name='m'/><gazebo><plugin/></gazebo><transmission name='t'><joint name='knuckle'/>\
                </transmission><robot";
    let text = example().replace(
        "<link name=\"palm\"/>",
        &format!(
            "<link name=\"palm\"><visual><geometry><box size='1 1 junk'/>\
        </geometry></visual></link>{}",
            &more[..more.len() - 6]
        ),
    );
    assert_eq!(
        Robot::from_urdf(&text).unwrap().chain(None, None),
        Robot::from_urdf(&example()).unwrap().chain(None, None)
    );
    let marked = format!(
        "\u{feff}<?xml version=\"1.0\"?>\n{}",
        example().replace("<robot", "<robot xmlns=\"http://drake.mit.edu\"")
    );
    assert!(Robot::from_urdf(&marked).is_ok());
}

#[test]
fn deep_nesting_and_large_files_are_no_danger() {
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(300_000), "</a>".repeat(300_000));
    assert!(Robot::from_urdf(&deep).unwrap_err().message().contains("deeper than 100"));
    let links: String = (0..50_000).map(|i| format!("<link name=\"l{i}\"/>")).collect();
    assert!(Robot::from_urdf(&format!("<robot>{links}</robot>")).unwrap_err().message().contains("and 49988 more"));
}

/// Type, xyz, rpy and axis of a joint, in thousandths.
type JointNumbers = (u8, [i32; 3], [i32; 3], [i32; 3]);

/// A serial robot with these joints.
fn serial(joints: &[JointNumbers]) -> String {
    let mut text = "<robot name=\"serial\"><link name=\"l0\"/>".to_owned();
    let show = |v: &[i32; 3]| v.map(|n| (f64::from(n) / 1000.0).to_string()).join(" ");
    for (i, (kind, xyz, rpy, axis)) in joints.iter().enumerate() {
        let kind = ["revolute", "continuous", "prismatic", "fixed"][usize::from(*kind)];
        text += &format!(
            "<link name=\"l{}\"/><joint name=\"j{i}\" type=\"{kind}\"><parent link=\"l{i}\"/><child link=\"l{}\"/>\
             <origin xyz=\"{}\" rpy=\"{}\"/><axis xyz=\"{}\"/><limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/></joint>",
            i + 1,
            i + 1,
            show(xyz),
            show(rpy),
            show(axis)
        );
    }
    text + "</robot>"
}

fn close(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    (a.to_homogeneous() - b.to_homogeneous()).norm()
}

#[test]
fn a_long_general_chain_survives_json() {
    let joints: Vec<_> =
        (0..64).map(|i| (if i % 6 == 0 { 0 } else { 3 }, [i, 77, -31], [i + 100, -900, 2000], [1, i, 5])).collect();
    let tree = Robot::from_urdf(&serial(&joints)).unwrap();
    let chain: Chain = tree.chain(Some("l1"), None).unwrap();
    let text = serde_json::to_string(&chain).unwrap();
    assert_eq!(serde_json::from_str::<Chain>(&text).unwrap(), chain);
}

proptest! {
    #![proptest_config(crate::cases(48))]

    #[test]
    fn a_serial_robot_is_the_product_of_its_joints(
        joints in prop::collection::vec(
            (0u8..4, prop::array::uniform3(-999i32..999), prop::array::uniform3(-3140i32..3140), prop::array::uniform3(1i32..999)),
            1..9,
        ),
        q in prop::collection::vec(-3.0f64..3.0, 9),
    ) {
        prop_assume!(joints.iter().any(|joint| joint.0 < 3));
        let text = serial(&joints);
        let chain = Robot::from_urdf(&text).unwrap().chain(None, None).unwrap();
        let q = &q[..chain.joints().len()];
        let off = close(&chain.forward(q).unwrap(), &multiplied_out(&text, q));
        prop_assert!(off < 1e-13, "{}", off);
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn damaged_files_never_panic(
        nao: bool,
        wounds in prop::collection::vec((any::<prop::sample::Index>(), 0usize..12, 0usize..14), 1..6),
    ) {
        const BITS: [&str; 14] =
            ["", "<", ">", "\"", "/", "&", "nan", "1e999", "-", "<a>", "</robot>", "\u{0}", "<!--", "0 0 0"];
        let mut text = if nao { NAO.to_owned() } else { example() };
        for (place, length, bit) in wounds {
            let start = place.index(text.len());
            let Some(start) = (start..=text.len()).find(|at| text.is_char_boundary(*at)) else { continue };
            let end = (start + length..).find(|at| *at >= text.len() || text.is_char_boundary(*at)).unwrap().min(text.len());
            text.replace_range(start..end, BITS[bit]);
        }
        match Robot::from_urdf(&text) {
            Ok(tree) => {
                for tip in tree.leaves() {
                    let _ = tree.chain(None, Some(tip));
                }
            }
            Err(error) => prop_assert!(error.place().line.is_some() && !error.message().is_empty(), "{}", error),
        }
    }

    #[test]
    fn any_attribute_text_is_read_or_refused(value in "[ -~]{0,24}", which in 0usize..6) {
        let from = ["0 0.02 0.0451", "0 0 1.5708", "0 1 0", "-0.2", "revolute", "phalanx"][which];
        let value = value.replace(['<', '"', '&'], "");
        if let Ok(tree) = Robot::from_urdf(&example().replacen(from, &value, 1)) {
            let _ = tree.chain(None, None);
        }
    }
}
