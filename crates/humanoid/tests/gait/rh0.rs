//! RH0's walks with the parameters printed in the thesis: 5.3.1, 5.3.2, 6.2.1, 6.2.2.

use std::f64::consts::PI;
use std::sync::OnceLock;

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{
    Action, Biped, GaitDefaults, Legs, Measures, Request, Route, Side, Summary, Walk, plan, plan_at, step_commands,
};
use groebot_humanoid::walkers::{Manipulator, RH0_EXPERIMENT, RH0_SIMULATION, coordinated_arm};
use groebot_robot::kinematics::Target;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, Vector3};

/// Four steps straight forward.
pub const LINE: &str = "out right, stride left, stride right, in left";
/// 25 rpm \[rad/s\], RH0 5.3.1.
const ACTUATOR: f64 = 25.0 * 2.0 * PI / 60.0;

pub fn walker() -> &'static (Biped, Legs) {
    static ROBOT: OnceLock<(Biped, Legs)> = OnceLock::new();
    ROBOT.get_or_init(|| super::built("rh0"))
}

pub fn request(defaults: &GaitDefaults, text: &str, hip_height: f64, from_upright: bool) -> Request {
    let (robot, _) = walker();
    let measures = Measures { length: defaults.length, half_width: robot.half_width(), most_turn: defaults.most_turn };
    let route = Route::of_commands(&step_commands(text).unwrap(), &measures).unwrap();
    let defaults = if from_upright { defaults.clone().from_upright(robot) } else { defaults.clone() };
    defaults.request(robot, route, hip_height)
}

fn walk(defaults: &GaitDefaults, text: &str, from_upright: bool) -> Walk {
    let (robot, legs) = walker();
    let at = |height, _| Ok(request(defaults, text, height, from_upright));
    plan_at((robot, legs), None, &defaults.hip_heights, at, &Watch::none()).unwrap()
}

/// All joints are within their limits and slower than 25 rpm, the zero moment point (ZMP) is inside the support polygon, and no phase is slowed down.
fn keeps_what_the_thesis_promises(walk: &Walk) {
    let (robot, _) = walker();
    let summary = Summary::of(robot, walk);
    assert!(summary.is_point_mass && summary.to_string().contains("a point at the trunk"));
    assert_eq!(summary.slowed.0, 0, "{summary}");
    for (sample, balance) in walk.balances.iter().enumerate() {
        assert!(balance.support.signed_distance(&balance.zmp) > 0.0, "{sample}: {}", balance.margin);
        let q = &walk.motion.postures[sample].q;
        let before = &walk.motion.postures[sample.saturating_sub(1)].q;
        for (joint, range) in robot.joints.iter().enumerate() {
            // The knee is at its limit while the leg is straight.
            assert!((range.limits.0 - 1e-6..=range.limits.1 + 1e-6).contains(&q[joint]), "{sample} {}", range.name);
            assert!((q[joint] - before[joint]).abs() / walk.schedule.tick < ACTUATOR, "{sample} {}", range.name);
        }
    }
}

#[test]
fn four_steps_straight_ahead_take_six_times_81_samples() {
    let walk = walk(&RH0_SIMULATION, LINE, true);
    keeps_what_the_thesis_promises(&walk);
    assert_eq!(walk.balances.len(), 1 + 6 * 81, "with the instant at which it starts");
    assert!((walk.time(486) - 17.496).abs() < 1e-9, "under 18 s");
    let actions: Vec<Action> = walk.schedule.phases.iter().map(|phase| phase.action).collect();
    assert_eq!((actions[0], actions[actions.len() - 1]), (Action::Lower, Action::Rise));
    let [left, right] = walk.schedule.route.stands().pop().unwrap();
    assert!((left.x - 0.48).abs() < 1e-12 && (right.x - 0.48).abs() < 1e-12, "0.08 + 0.16 + 0.16 + 0.08 m");
    let ahead: Vec<f64> = walk.schedule.route.steps.iter().map(|step| (step.print.x * 1e3).round()).collect();
    assert_eq!(ahead, [160.0, 320.0, 480.0, 480.0]);
}

#[test]
fn a_quarter_turn_takes_six_pairs_of_steps_and_less_than_36_s() {
    let walk = walk(&RH0_SIMULATION, "turn left 90", true);
    keeps_what_the_thesis_promises(&walk);
    let steps = &walk.schedule.route.steps;
    assert_eq!(steps.len(), 12);
    let summary = Summary::of(&walker().0, &walk);
    assert!((summary.stepping - 12.0 * 81.0 * 0.036).abs() < 1e-9 && summary.stepping < 36.0);
    for (pair, two) in steps.chunks(2).enumerate() {
        let yaw = (pair as f64 + 1.0) * PI / 12.0;
        assert_eq!((two[0].side, two[1].side), (Side::Right, Side::Left));
        assert!(
            two.iter()
                .all(|step| (step.print.yaw - yaw).abs() < 1e-12 && step.print.point().coords.norm() - 0.112 < 1e-12)
        );
    }
    let last = walk.motion.postures.last().unwrap();
    assert!((last.world_from_torso.rotation.scaled_axis().z - PI / 2.0).abs() < 1e-9);
    assert!(last.world_from_torso.translation.vector.xy().norm() < 1e-9, "on the spot");
}

