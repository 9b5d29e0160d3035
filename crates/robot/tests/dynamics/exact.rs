//! Equations of motion as polynomials compared with the recursions in doubles, and their certificates.

use std::collections::HashMap;

use groebot_algebra::limits::SYMBOLIC_TERMS;
use groebot_algebra::number::BigRational;
use groebot_algebra::poly::parse;
use groebot_robot::ErrorKind;
use groebot_robot::dynamics::exact::{Certificate, ExactModel, Masses, Symbolic, masses};
use groebot_robot::dynamics::{Base, Equations, State};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::Robot;
use groebot_robot::robots;
use groebot_robot::spatial::exact::ExactVector;
use nalgebra::DMatrix;

use super::samples::{Random, assert_near, ur5};

fn down() -> ExactVector {
    [0, 0, -1].map(|x: i32| BigRational::from_integer(x.into()))
}

fn symbolic(chain: &Chain, masses: Masses<'_>) -> Symbolic {
    Symbolic::new(ExactModel::new(chain, masses, &down(), SYMBOLIC_TERMS).unwrap()).unwrap()
}

/// Evaluates the equations of a robot from its root to a link, with numeric masses, and compares them with the
/// recursions in doubles.
fn agree(robot: &Robot, tip: &str) {
    let path = robot.path(None, Some(tip)).unwrap();
    let chain = robot.chain(None, Some(tip)).unwrap().ideal().0;
    let numbers = masses(robot, &path, &chain).unwrap();
    let equations_text = symbolic(&chain, Masses::Numbers(&numbers));
    let (equations, mut random) = (Equations::unchecked(robot, Base::Fixed).unwrap().without_friction(), Random(11));
    let places: Vec<usize> = chain
        .joints()
        .iter()
        .map(|joint| equations.joints().iter().position(|name| *name == joint.name).unwrap())
        .collect();
    let mut room = equations.workspace();
    let (mut q, mut velocity) = (vec![0.0; equations.freedoms()], vec![0.0; equations.freedoms()]);
    let mut values = HashMap::from([("g".to_owned(), 9.81)]);
    values.extend([2, 3, 5, 7].map(|prime: u32| (format!("r{prime}"), f64::from(prime).sqrt())));
    for (joint, place) in chain.joints().iter().zip(&places) {
        (q[*place], velocity[*place]) = (3.0 * random.number(), 2.0 * random.number());
        let unknowns = joint.unknowns();
        let of_value = if unknowns.len() == 2 { vec![q[*place].cos(), q[*place].sin()] } else { vec![q[*place]] };
        values.extend(unknowns.into_iter().zip(of_value));
        values.insert(format!("v{}", joint.symbol), velocity[*place]);
    }
    let entries: HashMap<String, f64> = equations_text
        .entries()
        .into_iter()
        .map(|(name, text)| (name, parse(&text).unwrap().evaluate_f64(&|name| values.get(name).copied()).unwrap()))
        .collect();
    let count = places.len();
    let part = |matrix: &DMatrix<f64>| DMatrix::from_fn(count, count, |i, j| matrix[(places[i], places[j])]);
    let found = |head: &str, lower: bool| {
        DMatrix::from_fn(count, count, |i, j| {
            let (i, j) = if lower { (i.max(j), i.min(j)) } else { (i, j) };
            entries[&format!("{head}{}{}", i + 1, j + 1)]
        })
    };
    let state = State::new(&q, &velocity);
    let mut armature = DMatrix::zeros(count, count);
    for (i, joint) in chain.joints().iter().enumerate() {
        armature[(i, i)] = robot.joints()[robot.joint(&joint.name).unwrap()].armature;
    }
    let [inertia, coriolis] = equations.matrices(&mut room, state).unwrap().map(part);
    assert_near(&found("M", true), &(inertia - armature), 1e-12, robot.name());
    assert_near(&found("C", false), &coriolis, 1e-12, robot.name());
    let gravity = equations.gravity(&mut room, &q).unwrap();
    let gravity = DMatrix::from_fn(count, 1, |i, _| gravity[places[i]]);
    let found = DMatrix::from_fn(count, 1, |i, _| entries[&format!("N{}", i + 1)]);
    assert_near(&found, &gravity, 1e-12, robot.name());
}

