//! Chain files: both forms agree, every error has its kind and line, and random text never panics.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{Chain, Choice, JointKind, LengthUnit, Plane, Root, Task};
use proptest::prelude::*;

use super::{documented_example, exact};
use crate::errors::assert_error;

#[test]
fn the_documented_example_is_read_exactly() {
    let chain = Chain::from_toml(&documented_example()).unwrap();
    assert_eq!(chain.unknowns(), ["c3", "s3", "c4", "s4"]);
    assert_eq!(chain.order().unwrap(), ["c4", "c3", "s4", "s3"]);
    assert_eq!(chain.choice(), Some(&Choice { unknown: "s3".into(), root: Root::Minus }));
    assert_eq!(chain.task(), Task::PlanarPosition { plane: Plane::Xz });
    assert_eq!(chain.length_unit(), LengthUnit::Millimetre);
    assert_eq!(chain.tip().point, ["0", "0", "2029/10"].map(exact));
    assert_eq!(chain.joints()[0].limits, Some((-88f64.to_radians(), 27.73f64.to_radians())));
    assert_eq!(chain.joints()[1].name, "KneePitch");
    assert!(chain.parts().source.as_ref().unwrap().contains("(6.7.12)"));
}

#[test]
fn the_documented_form_b_is_the_same_leg() {
    let text = documented_example()
        .replace("point = [0, 0, 0]", "origin = {}")
        .replace("point = [0, 0, 100]", "origin = { xyz = [0, 0, 100] }")
        .replace("point = [0, 0, 202.9]", "origin = { xyz = [0, 0, 102.9] }");
    assert_eq!(Chain::from_toml(&text).unwrap(), Chain::from_toml(&documented_example()).unwrap());
}

#[test]
fn defaults_are_metres_radians_and_counted_symbols() {
    let text = "name = 'two'\ntask = { kind = 'pose' }\ntip = { point = ['0.1029', '1029/10000', 0.1029], rpy_deg = [0, 0, 450] }
[[joint]]\nname = 'a'\ntype = 'revolute'\naxis = [0, 0, 1]\npoint = [0, 0, 0]\nlimits = [-1, 1]
[[joint]]\nname = 'b'\ntype = 'prismatic'\naxis = [0, 0, 1]\npoint = [0, 0, 0]\nlimits = [0, 0.5]";
    let chain = Chain::from_toml(text).unwrap();
    assert_eq!((chain.length_unit(), chain.task()), (LengthUnit::Metre, Task::Pose));
    assert_eq!(chain.unknowns(), ["c1", "s1", "d2"]);
    assert_eq!(chain.joints()[0].limits, Some((-1.0, 1.0)));
    assert_eq!(chain.joints()[1].kind, JointKind::Prismatic);
    assert_eq!(chain.tip().point, ["1029/10000"; 3].map(exact));
    let quarter_about_z = [["0", "-1", "0"], ["1", "0", "0"], ["0", "0", "1"]];
    assert_eq!(chain.tip().rotation, quarter_about_z.map(|row| row.map(exact)));
    assert!(chain.order().is_none() && chain.choice().is_none());
}

#[test]
fn tasks_directions_and_given_joints() {
    let arm = |task: &str, more: &str| {
        let joints = ["a", "b"]
            .map(|name| format!("[[joint]]\nname = '{name}'\ntype = 'revolute'\naxis = [0, 0, 1]\npoint = [0, 0, 0]"));
        let text =
            format!("name = 'two'\n{more}\ntask = {{ {task} }}\ntip = {{ point = [1, 0, 0] }}\n{}", joints.join("\n"));
        Chain::from_toml(&text)
    };
    let tasks =
        [("pose", Task::Pose), ("ray", Task::Ray), ("direction", Task::Direction), ("rotation", Task::Rotation)];
    for (name, task) in tasks {
        let chain = arm(&format!("kind = '{name}'"), "given = ['b']").unwrap();
        assert_eq!((chain.task(), task.name(), chain.given()), (task, name, vec![1]));
        assert_eq!(chain.direction(), &["0", "0", "1"].map(exact));
    }
    let aimed = arm("kind = 'ray', direction = ['-1/3', 0, 2]", "").unwrap();
    assert_eq!(aimed.direction(), &["-1/3", "0", "2"].map(exact));
    assert!(aimed.given().is_empty());
    let line = |wrong: Result<Chain, _>, kind, line, word| assert_error(&wrong.unwrap_err(), kind, Some(line), word);
    line(arm("kind = 'ray', direction = [0, 0, 0]", ""), ErrorKind::BadValue, 3, "non-zero");
    line(arm("kind = 'pose', direction = [0, 0, 1]", ""), ErrorKind::BadValue, 3, "orients no direction");
    line(arm("kind = 'ray', plane = 'xy'", ""), ErrorKind::BadValue, 3, "no plane");
    line(arm("kind = 'ray'", "given = ['c']"), ErrorKind::UnknownName, 2, "`a`, `b`");
    line(arm("kind = 'ray'", "given = ['a', 'a']"), ErrorKind::DuplicateName, 2, "twice");
    line(arm("kind = 'ray'", "given = ['a', 'b']"), ErrorKind::BadValue, 2, "leave at least one");
}