/// RH0 6.2.1: with RA_AS = 0.03 m, H_CM = 0.58 m is out of reach of legs of 0.28 + 0.28 m by one or two millimetres; see docs/rh0.md.
#[test]
fn the_experiment_straight_ahead_has_323_samples_a_step() {
    let (robot, legs) = walker();
    let heights = RH0_EXPERIMENT.hip_heights;
    let at_once = plan(robot, legs, &request(&RH0_EXPERIMENT, LINE, heights[0], false), &Watch::none());
    assert!(at_once.unwrap_err().message().contains("out of reach"));
    let walk = walk(&RH0_EXPERIMENT, LINE, false);
    keeps_what_the_thesis_promises(&walk);
    assert_eq!(walk.balances.len(), 1 + 4 * 323);
    let lower = heights[0] + robot.hip_to_torso() - walk.request.style.torso_height;
    assert!(lower > 0.0 && lower < 0.0035, "{lower}");
    let margin = Summary::of(robot, &walk).margin.value;
    assert!(margin > 0.039, "half of the sole's 140 mm less RA_AS: {margin}");
}

/// RH0 6.2.2: eight pairs of 10 degrees are 80 degrees; nine pairs are the 90 degrees of its title.
#[test]
fn the_experiment_turns_by_10_degrees_a_pair() {
    for (text, pairs) in [("turn left 80", 8), ("turn left 90", 9), ("turn right 85", 9)] {
        let walk = walk(&RH0_EXPERIMENT, text, false);
        keeps_what_the_thesis_promises(&walk);
        assert_eq!(walk.schedule.route.steps.len(), 2 * pairs, "{text}");
        assert_eq!(walk.balances.len(), 1 + 2 * pairs * 323);
    }
}

/// The trunk in the thesis' axes, relative to S of the reference configuration, and the foot's motion since then.
fn in_thesis_frames(walk: &Walk, sample: usize, side: Side) -> (Pose, Pose) {
    let (robot, _) = walker();
    let ours_from_thesis = nalgebra::UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(
        nalgebra::Matrix3::from_columns(&[Vector3::y(), Vector3::z(), Vector3::x()]),
    ));
    let ankle = robot.feet[0].ankle_height;
    let world_from_s = Pose::from_parts(Vector3::new(0.0, 0.0, ankle).into(), ours_from_thesis);
    let turn = Pose::from_parts(Vector3::zeros().into(), ours_from_thesis);
    let trunk = world_from_s.inverse() * walk.motion.postures[sample].world_from_torso * turn;
    let start = Pose::translation(0.0, side.sign() * 0.112, 0.0);
    let moved = walk.references[sample].world_from_soles[side as usize] * start.inverse();
    (trunk, world_from_s.inverse() * moved * world_from_s)
}

/// Both manipulators of the sagittal division reach the trunk with the walk's joints, by (3-13) and (3-28). The derived solver and the thesis' method by screws
/// find equal sets of up to eight solutions, and the walk's is among them.
#[test]
fn both_halves_are_solved_by_two_witnesses() {
    let (robot, _) = walker();
    for (text, step) in [(LINE, 29), ("turn left 30", 41)] {
        let walk = walk(&RH0_SIMULATION, text, true);
        let mut most = 0;
        for side in [Side::Left, Side::Right] {
            let half = Manipulator::rh0(side).unwrap();
            let screws = ScrewSolver::new(half.chain()).unwrap();
            let prefix = if side == Side::Left { "L" } else { "R" };
            let names = ["AnkleRoll", "AnklePitch", "KneePitch", "HipPitch", "HipRoll", "HipYaw"];
            for sample in (5..walk.balances.len()).step_by(step) {
                let q =
                    names.map(|name| walk.motion.postures[sample].q[robot.joint(&format!("{prefix}{name}")).unwrap()]);
                let (trunk, foot) = in_thesis_frames(&walk, sample, side);
                let virtual_joints = half.virtual_joints(&foot);
                let again = half.foot(&virtual_joints).to_homogeneous() - foot.to_homogeneous();
                assert!(again.amax() < 1e-12);
                let miss = half.trunk(&virtual_joints, &q).to_homogeneous() - trunk.to_homogeneous();
                assert!(miss.amax() < 1e-9, "{sample} {}: {}", side.name(), miss.amax());
                let derived = half.legs(&virtual_joints, &trunk).unwrap();
                let witness = screws.solve(&Target::Pose(foot.inverse() * trunk)).unwrap();
                assert_eq!(derived.len(), witness.len(), "{sample}");
                let apart = |a: &[f64], b: &[f64]| {
                    a.iter()
                        .zip(b)
                        .map(|(a, b)| groebot_robot::spatial::angle::difference(*a, *b).abs())
                        .fold(0.0, f64::max)
                };
                for answer in &derived {
                    let nearest = witness.iter().map(|other| apart(answer, &other.q)).fold(f64::MAX, f64::min);
                    assert!(nearest < 1e-6, "{sample}: {nearest}");
                }
                let own = derived.iter().map(|answer| apart(answer, &q)).fold(f64::MAX, f64::min);
                assert!(own < 1e-9, "{sample}: {own}");
                most = most.max(derived.len());
            }
        }
        assert_eq!(most, 8, "RH0 (3-24), (3-39)");
    }
}

