//! Denavit-Hartenberg tables in CSV, and calibrations of Universal Robots.

use std::f64::consts::FRAC_PI_2;

use groebot_robot::document::as_toml;
use groebot_robot::kinematics::Chain;
use groebot_robot::model::Robot;
use groebot_robot::{ErrorKind, robots};
use nalgebra::{Matrix4, Rotation3, Vector3};

/// The table in the documentation.
fn page() -> &'static str {
    let page = include_str!("../../docs/dh_csv.md");
    page.split("```text\n").nth(1).unwrap().split("```").next().unwrap()
}

/// Rz(theta) Tz(d) Tx(a) Rx(alpha), Denavit and Hartenberg 1955.
fn row(theta: f64, d: f64, a: f64, alpha: f64) -> Matrix4<f64> {
    let turn = |axis: Vector3<f64>, angle| Rotation3::new(axis * angle).to_homogeneous();
    turn(Vector3::z(), theta) * Matrix4::new_translation(&Vector3::new(a, 0.0, d)) * turn(Vector3::x(), alpha)
}

#[test]
fn a_table_in_csv_is_the_product_of_its_rows() {
    let chain = Chain::from_dh_toml(&as_toml(page().to_owned()).unwrap()).unwrap();
    let q = [0.3, -0.4, 0.7, 0.2, -0.5, 0.1];
    let h = FRAC_PI_2;
    let expected = row(q[0], 0.0, 0.0, h)
        * row(q[1], 0.0, 431.8, 0.0)
        * row(q[2], 150.05, 20.3, -h)
        * row(q[3], 431.8, 0.0, h)
        * row(q[4], 0.0, 0.0, -h)
        * row(q[5], 0.0, 0.0, 0.0);
    let found = chain.forward(&q).unwrap().to_homogeneous();
    assert!((found - expected).abs().max() < 1e-12, "{found}{expected}");
    let (lower, upper) = chain.joints()[5].limits.unwrap();
    assert!((lower.to_degrees() + 266.0).abs() < 1e-9 && (upper.to_degrees() - 266.0).abs() < 1e-9);
}

#[test]
fn names_and_units_of_columns_vary() {
    let plain = "# Convention = Modified\nLink,Kind,alpha_deg,a (mm),Theta [deg],d [mm]\n1,R,0,0,q1,400\n2,R,-90,25,-90,0\n3,P,90,0,0,30\n";
    let pi = "# convention: modified\nname,type,alpha,a [mm],theta,d [mm]\n1,revolute,0,0,,400\n2,revolute,-pi/2,25,-pi/2,0\n3,prismatic,0.5*pi,0,0,30\n";
    let chains = [plain, pi].map(|text| Chain::from_dh_toml(&as_toml(text.to_owned()).unwrap()).unwrap());
    assert_eq!(chains[0].joints(), chains[1].joints());
    assert_eq!(chains[0].base_from_tip(), chains[1].base_from_tip());
}

/// Excel writes a byte-order mark and the separators of empty cells, and in many countries semicolons and decimal commas.
#[test]
fn tables_of_spreadsheets_are_read() {
    let plain = page();
    let chain = |text: String| Chain::from_dh_toml(&as_toml(text).unwrap()).unwrap();
    let expected = chain(plain.to_owned());
    let european = plain.replace(", ", ";").replace('.', ",");
    let padded = |separator: &str| {
        let rows = plain.lines().map(|line| {
            if line.starts_with('#') {
                format!("\"{line}\"{}", separator.repeat(6))
            } else {
                line.replace(", ", separator)
            }
        });
        rows.collect::<Vec<_>>().join("\r\n") + &format!("\r\n{}\r\n", separator.repeat(6))
    };
    for text in [
        format!("\u{feff}{plain}"),
        european.clone(),
        padded(","),
        padded(";"),
        padded("\t"),
        format!("\u{feff}{european}"),
    ] {
        let found = chain(text.clone());
        assert_eq!((found.joints(), found.name()), (expected.joints(), expected.name()), "{text}");
        assert_eq!(found.base_from_tip(), expected.base_from_tip(), "{text}");
    }
}

