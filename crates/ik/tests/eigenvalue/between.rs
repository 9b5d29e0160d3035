//! Given joints between the six that are found together: revolute and prismatic, one and several.

use groebot_ik::derive::Derivation;
use groebot_ik::derive::closure::Mechanism;
use groebot_ik::derive::eigenvalue::{Determinant, all, fits};
use groebot_ik::derive::planner::{constant_relation, is_constant};
use groebot_ik::solver::eigenvalue::{GivenAxis, GivenLine, SixAxes, SixAxesParts};
use groebot_ik::solver::{Program, Step};
use groebot_ik::witness::Options;
use groebot_ik::witness::chain::check_chain;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Chain, ChainParts, Joint, Task, along_z};

use super::given::{ARM, slid, with_given};
use super::rational;

const IIWA: &str = include_str!("../../../../derivations/iiwa14/0_chain.toml");

/// Derives the solver of a chain with given joints, and checks it with the numeric solver and the chain's forward kinematics.
fn derived(chain: &Chain) -> Derivation {
    let derived = Derivation::by_eigenvalues(chain, &Watch::none()).unwrap();
    let options = Options { targets: 60, oracle: 1, exact: 4, seed: 3, ..Options::default() };
    let report = check_chain(chain, derived.program(), derived.dimension(), &options, &Watch::none()).unwrap();
    let failures: Vec<String> = report.failures().filter(|row| !row.is_weak_spot()).map(|r| r.to_string()).collect();
    assert!(failures.is_empty(), "{:?}: {}", chain.parts().given, failures.join("\n"));
    assert!(report.rows.iter().filter(|row| row.solutions > 2).count() > 20, "{}", report.summary());
    derived
}

fn parts_of(program: &Program) -> SixAxesParts {
    let steps = program.cases().flat_map(|case| &case.steps);
    let parts = |step: &Step| if let Step::SixAxes(six) = step { Some(six.parts().clone()) } else { None };
    steps.into_iter().find_map(parts).unwrap()
}

#[test]
fn a_joint_between_others_is_given() {
    let slide = slid("Joint3");
    for (text, joint) in [(ARM, "Joint4"), (ARM, "Joint6"), (&slide, "Joint3")] {
        let chain = with_given(text, joint);
        let derived = derived(&chain);
        let again = Derivation::prove(&chain, &derived.certificate().unwrap()).unwrap();
        assert_eq!(again.program(), derived.program());
        assert_eq!(Program::from_json(&derived.program().to_json()).unwrap(), *derived.program());
        assert_eq!(parts_of(derived.program()).given.len(), 1);
    }
}

/// Nine joints with three given: two that follow each other, and one behind two others.
#[test]
fn several_joints_between_others_are_given() {
    let mut parts: ChainParts = Chain::from_toml(ARM).unwrap().into();
    let extra = |name: &str, axis: [i64; 3], like: &Joint| Joint {
        name: name.to_owned(),
        symbol: name.to_owned(),
        axis: axis.map(|entry| rational(entry, 1)),
        point: std::array::from_fn(|k| &like.point[k] + rational(3 + k as i64, 100)),
        ..like.clone()
    };
    let [first, second] = [extra("extra", [2, 1, 2], &parts.joints[1]), extra("other", [0, 3, 4], &parts.joints[4])];
    parts.joints.insert(2, first);
    parts.joints.insert(6, second);
    parts.given = ["Joint2", "extra", "other"].map(str::to_owned).to_vec();
    let derived = derived(&Chain::new(parts).unwrap());
    let before: Vec<usize> = parts_of(derived.program()).given.iter().map(|given| given.axis.before).collect();
    assert_eq!(before, [1, 1, 4]);
}

/// A joint at an end, and one between others.
#[test]
fn a_joint_at_an_end_and_one_between_are_given() {
    let mut parts: ChainParts = Chain::from_toml(ARM).unwrap().into();
    let last = parts.joints[6].clone();
    let axis = [1, 2, 2].map(|entry| rational(entry, 1));
    parts.joints.push(Joint { name: "hand".to_owned(), symbol: "hand".to_owned(), axis, ..last });
    parts.given = ["Joint4", "hand"].map(str::to_owned).to_vec();
    let derived = derived(&Chain::new(parts).unwrap());
    assert_eq!(parts_of(derived.program()).given.len(), 1);
}

/// The determinant depends on the seed of the given value too, and is not zero for at least one formulation.
#[test]
fn the_given_value_is_random() {
    let chain = with_given(ARM, "Joint4");
    let prime = 2_147_483_629;
    let at = |seed| all().map(|f| Determinant::evaluate(&chain, f, prime, seed).unwrap().value).collect::<Vec<_>>();
    assert_eq!(at(3), at(3));
    assert_ne!(at(3), at(4));
    assert!(at(3).iter().any(|value| *value != 0));
}

#[test]
fn malformed_given_axes_are_refused() {
    let chain = with_given(ARM, "Joint4");
    let derived = Derivation::by_eigenvalues(&chain, &Watch::none()).unwrap();
    let parts = parts_of(derived.program());
    let given = parts.given[0];
    let with = |given: Vec<GivenAxis>| SixAxes::new(SixAxesParts { given, ..parts.clone() });
    assert!(with(vec![given; 8]).is_ok());
    assert!(with(vec![given; 9]).is_err());
    for before in [0, 6] {
        assert!(with(vec![GivenAxis { axis: GivenLine { before, ..given.axis }, ..given }]).is_err());
    }
    let mut long = given;
    long.axis.line.direction[0] += 0.5;
    assert!(with(vec![long]).is_err());
}

#[test]
fn six_joints_must_be_left() {
    assert!(fits(&with_given(ARM, "Joint3")).is_ok());
    let two = vec!["Joint3".to_owned(), "Joint5".to_owned()];
    let chain = Chain::from_toml(ARM).unwrap().with_task(Task::Pose, along_z(), two).unwrap();
    assert_eq!(fits(&chain).unwrap_err().kind(), ErrorKind::Unsupported);
}

/// The elbow of an arm with a spherical shoulder and a spherical wrist: the distance from shoulder to wrist determines it.
#[test]
fn the_elbow_of_a_spherical_arm_is_constant() {
    let mechanism = Mechanism::new(&Chain::from_toml(IIWA).unwrap()).unwrap();
    let constant: Vec<bool> = (0..7).map(|joint| is_constant(&mechanism, joint).unwrap()).collect();
    assert_eq!(constant, [false, false, false, true, false, false, false]);
    assert_eq!(constant_relation(&mechanism, 3).unwrap().unwrap().joints(), [3]);
    assert_eq!(is_constant(&mechanism, 7).unwrap_err().kind(), ErrorKind::BadValue);
    let general = Mechanism::new(&Chain::from_toml(ARM).unwrap()).unwrap();
    assert!((0..7).all(|joint| !is_constant(&general, joint).unwrap()));
}

#[test]
fn a_constant_joint_is_not_to_be_given() {
    let name = Chain::from_toml(IIWA).unwrap().joints()[3].name.clone();
    let error = Derivation::of_problem(&with_given(IIWA, &name), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::PositiveDimensional);
    let text = format!("the target alone determines `{name}`: constant on every self-motion");
    assert!(error.message().contains(&text), "{error}");
    assert!(error.message().contains("give the value of one of the joints"), "{error}");
}
