//! What bodies weigh, found again from motions and torques.

use groebot::dynamics::{Base, CONFIDENT, Consistency, Equations, Logged, State};
use groebot::model::Robot;
use nalgebra::DVector;

use super::samples::{Random, ur5};

fn rrp() -> Robot {
    Robot::from_urdf(include_str!("../corpus/dynamics/rrp.urdf")).unwrap()
}

/// A log of random motions, its torques by a function of equations, motions and noise.
fn log(
    equations: &Equations,
    rows: usize,
    mut torques: impl FnMut(State<'_>, &[f64], &mut Random) -> Vec<f64>,
) -> Vec<Logged> {
    let (count, mut random) = (equations.freedoms(), Random(41));
    let mut row = || {
        let [q, velocity, acceleration] = [3.0, 2.0, 5.0].map(|most| random.numbers(count, most));
        let torques = torques(State::new(&q, &velocity), &acceleration, &mut random);
        Logged { q, velocity, acceleration, torques }
    };
    (0..rows).map(|_| row()).collect()
}

#[test]
fn parameters_and_friction_are_found_again() {
    for robot in [ur5(), rrp()] {
        let mut parts = robot.parts().clone();
        for place in robot.moving() {
            let joint = &mut parts.joints[place];
            (joint.damping, joint.friction, joint.armature) = (1.5, 0.7, 0.2);
        }
        let robot = Robot::new(parts).unwrap();
        let equations = Equations::new(&robot, Base::Fixed).unwrap();
        let mut room = equations.workspace();
        let log = log(&equations, 100, |state, acceleration, _| {
            equations.inverse(&mut room, state, acceleration).unwrap().as_slice().to_vec()
        });
        let found = equations.identify(&log, true).unwrap();
        for estimate in found.base.iter().chain(found.friction.iter().flatten()) {
            assert!((estimate.value - estimate.told).abs() < 1e-9, "{estimate:?}");
        }
        assert_eq!(found.friction[0][0].told, 1.5);
        assert!(matches!(found.consistency, Consistency::Consistent(_)), "{:?}", found.consistency);
        assert_eq!(found.base.len(), if robot.name() == "rrp" { 12 } else { 36 });
        // With friction as it is told the rest is found, too.
        assert_eq!(equations.identify(&log, false).unwrap().friction.len(), 0);
    }
}

/// Of numbers from noisy torques 95 in a hundred are within their bounds.
#[test]
fn bounds_hold_as_often_as_they_say() {
    let robot = rrp();
    let equations = Equations::new(&robot, Base::Fixed).unwrap();
    let mut room = equations.workspace();
    let (mut within, mut all) = (0, 0);
    for trial in 0..40 {
        let mut noise = Random(1000 + trial);
        let log = log(&equations, 60, |state, acceleration, _| {
            let torques = equations.inverse(&mut room, state, acceleration).unwrap();
            // Twelve uniform numbers make one that is nearly normal; joints are measured unlike.
            let mut normal = || (0..12).map(|_| noise.number()).sum::<f64>() / 2.0;
            torques.iter().zip([0.1, 1.0, 0.01]).map(|(torque, size)| torque + size * normal()).collect()
        });
        for estimate in equations.identify(&log, false).unwrap().base {
            within += usize::from((estimate.value - estimate.told).abs() < CONFIDENT * estimate.deviation);
            all += 1;
        }
    }
    let share = within as f64 / all as f64;
    assert!((0.91..0.98).contains(&share), "{within} of {all}");
}

#[test]
fn what_no_bodies_weigh_is_told() {
    let robot = rrp();
    let equations = Equations::new(&robot, Base::Fixed).unwrap();
    let mut numbers = equations.parameters();
    // The rod slides: its mass is known for itself.
    let mass = equations.parameter_names().iter().position(|name| name == "rod.m").unwrap();
    numbers[mass] = -1.0;
    let mut room = equations.workspace();
    let numbers = DVector::from_vec(numbers);
    let log = log(&equations, 100, |state, acceleration, _| {
        (equations.regressor(&mut room, state, acceleration).unwrap() * &numbers).as_slice().to_vec()
    });
    let Consistency::Off { deviations, name } = equations.identify(&log, false).unwrap().consistency else {
        panic!("a mass below zero is taken");
    };
    assert!(deviations > 100.0 && !name.is_empty(), "{deviations} {name}");
}

#[test]
fn a_log_that_does_not_tell_is_refused() {
    let robot = rrp();
    let equations = Equations::new(&robot, Base::Fixed).unwrap();
    let mut log = log(&equations, 100, |_, _, _| vec![0.0; 3]);
    let error = equations.identify(&log[..2], false).unwrap_err().to_string();
    assert!(error.contains("2 rows of 3 torques"), "{error}");
    log.iter_mut().for_each(|row| {
        row.velocity.fill(0.0);
        row.acceleration.fill(0.0);
    });
    let error = equations.identify(&log, false).unwrap_err().to_string();
    assert!(error.contains("the log does not tell"), "{error}");
    log[7].torques[1] = f64::NAN;
    assert!(equations.identify(&log, false).unwrap_err().to_string().contains("row 8"));
}
