//! The recursions compared with the closed forms of the thesis, and with one another.

use groebot_algebra::number::BigRational;
use groebot_robot::ErrorKind;
use groebot_robot::dynamics::{Base, Data, Dual, Equations, Model, Motion, Place, Six, State, Tree, Workspace};
use groebot_robot::model::{Joint, JointType, Link, Mass, Mimic, Origin, Robot};
use groebot_robot::robots;
use groebot_robot::spatial::{Pose, Wrench};
use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};

use super::samples::{Random, assert_near, floating, moved, near, ur5};

fn all() -> [Robot; 4] {
    [ur5(), robots::robot("nao_v5").unwrap(), robots::robot("rh0").unwrap(), robots::robot("teo").unwrap()]
}

#[test]
fn matrices_are_those_of_the_thesis() {
    let mut random = Random(1);
    for robot in all() {
        let (equations, model) = (Equations::new(&robot, Base::Fixed).unwrap(), Model::new(&robot).unwrap());
        let equations = equations.without_friction();
        let mut room = equations.workspace();
        let mut armature = DMatrix::zeros(equations.freedoms(), equations.freedoms());
        for (at, place) in robot.moving().into_iter().enumerate() {
            armature[(at, at)] = robot.joints()[place].armature;
        }
        for _ in 0..10 {
            let count = equations.freedoms();
            let (q, velocity) = (random.numbers(count, 3.0), random.numbers(count, 2.0));
            let [inertia, coriolis] = equations.matrices(&mut room, State::new(&q, &velocity)).unwrap();
            assert_near(inertia, &(model.inertia(&q).unwrap() + &armature), 1e-12, robot.name());
            assert_near(coriolis, &model.coriolis(&q, &velocity).unwrap(), 1e-12, robot.name());
            // The gravity torque is the gradient of the potential energy.
            let gravity = equations.gravity(&mut room, &q).unwrap();
            let placed = model.place(&Pose::identity(), &q).unwrap();
            let slopes = placed.centre_of_mass_jacobian().columns(6, count).transpose() * Vector3::new(0.0, 0.0, 9.81);
            assert_near(
                &DMatrix::from_column_slice(count, 1, gravity.as_slice()),
                &DMatrix::from_column_slice(count, 1, (slopes * model.mass()).as_slice()),
                1e-12,
                robot.name(),
            );
        }
    }
}

#[test]
fn the_recursion_of_newton_and_euler_is_that_of_the_matrices() {
    let mut random = Random(2);
    for robot in all() {
        for base in [Base::Fixed, Base::Floating] {
            let equations = Equations::new(&robot, base).unwrap().without_friction();
            let mut room = equations.workspace();
            for _ in 0..10 {
                let (joints, count) = (equations.joints().len(), equations.freedoms());
                let q = if base == Base::Fixed { random.numbers(joints, 3.0) } else { floating(&mut random, joints) };
                let (velocity, acceleration) = (random.numbers(count, 2.0), random.numbers(count, 5.0));
                let state = State::new(&q, &velocity);
                let torques = equations.inverse(&mut room, state, &acceleration).unwrap().clone();
                let [inertia, coriolis] = equations.matrices(&mut room, state).unwrap().map(Clone::clone);
                let [v, a] = [&velocity, &acceleration].map(|list| DVector::from_column_slice(list));
                let summed = inertia * a + coriolis * v + equations.gravity(&mut room, &q).unwrap();
                let [found, expected] =
                    [&torques, &summed].map(|list| DMatrix::from_column_slice(count, 1, list.as_slice()));
                assert_near(&found, &expected, 1e-12, robot.name());
                // For RH0 only the trunk's mass is given.
                let weighs = robot.name() != "rh0";
                match equations.forward(&mut room, state, torques.as_slice()) {
                    Ok(back) => {
                        let miss = (back - DVector::from_column_slice(&acceleration)).amax();
                        assert!(miss < 1e-8, "{} {base:?}: {miss:e}", robot.name());
                    }
                    Err(error) => assert!(!weighs && error.message().contains("no mass"), "{error}"),
                }
            }
        }
    }
}