/// RH0 (3-23), (3-38): the arms have values of the opposite leg. The hand of a half is where forward kinematics of the whole robot places it.
#[test]
fn arms_are_coordinated_with_the_other_leg() {
    let (robot, _) = walker();
    let walk = walk(&RH0_SIMULATION, LINE, true);
    let whole = groebot_robot::robots::rh0();
    let place = |symbol: u32| robot.joints.iter().position(|joint| joint.symbol == symbol.to_string()).unwrap();
    for sample in (0..walk.balances.len()).step_by(31) {
        let posture = &walk.motion.postures[sample];
        let q = |symbol: u32| posture.q[place(symbol)];
        assert_eq!([q(14), q(15), q(16)], [q(9), q(8), q(10)]);
        assert_eq!([q(18), q(19), q(20)], [q(4), q(5), q(3)]);
        let left_leg = [12, 11, 10, 9, 8, 7].map(q);
        assert_eq!(coordinated_arm(&left_leg), [q(14), q(15), q(16)]);
        assert_eq!([q(13), q(17), q(21)], [0.0; 3]);
        let half = Manipulator::rh0(Side::Right).unwrap();
        let (_, foot) = in_thesis_frames(&walk, sample, Side::Right);
        let real = groebot_humanoid::walkers::Real {
            leg: [1, 2, 3, 4, 5, 6].map(q),
            column: q(13),
            arm: [14, 15, 16, 17].map(q),
        };
        let hand = half.hand(&half.virtual_joints(&foot), &real).translation.vector;
        let placed = robot.model.place(&posture.world_from_torso, &posture.q).unwrap();
        let wrist = placed.world_from_link(whole.link("RHand").unwrap()).translation.vector;
        let ours = Point3::new(hand.z, hand.x, hand.y + robot.feet[0].ankle_height);
        assert!((ours.coords - wrist).norm() < 1e-9, "{sample}");
    }
}

/// RH0 (3-47), (3-49): the foot's path is a cosine in space, with a pitch of 20 degrees at its highest point. The trunk is lowest at lift-off and landing.
#[test]
fn foot_and_trunk_follow_the_laws() {
    let walk = walk(&RH0_SIMULATION, LINE, true);
    let mut highest: f64 = 0.0;
    let crouch = walk.request.style.torso_height;
    let mut swings = Vec::new();
    for (sample, reference) in walk.references.iter().enumerate() {
        let height = walk.motion.postures[sample].world_from_torso.translation.z;
        match walk.schedule.phases[reference.phase].action {
            Action::Swing(1) => {
                let sole = reference.world_from_soles[Side::Left as usize];
                let ankle = sole * Point3::new(0.0, 0.0, 0.09);
                let expected = 0.05 * (1.0 + (PI / 0.16 * (ankle.x - 0.16)).cos());
                assert!((ankle.z - 0.09 - expected).abs() < 1e-12, "{sample}");
                let pitch = sole.rotation.scaled_axis();
                assert!((pitch.y - PI / 9.0 * expected / 0.1).abs() < 1e-12 && pitch.xz().norm() < 1e-12);
                highest = highest.max(expected);
                swings.push(height);
            }
            Action::Lower | Action::Rise => {}
            _ => assert!(height <= crouch + 1e-12 && height >= crouch - 0.008 - 1e-12),
        }
    }
    assert!(highest > 0.0995);
    let (first, last) = (swings[0], swings[swings.len() - 1]);
    let top = swings.iter().copied().fold(0.0, f64::max);
    assert!((last - (crouch - 0.008)).abs() < 1e-12 && first < crouch - 0.0079 && top > crouch - 1e-4);
}
