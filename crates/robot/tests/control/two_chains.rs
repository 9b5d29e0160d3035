//! Two chains compared with one tree: three models of a robot on one foot.

use groebot_robot::control::{ClosedLoop, ComputedTorque, Desired, Disturbance, Gains, Law, TwoChains};
use groebot_robot::dynamics::{Base, Equations, Model, State};
use groebot_robot::model::Robot;
use groebot_robot::spatial::{Pose, Wrench};
use groebot_robot::{ErrorKind, Watch, robots};
use nalgebra::{DVector, Vector3};

use super::FREQUENCY;
use crate::dynamics::samples::{Random, near};

const SOLES: [&str; 2] = ["l_sole", "r_sole"];

/// A robot whose foot is fixed to the floor.
fn supporting(robot: &Robot, foot: &str) -> Equations {
    let model = Model::new(robot).unwrap().rooted_at(robot.link(foot).unwrap());
    Equations::of(robot, &model, Base::Fixed).unwrap().without_friction()
}

/// The pose of a link, and its velocity and acceleration in its own frame.
fn moving(equations: &Equations, link: usize, state: State<'_>, acceleration: &[f64]) -> [Vec<f64>; 3] {
    let mut room = equations.workspace();
    let is_at: Pose = equations.pose(&mut room, state.q, link).unwrap();
    let [jacobian, change] = equations.jacobian(&mut room, state, link).unwrap();
    let [rates, changes] = [state.velocity, acceleration].map(DVector::from_column_slice);
    let (twist, classical) = (jacobian * &rates, jacobian * changes + change * &rates);
    let own =
        |six: &nalgebra::Vector6<f64>| [0, 3].map(|at| is_at.rotation.inverse() * six.fixed_rows::<3>(at).into_owned());
    let [v, w] = own(&twist);
    let [a, turning] = own(&classical);
    let place = is_at.translation.vector.iter().chain(is_at.rotation.coords.iter()).copied().collect();
    let pair = |first: &Vector3<f64>, second: &Vector3<f64>| first.iter().chain(second).copied().collect();
    [place, pair(&v, &w), pair(&(a - w.cross(&v)), &turning)]
}

/// A state on one foot, with accelerations.
fn random_state(random: &mut Random, count: usize) -> [Vec<f64>; 3] {
    [random.numbers(count, 0.8), random.numbers(count, 2.0), random.numbers(count, 5.0)]
}

/// A robot with a fixed foot equals a floating robot with the contact wrench of the foot.
#[test]
fn a_foot_as_root_is_a_floating_base_with_a_contact_force() {
    let mut random = Random(71);
    for name in ["nao_v5", "teo", "rh0"] {
        let robot = robots::robot(name).unwrap();
        let free = Equations::new(&robot, Base::Floating).unwrap().without_friction();
        for foot in SOLES {
            let held = supporting(&robot, foot);
            assert_eq!(held.joints(), free.joints());
            let link = robot.link(foot).unwrap();
            let mut room = held.workspace();
            for _ in 0..5 {
                let [q, velocity, acceleration] = random_state(&mut random, held.freedoms());
                let state = State::new(&q, &velocity);
                let ground = held.base_wrench(&mut room, state, &acceleration).unwrap();
                let torques = held.inverse(&mut room, state, &acceleration).unwrap().clone();
                let [place, base_velocity, base_acceleration] = moving(&held, robot.root_place(), state, &acceleration);
                let [all_q, all_v, all_a] =
                    [(place, &q), (base_velocity, &velocity), (base_acceleration, &acceleration)]
                        .map(|(base, joints)| [base, joints.clone()].concat());
                let outside = [(link, ground)];
                let state = State::new(&all_q, &all_v).with_wrenches(&outside);
                let found = free.inverse(&mut free.workspace(), state, &all_a).unwrap().clone();
                let size = torques.amax().max(ground.to_vector().amax()).max(1.0);
                near(&found.as_slice()[..6], &[0.0; 6], 1e-11 * size, name);
                near(&found.as_slice()[6..], torques.as_slice(), 1e-11 * size, name);
            }
        }
    }
}

