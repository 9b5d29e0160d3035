//! `groebot ik`: all joint values for a target. `groebot fk` maps each of them to the target.

use serde_json::Value;

use super::{refused, root, run, succeed, text};

fn solutions(arguments: &[&str]) -> Vec<Value> {
    let page: Value = serde_json::from_str(&succeed(&[&["ik", "--json"], arguments].concat())).unwrap();
    page["solutions"].as_array().unwrap().clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn joined(values: &[f64]) -> String {
    values.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

#[test]
fn fk_takes_every_answer_back_to_the_target() {
    let robot = root("tests/corpus/urdf/ur5.urdf");
    let (position, rpy) = ([0.4, 0.1, 0.5], [10.0, 120.0, -30.0]);
    let target = joined(&[position, rpy].concat());
    let found = solutions(&[text(&robot), "--target", &target, "--degrees"]);
    assert_eq!(found.len(), 8);
    for answer in found {
        let q = joined(&numbers(&answer["q"]));
        let page = succeed(&["fk", text(&robot), "--json", "--degrees", "--q", &q]);
        let reached: Value = serde_json::from_str(&page).unwrap();
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        // At a pitch of 120 degrees the other triple describes the same rotation.
        let other = [rpy[0] - 180.0, 180.0 - rpy[1], rpy[2] + 180.0];
        assert!(near(&numbers(&reached["position"]), &position), "{reached}");
        assert!(near(&numbers(&reached["rpy"]), &rpy) || near(&numbers(&reached["rpy"]), &other), "{reached}");
    }
}

#[test]
fn a_quaternion_and_angles_say_the_same() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let by_angles = solutions(&["puma", "--target", "0.3,1.1,0.4,0,0,90", "--degrees"]);
    let by_quaternion = solutions(&["puma", "--degrees", "--target", &joined(&[0.3, 1.1, 0.4, 0.0, 0.0, half, half])]);
    assert_eq!(by_angles.len(), 8);
    for (a, b) in by_angles.iter().zip(&by_quaternion) {
        assert!(numbers(&a["q"]).iter().zip(numbers(&b["q"])).all(|(a, b)| (a - b).abs() < 1e-9), "{a} {b}");
    }
}

#[test]
fn joint_values_are_among_the_answers_and_limits_are_reported() {
    let page = succeed(&["ik", "nao_left_leg", "--q", "5,10,-20,30,-10,5", "--degrees"]);
    let row = page
        .lines()
        .find(|line| ["5.000000", "10.000000", "-20.000000", "30.000000"].iter().all(|value| line.contains(value)));
    assert!(row.is_some_and(|row| !row.contains("outside")), "{page}");
    assert!(page.contains("KneePitch outside its limits"), "{page}");
}

#[test]
fn a_target_out_of_reach_is_reported() {
    assert_eq!(succeed(&["ik", "puma", "--target", "9,9,9,0,0,0"]), "puma at 9,9,9,0,0,0: out of reach: no solution\n");
    assert!(solutions(&["polar", "--target", "0.2,0.9,0.3"]).len() == 4);
}

#[test]
fn bad_targets_are_refused() {
    assert!(refused(&["ik", "puma"]).contains("no target"));
    assert!(refused(&["ik", "puma", "--target", "1,2,3,1,0,0,0,1,0,0,0,-1"]).contains("not a rotation matrix"));
    assert!(refused(&["ik", "puma", "--target", "1,2"]).contains("2 numbers are given; a pose has 6 numbers"));
    assert!(refused(&["ik", "puma", "--target", "1,2,x,0,0,0"]).contains("finite numbers separated by commas"));
    assert!(refused(&["ik", "puma", "--target", "1,2,nan,0,0,0"]).contains("finite numbers"));
    assert!(refused(&["ik", "puma", "--target", "1,2,3,0,0,0,2"]).contains("norm 2"));
    assert!(refused(&["ik", "puma", "--q", "1,2,3"]).contains("3 joint values are given; the chain has 6"));
    assert!(refused(&["ik", "polar", "--target", "1,2,3,4"]).contains("a position has 3 numbers"));
}

/// Seven numbers for an arm with a given joint: a quaternion without the joint's value, or three angles with it.
#[test]
fn a_quaternion_without_the_value_of_the_given_joint_is_refused() {
    let solved = |target: &str| run(&["ik", "kuka_iiwa14", "--given", "joint_5", "--target", target]);
    let error = solved("0.4,0.1,0.5,0,0.6,0,0.8").err;
    assert!(error.contains("the last four may be a quaternion") && error.contains("joint_5"), "{error}");
    let [quaternion, angles] = ["0.4,0.1,0.5,0,0,0,1,0.3", "0.4,0.1,0.5,0,0,0,0.3"].map(|target| solved(target).out);
    let rows =
        |text: &str| text.lines().skip(2).map(|row| row.split("  ").take(9).collect::<String>()).collect::<Vec<_>>();
    assert!(!rows(&quaternion).is_empty());
    assert_eq!(rows(&quaternion), rows(&angles));
}

/// A Stanford arm whose prismatic joint is after the first wrist axis: no method of groebot solves it in closed form.
const SLIDE_IN_THE_WRIST: &str = r#"
name = "arm"
source = "made for this test"
task = { kind = "pose" }
tip = { point = [0, 0.15, 1] }
joint = [
    { name = "j1", type = "revolute", axis = [0, 0, 1], point = [0, 0, 0] },
    { name = "j2", type = "revolute", axis = [0, 1, 0], point = [0, 0.1, 0.4] },
    { name = "j3", type = "revolute", axis = [0, 0, 1], point = [0, 0.15, 0.8] },
    { name = "j4", type = "prismatic", axis = [0, 0, 1], point = [0, 0.15, 0.8] },
    { name = "j5", type = "revolute", axis = [0, 1, 0], point = [0, 0.15, 0.8] },
    { name = "j6", type = "revolute", axis = [1, 0, 0], point = [0, 0.15, 0.8] },
]
"#;

#[test]
fn a_chain_without_closed_form_is_searched() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("arm.toml");
    std::fs::write(&file, SLIDE_IN_THE_WRIST).unwrap();
    // The derivation with all joints has as many solutions as the search below finds. One target of its check next to a singular pose is a weak spot.
    let derived = run(&["derive", text(&file)]);
    assert!([0, 3].contains(&derived.code), "{}", derived.err);
    assert!(derived.out.contains("8 solutions at most, all joints together"), "{}", derived.out);
    assert!(refused(&["ik", text(&file), "--q", "0,0,0,0,0,0"]).contains("ik --numeric"));
    // A rotation about the axis of a prismatic joint and its translation commute: the screw solver finds the same solutions in another order.
    let other = folder.path().join("other.toml");
    let swapped =
        SLIDE_IN_THE_WRIST.replace("name = \"j3\", type = \"revolute\"", "name = \"j4\", type = \"prismatic\"");
    let swapped = swapped.replacen(
        "{ name = \"j4\", type = \"prismatic\", axis = [0, 0, 1], point = [0, 0.15, 0.8] },\n    { name = \"j5\"",
        "{ name = \"j3\", type = \"revolute\", axis = [0, 0, 1], point = [0, 0.15, 0.8] },\n    { name = \"j5\"",
        1,
    );
    std::fs::write(&other, swapped).unwrap();
    let found = solutions(&[text(&file), "--numeric", "--q", "0.1,0.2,0.3,0.15,0.4,0.5"]);
    let by_screws = solutions(&[text(&other), "--q", "0.1,0.2,0.15,0.3,0.4,0.5"]);
    assert_eq!((found.len(), by_screws.len()), (8, 8));
    for answer in found.iter().map(|answer| numbers(&answer["q"])) {
        let [a, b, c, d, e, f] = answer[..] else { panic!("{answer:?}") };
        let near =
            |other: &Value| numbers(&other["q"]).iter().zip([a, b, d, c, e, f]).all(|(x, y)| (x - y).abs() < 1e-9);
        assert!(by_screws.iter().any(near), "{answer:?}");
    }
    let page = succeed(&["ik", text(&file), "--numeric", "--q", "0.1,0.2,0.3,0.15,0.4,0.5"]);
    assert!(page.contains("8 solutions, found by search; there may be others"), "{page}");
    let far = succeed(&["ik", "ur5", "--numeric", "--target", "9,9,9,0,0,0"]);
    assert!(far.contains("the search found none"), "{far}");
}

