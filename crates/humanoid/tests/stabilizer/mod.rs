//! The stabiliser without physics: it does nothing where nothing is wrong, and displaced footsteps are those of the forward kinematics of its targets. Walks in
//! MuJoCo are in `tests/cli/simulate.rs` of the workspace.

mod descent;

use groebot_humanoid::gait::{GRAVITY, Regular, Route, Side, Walk, Walker, plan};
use groebot_humanoid::stabilizer::{SoleForce, Stabilizer, State};
use groebot_humanoid::walkers::{Outline, walker};
use groebot_humanoid::{ErrorKind, sim};
use groebot_robot::motion::Trajectory;
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// A robot with a walk of four steps, the first one by the right foot.
fn four_steps(name: &str) -> (Walker, Walk) {
    let walker = walker(name, Outline::Measured).unwrap().unwrap();
    let (biped, defaults) = (&walker.biped, &walker.gaits[0].1);
    let regular =
        Regular { steps: 4, length: 0.04, turn: 0.0, aside: 0.0, half_width: biped.half_width(), first: Side::Right };
    let route = Route::regular(&regular).unwrap();
    let planned = |height: &f64| plan(biped, &walker.legs, &defaults.request(biped, route.clone(), *height), None).ok();
    let walk = defaults.hip_heights.iter().find_map(planned).unwrap();
    (walker, walk)
}

/// The poses of both soles in the base for joint values in the order of the robot.
fn soles(walker: &Walker, q: &[f64]) -> [Pose; 2] {
    let biped = &walker.biped;
    let placed = biped.model.place(&Pose::identity(), q).unwrap();
    [Side::Left, Side::Right].map(|side| {
        let foot = &biped.feet[side as usize];
        placed.world_from_link(foot.link) * biped.model.link(foot.link).1.inv_mul(&foot.torso_from_sole)
    })
}

/// The state in which the robot is as planned at a row. The soles carry these shares of the weight, so that the zero moment point is the planned one.
fn planned(walker: &Walker, walk: &Trajectory, row: usize, carry: [f64; 2]) -> State {
    let biped = &walker.biped;
    let mut q = vec![0.0; biped.joints.len()];
    for (joint, value) in walk.joints.iter().zip(&walk.q[row]) {
        q[biped.joint(&joint.name).unwrap()] = *value;
    }
    let base = walk.base[row];
    let zmp = walk.points.iter().find(|point| point.name == "zmp").unwrap().at[row];
    let weight = biped.model.mass() * GRAVITY;
    let force = |side: usize| {
        let world_from_sole = base * soles(walker, &q)[side];
        let below = world_from_sole.inverse() * Point3::new(zmp.x, zmp.y, 0.0);
        // On both feet the weight is at the middles of the soles.
        let ends = biped.feet[side].corners.iter().map(|corner| corner.y);
        let low_and_high = ends.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
        let aside = (low_and_high.0 + low_and_high.1) / 2.0;
        let middle = if carry[0] == carry[1] { Point3::new(below.x, aside, 0.0) } else { below };
        let force = Vector3::new(0.0, 0.0, carry[side] * weight);
        SoleForce { force, moment: middle.coords.cross(&force) }
    };
    let soles = [force(0), force(1)];
    State { time: walk.times[row], q, orientation: base.rotation, angular_velocity: Vector3::zeros(), soles }
}

#[test]
fn a_robot_that_stands_as_planned_is_not_moved() {
    // NAO rests at first; RH0 and TEO start to move at once.
    for (name, period) in [("nao", 0.005), ("rh0", 1e-6), ("teo", 1e-6)] {
        let (walker, walk) = four_steps(name);
        let walk = walk.trajectory(&walker.biped);
        let mut stabilizer = Stabilizer::new(walker.clone(), &walk).unwrap();
        for step in 0..100 {
            let mut state = planned(&walker, &walk, 0, [0.5, 0.5]);
            state.time = period * f64::from(step);
            let targets = stabilizer.step(&state).unwrap();
            let apart =
                targets.positions.iter().zip(&state.q).map(|(target, q)| (target - q).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-3, "{name}: {apart}");
        }
    }
}

