//! Written trajectories are read back, as CSV and as JSON; other files are refused with their line.

use groebot_robot::ErrorKind;
use groebot_robot::motion::Trajectory;
use proptest::prelude::*;

use super::sample;

#[test]
fn a_table_is_read_back() {
    let path = sample();
    let text = path.to_csv();
    let header = "time [s],q:hip [rad],q:mast_x [m],base_x [m],base_y [m],base_z [m],base_qx [1],base_qy [1],base_qz [1],base_qw [1],left_x [m]";
    assert!(text.starts_with(&format!("# groebot trajectory 1\n# robot: r\n{header},")), "{text}");
    let read = Trajectory::from_csv(&text).unwrap();
    assert_eq!(read.to_csv(), text);
    for ends in ["\r\n", "\r"] {
        assert_eq!(Trajectory::from_csv(&text.replace('\n', ends)), Ok(read.clone()), "{ends:?}");
    }
    assert_eq!((&read.robot, &read.times, &read.q), (&path.robot, &path.times, &path.q));
    assert_eq!(
        (&read.figures, &read.points, &read.contacts[0].stands),
        (&path.figures, &path.points, &path.contacts[0].stands)
    );
    for (a, b) in read.base.iter().zip(&path.base).chain(read.contacts[0].poses.iter().zip(&path.contacts[0].poses)) {
        assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 2e-9);
    }
    assert!(read.joints.iter().all(|joint| joint.limits.is_none()), "a table does not tell limits");
    assert_eq!(read.joints[1].unit(), "m");
}

#[test]
fn json_is_read_back() {
    let path = sample();
    let mut value = path.to_json();
    assert_eq!(Trajectory::from_json(&value.to_string()).unwrap(), path);
    value["walk"] = 1.into();
    assert!(Trajectory::from_json(&value.to_string()).is_ok(), "what others add is ignored");
    value["format"] = 1.into();
    assert_eq!(Trajectory::from_json(&value.to_string()).unwrap(), path);
    for (format, reported) in [(3.into(), "has `format` 3"), (serde_json::Value::Null, "has no `format`")] {
        value["format"] = format;
        let error = Trajectory::from_json(&value.to_string()).unwrap_err();
        assert!(error.kind() == ErrorKind::Unsupported && error.message().contains(reported), "{error}");
    }
    assert_eq!(Trajectory::from_json("{").unwrap_err().kind(), ErrorKind::Syntax);
}

/// Names as in descriptions; foreign units; a force is not a point.
#[test]
fn names_are_quoted_and_units_checked() {
    let mut path = sample();
    path.robot = format!("O'Neil's {}", "arm".repeat(20));
    path.joints[0].name = "hip, \"left\"".to_owned();
    let text = path.to_csv();
    assert!(text.contains(",\"q:hip, \"\"left\"\" [rad]\","), "{text}");
    let again = Trajectory::from_csv(&text).unwrap();
    assert_eq!(
        (&again.robot, &again.joints[0].name, again.joints.len()),
        (&path.robot, &path.joints[0].name, path.joints.len())
    );
    for (from, to) in [("[rad]", "[deg]"), ("base_y [m]", "base_y [mm]"), ("left_qx [1]", "left_qx [rad]")] {
        let error = Trajectory::from_csv(&text.replacen(from, to, 1)).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::BadValue, Some(3)), "{error}");
        assert!(error.message().contains("give "), "{error}");
    }
    let forces = "# groebot trajectory 1\ntime [s],f_x [N],f_y [N],f_z [N]\n0,1,2,3\n";
    let read = Trajectory::from_csv(forces).unwrap();
    assert_eq!((read.points.len(), read.figures.len(), read.figures[0].unit.as_str()), (0, 3, "N"));
}

/// Two samples that would be written with equal times, or a number that no reader accepts, are refused before writing.
#[test]
fn numbers_and_steps_have_limits() {
    let text = "# groebot trajectory 1\ntime [s],power [W]\n0,1\nSTEP,NUMBER\n";
    let read = |step: &str, number: &str| Trajectory::from_csv(&text.replace("STEP", step).replace("NUMBER", number));
    assert!(read("1e-8", "1e15").is_ok());
    assert!(read("1e-9", "1").unwrap_err().message().contains("sample 2: its time"));
    let error = read("1", "1e160").unwrap_err();
    assert!(error.message().contains("at most 1e15") && error.place().line == Some(4), "{error}");
    let wide = format!("# groebot trajectory 1\ntime [s]{}\n", ",a [1]".repeat(10_000));
    assert!(Trajectory::from_csv(&wide).unwrap_err().message().contains("10001 columns are too many"));
}

#[test]
fn mistakes_have_a_line() {
    use ErrorKind::*;
    let text = sample().to_csv();
    let last = text.lines().last().unwrap();
    let cases = [
        ("# groebot trajectory 1", "# groebot trajectory 2", Syntax, 1, "version `2`"),
        ("# groebot trajectory 1\n", "", Syntax, 1, "begins with"),
        ("time [s]", "t [s]", MissingKey, 3, "give `time [s]`"),
        ("q:hip [rad]", "q:hip", Syntax, 3, "has no unit"),
        (last, "0.3,1", BadValue, 6, "2 cells; there are 22 columns"),
        ("0.1,0.1,", "0.1,x,", Syntax, 5, "`x` is not a finite number"),
        ("0.1,0.1,", "0.1,nan,", Syntax, 5, "`nan` is not a finite number"),
    ];
    for (from, to, kind, line, words) in cases {
        let error = Trajectory::from_csv(&text.replacen(from, to, 1)).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (kind, Some(line)), "{error}");
        assert!(error.message().contains(words), "{error}");
    }
    assert!(Trajectory::from_csv("# groebot trajectory 1\n").unwrap_err().message().contains("no row of names"));
    let twice = text.replacen("q:mast_x [m]", "q:hip [m]", 1);
    assert_eq!(Trajectory::from_csv(&twice).unwrap_err().kind(), DuplicateName);
}

proptest! {
    #![proptest_config(crate::cases(256))]

    /// No input causes a panic.
    #[test]
    fn damaged_tables_are_read_or_refused(at in 0usize..900, what in ".{0,4}", length in 0usize..30) {
        let text = sample().to_csv();
        let at = at % text.len();
        let end = (at + length).min(text.len());
        let _ = Trajectory::from_csv(&format!("{}{what}{}", &text[..at], &text[end..]));
        let json = sample().to_json().to_string();
        let (at, end) = (at % json.len(), end % json.len());
        let _ = Trajectory::from_json(&format!("{}{what}{}", &json[..at], &json[end.max(at)..]));
    }
}