fn urdf(name: &str) -> String {
    text(&root("tests/corpus/urdf").join(name)).to_owned()
}

/// ABB's painting robot: two axes 5 have opposite directions, and the axes of the wrist do not intersect in one point. It has eight solutions, including these
/// joint values. Newton's method in numpy from 1,500 random starts confirms this.
#[test]
fn a_hollow_wrist_whose_axes_do_not_meet_is_searched() {
    let robot = urdf("irb5400.urdf");
    let refusal = run(&["derive", &robot, "--task", "pose"]);
    assert!(refusal.err.contains("32 complex solutions") && refusal.err.contains("ik --numeric"), "{}", refusal.err);
    let made = [0.3, 0.4, 0.2, 0.5, 0.9, -0.9, 0.7];
    let found = solutions(&[&robot, "--numeric", "--q", &joined(&made)]);
    assert_eq!(found.len(), 8);
    let answers: Vec<Vec<f64>> = found.iter().map(|answer| numbers(&answer["q"])).collect();
    assert!(answers.iter().all(|q| (q[4] + q[5]).abs() < 1e-12), "{answers:?}");
    assert!(answers.iter().any(|q| q.iter().zip(made).all(|(a, b)| (a - b).abs() < 1e-9)), "{answers:?}");
}

/// Joint values in degrees, with the first joint moved by whole turns into limits of 22.5 to 360 degrees: -73.52
/// becomes 286.48.
#[test]
fn answers_are_turned_into_limits() {
    let robot = urdf("limits_of_a_turn.urdf");
    let requested = ["--q", "5.0,0.3,0.4,4.0,0.7,-5.0"];
    let found = solutions(&[&[robot.as_str()], &requested[..]].concat());
    assert_eq!(found.len(), 8);
    for answer in &found {
        let q = numbers(&answer["q"]);
        assert!((22.5..=360.0).contains(&q[0].to_degrees()), "{answer}");
        let reached = |q: &[f64]| -> Value {
            serde_json::from_str(&succeed(&["fk", &robot, "--json", "--q", &joined(q)])).unwrap()
        };
        let outside = &reached(&q)["outside_limits"];
        assert_eq!(&answer["outside_limits"], outside, "no turn helps the joints that are outside");
    }
    // Values of more than one turn are permitted.
    let turned = solutions(&[&robot, "--q", &format!("{},0.3,0.4,4.0,0.7,-5.0", 5.0 + 4.0 * std::f64::consts::PI)]);
    for (one, other) in found.iter().zip(&turned) {
        assert!(numbers(&one["q"]).iter().zip(numbers(&other["q"])).all(|(a, b)| (a - b).abs() < 1e-9));
    }
    let page = succeed(&[&["ik", &robot], &requested[..]].concat());
    assert!(page.contains("286.478898") && !page.contains("j1 outside"), "{page}");
    assert!(page.starts_with("tip link `l6`: the only leaf link"), "{page}");
}

