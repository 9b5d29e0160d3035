//! Control laws: each error decays as in its law, also in workspace, and impossible requests are refused.

mod two_chains;

use groebot_robot::control::{
    ClosedLoop, ComputedTorque, Desired, Disturbance, Gains, GravityCompensation, Inversion, Law, Limited, OpenLoop,
    OperationalSpace, Sample,
};
use groebot_robot::dynamics::{Base, Equations, State};
use groebot_robot::model::Robot;
use groebot_robot::{ErrorKind, Watch};
use nalgebra::{DMatrix, DVector};

use crate::dynamics::samples::{Random, moved, near};

fn equations(text: &str) -> Equations {
    Equations::new(&Robot::from_urdf(text).unwrap(), Base::Fixed).unwrap().without_friction()
}

fn ur5() -> Equations {
    equations(include_str!("../../../../tests/corpus/dynamics/ur5.urdf"))
}

fn stanford() -> Equations {
    equations(include_str!("../../../../tests/corpus/dynamics/stanford.urdf"))
}

/// `q_i = 0.3 sin(2 pi 0.4 t + i)` \[rad or m\], with velocities and accelerations.
fn waves(count: usize) -> impl Fn(f64) -> [Vec<f64>; 3] {
    let rate = std::f64::consts::TAU * 0.4;
    move |time| {
        let phase = |i: usize| rate * time + i as f64;
        let list = |value: fn(f64) -> f64, factor: f64| (0..count).map(|i| factor * value(phase(i))).collect();
        [list(f64::sin, 0.3), list(f64::cos, 0.3 * rate), list(f64::sin, -0.3 * rate * rate)]
    }
}

const FREQUENCY: f64 = 20.0;

/// The expected value of an initial error of 0.02: `e'' + 2 w e' + w^2 e = 0`.
fn ideal(time: f64) -> f64 {
    0.02 * (1.0 + FREQUENCY * time) * (-FREQUENCY * time).exp()
}

fn start(desired: &impl Fn(f64) -> [Vec<f64>; 3]) -> [Vec<f64>; 2] {
    let [q, velocity, _] = desired(0.0);
    [q.iter().map(|q| q + 0.02).collect(), velocity]
}

fn run(plant: &Equations, law: impl Law, step: f64, duration: f64, disturbance: Disturbance) -> Vec<Sample> {
    let desired = waves(plant.freedoms());
    let [q, velocity] = start(&desired);
    let mut closed = ClosedLoop::new(plant, law, step, disturbance).unwrap();
    closed.run([&q, &velocity], duration, &desired, &Watch::none()).unwrap()
}

fn errors(sample: &Sample) -> impl Iterator<Item = f64> {
    sample.q.iter().zip(&sample.desired).map(|(q, desired)| q - desired)
}

/// The largest deviation of the errors from their expected values.
fn deviation(samples: &[Sample]) -> f64 {
    let of = |sample: &Sample| errors(sample).map(|error| (error - ideal(sample.time)).abs()).fold(0.0, f64::max);
    samples.iter().map(of).fold(0.0, f64::max)
}

fn worst(samples: &[Sample]) -> f64 {
    samples.iter().flat_map(|sample| errors(sample).map(f64::abs).collect::<Vec<_>>()).fold(0.0, f64::max)
}

#[test]
fn errors_decay_as_predicted_by_computed_torque() {
    for plant in [ur5(), stanford()] {
        let law = || ComputedTorque::new(&plant, Gains::critical(6, FREQUENCY)).unwrap();
        let [coarse, fine] = [1e-3, 5e-4].map(|step| deviation(&run(&plant, law(), step, 5.0, Disturbance::default())));
        // Constant torques are late by half a step.
        assert!(coarse < 1e-3 && (coarse / fine - 2.0).abs() < 0.1, "{coarse:e} {fine:e}");
        let late = Disturbance { delay: 1, ..Disturbance::default() };
        let noisy = Disturbance { noise: [1e-4, 1e-3], seed: 1, ..Disturbance::default() };
        let settled = |disturbance| worst(&run(&plant, law(), 1e-3, 2.0, disturbance)[1000..]);
        assert!(settled(late) < 2e-3 && settled(noisy) < 1e-3, "{:e} {:e}", settled(late), settled(noisy));
    }
}