/// The targets of a motor with a stiffness contain the planned torque divided by it, here of a robot that stands on one foot: compared with inverse dynamics.
#[test]
fn the_deflection_under_the_weight_is_that_of_inverse_dynamics() {
    let (walker, plan) = four_steps("nao");
    let walk = plan.trajectory(&walker.biped);
    let row = single_support(&walk, 1);
    let state = planned(&walker, &walk, row, [1.0, 0.0]);
    let targets = |stiffness: Option<f64>| {
        let stabilizer = Stabilizer::new(walker.clone(), &walk).unwrap();
        let mut stabilizer = stiffness.into_iter().fold(stabilizer, Stabilizer::stiffness);
        stabilizer.step(&state).unwrap().positions
    };
    let (rigid, soft) = (targets(None), targets(Some(300.0)));
    let forces = plan.forces(&walker.biped);
    for joint in &walker.biped.feet[0].joints {
        let torque = 300.0 * (soft[*joint] - rigid[*joint]);
        let expected = forces[row].torques[*joint];
        assert!((torque - expected).abs() < 0.35, "{}: {torque} for {expected}", walker.biped.joints[*joint].name);
    }
}

#[test]
fn each_joint_has_its_own_stiffness() {
    let (walker, plan) = four_steps("nao");
    let walk = plan.trajectory(&walker.biped);
    let state = planned(&walker, &walk, single_support(&walk, 1), [1.0, 0.0]);
    let new = || Stabilizer::new(walker.clone(), &walk).unwrap();
    let count = walker.biped.joints.len();
    let [rigid, soft] = [new(), new().stiffness(300.0)].map(|mut law| law.step(&state).unwrap().positions);
    let knee = walker.biped.feet[0].joints[3];
    let mut stiffness = vec![f64::INFINITY; count];
    stiffness[knee] = 150.0;
    let own = new().joint_stiffness(stiffness.clone()).unwrap().step(&state).unwrap().positions;
    for joint in 0..count {
        let expected = if joint == knee { rigid[knee] + 2.0 * (soft[knee] - rigid[knee]) } else { rigid[joint] };
        assert!((own[joint] - expected).abs() < 1e-12, "{}", walker.biped.joints[joint].name);
    }
    let refused = |stiffness: Vec<f64>| new().joint_stiffness(stiffness).map(drop).unwrap_err();
    assert_eq!(refused(vec![300.0]).kind(), ErrorKind::BadValue);
    stiffness[knee] = 0.0;
    assert!(refused(stiffness).to_string().contains(&walker.biped.joints[knee].name));
}

/// The first row after which the foot of a side swings for a while.
fn single_support(walk: &Trajectory, side: usize) -> usize {
    let stands = &sim::soles(walk).unwrap()[side].stands;
    let start = stands.iter().position(|stands| !stands).unwrap();
    start + stands[start..].iter().take_while(|stands| !**stands).count() / 4
}

/// The pose of the right sole in the frame of the left one for joint values.
fn right_in_left(walker: &Walker, q: &[f64]) -> Pose {
    let [left, right] = soles(walker, q);
    left.inv_mul(&right)
}

/// Steps a stabiliser of NAO along its plan until the first landing of the right foot, with states that `change` makes of the planned ones from a quarter of the
/// swing on. Returns the walker, the walk, the row of the landing and the targets of each row.
fn until_landing(change: impl Fn(f64, &mut State)) -> (Walker, Trajectory, usize, Vec<Vec<f64>>) {
    let (walker, walk) = four_steps("nao");
    let walk = walk.trajectory(&walker.biped);
    let start = single_support(&walk, 1);
    let stands = &sim::soles(&walk).unwrap()[1].stands;
    let landing = start + stands[start..].iter().position(|stands| *stands).unwrap();
    let mut stabilizer = Stabilizer::new(walker.clone(), &walk).unwrap();
    let targets = (0..landing).map(|row| {
        let standing = if row < start { [0.5, 0.5] } else { [1.0, 0.0] };
        let mut state = planned(&walker, &walk, row, standing);
        if row >= start {
            change((row - start) as f64 / (landing - start) as f64, &mut state);
        }
        stabilizer.step(&state).unwrap().positions
    });
    let targets = targets.collect();
    (walker, walk, landing, targets)
}