/// A prismatic joint and a six-joint arm: the planner gives the same joint as `derive`, and the solutions reach the
/// target.
#[test]
fn a_joint_too_many_is_given_as_the_planner_chooses() {
    let robot = urdf("arm_on_a_rail.urdf");
    let values = [0.4, 0.3, -0.5, 0.6, 0.2, 0.7, -0.4];
    let (requested, json) = (joined(&values), |more: &[&str]| -> Value {
        serde_json::from_str(&succeed(&[&["ik", &robot, "--json", "--q", &joined(&values)], more].concat())).unwrap()
    });
    let (chosen, named) = (json(&[]), json(&["--given", "j2"]));
    for answer in [&chosen, &named] {
        let found: Vec<Vec<f64>> =
            answer["solutions"].as_array().unwrap().iter().map(|solution| numbers(&solution["q"])).collect();
        let near = |q: &&Vec<f64>| q.iter().zip(values).all(|(a, b)| (a - b).abs() < 1e-9);
        assert_eq!(found.iter().filter(near).count(), 1, "{answer}");
        assert!(found.iter().all(|q| (q[1] - 0.3).abs() < 1e-15), "j2 is given: {answer}");
    }
    assert_eq!((&chosen["given"]["joints"], &named["given"]), (&Value::from(vec!["j2"]), &Value::Null));
    let page = succeed(&["ik", &robot, "--given", "auto", "--q", &requested]);
    assert!(page.contains("Given with each target: the value of `j2`. The planner chose; `--given JOINT`"), "{page}");
}

#[test]
fn without_an_order_derive_is_named_first() {
    let reported = refused(&["ik", &urdf("slide_and_five_axes.urdf"), "--q", "0.1,0.2,0.3,0.4,0.5,0.6"]);
    let place = |words: &str| reported.find(words).unwrap_or_else(|| panic!("{words}: {reported}"));
    assert!(place("`groebot derive`") < place("`groebot ik --numeric`"), "{reported}");
}

#[test]
fn a_base_at_survey_distance_is_named() {
    let robot = urdf("survey_base.urdf");
    let out = tempfile::tempdir().unwrap();
    let ends = ["--base", "w", "--tip", "t"];
    for command in [
        [&["derive", &robot, "--out", text(out.path())], &ends[..]].concat(),
        [&["ik", &robot, "--q", "0,0,0,0,0,0"], &ends[..]].concat(),
        [&["plan", &robot], &ends[..]].concat(),
    ] {
        let reported = refused(&command);
        assert!(reported.contains("choose a base link nearer to the arm, `b` (`--base`)"), "{reported}");
    }
    assert!(succeed(&[&["info", &robot], &ends[..]].concat()).contains("choose a base link nearer to the arm, `b`"));
    assert_eq!(solutions(&[&robot, "--base", "b", "--q", "0.1,0.2,0.3,0.4,0.5,0.6"]).len(), 8);
}

/// In the last row of a standard table a and alpha are zero. Read as a modified table, its last two axes are coaxial.
#[test]
fn a_table_of_the_other_convention_is_suspected() {
    for (own, other) in [("standard", "modified"), ("modified", "standard")] {
        let table = std::fs::read_to_string(urdf(&format!("ur5_{own}.toml"))).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("table.toml");
        std::fs::write(&file, table.replace(&format!("\"{own}\""), &format!("\"{other}\""))).unwrap();
        let advice = format!("try `convention = \"{own}\"`");
        for command in ["derive", "plan"] {
            let reported = refused(&[command, text(&file)]);
            assert!(reported.contains(&advice), "{reported}");
        }
        assert!(succeed(&["info", text(&file)]).contains(&advice));
        assert!(!succeed(&["info", &urdf(&format!("ur5_{own}.toml"))]).contains("convention ="));
    }
}