#[test]
fn limits_of_prismatic_joints_are_never_degrees() {
    let text = documented_example().replacen(
        "type = \"revolute\"\naxis = [0, 1, 0]",
        "type = \"prismatic\"\naxis = [0, 0, 1]",
        1,
    );
    let text = text.replace("\"c4\", \"c3\", \"s4\", \"s3\"", "\"c4\", \"d3\", \"s4\"").replace("\"s3\"", "\"s4\"");
    assert_eq!(Chain::from_toml(&text).unwrap().joints()[0].limits, Some((-88.0, 27.73)));
}

/// Form A; each key is on its own line.
const FORM_A: &str = "\
name = 'arm'
length_unit = 'mm'
angle_unit = 'deg'
order = ['c1', 's1', 'd2']
[choice]
unknown = 's1'
root = 'plus'
[task]
kind = 'planar_pose'
plane = 'xy'
[[joint]]
name = 'turn'
type = 'revolute'
axis = [0, 0, 1]
point = [0, 0, 0]
limits = [-90, 90]
[[joint]]
name = 'slide'
symbol = '2'
type = 'prismatic'
axis = [1, 0, 0]
point = [0, 0, 0]
[tip]
point = [1, 0, 0]
rpy_deg = [0, 0, 90]
";

#[test]
fn every_mistake_of_a_file_has_its_kind_and_line() {
    use ErrorKind::{BadValue, DuplicateName, MissingKey, Syntax, UnknownKey, UnknownName};
    Chain::from_toml(FORM_A).unwrap();
    let second = "name = 'slide'";
    let cases: [(&str, &str, ErrorKind, usize, &str); 57] = [
        ("name = 'arm'", "nam = 'arm'", UnknownKey, 1, "did you mean `name`?"),
        ("name = 'arm'", "", MissingKey, 1, "`name`"),
        ("name = 'arm'", "name = 3", BadValue, 1, "a string"),
        ("name = 'arm'", "name = ''", BadValue, 1, "visible characters"),
        ("length_unit = 'mm'", "length_unit = 'cm'", BadValue, 2, "allowed: `m`, `mm`"),
        ("length_unit = 'mm'", "length_unit = 1", BadValue, 2, "one of `m`, `mm`"),
        ("length_unit = 'mm'", "description = ['x']", BadValue, 2, "`description`"),
        ("angle_unit = 'deg'", "angle_unit = 'grad'", BadValue, 3, "did you mean `rad`?"),
        ("'d2']", "'d3']", UnknownName, 4, "did you mean `d2`?"),
        ("'d2']", "'s1']", DuplicateName, 4, "`s1` is given twice"),
        (", 'd2']", "]", BadValue, 4, "`d2` is missing"),
        ("['c1', 's1', 'd2']", "'c1'", BadValue, 4, "an array"),
        ("'s1', 'd2'", "7", BadValue, 4, "a string"),
        ("unknown = 's1'", "unknown = 'q1'", UnknownName, 6, "no joint has the unknown `q1`"),
        ("unknown = 's1'", "unknowns = 's1'", UnknownKey, 6, "did you mean `unknown`?"),
        ("unknown = 's1'", "", MissingKey, 5, "`choice` has no `unknown`"),
        ("root = 'plus'", "root = 'both'", BadValue, 7, "`minus`, `plus`"),
        ("root = 'plus'", "", MissingKey, 5, "`root`"),
        ("kind = 'planar_pose'", "kind = 'planar'", BadValue, 9, "`planar_pose`"),
        ("kind = 'planar_pose'", "", MissingKey, 8, "`kind`"),
        ("kind = 'planar_pose'", "kind = 'pose'", BadValue, 10, "no plane"),
        ("plane = 'xy'", "", MissingKey, 8, "`plane`"),
        ("plane = 'xy'", "plane = 'yx'", BadValue, 10, "`xy`, `xz`, `yz`"),
        ("plane = 'xy'", "plane = 'xz'", BadValue, 14, "parallel to y"),
        ("[task]", "[tasks]", UnknownKey, 8, "did you mean `task`?"),
        ("[[joint]]\nname = 'turn'", "[joint]\nname = 'turn'", Syntax, 17, "not TOML"),
        ("name = 'turn'", "", MissingKey, 11, "joint 1: `joint` has no `name`"),
        ("name = 'turn'", "name = 'slide'", DuplicateName, 18, "an earlier joint has this name"),
        ("type = 'revolute'", "type = 'fixed'", BadValue, 13, "`revolute`, `prismatic`"),
        ("type = 'revolute'", "", MissingKey, 11, "joint `turn`: `joint` has no `type`"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 0]", BadValue, 14, "no direction"),
        ("axis = [0, 0, 1]", "axis = [0, 0.0, '0/1']", BadValue, 14, "no direction"),
        ("axis = [0, 0, 1]", "axis = [0, 0, nan]", BadValue, 14, "finite"),
        ("axis = [0, 0, 1]", "axis = [0, 0]", BadValue, 14, "an array of 3 numbers"),
        ("axis = [0, 0, 1]", "axis = 'z'", BadValue, 14, "an array of 3 numbers"),
        ("axis = [0, 0, 1]", "axis = [0, 0, true]", BadValue, 14, "a boolean"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 'one']", Syntax, 14, "not an exact number"),
        ("axis = [0, 0, 1]", "axis = [0, 0, '1/0']", Syntax, 14, "not an exact number"),
        ("axis = [0, 0, 1]", "axis = [0, 0.2, 1]", BadValue, 14, "the plane's normal"),
        ("axis = [0, 0, 1]", "axes = [0, 0, 1]", UnknownKey, 14, "did you mean `axis`?"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 1e9999]", Syntax, 14, "not an exact number"),
        ("point = [0, 0, 0]\nlimits", "limits", MissingKey, 11, "`origin`"),
        ("point = [0, 0, 0]\nlimits", "point = [0, inf, 0]\nlimits", BadValue, 15, "finite"),
        ("point = [0, 0, 0]\nlimits", "point = [0, 1e13, 0]\nlimits", BadValue, 15, "10^12"),
        ("point = [0, 0, 0]\nlimits", "pont = [0, 0, 0]\nlimits", UnknownKey, 15, "did you mean `point`?"),
        ("point = [0, 0, 0]\nlimits", "origin = {}\nlimits", BadValue, 22, "give all joints and the tip a `origin`"),
        ("limits = [-90, 90]", "limits = [90, -90]", BadValue, 16, "inverted"),
        ("limits = [-90, 90]", "limits = [-inf, 90]", BadValue, 16, "finite"),
        ("limits = [-90, 90]", "limits = [-90, 1e400]", BadValue, 16, "too large"),
        ("limits = [-90, 90]", "limits = [90]", BadValue, 16, "an array of 2 numbers"),
        ("axis = [1, 0, 0]", "axis = [1, 0, 1]", BadValue, 21, "must have z = 0"),
        (second, "name = 'slide'\norigin = {}", BadValue, 17, "`point` and `origin` are given"),
        ("symbol = '2'", "symbol = '1'", DuplicateName, 19, "joint `turn` has the symbol"),
        ("symbol = '2'", "symbol = 'ä'", BadValue, 19, "ASCII letters and digits"),
        ("[tip]\npoint = [1, 0, 0]\nrpy_deg = [0, 0, 90]", "", MissingKey, 1, "`tip`"),
        ("point = [1, 0, 0]", "", MissingKey, 23, "`point`"),
        ("rpy_deg = [0, 0, 90]", "rpy_deg = [0, 0, 45]", BadValue, 25, "multiples of 90"),
    ];
    for (from, to, kind, line, word) in cases {
        assert!(FORM_A.contains(from), "{from}");
        let error = Chain::from_toml(&FORM_A.replacen(from, to, 1)).expect_err(to);
        assert_error(&error, kind, Some(line), word);
    }
}

