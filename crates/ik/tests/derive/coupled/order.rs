//! Planar chains on one shoulder actuator, compared with the law of cosines, and the order of solution of the chains.

use std::path::Path;

use groebot_ik::derive::Derivation;
use groebot_ik::derive::coupled::CoupledChains;
use groebot_ik::{Error, ErrorKind, Watch};

use super::distance;

const Z: &str = "type = \"revolute\"\naxis = [0, 0, 1]";

/// A planar chain of links of length one.
fn member(name: &str, joints: usize, task: &str) -> String {
    let joint = |k: usize| format!("[[chain.chain.joint]]\nname = \"j{k}\"\n{Z}\npoint = [{k}, 0, 0]\n");
    let joints: String =
        (0..joints).map(joint).collect::<String>() + &format!("[chain.chain.tip]\npoint = [{joints}, 0, 0]\n");
    format!(
        "[[chain]]\nname = \"{name}\"\n[chain.chain]\nname = \"{name}\"\ntask = {{ {task}, plane = \"xy\" }}\n{joints}"
    )
}

fn derive(shared: &str, members: &[String]) -> Result<Derivation, Error> {
    let text = format!("name = \"planar\"\nshared = {shared}\n{}", members.concat());
    Derivation::of_problem(CoupledChains::from_toml(&text, Path::new("")).unwrap(), &Watch::none())
}

const POSITION: &str = "kind = \"planar_position\"";
const POSE: &str = "kind = \"planar_pose\"";

/// The first arm has two links, the second three; both share the first joint. At q = (0, pi/2) the first arm's tip is at (1, 1), which (pi/2, -pi/2) also
/// reaches. The second arm's tip at (0, 0, pi/2) is (2, 1). With j0 = 0 its elbow is at (1, 0) or, for the relative tip (1, 1), at (1, 1). With j0 = pi/2 the
/// elbow is at (0, 1), and the tip (2, 1) is just in reach.
#[test]
fn each_way_of_the_first_chain_is_continued_by_the_second() {
    let members = [member("b", 3, POSITION), member("a", 2, POSITION)];
    let arms = derive("[[\"b.j0\", \"a.j0\"]]", &members).unwrap();
    assert_eq!(arms.coupled().unwrap().method.stages.iter().map(|stage| stage.member).collect::<Vec<_>>(), [1, 0]);
    let joints: Vec<&str> = arms.program().joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(joints, ["j0", "a_j1", "b_j1", "b_j2"]);
    let half = std::f64::consts::FRAC_PI_2;
    let target = [1.0, 1.0, 1.9, 1.0];
    let answers = arms.program().solve_numbers(&target).unwrap();
    // The second arm reaches (1.9, 1) from (1, 0) and from (0, 1), with two elbows each.
    assert_eq!(answers.len(), 4, "{answers:?}");
    for hip in [0.0, half] {
        let count = answers.iter().filter(|answer| distance(&answer.q[..1], &[hip]) < 1e-12).count();
        assert_eq!(count, 2, "{answers:?}");
    }
    let elbow = (0.95_f64).acos();
    let expected = [half, -half, -half + elbow, -2.0 * elbow];
    assert!(answers.iter().any(|answer| distance(&answer.q, &expected) < 1e-12), "{expected:?}: {answers:?}");
    for answer in &answers {
        let reached = arms.reached(&answer.q).unwrap();
        assert!(reached.iter().zip(target).all(|(a, b)| (a - b).abs() < 1e-12), "{reached:?}");
    }
}

