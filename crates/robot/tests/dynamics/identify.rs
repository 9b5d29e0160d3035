//! Identification of inertial parameters from motions and torques.

use groebot_robot::dynamics::{Base, Equations, FindingKind, Identification, Logged, State};
use groebot_robot::model::Robot;
use nalgebra::DVector;

use super::samples::{Random, ur5};

fn rrp() -> Robot {
    Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/rrp.urdf")).unwrap()
}

/// A log of random motions. A function of equations, motions and noise computes its torques.
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
            assert!((estimate.value - estimate.described).abs() < 1e-9, "{estimate:?}");
        }
        assert_eq!(found.friction[0][0].described, 1.5);
        assert!(found.consistency.is_converged && found.consistency.holds(), "{:?}", found.consistency);
        assert_eq!(found.findings, []);
        assert_eq!(found.base.len(), if robot.name() == "rrp" { 12 } else { 36 });
        // With friction from the description, the other parameters are found too.
        assert_eq!(equations.identify(&log, false).unwrap().friction.len(), 0);
    }
}

/// Of the parameters from noisy torques, 95 % are within their intervals.
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
            // The sum of twelve uniform numbers is nearly normal. Joints have different noise.
            let mut normal = || (0..12).map(|_| noise.number()).sum::<f64>() / 2.0;
            torques.iter().zip([0.1, 1.0, 0.01]).map(|(torque, size)| torque + size * normal()).collect()
        });
        for estimate in equations.identify(&log, false).unwrap().base {
            within += usize::from((estimate.value - estimate.described).abs() < estimate.interval.unwrap());
            all += 1;
        }
    }
    let share = within as f64 / all as f64;
    assert!((0.91..0.98).contains(&share), "{within} of {all}");
}

#[test]
fn physically_impossible_parameters_are_reported() {
    let robot = rrp();
    let equations = Equations::new(&robot, Base::Fixed).unwrap();
    let mut numbers = equations.parameters();
    // The rod's joint is prismatic, so its mass is determined by itself.
    let mass = equations.parameter_names().iter().position(|name| name == "rod.m").unwrap();
    numbers[mass] = -1.0;
    let mut room = equations.workspace();
    let numbers = DVector::from_vec(numbers);
    let log = log(&equations, 100, |state, acceleration, _| {
        (equations.regressor(&mut room, state, acceleration).unwrap() * &numbers).as_slice().to_vec()
    });
    let found = equations.identify(&log, false).unwrap();
    assert!(found.consistency.is_converged && found.consistency.is_refuted(), "{:?}", found.consistency);
    let finding = found.findings.iter().find(|finding| finding.kind == FindingKind::NoBodies).unwrap();
    assert!(finding.size > 100.0, "{finding}");
}

#[test]
fn an_uninformative_log_is_refused() {
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
    assert!(error.contains("the log does not determine"), "{error}");
    log[7].torques[1] = f64::NAN;
    assert!(equations.identify(&log, false).unwrap_err().to_string().contains("row 8"));
    log[7].torques[1] = 0.0;
    log[9].velocity[2] = 1e160;
    let error = equations.identify(&log, false).unwrap_err().to_string();
    assert!(error.contains("row 10: v2 is 1e160"), "{error}");
}

fn kinds(found: &Identification) -> Vec<FindingKind> {
    let mut kinds: Vec<FindingKind> = found.findings.iter().map(|finding| finding.kind).collect();
    kinds.dedup();
    kinds
}

fn normal(random: &mut Random) -> f64 {
    (0..12).map(|_| random.number()).sum::<f64>() / 2.0
}

fn hinge() -> Robot {
    Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/faults/hinge.urdf")).unwrap()
}

/// By hand: a body of 100 kg with its centre at 2.5 mm has exactly the parameters of this log. A body of less than
/// 0.25^2 / 0.00144 = 43.4 kg cannot have them: mx^2 <= m Iyy.
#[test]
fn bodies_are_sought_until_they_are_found() {
    let equations = Equations::new(&hinge(), Base::Fixed).unwrap();
    let table = include_str!("../../../../tests/corpus/dynamics/faults/hinge_of_100_kg.csv");
    let row = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let [q, velocity, acceleration, torques] = [0, 1, 2, 3].map(|at| vec![cells[at]]);
        Logged { q, velocity, acceleration, torques }
    };
    let log: Vec<Logged> = table.lines().skip(1).map(row).collect();
    let found = equations.identify(&log, false).unwrap();
    let consistency = &found.consistency;
    assert!(consistency.is_converged && consistency.holds(), "{consistency:?}");
    for (value, expected) in consistency.values.iter().zip([0.25, 0.0, 0.00144]) {
        assert!((value - expected).abs() < 1e-6, "{consistency:?}");
    }
    let [mass, mx, iyy] = [0, 1, 6].map(|at| consistency.bodies[at]);
    assert!(mass > 43.4 && mx * mx <= mass * iyy, "{consistency:?}");
}