/// The momentum of a floating root in its own frame is the first rows of the inertia matrix times the velocity. `M' - 2
/// C` is skew-symmetric along a motion.
#[test]
fn a_free_root_has_the_momentum_of_all_bodies() {
    let mut random = Random(3);
    let robot = robots::robot("rh0").unwrap();
    let (equations, model) = (Equations::new(&robot, Base::Floating).unwrap(), Model::new(&robot).unwrap());
    let (mut room, joints) = (equations.workspace(), equations.joints().len());
    let mut q = floating(&mut random, joints);
    let velocity = random.numbers(6 + joints, 1.0);
    let [inertia, coriolis] = equations.matrices(&mut room, State::new(&q, &velocity)).unwrap().map(Clone::clone);
    let momentum = &inertia * DVector::from_column_slice(&velocity);
    let base = groebot_robot::spatial::Twist {
        v: Vector3::from_column_slice(&velocity[..3]),
        w: Vector3::from_column_slice(&velocity[3..6]),
    };
    let placed = model.place(&Pose::identity(), &q[7..]).unwrap();
    let all = placed.momentum(&base, &velocity[6..]).unwrap();
    assert!((momentum.rows(0, 3) - all.linear).amax() < 1e-12 && (momentum.rows(3, 3) - all.angular).amax() < 1e-12);

    // In the base's own frame only joints change the inertia matrix.
    let step = 1e-6;
    let mut at = |path: f64| {
        q[7..].iter_mut().zip(&velocity[6..]).for_each(|(q, rate)| *q += path * rate);
        equations.inertia(&mut room, &q).unwrap().clone()
    };
    let (ahead, after) = (at(step), at(-2.0 * step));
    let change = (ahead - after) / (2.0 * step);
    let left = change - (&coriolis + coriolis.transpose());
    assert!(left.amax() < 1e-6, "{}", left.amax());
}

/// A mimic joint with factor one half: the inertia is that of one joint with the sum of both motions.
#[test]
fn joints_that_follow_are_moved_by_their_leader() {
    let plain = ur5();
    let mut parts = plain.parts().clone();
    let moving = plain.moving();
    let half = BigRational::new(1.into(), 2.into());
    let leader = parts.joints[moving[1]].name.clone();
    parts.joints[moving[2]].mimic = Some(Mimic { leader, multiplier: half, offset: BigRational::default() });
    let coupled = Equations::new(&Robot::new(parts).unwrap(), Base::Fixed).unwrap();
    let free = Equations::new(&plain, Base::Fixed).unwrap();
    assert_eq!((coupled.freedoms(), free.freedoms()), (5, 6));
    let spread = |list: &[f64]| vec![list[0], list[1], 0.5 * list[1], list[2], list[3], list[4]];
    let (q, velocity) = ([0.3, -0.7, 0.4, 1.1, -0.2], [0.5, 0.6, -0.7, 0.8, 0.9]);
    let (mut room, mut wide) = (coupled.workspace(), free.workspace());
    let state = State::new(&q, &velocity);
    let (spread_q, spread_velocity) = (spread(&q), spread(&velocity));
    let torques = coupled.inverse(&mut room, state, &velocity).unwrap();
    let all = free.inverse(&mut wide, State::new(&spread_q, &spread_velocity), &spread_velocity).unwrap();
    let expected = [all[0], all[1] + 0.5 * all[2], all[3], all[4], all[5]];
    assert!((torques - DVector::from_column_slice(&expected)).amax() < 1e-12);
}

#[test]
fn friction_and_rotors_are_counted_once() {
    let plain = ur5();
    let mut parts = plain.parts().clone();
    let joint = &mut parts.joints[plain.moving()[0]];
    (joint.damping, joint.friction, joint.armature) = (2.0, 3.0, 4.0);
    let with = Equations::new(&Robot::new(parts).unwrap(), Base::Fixed).unwrap();
    let without = Equations::new(&plain, Base::Fixed).unwrap();
    let (mut room, mut other) = (with.workspace(), without.workspace());
    let (q, velocity, acceleration) = ([0.1; 6], [-0.5; 6], [0.7; 6]);
    let state = State::new(&q, &velocity);
    let torques = with.inverse(&mut room, state, &acceleration).unwrap().clone();
    let more = &torques - without.inverse(&mut other, state, &acceleration).unwrap();
    assert!((more[0] - (4.0 * 0.7 - 2.0 * 0.5 - 3.0)).abs() < 1e-12 && more.rows(1, 5).amax() == 0.0);
    let back = with.forward(&mut room, state, torques.as_slice()).unwrap();
    assert!((back - DVector::from_column_slice(&acceleration)).amax() < 1e-10);
    let bare = with.without_friction().inverse(&mut room, state, &acceleration).unwrap();
    assert!((bare[0] - torques[0] - 4.0).abs() < 1e-12);
}

