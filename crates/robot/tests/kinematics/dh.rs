//! Denavit-Hartenberg tables compared with their definition, the product of the rows' matrices.

use std::f64::consts::FRAC_PI_2;

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{Chain, DhConvention, DhTable, JointKind, LengthUnit, Task};
use groebot_robot::model::Robot;
use nalgebra::{Matrix4, Rotation3, Translation3, Vector3};
use proptest::prelude::*;

const STANDARD: &str = include_str!("../../../../tests/corpus/urdf/ur5_standard.toml");
const MODIFIED: &str = include_str!("../../../../tests/corpus/urdf/ur5_modified.toml");
const AXES: &str = include_str!("../../../../tests/corpus/urdf/ur5_axes.toml");
const URDF: &str = include_str!("../../../../tests/corpus/urdf/ur5.urdf");

fn rotation(axis: Vector3<f64>, angle: f64) -> Matrix4<f64> {
    Rotation3::new(axis * angle).to_homogeneous()
}

fn shift(x: f64, z: f64) -> Matrix4<f64> {
    Translation3::new(x, 0.0, z).to_homogeneous()
}

/// The transform of one row, as the conventions define it.
fn row_matrix(convention: DhConvention, [theta, d, a, alpha]: [f64; 4]) -> Matrix4<f64> {
    let about_z = rotation(Vector3::z(), theta) * shift(0.0, d);
    let about_x = rotation(Vector3::x(), alpha) * shift(a, 0.0);
    match convention {
        DhConvention::Standard => about_z * about_x,
        DhConvention::Modified => about_x * about_z,
    }
}

fn forward(chain: &Chain, q: &[f64]) -> Matrix4<f64> {
    chain.forward(q).unwrap().to_homogeneous()
}

/// The example of `docs/dh_toml.md`.
fn documented_example() -> String {
    let page = include_str!("../../../../docs/dh_toml.md");
    page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap().to_owned()
}

#[test]
fn the_documented_example() {
    let table = DhTable::from_toml(&documented_example()).unwrap();
    assert_eq!((table.length_unit, table.task, table.rows.len()), (LengthUnit::Millimetre, Task::Pose, 4));
    let chain = table.chain().unwrap();
    assert_eq!(chain, Chain::from_dh_toml(&documented_example()).unwrap());
    assert_eq!(chain.joints()[2].kind, JointKind::Prismatic);
    assert_eq!(chain.joints()[2].limits, Some((0.0, 150.0)));
    // From the drawing of a SCARA: the arm in the plane z = 211.5, the quill points down.
    let (a, b, quill) = (0.3f64, -0.8f64, 40.0);
    let pose = chain.forward(&[a, b, quill, 0.1]).unwrap();
    let wanted =
        [225.0 * a.cos() + 175.0 * (a + b).cos(), 225.0 * a.sin() + 175.0 * (a + b).sin(), 211.5 - 30.0 - quill];
    assert!((pose.translation.vector - Vector3::from(wanted)).norm() < 1e-11);
    let x = pose.rotation * Vector3::x();
    let heading = a + b - (0.1 - FRAC_PI_2);
    assert!((x - Vector3::new(heading.cos(), heading.sin(), 0.0)).norm() < 1e-14);
}

#[test]
fn base_and_tool_are_applied() {
    let text = "name = 't'\nangle_unit = 'deg'\nbase = { xyz = [1, 2, 3], rpy = [90, 0, 0] }\ntool = { xyz = [0, 0, 0.5] }\n\
                [dh]\nconvention = 'standard'\n[[joint]]\nname = 'j'\ntype = 'revolute'\n";
    let chain = Chain::from_dh_toml(text).unwrap();
    let tip = chain.forward(&[0.7]).unwrap().translation.vector;
    assert!((tip - Vector3::new(1.0, 1.5, 3.0)).norm() < 1e-15, "z of frame 0 is -y of the base: {tip}");
    assert!((chain.joints()[0].direction().into_inner() - Vector3::new(0.0, -1.0, 0.0)).norm() < 1e-15);
}

#[test]
fn a_long_table_is_refused_before_it_is_multiplied_out() {
    let rows = "[[joint]]\nname = 'j'\ntype = 'revolute'\nalpha = 0.3\n".repeat(10_000);
    let table = DhTable::from_toml(&format!("name = 'long'\n[dh]\nconvention = 'modified'\n{rows}")).unwrap();
    assert!(table.chain().unwrap_err().message().contains("10000 joints; give 1 to 12"));
}