/// By hand: an inertia of -0.01 is nearest to zero. The other two parameters are free, because the mass is. The least
/// squares are those of -0.01 in units of its deviation.
#[test]
fn the_least_squares_of_bodies_are_enclosed() {
    let equations = Equations::new(&hinge(), Base::Fixed).unwrap();
    let mut numbers = equations.parameters();
    numbers[6] = -0.01;
    let (mut room, numbers) = (equations.workspace(), DVector::from_vec(numbers));
    let log = log(&equations, 400, |state, acceleration, noise| {
        let torques = equations.regressor(&mut room, state, acceleration).unwrap() * &numbers;
        vec![torques[0] + 0.01 * normal(noise)]
    });
    let found = equations.identify(&log, false).unwrap();
    let (inertia, consistency) = (&found.base[2], &found.consistency);
    assert_eq!(inertia.name, "l1.Iyy");
    let deviation = inertia.interval.unwrap() / 1.966;
    let expected = (inertia.value / deviation).powi(2);
    // No body has the minimum: its mass grows without bound.
    assert!((consistency.least / expected - 1.0).abs() < 2e-3, "{consistency:?} beside {expected}");
    assert!(consistency.squares >= consistency.least, "{consistency:?}");
    assert!(consistency.is_refuted() && consistency.values[2] > 0.0, "{consistency:?}");
    assert_eq!(kinds(&found), [FindingKind::NoBodies]);
}

/// With two degrees of freedom, 95 % are within 4.3 deviations; within 1.96 there are 81 %.
#[test]
fn few_rows_have_wide_intervals() {
    let equations = Equations::new(&hinge(), Base::Fixed).unwrap();
    let (mut room, mut within, mut all) = (equations.workspace(), 0, 0);
    for trial in 0..400 {
        let mut noise = Random(5000 + trial);
        let log = log(&equations, 5, |state, acceleration, _| {
            vec![equations.inverse(&mut room, state, acceleration).unwrap()[0] + 0.1 * normal(&mut noise)]
        });
        let found = equations.identify(&log, false).unwrap();
        assert_eq!(found.freedom, 2);
        for estimate in &found.base {
            within += usize::from((estimate.value - estimate.described).abs() < estimate.interval.unwrap());
            all += 1;
        }
        let none = equations.identify(&log[..3], false).unwrap();
        assert!(none.freedom == 0 && none.base.iter().all(|estimate| estimate.interval.is_none()));
    }
    let share = within as f64 / all as f64;
    assert!((0.92..0.98).contains(&share), "{within} of {all}");
}

/// An arm that swings all its joints, with one row every 20 ms. The noise of each joint is a fraction of its torques.
fn swinging(equations: &Equations, rows: usize, seed: u64, share: f64) -> Vec<Logged> {
    let (count, mut random, mut room) = (equations.freedoms(), Random(seed), equations.workspace());
    let waves: Vec<[f64; 3]> = (0..3 * count)
        .map(|_| [0.6 + 0.4 * random.number(), 2.5 + 2.0 * random.number(), 3.0 * random.number()])
        .collect();
    let row = |number: usize| {
        let time = 0.02 * number as f64;
        let mut lists = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        for (at, [size, rate, phase]) in waves.iter().enumerate() {
            let (sine, cosine) = (rate * time + phase).sin_cos();
            let changes = [sine, rate * cosine, -rate * rate * sine];
            lists.iter_mut().zip(changes).for_each(|(list, change)| list[at % count] += size * change);
        }
        let [q, velocity, acceleration] = lists;
        let state = State::new(&q, &velocity);
        let torques = equations.inverse(&mut room, state, &acceleration).unwrap().as_slice().to_vec();
        Logged { q, velocity, acceleration, torques }
    };
    let mut log: Vec<Logged> = (0..rows).map(row).collect();
    for joint in 0..count {
        let squares: f64 = log.iter().map(|row| row.torques[joint].powi(2)).sum();
        let size = share * (squares / rows as f64).sqrt();
        log.iter_mut().for_each(|row| row.torques[joint] += size * normal(&mut random));
    }
    log
}

