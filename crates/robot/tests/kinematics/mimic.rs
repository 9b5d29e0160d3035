//! Coupled joints: telescopes become one joint, others follow. Poses are compared with a URDF without `<mimic>`, where
//! each joint has the value given by its law.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::numeric::NumericSolver;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Target, Task};
use groebot_robot::model::Robot;

const TELESCOPE: &str = include_str!("../../../../tests/corpus/urdf/telescope.urdf");
const FINGER: &str = include_str!("../../../../tests/corpus/urdf/finger.urdf");

/// Same robot, but with every joint independent.
fn alone(text: &str) -> Chain {
    let lines: Vec<&str> = text.lines().filter(|line| !line.contains("<mimic")).collect();
    Robot::from_urdf(&lines.join("\n")).unwrap().chain(None, Some("tip")).unwrap()
}

fn chain(text: &str) -> Chain {
    Robot::from_urdf(text).unwrap().chain(None, Some("tip")).unwrap()
}

fn apart(a: &Chain, p: &[f64], b: &Chain, q: &[f64]) -> f64 {
    (a.forward(p).unwrap().to_homogeneous() - b.forward(q).unwrap().to_homogeneous()).norm()
}

#[test]
fn slides_that_move_together_are_one_joint() {
    let whole = chain(TELESCOPE);
    let names: Vec<&str> = whole.joints().iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["lift", "first + second + third - fourth", "wrist"]);
    // The joint's value is the sum. The second moves as far as the first, the third twice as far, and the fourth half
    // as far in the opposite direction.
    for (lift, first, wrist) in [(0.3, 0.1, 0.5), (1.0, -0.04, -2.0)] {
        let each = [lift, first, first, 2.0 * first, -0.5 * first, wrist];
        let sum = first * (1.0 + 1.0 + 2.0 + 0.5);
        assert!(apart(&whole, &[lift, sum, wrist], &alone(TELESCOPE), &each) < 1e-15);
    }
    // The tightest limits are those of the third: 0.15 for its 2 parts of 4.5.
    let (low, high) = whole.joints()[1].limits.unwrap();
    assert!(low.abs() < 1e-15 && (high - 0.15 * 4.5 / 2.0).abs() < 1e-12, "{low}..{high}");
    let tree = Robot::from_urdf(TELESCOPE).unwrap();
    let notes = tree.notes(&tree.path(None, Some("tip")).unwrap());
    assert!(
        notes
            .iter()
            .any(|note| note.contains("whose value is this sum; first is 0.222") && note.contains("third is 0.444")),
        "{notes:?}"
    );
}

#[test]
fn a_joint_that_turns_follows() {
    let whole = chain(FINGER);
    let mut q = vec![0.4, -0.3, 0.7, 9.0, 9.0];
    whole.follow(&mut q);
    // The multipliers in the file are -1 and 1.5, the offset is 0.25.
    assert_eq!(q, [0.4, -0.3, 0.7, -0.7, 1.5 * -0.7 + 0.25]);
    assert!(whole.strays(&q) < 1e-15 && whole.strays(&[0.0; 5]) > 0.2);
    assert!(apart(&whole, &q, &alone(FINGER), &q) < 1e-15);
    assert_eq!(whole.open_leaders(), ["knuckle"]);
    let error = whole.check_leaders().unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(
        error.message().contains("`--given knuckle`") && error.message().contains("`last` is -1.5 * knuckle + 0.25"),
        "{error}"
    );
}

#[test]
fn where_the_leader_is_given_the_others_are() {
    let requested =
        chain(FINGER).with_task(Task::Position, groebot_robot::kinematics::along_z(), vec!["knuckle".into()]).unwrap();
    assert_eq!((requested.given(), requested.given_inputs()), (vec![2, 3, 4], vec![2]));
    let solver = ScrewSolver::new(&requested);
    let numeric = NumericSolver::new(&requested).unwrap();
    for at in 0..20 {
        let mut q = vec![0.37 * f64::from(at) - 3.0, 0.2 * f64::from(at) - 2.0, 0.1 * f64::from(at), 0.0, 0.0];
        requested.follow(&mut q);
        let target = Target::reached(&requested, &q).unwrap();
        let found = |answers: Vec<groebot_robot::kinematics::Solution>| {
            answers.iter().any(|answer| answer.q.iter().zip(&q).all(|(a, b)| (a - b).sin().abs() < 1e-7))
        };
        assert!(found(numeric.solve(&target, &[q[2]]).unwrap()), "{at}");
        assert!(found(solver.as_ref().unwrap().solve_given(&target, &[q[2]]).unwrap()), "{at}");
    }
}

#[test]
fn a_search_finds_a_leader_and_what_follows_it() {
    // The position of a fingertip: three unknown numbers, for any multipliers.
    let requested = chain(FINGER).with_task(Task::Position, groebot_robot::kinematics::along_z(), Vec::new()).unwrap();
    let mut q = vec![0.5, -0.4, 0.6, 0.0, 0.0];
    requested.follow(&mut q);
    let target = Target::reached(&requested, &q).unwrap();
    let answers = NumericSolver::new(&requested).unwrap().solve(&target, &[]).unwrap();
    assert!(answers.iter().all(|answer| requested.strays(&answer.q) < 1e-12));
    assert!(answers.iter().any(|answer| (0..5).all(|joint| (answer.q[joint] - q[joint]).abs() < 1e-8)), "{answers:?}");
}

#[test]
fn a_toml_chain_may_have_followers_too() {
    let text = |mimic: &str| {
        format!(
            "name = \"two\"\n[task]\nkind = \"position\"\n[[joint]]\nname = \"a\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [0, 0, 0]\n\
             [[joint]]\nname = \"b\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [1, 0, 0]\nmimic = {mimic}\n[tip]\npoint = [2, 0, 0]\n"
        )
    };
    let chain = Chain::from_toml(&text("{ joint = \"a\", multiplier = -2, offset = 0.5 }")).unwrap();
    assert_eq!(chain.leader(1).map(|(leader, mimic)| (leader, mimic.law())), Some((0, [-2.0, 0.5])));
    assert_eq!(chain.joints()[1].mimic.as_ref().unwrap().to_string(), "-2 * a + 0.5");
    let again: Chain = serde_json::from_str(&serde_json::to_string(&chain).unwrap()).unwrap();
    assert_eq!(again, chain);
    for (mimic, kind, words) in [
        ("{ joint = \"c\" }", ErrorKind::UnknownName, "mimics `c`, which is not a joint"),
        ("{ joint = \"b\" }", ErrorKind::BadValue, "is a mimic joint"),
        ("{ joint = \"a\", multiplier = 0 }", ErrorKind::BadValue, "multiplier is zero"),
        ("{ joint = \"a\", factor = 2 }", ErrorKind::UnknownKey, "factor"),
        ("{ multiplier = 2 }", ErrorKind::MissingKey, "joint"),
    ] {
        let error = Chain::from_toml(&text(mimic)).unwrap_err();
        assert_eq!((error.kind(), error.to_string().contains("line ")), (kind, true), "{error}");
        assert!(error.message().contains(words), "{error}");
    }
    let given = chain.with_task(Task::Position, groebot_robot::kinematics::along_z(), vec!["b".into()]).unwrap_err();
    assert!(given.message().contains("joint `b` follows `a`; name that one"), "{given}");
}