/// With masses that are 5 % wrong an error remains, which integral action removes at rest.
#[test]
fn integral_action_takes_wrong_masses_away() {
    let plant = ur5();
    let mut parts =
        Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/ur5.urdf")).unwrap().parts().clone();
    for mass in parts.links.iter_mut().filter_map(|link| link.mass.as_mut()) {
        let factor = groebot_algebra::number::BigRational::new(105.into(), 100.into());
        mass.mass *= &factor;
        mass.moments.iter_mut().for_each(|moment| *moment *= &factor);
    }
    let known = Equations::new(&Robot::new(parts).unwrap(), Base::Fixed).unwrap().without_friction();
    let stand = |_: f64| [vec![0.3, -1.0, 0.8, 0.2, 0.4, 0.1], vec![0.0; 6], vec![0.0; 6]];
    let left = |integral: f64| {
        let gains = Gains { integral: vec![integral; 6], ..Gains::critical(6, FREQUENCY) };
        let law = ComputedTorque::new(&known, gains).unwrap();
        let [q, velocity, _] = stand(0.0);
        let mut closed = ClosedLoop::new(&plant, law, 1e-3, Disturbance::default()).unwrap();
        let samples = closed.run([&q, &velocity], 4.0, stand, &Watch::none()).unwrap();
        errors(&samples[4000]).map(f64::abs).fold(0.0, f64::max)
    };
    let (without, with) = (left(0.0), left(2000.0));
    assert!(without > 1e-4 && with < 1e-6, "{without:e} {with:e}");
}

#[test]
fn gravity_compensation_comes_to_rest_and_open_loop_does_not_pull_back() {
    let plant = ur5();
    let gains = Gains { proportional: vec![300.0; 6], derivative: vec![60.0; 6], integral: vec![0.0; 6] };
    let law = GravityCompensation::new(&plant, gains).unwrap();
    let stand = |_: f64| [vec![0.2; 6], vec![0.0; 6], vec![0.0; 6]];
    let mut closed = ClosedLoop::new(&plant, law, 5e-4, Disturbance::default()).unwrap();
    let samples = closed.run([&[0.0; 6], &[0.0; 6]], 6.0, stand, &Watch::none()).unwrap();
    assert!(errors(samples.last().unwrap()).all(|error| error.abs() < 1e-3));
    // At rest in the desired configuration, the gravity torque is the correct one.
    let place = stand(0.0);
    let desired = Desired { q: &place[0], velocity: &place[1], acceleration: &place[2] };
    let mut law = OpenLoop::new(&plant).unwrap();
    let torques = law.torques(&desired, State::new(&[1.0; 6], &[1.0; 6])).unwrap().to_vec();
    let mut room = plant.workspace();
    near(&torques, plant.gravity(&mut room, &place[0]).unwrap().as_slice(), 1e-13, "open loop");
    let open = run(&plant, OpenLoop::new(&plant).unwrap(), 1e-3, 1.0, Disturbance::default());
    assert!(errors(open.last().unwrap()).any(|error| error.abs() > 0.02));
}

#[test]
fn torques_are_limited_and_the_excess_is_reported() {
    let plant = ur5();
    let law = ComputedTorque::new(&plant, Gains::critical(6, FREQUENCY)).unwrap();
    let mut limited = Limited::new(law, vec![10.0; 6]);
    let [q, velocity, acceleration] = waves(6)(0.0);
    let desired = Desired { q: &q, velocity: &velocity, acceleration: &acceleration };
    let state = [0.5; 6];
    let torques = limited.torques(&desired, State::new(&state, &velocity)).unwrap().to_vec();
    assert!(torques.iter().all(|torque| torque.abs() <= 10.0));
    let mut law = ComputedTorque::new(&plant, Gains::critical(6, FREQUENCY)).unwrap();
    let whole = law.torques(&desired, State::new(&state, &velocity)).unwrap();
    let sum: Vec<f64> = torques.iter().zip(limited.cut()).map(|(torque, cut)| torque + cut).collect();
    near(&sum, whole, 1e-12, "cut");
    assert!(limited.cut().iter().any(|cut| *cut != 0.0));
}