fn arm() -> Equations {
    let robot = Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/ur5.urdf")).unwrap();
    Equations::new(&robot, Base::Fixed).unwrap()
}

#[test]
fn good_logs_are_good() {
    let equations = arm();
    for seed in 0..8 {
        let found = equations.identify(&swinging(&equations, 200, seed, 0.01), false).unwrap();
        assert_eq!(found.findings, [], "seed {seed}");
        assert!(found.consistency.is_converged && found.consistency.holds(), "seed {seed}: {:?}", found.consistency);
        assert!(found.unexplained.iter().all(|share| *share < 0.05), "{:?}", found.unexplained);
    }
}

/// Torques in another unit are those of other bodies: multiples of consistent bodies are consistent.
#[test]
fn bodies_of_any_mass_are_found() {
    let equations = arm();
    let mut log = swinging(&equations, 200, 5, 0.01);
    log.iter_mut().flat_map(|row| &mut row.torques).for_each(|torque| *torque *= 1000.0);
    let found = equations.identify(&log, false).unwrap();
    assert!(found.consistency.holds() && !found.consistency.is_refuted(), "{:?}", found.consistency);
    assert_eq!(kinds(&found), [FindingKind::Unit]);
}

#[test]
fn bad_logs_are_reported_by_their_kind() {
    let equations = arm();
    let good = swinging(&equations, 300, 77, 0.01);
    let find = |change: &dyn Fn(&mut Vec<Logged>)| {
        let mut log = good.clone();
        change(&mut log);
        let found = equations.identify(&log, false).unwrap();
        (kinds(&found), found.findings)
    };
    let expect = |kind: FindingKind, (kinds, findings): (Vec<FindingKind>, Vec<groebot_robot::dynamics::Finding>)| {
        let reported: Vec<String> = findings.iter().map(ToString::to_string).collect();
        assert!(kinds.contains(&kind), "{kind:?}: {reported:?}");
    };
    let degrees = |log: &mut Vec<Logged>| {
        for row in log {
            let lists = [&mut row.q, &mut row.velocity, &mut row.acceleration];
            lists.into_iter().flatten().for_each(|value| *value = value.to_degrees());
        }
    };
    expect(FindingKind::Unexplained, find(&degrees));
    let torques = |change: &'static dyn Fn(usize, usize, &mut f64)| {
        move |log: &mut Vec<Logged>| {
            for (number, row) in log.iter_mut().enumerate() {
                row.torques.iter_mut().enumerate().for_each(|(joint, torque)| change(number, joint, torque));
            }
        }
    };
    expect(FindingKind::Unit, find(&torques(&|_, _, torque| *torque *= 1000.0)));
    expect(FindingKind::Sign, find(&torques(&|_, _, torque| *torque = -*torque)));
    expect(FindingKind::Sign, find(&torques(&|_, joint, torque| *torque *= if joint == 2 { -1.0 } else { 1.0 })));
    expect(
        FindingKind::Outliers,
        find(&torques(&|number, joint, torque| {
            *torque += if number % 60 == 7 && joint == 1 { 40.0 } else { 0.0 };
        })),
    );
    expect(
        FindingKind::Clipped,
        find(&torques(&|_, joint, torque| {
            *torque = if joint == 1 { torque.clamp(-60.0, 60.0) } else { *torque };
        })),
    );
    // Torques of the row two rows earlier, 40 ms late.
    expect(
        FindingKind::Correlated,
        find(&|log: &mut Vec<Logged>| {
            for number in (2..log.len()).rev() {
                log[number].torques = log[number - 2].torques.clone();
            }
        }),
    );
    // Noise with autocorrelation 0.95: its intervals contain 52 % instead of 95 %.
    expect(
        FindingKind::Correlated,
        find(&|log: &mut Vec<Logged>| {
            let (mut random, mut slow) = (Random(3), [0.0; 6]);
            for row in log {
                for (torque, slow) in row.torques.iter_mut().zip(&mut slow) {
                    *slow = 0.95 * *slow + 0.3 * normal(&mut random);
                    *torque += *slow;
                }
            }
        }),
    );
}
