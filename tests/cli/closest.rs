//! `groebot solve --closest`: text, JSON and CSV say the same of targets out of reach, and nothing else changes.

use serde_json::Value;

use super::{refused, root, run, run_on, succeed};

/// The links of `planar_2r` are 0.5 and 0.4 m long.
const REACH: f64 = 0.9;

/// The committed derivation of an arm of two joints, whose program compares each number of the target with the joints.
fn arm() -> String {
    root("derivations/planar_2r").to_str().unwrap().to_owned()
}

fn json(target: &str, more: &[&str]) -> Value {
    let text = succeed(&[&["solve", &arm(), "--json", "--target", target], more].concat());
    serde_json::from_str(&text).unwrap()
}

/// The leg is stretched towards 300, 400, whose distance is 500.
#[test]
fn an_arm_stretches_towards_a_target_out_of_reach() {
    let answer = json("3,4", &["--closest"]);
    assert_eq!(answer["solutions"], Value::Array(Vec::new()));
    let closest = &answer["closest"];
    let distance = closest["distance"].as_f64().unwrap();
    assert!((distance - (5.0 - REACH)).abs() < 1e-9, "{distance}");
    assert_eq!((closest["angle"].as_f64(), closest["is_minimum"].as_bool()), (Some(0.0), Some(true)));
    let q: Vec<f64> = closest["q"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
    assert!(q[1].abs() < 1e-6, "{q:?}");
    let reached: Vec<f64> =
        closest["reached"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
    assert!((reached[0] - 0.6 * REACH).abs() < 1e-6 && (reached[1] - 0.8 * REACH).abs() < 1e-6, "{reached:?}");
    let [starts, agreeing] = ["starts", "agreeing"].map(|name| closest[name].as_u64().unwrap());
    assert!(0 < agreeing && agreeing <= starts, "{closest}");
}

#[test]
fn without_the_option_and_for_reachable_targets_nothing_is_added() {
    assert!(json("3,4", &[]).get("closest").is_none());
    assert!(json("0.6,0.3", &["--closest"]).get("closest").is_none());
    let plain = succeed(&["solve", &arm(), "--target", "0.6,0.3"]);
    assert_eq!(succeed(&["solve", &arm(), "--target", "0.6,0.3", "--closest"]), plain);
}

#[test]
fn text_names_the_error_and_the_joints() {
    let text = succeed(&["solve", &arm(), "--target", "3,4", "--closest"]);
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].ends_with("unreachable: no solution"), "{text}");
    assert!(
        lines[1].starts_with("closest joint values: 4.100000 m from the target; a local minimum, found from "),
        "{text}"
    );
    assert!(lines[2].contains("Shoulder") && lines[3].contains(" deg ("), "{text}");
    // A number that rounds to zero has no sign: the elbow is straight.
    assert!(lines[3].ends_with("  0.000000 deg (0.000000000 rad)"), "{text}");
}

#[test]
fn csv_has_the_joints_and_the_error_in_the_row_without_solutions() {
    let out = run_on(&["solve", &arm(), "--closest"], b"3,4\n0.6,0.3\n");
    let text = out.out;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|cell| cell == name).unwrap_or_else(|| panic!("{name}: {text}"));
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 3, "{text}");
    assert_eq!(&rows[0][column("solutions")], "0");
    let number = |row: usize, name: &str| rows[row][column(name)].parse::<f64>().unwrap();
    assert!((number(0, "closest_distance") - (5.0 - REACH)).abs() < 1e-9, "{text}");
    assert!(number(0, "Elbow").abs() < 1e-6 && number(0, "closest_angle") == 0.0, "{text}");
    assert_eq!((&rows[1][column("solutions")], &rows[1][column("closest_distance")]), ("2", ""), "{text}");
    // The command reads its own output.
    let again = run_on(&["solve", &arm(), "--closest"], text.as_bytes());
    assert_eq!(again.code, 0, "{}", again.err);
}

/// Equations do not compare the numbers of a target with those of a tip.
#[test]
fn equations_are_refused_with_the_command_that_helps() {
    let equations = root("derivations/nao_arm_planar");
    let refused = refused(&["solve", equations.to_str().unwrap(), "--target", "3,4", "--closest"]);
    assert!(refused.contains("`groebot derive CHAIN`"), "{refused}");
}

#[test]
fn a_length_needs_the_option_and_must_be_positive() {
    let alone = run(&["solve", &arm(), "--target", "3,4", "--length", "1"]);
    assert_eq!(alone.code, 2, "{}", alone.err);
    let refused = refused(&["solve", &arm(), "--target", "3,4", "--closest", "--length=-1"]);
    assert!(refused.contains("give a positive number"), "{refused}");
}