#[test]
fn the_number_of_joints_is_limited() {
    let joint = "[[joint]]\nname = 'a'\ntype = 'revolute'\naxis = [0, 0, 1]\npoint = [0, 0, 0]\n";
    let head = "name = 'x'\ntask.kind = 'pose'\ntip.point = [0, 0, 0]\n";
    let error = Chain::from_toml(&format!("{head}{}", joint.repeat(13))).unwrap_err();
    assert_error(&error, ErrorKind::BadValue, Some(4), "13 joints; give 1 to 12");
    assert_error(&Chain::from_toml(head).unwrap_err(), ErrorKind::MissingKey, Some(1), "`joint`");
    let error = Chain::from_toml(&format!("{head}joint = []")).unwrap_err();
    assert_error(&error, ErrorKind::BadValue, Some(4), "0 joints");
    let error = Chain::from_toml(&format!("{head}[joint]\nname = 'a'")).unwrap_err();
    assert_error(&error, ErrorKind::BadValue, Some(4), "[[joint]]");
}

#[test]
fn mistakes_of_form_b_are_reported_too() {
    let form_b = FORM_A
        .replace("point = [0, 0, 0]", "origin = { xyz = [0, 0, 0] }")
        .replace("point = [1, 0, 0]\nrpy_deg = [0, 0, 90]", "origin = { xyz = [1, 0, 0], rpy_deg = [0, 0, 90] }");
    assert_eq!(Chain::from_toml(&form_b).unwrap(), Chain::from_toml(FORM_A).unwrap());
    let origin = "origin = { xyz = [0, 0, 0] }";
    let cases = [
        (
            origin,
            "origin = { xyz = [0, 0, 0], rpy = [0, 0, 0] }",
            ErrorKind::UnknownKey,
            15,
            "`rpy`; allowed: `xyz`, `rpy_deg`",
        ),
        (origin, "origin = { rpy_deg = [90, 0, 90.5] }", ErrorKind::BadValue, 15, "multiples of 90"),
        (origin, "origin = { rpy_deg = [90, 0] }", ErrorKind::BadValue, 15, "3 numbers"),
        (origin, "origin = [0, 0, 0]", ErrorKind::BadValue, 15, "a table"),
        (origin, "origin = { xyz = [0, 0, 1e13] }", ErrorKind::BadValue, 11, "10^12"),
        (origin, "point = [0, 0, 0]", ErrorKind::BadValue, 22, "give all joints and the tip a `point`"),
        (origin, "origin = { rpy_deg = [90, 0, 0] }", ErrorKind::BadValue, 14, "parallel to z"),
        (
            "origin = { xyz = [1,",
            "rpy_deg = [0, 0, 0]\norigin = { xyz = [1,",
            ErrorKind::UnknownKey,
            24,
            "`rpy_deg`; allowed: `origin`",
        ),
        (
            "origin = { xyz = [1, 0, 0], rpy_deg = [0, 0, 90] }",
            "point = [1, 0, 0]",
            ErrorKind::BadValue,
            24,
            "`origin`",
        ),
    ];
    for (from, to, kind, line, word) in cases {
        assert!(form_b.contains(from), "{from}");
        assert_error(&Chain::from_toml(&form_b.replacen(from, to, 1)).expect_err(to), kind, Some(line), word);
    }
}