/// `M~' - 2 C~` of the effective parameters is skew-symmetric, RH0 (2-49), and the law's torques are those of the
/// commanded error.
#[test]
fn work_space_is_that_of_the_thesis() {
    let robot = Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/ur5.urdf")).unwrap();
    let (plant, link) = (ur5(), robot.link("wrist_3_link").unwrap());
    let mut random = Random(31);
    let mut law = OperationalSpace::new(&plant, link, [400.0, 40.0], Inversion::Exact(1e-3)).unwrap();
    let q = [0.3, -1.2, 1.4, 0.5, 0.9, -0.4];
    let velocity = random.numbers(6, 1.0);
    let state = State::new(&q, &velocity);
    let step = 1e-5;
    let mut inertia = |time: f64| {
        let q = moved(Base::Fixed, &q, &velocity, time);
        law.effective(State::new(&q, &velocity)).unwrap().inertia
    };
    let change: DMatrix<f64> = (inertia(step) - inertia(-step)) / (2.0 * step);
    let effective = law.effective(state).unwrap();
    let skew = change - &effective.coriolis * 2.0;
    let left = &skew + skew.transpose();
    assert!(left.amax() < 1e-6 * effective.inertia.amax().max(skew.amax()), "{}", left.amax());

    // (2-50) from the effective parameters, compared with the law's torques.
    let [place, rate, acceleration] = waves(6)(0.3);
    let desired = Desired { q: &place, velocity: &rate, acceleration: &acceleration };
    let mut room = plant.workspace();
    let target = desired.target(&plant, &mut room, link).unwrap();
    let torques = law.torques(&target, state).unwrap().to_vec();
    let pose = plant.pose(&mut room, &q, link).unwrap();
    let jacobian = plant.jacobian(&mut room, state, link).unwrap()[0].clone();
    let moving = &jacobian * DVector::from_column_slice(&velocity);
    let mut error = DVector::zeros(6);
    error.rows_mut(0, 3).copy_from(&(pose.translation.vector - target.pose.translation.vector));
    error.rows_mut(3, 3).copy_from(&(pose.rotation * target.pose.rotation.inverse()).scaled_axis());
    let six = |vector: &nalgebra::Vector6<f64>| DVector::from_column_slice(vector.as_slice());
    let late = moving - six(&target.velocity);
    let requested = six(&target.acceleration) - late * 40.0 - error * 400.0;
    let force = effective.inertia * requested + effective.coriolis * moving + effective.gravity;
    near(&torques, (jacobian.transpose() * force).as_slice(), 1e-9, "(2-50)");
    assert_eq!(law.damped(), 0.0);
}

#[test]
fn singular_and_other_jacobians_are_refused_or_damped() {
    let robot = Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/ur5.urdf")).unwrap();
    let (plant, link) = (ur5(), robot.link("wrist_3_link").unwrap());
    let stretched = [0.0; 6];
    let mut room = plant.workspace();
    let desired = Desired { q: &stretched, velocity: &stretched, acceleration: &stretched };
    let target = desired.target(&plant, &mut room, link).unwrap();
    let state = State::new(&stretched, &stretched);
    let mut exact = OperationalSpace::new(&plant, link, [400.0, 40.0], Inversion::Exact(1e-3)).unwrap();
    let error = exact.torques(&target, state).unwrap_err();
    assert!(error.kind() == ErrorKind::BadValue && error.message().contains("singular"), "{error}");
    let mut damped = OperationalSpace::new(&plant, link, [400.0, 40.0], Inversion::Damped(0.01)).unwrap();
    let torques = damped.torques(&target, state).unwrap().to_vec();
    near(&torques, plant.gravity(&mut room, &stretched).unwrap().as_slice(), 1e-9, "at rest");
    assert_eq!(damped.damped(), 0.01);

    let robot = Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/panda.urdf")).unwrap();
    let (plant, link) = (Equations::new(&robot, Base::Fixed).unwrap(), robot.link("panda_link7").unwrap());
    let q = [0.1; 9];
    let mut room = plant.workspace();
    let desired = Desired { q: &q, velocity: &[0.0; 9], acceleration: &[0.0; 9] };
    let target = desired.target(&plant, &mut room, link).unwrap();
    let mut exact = OperationalSpace::new(&plant, link, [400.0, 40.0], Inversion::Exact(1e-3)).unwrap();
    let error = exact.torques(&target, State::new(&q, &[0.0; 9])).unwrap_err();
    assert!(error.kind() == ErrorKind::Unsupported && error.message().contains("9 joints"), "{error}");
    assert!(
        OperationalSpace::new(&plant, link, [400.0, 40.0], Inversion::Damped(0.02))
            .unwrap()
            .torques(&target, State::new(&q, &[0.0; 9]))
            .is_ok()
    );
}

/// Without torques and friction the energy is constant: within 1e-9 over 10 s.
#[test]
fn energy_is_kept() {
    struct Nothing(Vec<f64>);
    impl Law for Nothing {
        fn torques(&mut self, _: &Desired<'_>, _: State<'_>) -> groebot_robot::Result<&[f64]> {
            Ok(&self.0)
        }
    }
    let plant = equations(include_str!("../../../../tests/corpus/dynamics/rrp.urdf"))
        .with_gravity(nalgebra::Vector3::new(0.0, 0.0, -0.5));
    let desired = waves(3);
    let mut closed = ClosedLoop::new(&plant, Nothing(vec![0.0; 3]), 5e-4, Disturbance::default()).unwrap();
    let samples = closed.run([&[0.3, 0.2, 0.5], &[0.4, 0.1, 0.0]], 10.0, desired, &Watch::none()).unwrap();
    let mut room = plant.workspace();
    let mut energy = |sample: &Sample| {
        let energy = plant.energy(&mut room, State::new(&sample.q, &sample.velocity)).unwrap();
        energy.kinetic + energy.potential
    };
    let first = energy(&samples[0]);
    let worst = samples.iter().map(|sample| (energy(sample) - first).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-9 * first.abs().max(1.0), "{worst:e} of {first}");
}
