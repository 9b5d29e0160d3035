//! The recursions beside the closed forms of the thesis, and beside one another.

use groebot::ErrorKind;
use groebot::dynamics::{Base, Equations, Model, State};
use groebot::model::{Joint, JointType, Link, Mass, Mimic, Origin, Robot};
use groebot::number::BigRational;
use groebot::robots;
use groebot::spatial::Pose;
use nalgebra::{DMatrix, DVector, Vector3};

/// SplitMix64 (Steele, Lea and Flood 2014), numbers between -1 and 1.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn numbers(&mut self, count: usize, most: f64) -> Vec<f64> {
        (0..count).map(|_| most * self.number()).collect()
    }
}

/// The corpus tells no masses of it: each link weighs something else, off its axis.
fn ur5() -> Robot {
    let mut parts = Robot::from_urdf(include_str!("../corpus/urdf/ur5.urdf")).unwrap().parts().clone();
    let share = |numerator: i64, denominator: i64| BigRational::new(numerator.into(), denominator.into());
    for (number, link) in (1..).zip(&mut parts.links) {
        let mut origin = Origin::identity();
        origin.placement.origin = [share(number, 50), share(-1, 20), share(3, 10 + number)];
        let [little, much] = [share(number, 200), share(number, 40)];
        let moments = [much.clone(), little, share(0, 1), much.clone(), share(-number, 300), much];
        link.mass = Some(Mass { mass: share(9 - number, 2), origin, moments });
    }
    Robot::new(parts).unwrap()
}

fn all() -> [Robot; 4] {
    [ur5(), robots::robot("nao_v5").unwrap(), robots::robot("rh0").unwrap(), robots::robot("teo").unwrap()]
}

/// The configuration of a free root, and of joints.
fn floating(random: &mut Random, joints: usize) -> Vec<f64> {
    let mut q = random.numbers(7 + joints, 2.0);
    let length = DVector::from_column_slice(&q[3..7]).norm();
    q[3..7].iter_mut().for_each(|x| *x /= length);
    q
}

fn assert_near(found: &DMatrix<f64>, expected: &DMatrix<f64>, share: f64, what: &str) {
    let miss = (found - expected).amax();
    assert!(miss <= share * expected.amax().max(1.0), "{what}: off by {miss:e} of {:e}", expected.amax());
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
            let [inertia, coriolis] = equations.matrices(&mut room, State { q: &q, velocity: &velocity }).unwrap();
            assert_near(&inertia, &(model.inertia(&q).unwrap() + &armature), 1e-12, robot.name());
            assert_near(&coriolis, &model.coriolis(&q, &velocity).unwrap(), 1e-12, robot.name());
            // Gravity is the slope of the potential energy.
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
                let state = State { q: &q, velocity: &velocity };
                let torques = equations.inverse(&mut room, state, &acceleration).unwrap();
                let [inertia, coriolis] = equations.matrices(&mut room, state).unwrap();
                let [v, a] = [&velocity, &acceleration].map(|list| DVector::from_column_slice(list));
                let summed = inertia * a + coriolis * v + equations.gravity(&mut room, &q).unwrap();
                let [found, expected] =
                    [&torques, &summed].map(|list| DMatrix::from_column_slice(count, 1, list.as_slice()));
                assert_near(&found, &expected, 1e-12, robot.name());
                // Of RH0 the trunk's mass alone is told.
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

/// A free root's momentum in its own frame is the inertia matrix's first rows times the velocity; and `M' - 2 C` is skew along a motion.
#[test]
fn a_free_root_has_the_momentum_of_all_bodies() {
    let mut random = Random(3);
    let robot = robots::robot("rh0").unwrap();
    let (equations, model) = (Equations::new(&robot, Base::Floating).unwrap(), Model::new(&robot).unwrap());
    let (mut room, joints) = (equations.workspace(), equations.joints().len());
    let mut q = floating(&mut random, joints);
    let velocity = random.numbers(6 + joints, 1.0);
    let [inertia, coriolis] = equations.matrices(&mut room, State { q: &q, velocity: &velocity }).unwrap();
    let momentum = &inertia * DVector::from_column_slice(&velocity);
    let base = groebot::spatial::Twist {
        v: Vector3::from_column_slice(&velocity[..3]),
        w: Vector3::from_column_slice(&velocity[3..6]),
    };
    let placed = model.place(&Pose::identity(), &q[7..]).unwrap();
    let all = placed.momentum(&base, &velocity[6..]).unwrap();
    assert!((momentum.rows(0, 3) - all.linear).amax() < 1e-12 && (momentum.rows(3, 3) - all.angular).amax() < 1e-12);

    // In the base's own frame joints alone change the inertia matrix.
    let step = 1e-6;
    let mut at = |way: f64| {
        q[7..].iter_mut().zip(&velocity[6..]).for_each(|(q, rate)| *q += way * rate);
        equations.inertia(&mut room, &q).unwrap()
    };
    let (ahead, behind) = (at(step), at(-2.0 * step));
    let change = (ahead - behind) / (2.0 * step);
    let left = change - (&coriolis + coriolis.transpose());
    assert!(left.amax() < 1e-6, "{}", left.amax());
}

/// A joint that follows another one halves its way: as if both were one joint whose inertia is summed so.
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
    let state = State { q: &q, velocity: &velocity };
    let (spread_q, spread_velocity) = (spread(&q), spread(&velocity));
    let torques = coupled.inverse(&mut room, state, &velocity).unwrap();
    let all = free.inverse(&mut wide, State { q: &spread_q, velocity: &spread_velocity }, &spread_velocity).unwrap();
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
    let state = State { q: &q, velocity: &velocity };
    let torques = with.inverse(&mut room, state, &acceleration).unwrap();
    let more = &torques - without.inverse(&mut other, state, &acceleration).unwrap();
    assert!((more[0] - (4.0 * 0.7 - 2.0 * 0.5 - 3.0)).abs() < 1e-12 && more.rows(1, 5).amax() == 0.0);
    let back = with.forward(&mut room, state, torques.as_slice()).unwrap();
    assert!((back - DVector::from_column_slice(&acceleration)).amax() < 1e-10);
    let bare = with.without_friction().inverse(&mut room, state, &acceleration).unwrap();
    assert!((bare[0] - torques[0] - 4.0).abs() < 1e-12);
}

#[test]
fn what_is_no_state_is_refused() {
    let equations = Equations::new(&ur5(), Base::Floating).unwrap();
    let mut room = equations.workspace();
    let (mut q, velocity) = (vec![0.0; 13], vec![0.0; 12]);
    let refused = |room: &mut _, q: &[f64], velocity: &[f64]| {
        let error = equations.inverse(room, State { q, velocity }, &[0.0; 12]).unwrap_err();
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

    // A rod of which only one moment is told is no body; fixed to another link it may be part of one.
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
    assert!(Equations::as_told(&alone, Base::Fixed).is_ok());

    let mut parts = plain.parts().clone();
    parts.links.iter_mut().for_each(|link| link.mass = None);
    let massless = Equations::new(&Robot::new(parts).unwrap(), Base::Fixed).unwrap();
    let still = [0.0; 6];
    let state = State { q: &still, velocity: &still };
    let error = massless.forward(&mut massless.workspace(), state, &still).unwrap_err().to_string();
    assert!(error.contains("link `wrist_3_link` behind joint `wrist_3`") && error.contains("no mass"), "{error}");
}