/// Each robot with each base, with a state and an acceleration. A massless body of RH0 is irrelevant here.
fn states(seed: u64, mut judge: impl FnMut(&Equations, &mut Workspace, &Robot, Base, [&[f64]; 3])) {
    let mut random = Random(seed);
    for robot in all() {
        for base in [Base::Fixed, Base::Floating] {
            let equations = Equations::new(&robot, base).unwrap();
            let (joints, count) = (equations.joints().len(), equations.freedoms());
            let q = if base == Base::Fixed { random.numbers(joints, 3.0) } else { floating(&mut random, joints) };
            let (velocity, acceleration) = (random.numbers(count, 2.0), random.numbers(count, 5.0));
            judge(&equations, &mut equations.workspace(), &robot, base, [&q, &velocity, &acceleration]);
        }
    }
}

#[test]
fn derivatives_are_finite_differences() {
    states(4, |equations, room, robot, base, [q, velocity, acceleration]| {
        let state = State::new(q, velocity);
        let exact = equations.derivatives(room, state, acceleration).unwrap().clone();
        let step = 1e-6;
        for freedom in 0..equations.freedoms() {
            let mut unit = vec![0.0; equations.freedoms()];
            unit[freedom] = 1.0;
            let along =
                |list: &[f64], path: f64| -> Vec<f64> { list.iter().zip(&unit).map(|(x, u)| x + path * u).collect() };
            let mut torques = |path: f64| {
                let q = moved(base, q, &unit, path);
                let by_q = equations.inverse(room, State::new(&q, velocity), acceleration).unwrap().clone();
                let faster = along(velocity, path);
                let by_velocity =
                    equations.inverse(room, State { velocity: &faster, ..state }, acceleration).unwrap().clone();
                let pushed = along(acceleration, path);
                [by_q, by_velocity, equations.inverse(room, state, &pushed).unwrap().clone()]
            };
            let (ahead, after) = (torques(step), torques(-step));
            for (which, (ahead, after)) in ahead.iter().zip(&after).enumerate() {
                let slope = (ahead - after) / (2.0 * step);
                let what = format!("{} {base:?} freedom {freedom} matrix {which}", robot.name());
                near(exact[which].column(freedom).as_slice(), slope.as_slice(), 1e-6, &what);
            }
        }
    });
}

/// They equal the derivatives by dual numbers, up to rounding: joints only, for a robot without rotors and friction.
#[test]
fn derivatives_are_those_of_dual_numbers() {
    let (robot, mut random) = (ur5(), Random(5));
    let model = Model::new(&robot).unwrap();
    let equations = Equations::new(&robot, Base::Fixed).unwrap().without_friction();
    let mut room = equations.workspace();
    let [q, velocity, acceleration] = [3.0, 2.0, 5.0].map(|most| random.numbers(6, most));
    let exact = equations.derivatives(&mut room, State::new(&q, &velocity), &acceleration).unwrap();
    let tree = Tree::new(&model).map(|x| Dual::constant(*x));
    let mut data = Data::new(&tree);
    for column in 0..6 {
        let slope = |at: usize| if at == column { 1.0 } else { 0.0 };
        for (which, exact) in exact[..2].iter().enumerate() {
            let place = |(at, q): (usize, &f64)| {
                let slope = if which == 0 { slope(at) } else { 0.0 };
                let (s, c) = q.sin_cos();
                Place::Turn([Dual { value: c, slope: -s * slope }, Dual { value: s, slope: c * slope }])
            };
            data.place(&tree, q.iter().enumerate().map(place));
            let rate = |(at, v): (usize, &f64)| Dual { value: *v, slope: if which == 1 { slope(at) } else { 0.0 } };
            let rates: Vec<_> = velocity.iter().enumerate().map(rate).collect();
            let accelerations: Vec<_> = acceleration.iter().map(|a| Dual::constant(*a)).collect();
            let mut base_acceleration = Six::zero();
            base_acceleration.linear[2] = Dual::constant(9.81);
            let motion = Motion { base: Six::zero(), base_acceleration, rates: &rates, accelerations: &accelerations };
            let mut torques = vec![Dual::constant(0.0); 6];
            data.inverse(&tree, &motion, &[], &mut torques);
            let slopes: Vec<f64> = torques.iter().map(|torque| torque.slope).collect();
            near(exact.column(column).as_slice(), &slopes, 1e-12, "dual");
        }
    }
}