/// RH0 (3-42), (3-43) with the wrench through the trunk equal (2-47) of the whole robot.
#[test]
fn coupled_chains_are_one_tree() {
    let mut random = Random(72);
    for name in ["nao_v5", "teo", "rh0"] {
        let robot = robots::robot(name).unwrap();
        for (side, foot) in SOLES.into_iter().enumerate() {
            let tree = supporting(&robot, foot);
            let gains = || Gains::critical(tree.freedoms(), FREQUENCY);
            let mut one = ComputedTorque::new(&tree, gains()).unwrap();
            let mut two = TwoChains::new(&robot, SOLES, side, gains(), true).unwrap();
            let [q, velocity, acceleration] = random_state(&mut random, tree.freedoms());
            let [place, rate, _] = random_state(&mut random, tree.freedoms());
            let desired = Desired { q: &place, velocity: &rate, acceleration: &acceleration };
            let state = State::new(&q, &velocity);
            let expected = one.torques(&desired, state).unwrap().to_vec();
            let size = expected.iter().fold(1.0, |size: f64, torque| size.max(torque.abs()));
            // Friction counts in both models.
            let friction =
                |robot: &Robot| robot.joints().iter().any(|joint| joint.friction != 0.0 || joint.damping != 0.0);
            assert!(!friction(&robot), "{name}");
            near(two.torques(&desired, state).unwrap(), &expected, 1e-11 * size, name);
            assert!(two.between().f.norm() > 1.0);
        }
    }
}

/// RH0 (3-40), (3-41): `M a + C v + N` of a chain with six virtual joints at its foot.
#[test]
fn a_chain_alone_is_that_of_its_matrices() {
    let mut random = Random(73);
    let robot = robots::robot("teo").unwrap();
    let model = Model::new(&robot).unwrap();
    let links = SOLES.map(|sole| robot.link(sole).unwrap());
    let halves = model.halves(links);
    assert!((halves[0].mass() + halves[1].mass() - model.mass()).abs() < 1e-12 * model.mass());
    let tree = supporting(&robot, SOLES[1]);
    let [q, velocity, acceleration] = random_state(&mut random, tree.freedoms());
    let state = State::new(&q, &velocity);
    let desired = Desired { q: &q, velocity: &velocity, acceleration: &acceleration };
    let gains = Gains::critical(tree.freedoms(), FREQUENCY);
    let mut alone = TwoChains::new(&robot, SOLES, 1, gains, false).unwrap();
    let found = alone.torques(&desired, state).unwrap().to_vec();
    assert_eq!(alone.between(), &Wrench::zero());
    let mut sum = vec![0.0; tree.freedoms()];
    let mut ground = Vector3::zeros();
    for (half, link) in halves.iter().zip(links) {
        let chain = Equations::of(&robot, &half.rooted_at(link), Base::Floating).unwrap().without_friction();
        let mut room = chain.workspace();
        // Its root is the foot, which moves as in the tree.
        let [place, base_velocity, base_acceleration] = moving(&tree, link, state, &acceleration);
        let [all_q, all_v, all_a] = [(place, &q), (base_velocity, &velocity), (base_acceleration, &acceleration)]
            .map(|(base, joints)| [base, joints.clone()].concat());
        let gravity = chain.gravity(&mut room, &all_q).unwrap().clone();
        let [inertia, coriolis] = chain.matrices(&mut room, State::new(&all_q, &all_v)).unwrap();
        let forces = inertia * DVector::from_vec(all_a) + coriolis * DVector::from_vec(all_v) + gravity;
        sum.iter_mut().zip(&forces.as_slice()[6..]).for_each(|(sum, torque)| *sum += torque);
        let foot = tree.pose(&mut tree.workspace(), &q, link).unwrap();
        ground += foot.rotation * forces.fixed_rows::<3>(0);
    }
    near(&found, &sum, 1e-9, "chains");
    // Both chains together need the wrench that the floor transmits to the one foot.
    let whole = tree.base_wrench(&mut tree.workspace(), state, &acceleration).unwrap();
    assert!((whole.f - ground).norm() < 1e-9 * whole.f.norm(), "{whole:?} {ground}");
}