/// Three chains on one actuator: its angle occurs once among the joints.
#[test]
fn an_actuator_of_three_chains_stands_once() {
    let members = [member("a", 2, POSITION), member("b", 2, POSITION), member("c", 3, POSITION)];
    let arms = derive("[[\"a.j0\", \"c.j0\", \"b.j0\"]]", &members).unwrap();
    assert_eq!(arms.program().joints.len(), 5);
    let solver = arms.program().solver();
    for q in [[0.3, 0.7, -1.1, 0.4, 0.9], [-2.0, 1.0, 2.0, -1.5, 0.5]] {
        let target = arms.reached(&q).unwrap();
        let answers = solver.solve_numbers(&target).unwrap();
        assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-12), "{q:?}: {answers:?}");
        // b has one joint for two numbers, so only the hip value of the target's joints fits.
        assert!(answers.iter().all(|answer| distance(&answer.q[..1], &q[..1]) < 1e-12), "{answers:?}");
        assert_eq!(answers.len(), 2, "{answers:?}");
    }
}

/// Two arms of two links on one shoulder: four numbers for three actuators. The first arm's elbow is at (1, 0) or (0, 1) for its tip at (1, 1).
#[test]
fn two_arms_that_must_agree_on_the_shoulder() {
    let arms = derive("[[\"a.j0\", \"b.j0\"]]", &[member("a", 2, POSITION), member("b", 2, POSITION)]).unwrap();
    assert!(arms.coupled().unwrap().method.simultaneous.is_some() && arms.dimension() == Some(2));
    let solver = arms.program().solver();
    for q in [[0.3, 0.7, -1.1], [-2.0, 1.0, 2.0], [0.0, std::f64::consts::PI, 0.5]] {
        let answers = solver.solve_numbers(&arms.reached(&q).unwrap()).unwrap();
        assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-7), "{q:?}: {answers:?}");
    }
    // The second arm's shoulder is at 0.25 or, mirrored at the line to its tip, at 0.85. The first one's is at 0 or pi/2.
    let (near, far) = (0.25_f64, 0.85_f64);
    let target = [1.0, 1.0, near.cos() + far.cos(), near.sin() + far.sin()];
    assert!(solver.solve_numbers(&target).unwrap().is_empty());
    let explained = arms.coupled().unwrap().explain(&target, &Watch::none()).unwrap().unwrap();
    let disagreement = explained.disagreement.unwrap();
    assert_eq!((explained.member.as_str(), disagreement.actuator.as_str()), ("b", "j0"));
    assert!((disagreement.off() - 0.25).abs() < 1e-9, "{disagreement:?}");
}

#[test]
fn chains_that_cannot_be_solved_say_what_is_open() {
    let error = derive("[[\"a.j0\", \"b.j0\"]]", &[member("a", 3, POSITION), member("b", 3, POSITION)]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::PositiveDimensional);
    assert!(error.message().contains("`a` has 3 joints to find, its task `planar_position` determines 2"), "{error}");
}

#[test]
fn a_joint_that_is_found_before_is_not_given_too() {
    let second =
        member("b", 2, POSE).replace("name = \"b\"\n[chain.chain]", "name = \"b\"\ngiven = [\"j0\"]\n[chain.chain]");
    let error = derive("[[\"a.j0\", \"b.j0\"]]", &[member("a", 2, POSITION), second]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue);
    assert!(error.message().contains("`b`: `j0` is given"), "{error}");
}

/// A hip value given to the first chain is also given to the second.
#[test]
fn a_given_shared_joint_is_given_once() {
    let given = |text: String| text.replace("\n[chain.chain]\n", "\ngiven = [\"j0\"]\n[chain.chain]\n");
    let arms = derive("[[\"a.j0\", \"b.j0\"]]", &[given(member("a", 3, POSITION)), member("b", 3, POSITION)]).unwrap();
    let inputs: Vec<&str> = arms.program().inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(inputs, ["a_px", "a_py", "a_j0", "b_px", "b_py"]);
    let q = [0.4, 0.5, 0.6, -0.7, -0.8];
    let answers = arms.program().solve_numbers(&arms.reached(&q).unwrap()).unwrap();
    assert_eq!(answers.len(), 4, "{answers:?}");
    assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-12), "{answers:?}");
}