#[test]
fn polynomials_are_what_the_recursions_compute() {
    let described = |text: &str| Robot::from_urdf(text).unwrap();
    agree(&described(include_str!("../../../../tests/corpus/dynamics/stanford.urdf")), "hand");
    agree(&described(include_str!("../../../../tests/corpus/dynamics/rrp.urdf")), "rod");
    // A hip with square roots of two, and an arm of a robot with other limbs at the root.
    let nao = robots::robot("nao_v5").unwrap();
    agree(&nao, "LFoot");
    agree(&nao, "LHand");
}

#[test]
fn base_parameters_are_as_many_as_others_count() {
    // 36: the count of M. Gautier for arms of this kind.
    let chain = ur5().chain(None, Some("wrist_3_link")).unwrap().ideal().0;
    let equations_text = symbolic(&chain, Masses::Symbols);
    let base = equations_text.base_parameters().unwrap();
    assert_eq!(base.forms.len(), 36);
    // Numerically: the singular values of many regressors.
    let robot = ur5();
    let (equations, mut random) = (Equations::new(&robot, Base::Fixed).unwrap(), Random(12));
    let mut room = equations.workspace();
    let mut rows = DMatrix::zeros(6 * 60, 60);
    for at in 0..60 {
        let [q, velocity, acceleration] = [3.0, 2.0, 5.0].map(|most| random.numbers(6, most));
        let regressor = equations.regressor(&mut room, State::new(&q, &velocity), &acceleration).unwrap();
        rows.rows_mut(6 * at, 6).copy_from(regressor);
    }
    let values = rows.singular_values();
    assert_eq!(values.iter().filter(|value| **value > 1e-9 * values[0]).count(), 36);
}

#[test]
fn other_equations_are_not_proved() {
    let chain = Chain::from_toml(include_str!("../../../../derivations/polar/0_chain.toml")).unwrap();
    let equations_text = symbolic(&chain, Masses::Symbols);
    let certificate = Certificate::new(&equations_text, &chain, Masses::Symbols, &down());
    let text = equations_text.to_text();
    let proof = certificate.prove(&chain, &text).unwrap();
    assert_eq!((proof.joints, proof.base_parameters), (3, Some(14)));
    assert_eq!(Certificate::from_json(&certificate.to_json(), chain.name()).unwrap(), certificate);
    for (old, new, kind) in [
        ("M22 = Izz2", "M22 = Izz2 + m1", "M22"),
        ("C23 = m3*v2*d3", "C23 = 2*m3*v2*d3", "C23"),
        ("C33 = 0", "C33 = v1", "C33"),
        ("N3 = -m3*g*s1*c2", "N3 = m3*g*s1*c2", "N3"),
        ("V = -mx1*g*s1", "V = mx1*g*s1", "V"),
        ("B1 = mx1", "B1 = 2*mx1", "factor"),
        ("B2 = mz1 + mz2", "B2 = mz1", "more"),
        ("B14 = mz3\n", "B14 = mz3\nB15 = Iyz1\n", "15 base parameters are given; there are 14"),
        ("M33 = m3\n", "", "`M33` is missing"),
        ("M33 = m3\n", "M33 = m3\nM33 = m3\n", "twice"),
        ("M33 = m3\n", "M33 = m3\nM44 = m3\n", "M44"),
    ] {
        let forged = text.replacen(old, new, 1);
        assert_ne!(forged, text, "{old}");
        let error = certificate.prove(&chain, &forged).unwrap_err().to_string();
        assert!(error.contains(kind), "{kind}: {error}");
    }
    let other = Chain::from_toml(include_str!("../../../../derivations/puma/0_chain.toml")).unwrap();
    assert!(certificate.prove(&other, &text).is_err());
}

#[test]
fn too_many_terms_and_odd_directions_are_refused() {
    let chain = Chain::from_toml(include_str!("../../../../derivations/puma/0_chain.toml")).unwrap();
    let model = ExactModel::new(&chain, Masses::Symbols, &down(), 100).unwrap();
    let error = Symbolic::new(model).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
    assert!(error.message().contains("at most 100 are allowed"), "{error}");
    let odd = [1, 2, 100_003].map(|x: i32| BigRational::from_integer(x.into()));
    let error = ExactModel::new(&chain, Masses::Symbols, &odd, SYMBOLIC_TERMS).unwrap_err();
    assert!(error.kind() == ErrorKind::Unsupported && error.message().contains("gravity"), "{error}");
}