/// TEO on its right foot. If the chains are coupled, each error decays independently. Separate chains do not even hold
/// the posture.
#[test]
fn chains_that_are_not_coupled_do_not_hold_a_robot_on_one_foot() {
    let robot = robots::robot("teo").unwrap();
    let plant = supporting(&robot, SOLES[1]);
    let count = plant.freedoms();
    let place = |name: &str| plant.joints().iter().position(|joint| joint == name).unwrap();
    let bent: Vec<(usize, f64)> = plant
        .joints()
        .iter()
        .filter_map(|name| {
            let angle = if name.contains("Knee") { 0.5 } else { -0.25 };
            name.contains("Pitch").then(|| (place(name), angle))
        })
        .collect();
    assert!(bent.len() == 6, "{:?}", plant.joints());
    let desired = move |time: f64| {
        let mut lists = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        for (joint, angle) in &bent {
            let (rate, depth) = (3.0, 0.1);
            lists[0][*joint] = angle * (1.0 + depth * (rate * time).sin());
            lists[1][*joint] = angle * depth * rate * (rate * time).cos();
            lists[2][*joint] = -angle * depth * rate * rate * (rate * time).sin();
        }
        lists
    };
    let [q, velocity, _] = desired(0.0);
    let start: Vec<f64> = q.iter().map(|q| q + 0.02).collect();
    let run = |law: &mut dyn FnMut() -> Box<dyn Law>| {
        let mut closed = ClosedLoop::new(&plant, law(), 1e-3, Disturbance::default()).unwrap();
        closed.run([&start, &velocity], 1.0, &desired, &Watch::none())
    };
    let gains = || Gains::critical(count, FREQUENCY);
    let tree = run(&mut || Box::new(ComputedTorque::new(&plant, gains()).unwrap())).unwrap();
    let coupled = run(&mut || Box::new(TwoChains::new(&robot, SOLES, 1, gains(), true).unwrap())).unwrap();
    for (one, two) in tree.iter().zip(&coupled) {
        near(&two.q, &one.q, 1e-9, "one tree");
        let worst = super::errors(two).map(|error| (error - super::ideal(two.time)).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-3, "{worst:e} at {}", two.time);
    }
    let alone = run(&mut || Box::new(TwoChains::new(&robot, SOLES, 1, gains(), false).unwrap()));
    let worst =
        alone.map_or(f64::INFINITY, |samples| samples.iter().flat_map(super::errors).map(f64::abs).fold(0.0, f64::max));
    assert!(worst > 0.5, "{worst}");
}

#[test]
fn feet_must_be_two() {
    let robot = robots::robot("teo").unwrap();
    let new = |feet: [&str; 2], supporting: usize| {
        TwoChains::new(&robot, feet, supporting, Gains::critical(12, FREQUENCY), true).unwrap_err().kind()
    };
    assert_eq!(new(["l_sole", "l_sole"], 0), ErrorKind::BadValue);
    assert_eq!(new(["l_sole", "RootWaist"], 0), ErrorKind::BadValue);
    assert_eq!(new(SOLES, 2), ErrorKind::BadValue);
    assert_eq!(new(["l_sole", "tail"], 0), ErrorKind::UnknownName);
    // Rooting at a foot and back again gives the same robot.
    let model = Model::new(&robot).unwrap();
    let there = model.rooted_at(robot.link("l_sole").unwrap());
    let back = there.rooted_at(robot.root_place());
    for body in 0..=model.joints().len() {
        let miss = model.inertia_of(body).generalised() - back.inertia_of(body).generalised();
        assert!(miss.amax() < 1e-12, "{body}");
    }
    for (one, other) in model.joints().iter().zip(back.joints()) {
        assert_eq!(one.parent, other.parent);
    }
}