#[test]
fn files_are_named_in_errors() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chain.toml");
    assert_eq!(Chain::read(&path).unwrap_err().kind(), ErrorKind::Io);
    std::fs::write(&path, "name = 'x'\nfoo = 1").unwrap();
    let error = Chain::read(&path).unwrap_err();
    assert_error(&error, ErrorKind::UnknownKey, Some(2), "`foo`");
    assert_eq!(error.place().file.as_ref(), Some(&path));
    std::fs::write(&path, "#".repeat(1_000_001)).unwrap();
    assert_error(&Chain::read(&path).unwrap_err(), ErrorKind::BadValue, None, "too long");
    std::fs::write(&path, documented_example()).unwrap();
    assert_eq!(Chain::read(&path).unwrap().name(), "nao_leg_sagittal");
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn damaged_files_never_panic(at in 0..FORM_A.len(), length in 0usize..40, patch in "\\PC{0,8}|[-0-9.e'\\[\\]{}=\\n]{0,8}") {
        let end = (at + length).min(FORM_A.len());
        let _ = Chain::from_toml(&format!("{}{patch}{}", &FORM_A[..at], &FORM_A[end..]));
    }

    #[test]
    fn noise_never_panics(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = Chain::from_toml(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn keys_with_any_value_never_panic(key in prop::sample::select(vec!["axis", "point", "limits", "symbol", "tip", "order"]),
        value in "[-+0-9a-z.,'\\[\\]{}= ]{1,20}") {
        let lines: Vec<String> = FORM_A.lines().map(|line| {
            if line.starts_with(key) { format!("{key} = {value}") } else { line.to_owned() }
        }).collect();
        let _ = Chain::from_toml(&lines.join("\n"));
    }

    #[test]
    fn numbers_survive_reading(tenths in -10_000i64..10_000, places in 1usize..30) {
        let decimal = format!("{}.{:0>places$}", tenths, 7);
        let text = FORM_A.replace("point = [1, 0, 0]", &format!("point = [{decimal}, '{decimal}', 0]"));
        let chain = Chain::from_toml(&text).unwrap();
        prop_assert_eq!(&chain.tip().point[0], &exact(&decimal));
        prop_assert_eq!(&chain.tip().point[1], &exact(&decimal));
    }
}