#[test]
fn faults_of_a_table_have_their_line() {
    let head = "# convention: standard\nname, theta, d, a, alpha\n";
    let cases = [
        ("name,theta,d,a,alpha\nj,0,0,1,0\n".to_owned(), ErrorKind::MissingKey, None, "# convention: standard"),
        (format!("{head}j,0,0,1\n"), ErrorKind::BadValue, Some(3), "4 cells"),
        (format!("{head}\nj,0,0,x,0\n"), ErrorKind::Syntax, Some(4), "x"),
        (format!("{head}j,q1+90,0,1,0\n"), ErrorKind::Syntax, Some(3), "q1+90"),
        (format!("{head}j,q1-pi/2,0,1,0\n"), ErrorKind::BadValue, Some(3), "q1-pi/2"),
        (format!("{head}j,nan,0,1,0\n"), ErrorKind::Syntax, Some(3), "nan"),
        (format!("{head}j,q1*2,0,1,0\n"), ErrorKind::Syntax, Some(3), "q1*2"),
        (
            "# convention: standard\nname;theta;d;a;alfa\n".to_owned(),
            ErrorKind::UnknownKey,
            Some(2),
            "did you mean `alpha`",
        ),
        (
            "# convention: standard\nname,theta,d,a,alpha [grad]\n".to_owned(),
            ErrorKind::BadValue,
            Some(2),
            "m, mm, rad or deg",
        ),
        (format!("{head}j,0,0,1,pi/0\n"), ErrorKind::BadValue, Some(3), "pi/0"),
        (
            "# convention: standard\nname,theta [deg],d,a,alpha [rad]\n".to_owned(),
            ErrorKind::BadValue,
            Some(2),
            "different units",
        ),
        ("# convention: standard\nname,a,alpha,colour\n".to_owned(), ErrorKind::UnknownKey, Some(2), "colour"),
        ("# convention: standard\nname,a,a,alpha\n".to_owned(), ErrorKind::DuplicateName, Some(2), "twice"),
        (format!("# convention: other\n{}j,0,0,1,0\n", &head[23..]), ErrorKind::BadValue, None, "standard"),
    ];
    for (text, kind, line, part) in cases {
        let error = as_toml(text.clone()).and_then(|toml| Chain::from_dh_toml(&toml).map(drop)).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}\n{text}");
        assert!(error.to_string().contains(part), "{error}\n{text}");
        if let Some(line) = line {
            assert!(error.to_string().contains(&format!("line {line}")), "{error}\n{text}");
        }
    }
}

/// The kinematics that Universal Robots publishes for every UR10e, in the format of a calibration.
const UR10E: &str = "\
kinematics:
  shoulder: {x: 0, y: 0, z: 0.1807, roll: -0, pitch: 0, yaw: -0}
  upper_arm: {x: -0, y: -0, z: 0, roll: 1.570796327, pitch: 0, yaw: -0}
  forearm: {x: -0.6127, y: 0, z: 0, roll: -0, pitch: 0, yaw: -0}
  wrist_1: {x: -0.57155, y: 0, z: 0.17415, roll: -0, pitch: 0, yaw: -0}
  wrist_2: {x: 0, y: -0.11985, z: -2.458164590756244e-11, roll: 1.570796327, pitch: 0, yaw: -0}
  wrist_3: {x: 0, y: 0.11655, z: -2.390480459346185e-11, roll: 1.570796326589793, pitch: 3.141592653589793, yaw: 3.141592653589793}
  hash: calib_1
";

/// The same in YAML's block style, as the driver writes it.
fn block() -> String {
    UR10E.replace(": {", ":\n    ").replace(", ", "\n    ").replace('}', "")
}

#[test]
fn a_calibration_is_the_robot_of_ur_description() {
    let listed = robots::by_name("ur10e").unwrap();
    let robot = Robot::from_toml(&as_toml(block()).unwrap()).unwrap();
    let chain = robot.chain(None, Some("tool0")).unwrap();
    let q = [0.3, -1.4, 1.7, 0.2, -0.5, 0.1];
    let [found, expected] = [&chain, &listed].map(|chain| chain.forward(&q).unwrap().to_homogeneous());
    assert!((found - expected).abs().max() < 1e-12, "{found}{expected}");
    assert!(robot.parts().source.as_deref().unwrap().contains("calib_1"));
}

#[test]
fn faults_of_a_calibration_have_their_line() {
    let renamed = as_toml(block().replace("wrist_2:", "wrist2:")).unwrap_err();
    assert_eq!((renamed.kind(), renamed.message()), (ErrorKind::MissingKey, "`wrist_2` has no `x`"));
    let missing = as_toml(block().replace("    z: 0.17415\n", "")).unwrap_err();
    assert_eq!((missing.kind(), missing.message()), (ErrorKind::MissingKey, "`wrist_1` has no `z`"));
    for (from, to) in [
        ("0.17415", "long"),
        ("0.17415", "[1, 2]"),
        ("0.17415", "{a: {b: 1}}"),
        ("0.17415", "nan"),
        ("0.17415", "*other"),
    ] {
        let error = as_toml(block().replace(from, to)).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::BadValue | ErrorKind::Syntax), "{error}");
        assert!(error.to_string().contains("line "), "{error}");
    }
}