#[test]
fn mistakes_have_a_line_and_a_name() {
    let good = documented_example();
    let cases = [
        ("convention = \"standard\"", "convention = \"craig\"", ErrorKind::BadValue, "allowed: `standard`, `modified`"),
        ("convention = \"standard\"", "", ErrorKind::MissingKey, "convention"),
        (
            "d = 211.5",
            "theta = 3",
            ErrorKind::BadValue,
            "joint `shoulder`: `theta`: it is the value of a revolute joint",
        ),
        ("offset = 30", "d = 3", ErrorKind::BadValue, "joint `quill`: `d`: it is the value of a prismatic joint"),
        ("offset = 30", "ofset = 3", ErrorKind::UnknownKey, "did you mean `offset`?"),
        ("d = 211.5", "d = nan", ErrorKind::BadValue, "not a finite number"),
        ("alpha = 180", "alpha = 1e200", ErrorKind::BadValue, "angle is too large"),
        ("[-105, 105]", "[105, -105]", ErrorKind::BadValue, "joint `shoulder`: the limits are inverted"),
        ("name = \"elbow\"", "name = \"shoulder\"", ErrorKind::DuplicateName, "joint `shoulder`"),
        ("d = 211.5", "d = 1e13", ErrorKind::BadValue, "beyond 10^12"),
    ];
    for (from, to, kind, words) in cases {
        assert!(good.contains(from));
        let error = Chain::from_dh_toml(&good.replacen(from, to, 1)).unwrap_err();
        assert_eq!(error.kind(), kind, "{to}: {error}");
        assert!(error.message().contains(words) && error.place().line.is_some(), "{to}: {error}");
    }
}

proptest! {
    #![proptest_config(crate::cases(40))]

    #[test]
    fn four_readers_of_one_robot_agree(q in prop::collection::vec(-6.3f64..6.3, 6)) {
        let [standard, modified] = [STANDARD, MODIFIED].map(|text| forward(&Chain::from_dh_toml(text).unwrap(), &q));
        let by_axes = forward(&Chain::from_toml(AXES).unwrap(), &q);
        let by_urdf = forward(&Robot::from_urdf(URDF).unwrap().chain(None, None).unwrap().ideal().0, &q);
        for other in [modified, by_axes, by_urdf] {
            prop_assert!((standard - other).norm() < 1e-14, "{}", (standard - other).norm());
        }
        // The manufacturer's table, multiplied out.
        let alpha = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];
        let (a, d) = ([0.0, -0.425, -0.39225, 0.0, 0.0, 0.0], [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823]);
        let rows = (0..6).map(|i| row_matrix(DhConvention::Standard, [q[i], d[i], a[i], alpha[i]]));
        let wanted: Matrix4<f64> = rows.product();
        prop_assert!((standard - wanted).norm() < 1e-14);
    }

    #[test]
    fn a_table_is_the_product_of_its_rows(
        modified: bool,
        rows in prop::collection::vec((any::<bool>(), prop::array::uniform4(-3_141i32..3_141), -3.0f64..3.0), 1..9),
    ) {
        let convention = if modified { DhConvention::Modified } else { DhConvention::Standard };
        let mut text = format!("name = 'random'\n[dh]\nconvention = '{}'\n", if modified { "modified" } else { "standard" });
        let (mut wanted, mut q) = (Matrix4::identity(), Vec::new());
        for (index, (slides, numbers, value)) in rows.iter().enumerate() {
            let [theta, d, a, alpha] = numbers.map(|n| f64::from(n) / 1000.0);
            let (kind, fixed, offset) = if *slides { ("prismatic", ("theta", theta), d) } else { ("revolute", ("d", d), theta) };
            text += &format!("[[joint]]\nname = 'j{index}'\ntype = '{kind}'\n{} = {}\noffset = {offset}\na = {a}\nalpha = {alpha}\n",
                fixed.0, fixed.1);
            let (turned, moved) = if *slides { (theta, d + value) } else { (theta + value, d) };
            wanted *= row_matrix(convention, [turned, moved, a, alpha]);
            q.push(*value);
        }
        let given = forward(&Chain::from_dh_toml(&text).unwrap(), &q);
        prop_assert!((given - wanted).norm() < 1e-13, "{}", (given - wanted).norm());
    }
}