/// The power of torques, including rotors and without friction, is the rate of the energy.
#[test]
fn power_is_what_the_energy_changes_by() {
    states(6, |equations, room, robot, base, [q, velocity, acceleration]| {
        let equations = equations.clone().without_friction();
        let torques = equations.inverse(room, State::new(q, velocity), acceleration).unwrap();
        let power = torques.dot(&DVector::from_column_slice(velocity));
        let mut at = |time: f64| {
            let faster: Vec<f64> = velocity.iter().zip(acceleration).map(|(v, a)| v + time * a).collect();
            let mean: Vec<f64> = velocity.iter().zip(&faster).map(|(a, b)| 0.5 * (a + b)).collect();
            let energy = equations.energy(room, State::new(&moved(base, q, &mean, time), &faster)).unwrap();
            energy.kinetic + energy.potential
        };
        let rate = (at(1e-5) - at(-1e-5)) / 2e-5;
        near(&[power], &[rate], 1e-6, robot.name());
    });
}

#[test]
fn the_regressor_times_what_bodies_weigh_is_the_torques() {
    states(7, |equations, room, robot, _, [q, velocity, acceleration]| {
        let mut bare = robot.parts().clone();
        bare.joints.iter_mut().for_each(|joint| joint.armature = 0.0);
        let bare = Equations::new(&Robot::new(bare).unwrap(), Base::Fixed).unwrap();
        let bare =
            bare.with_base(if q.len() == velocity.len() { Base::Fixed } else { Base::Floating }).without_friction();
        let parameters = equations.parameters();
        assert_eq!(equations.parameter_names().len(), parameters.len());
        let state = State::new(q, velocity);
        let product = equations.regressor(room, state, acceleration).unwrap() * DVector::from_vec(parameters);
        near(product.as_slice(), bare.inverse(room, state, acceleration).unwrap().as_slice(), 1e-12, robot.name());
    });
}

#[test]
fn jacobians_and_momenta_are_those_of_motions() {
    states(8, |equations, room, robot, base, [q, velocity, acceleration]| {
        let still = vec![0.0; acceleration.len()];
        let model = Model::new(robot).unwrap();
        let joints = &q[q.len() - model.joints().len()..];
        let turn = |q: &[f64]| UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5]));
        let world_from_base = match base {
            Base::Fixed => Pose::identity(),
            Base::Floating => Pose::from_parts(Vector3::from_column_slice(&q[..3]).into(), turn(q)),
        };
        let placed = model.place(&world_from_base, joints).unwrap();
        let v = DVector::from_column_slice(velocity);
        for link in [0, robot.links().len() - 1] {
            let pose = equations.pose(room, q, link).unwrap();
            assert!((pose.to_homogeneous() - placed.world_from_link(link).to_homogeneous()).amax() < 1e-12);
            let [jacobian, rate] = equations.jacobian(room, State::new(q, velocity), link).unwrap().map(Clone::clone);
            let step = 1e-6;
            let mut at = |time: f64| {
                let q = moved(base, q, velocity, time);
                let pose = equations.pose(room, &q, link).unwrap();
                (pose, equations.jacobian(room, State::new(&q, &still), link).unwrap()[0].clone())
            };
            let ((ahead, jacobian_ahead), (after, jacobian_behind)) = (at(step), at(-step));
            let linear = (ahead.translation.vector - after.translation.vector) / (2.0 * step);
            let angular = (ahead.rotation * after.rotation.inverse()).scaled_axis() / (2.0 * step);
            let moving = &jacobian * &v;
            near(moving.as_slice(), &[linear.as_slice(), angular.as_slice()].concat(), 1e-7, robot.name());
            let change = (jacobian_ahead - jacobian_behind) / (2.0 * step);
            near(rate.as_slice(), change.as_slice(), 1e-7, robot.name());
        }
        let centre = equations.centre_of_mass(room, q).unwrap();
        assert!((centre - placed.centre_of_mass()).amax() < 1e-12);
        let momentum = equations.momentum(room, State::new(q, velocity)).unwrap();
        let (base_twist, rates) = match base {
            Base::Fixed => (groebot_robot::spatial::Twist { v: Vector3::zeros(), w: Vector3::zeros() }, velocity),
            Base::Floating => {
                let own = groebot_robot::spatial::Twist {
                    v: Vector3::from_column_slice(&velocity[..3]),
                    w: Vector3::from_column_slice(&velocity[3..6]),
                };
                (own.transform(&world_from_base), &velocity[6..])
            }
        };
        let expected = placed.momentum(&base_twist, rates).unwrap();
        near(momentum.linear.as_slice(), expected.linear.as_slice(), 1e-12, robot.name());
        near(momentum.angular.as_slice(), expected.angular.as_slice(), 1e-12, robot.name());
        let centroidal = equations.centroidal(room, q).unwrap() * &v;
        let about = momentum.about(&centre);
        near(centroidal.as_slice(), &[momentum.linear.as_slice(), about.as_slice()].concat(), 1e-12, robot.name());
    });
}