/// The robot stands on the left foot and falls to the right, with the pressure on the inner border. The right foot lands farther to the right.
#[test]
fn a_footstep_moves_to_where_the_robot_falls() {
    let (walker, walk, landing, targets) = until_landing(|share, state| {
        // A rotation about x turns the robot to the right.
        state.orientation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.12 * share) * state.orientation;
    });
    let apart = |q: &[f64]| right_in_left(&walker, q).translation.vector;
    let plan = apart(&planned(&walker, &walk, landing - 1, [1.0, 0.0]).q);
    let moved = apart(&targets[landing - 1]);
    let aside = plan.y - moved.y;
    // At most a fifth of the height of the centre of mass, 0.33 m.
    assert!((0.01..0.066).contains(&aside), "{moved} for {plan}");
}

/// The robot has slipped: it is turned to the left by 0.05 rad. The next foot lands turned to the right.
#[test]
fn a_footstep_corrects_the_heading() {
    let (walker, walk, landing, targets) = until_landing(|_, state| {
        state.orientation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.05) * state.orientation;
    });
    let planned = planned(&walker, &walk, landing - 1, [1.0, 0.0]).q;
    let yaw = |q: &[f64]| right_in_left(&walker, q).rotation.euler_angles().2;
    let turned = yaw(&targets[landing - 1]) - yaw(&planned);
    // At most half of the error; the filter has not yet seen all of it.
    assert!((-0.025..-0.01).contains(&turned), "{turned}");
}

/// The swinging foot presses the floor too early, at two thirds of its swing: it goes no further.
#[test]
fn a_foot_that_touches_early_stays_where_it_is() {
    let (walker, walk, landing, targets) = until_landing(|share, state| {
        if share > 0.6 {
            let weight = state.soles[0].force.z;
            state.soles[0].force.z = 0.85 * weight;
            state.soles[1].force = Vector3::new(0.0, 0.0, 0.15 * weight);
        }
    });
    let ahead = |q: &[f64]| right_in_left(&walker, q).translation.x;
    let plan = |row: usize| ahead(&planned(&walker, &walk, row, [1.0, 0.0]).q);
    let start = single_support(&walk, 1);
    let touch = start + (0.65 * (landing - start) as f64) as usize;
    let (own, planned) = (ahead(&targets[landing - 1]) - ahead(&targets[touch]), plan(landing - 1) - plan(touch));
    assert!(planned > 1e-3 && own.abs() < 0.1 * planned, "{own} for {planned}");
}

#[test]
fn states_and_walks_that_do_not_fit_are_refused() {
    let (walker, walk) = four_steps("nao");
    let walk = walk.trajectory(&walker.biped);
    let new = |walk: &Trajectory| Stabilizer::new(walker.clone(), walk).map(drop).unwrap_err().kind();
    assert_eq!(new(&Trajectory { points: Vec::new(), ..walk.clone() }), ErrorKind::MissingKey);
    assert_eq!(new(&Trajectory { base: Vec::new(), ..walk.clone() }), ErrorKind::MissingKey);
    let (rh0, _) = four_steps("rh0");
    assert_eq!(Stabilizer::new(rh0, &walk).map(drop).unwrap_err().kind(), ErrorKind::UnknownName);
    let state = planned(&walker, &walk, 5, [0.5, 0.5]);
    let mut stabilizer = Stabilizer::new(walker.clone(), &walk).unwrap();
    stabilizer.step(&state).unwrap();
    let mut refused = |state: State| stabilizer.step(&state).unwrap_err().kind();
    assert_eq!(refused(State { q: vec![0.0; 3], ..state.clone() }), ErrorKind::BadValue);
    assert_eq!(refused(State { time: f64::NAN, ..state.clone() }), ErrorKind::BadValue);
    assert_eq!(refused(State { time: 0.0, ..state.clone() }), ErrorKind::BadValue);
    let broken = SoleForce { force: Vector3::repeat(f64::INFINITY), ..state.soles[0] };
    assert_eq!(refused(State { soles: [broken; 2], ..state }), ErrorKind::BadValue);
}