/// An external wrench on a link is subtracted by its Jacobian, and forward dynamics includes it.
#[test]
fn what_acts_from_outside_is_felt_by_jacobians() {
    states(9, |equations, room, robot, _, [q, velocity, acceleration]| {
        let link = robot.links().len() - 1;
        let wrench = Wrench { f: Vector3::new(1.0, -2.0, 3.0), tau: Vector3::new(0.4, 0.5, -0.6) };
        let outside = [(link, wrench), (0, wrench)];
        let (state, pushed) = (State::new(q, velocity), State::new(q, velocity).with_wrenches(&outside));
        let without = equations.inverse(room, state, acceleration).unwrap().clone();
        let with = equations.inverse(room, pushed, acceleration).unwrap().clone();
        let mut expected = without - &with;
        for place in [0, link] {
            let turn = equations.pose(room, q, place).unwrap().rotation;
            let [jacobian, _] = equations.jacobian(room, state, place).unwrap();
            let world = Wrench { f: turn * wrench.f, tau: turn * wrench.tau }.to_vector();
            expected -= jacobian.transpose() * world;
        }
        assert!(expected.amax() < 1e-10, "{}: {}", robot.name(), expected.amax());
        if robot.name() != "rh0" {
            let back = equations.forward(room, pushed, with.as_slice()).unwrap();
            near(back.as_slice(), acceleration, 1e-8, robot.name());
        }
    });
}

#[test]
fn what_is_no_state_is_refused() {
    let equations = Equations::new(&ur5(), Base::Floating).unwrap();
    let mut room = equations.workspace();
    let (mut q, velocity) = (vec![0.0; 13], vec![0.0; 12]);
    let refused = |room: &mut _, q: &[f64], velocity: &[f64]| {
        let error = equations.inverse(room, State::new(q, velocity), &[0.0; 12]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue);
        error.to_string()
    };
    assert!(refused(&mut room, &q, &velocity).contains("quaternion"));
    q[6] = 1.0;
    assert!(refused(&mut room, &q[1..], &velocity).contains("12 numbers are given, the robot has 13"));
    assert!(refused(&mut room, &q, &[f64::NAN; 12]).contains("velocity0 is NaN"));
}

#[test]
fn what_no_body_has_is_refused_by_its_link() {
    let plain = ur5();
    let mut parts = plain.parts().clone();
    let link = parts.links.iter_mut().find(|link| link.mass.is_some()).unwrap();
    link.mass.as_mut().unwrap().mass = BigRational::from_integer((-1).into());
    let name = link.name.clone();
    let error = Equations::new(&Robot::new(parts).unwrap(), Base::Fixed).unwrap_err().to_string();
    assert!(error.contains(&name) && error.contains("mass -1"), "{error}");

    // A rod with one given moment only is physically impossible. Fixed to another link it can be part of a body.
    let mut parts = plain.parts().clone();
    let zero = BigRational::default;
    let thin = [BigRational::new(1.into(), 1000.into()), zero(), zero(), zero(), zero(), zero()];
    let bad = Mass { mass: BigRational::from_integer(1.into()), origin: Origin::identity(), moments: thin };
    let moving = parts.links.iter().position(|link| link.name == "wrist_3_link").unwrap();
    let mut child = Joint::new("mount", JointType::Fixed, "wrist_3_link", "camera");
    child.origin.placement.origin[0] = BigRational::new(1.into(), 10.into());
    parts.joints.push(child);
    parts.links.push(Link { mass: Some(bad.clone()), ..Link::new("camera") });
    assert!(Equations::new(&Robot::new(parts.clone()).unwrap(), Base::Fixed).is_ok());
    parts.links[moving].mass = None;
    let alone = Robot::new(parts).unwrap();
    let error = Equations::new(&alone, Base::Fixed).unwrap_err().to_string();
    assert!(error.contains("link `camera`") && error.contains("each principal moment"), "{error}");
    assert!(Equations::unchecked(&alone, Base::Fixed).is_ok());

    let mut parts = plain.parts().clone();
    parts.links.iter_mut().for_each(|link| link.mass = None);
    let massless = Equations::new(&Robot::new(parts).unwrap(), Base::Fixed).unwrap();
    let still = [0.0; 6];
    let state = State::new(&still, &still);
    let error = massless.forward(&mut massless.workspace(), state, &still).unwrap_err().to_string();
    assert!(error.contains("link `wrist_3_link` of joint `wrist_3`") && error.contains("no mass"), "{error}");
}
