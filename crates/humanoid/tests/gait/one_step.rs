//! One step goal for any humanoid, RH0 3.3; walks given in words and walks to a goal.

use groebot_humanoid::gait::{
    Action, GaitDefaults, Measures, Route, Side, StepCommand, Summary, Walk, plan_at, step_commands,
};
use groebot_humanoid::walkers::{NAO_ONE_STEP, RH0_GENERIC, TEO_ONE_STEP};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;
use proptest::prelude::*;

const MEASURES: Measures = Measures { length: 0.16, half_width: 0.112, most_turn: 0.2 };

fn walk(walker: &str, defaults: &GaitDefaults, goal: (f64, f64)) -> Walk {
    let (robot, legs) = super::built(walker);
    let measures = Measures { length: defaults.length, half_width: robot.half_width(), most_turn: defaults.most_turn };
    let route = Route::towards(&Point2::new(goal.0, goal.1), None, Side::Left, &measures).unwrap();
    let defaults = defaults.clone().from_upright(&robot);
    let request = |height, _| Ok(defaults.request(&robot, route.clone(), height));
    let walk = plan_at((&robot, &legs), None, &defaults.hip_heights, request, &Watch::none()).unwrap();
    let arrived = walk.schedule.route.rests.last().unwrap().point();
    assert!((arrived - Point2::new(goal.0, goal.1)).norm() < 1e-3, "{arrived}");
    for balance in &walk.balances {
        assert!(balance.support.signed_distance(&balance.zmp) >= defaults.margin);
    }
    feet_are_on_their_prints(&robot, &walk);
    walk
}

/// Checks the footprints by forward kinematics of the whole robot.
pub fn feet_are_on_their_prints(robot: &groebot_humanoid::gait::Biped, walk: &Walk) {
    for (sample, reference) in walk.references.iter().enumerate() {
        let posture = &walk.motion.postures[sample];
        let placed = robot.model.place(&posture.world_from_torso, &posture.q).unwrap();
        for (foot, sole) in robot.feet.iter().zip(&reference.world_from_soles) {
            let reached = placed.motion(foot.body) * foot.torso_from_sole;
            let miss = (reached.to_homogeneous() - sole.to_homogeneous()).amax();
            assert!(miss < 1e-9, "{sample}: {miss}");
        }
    }
}

#[test]
fn three_robots_step_towards_a_goal() {
    for (walker, defaults, goal) in [
        ("nao", NAO_ONE_STEP, (0.2, 0.1)),
        ("rh0", RH0_GENERIC, (0.6, -0.3)),
        ("teo", TEO_ONE_STEP, (0.5, 0.2)),
        ("teo", TEO_ONE_STEP, (0.3, 0.0)),
    ] {
        let walk = walk(walker, &defaults, goal);
        let (robot, _) = super::built(walker);
        let summary = Summary::of(&robot, &walk);
        assert_eq!(summary.is_point_mass, walker == "rh0", "{summary}");
        assert!(summary.margin.value >= defaults.margin && summary.fastest.1.value <= defaults.speed_share);
    }
}

/// RH0 3.3.2: while a foot swings, the centre of mass is on the circle about the middle of the supporting sole, on the line to the swing foot. Each step starts
/// and ends half-way between the feet. The key points are the ends of the phases.
#[test]
fn the_centre_of_mass_keeps_to_the_circle() {
    let walk = walk("rh0", &RH0_GENERIC, (0.6, -0.3));
    let radius = walk.request.style.half_width - walk.request.style.amplitude;
    assert!((radius - 0.06).abs() < 1e-15, "RA_AS");
    let mut swings = 0;
    for (sample, reference) in walk.references.iter().enumerate() {
        let Action::Swing(step) = walk.schedule.phases[reference.phase].action else { continue };
        let moving = walk.schedule.route.steps[step].side;
        let middle = |side: Side| reference.world_from_soles[side as usize].translation.vector.xy();
        let (fixed, other) = (middle(moving.other()), middle(moving));
        let out = walk.motion.centres[sample].xy().coords - fixed;
        assert!((out.norm() - radius).abs() < 1e-6, "{sample}");
        assert!(out.perp(&(other - fixed)).abs() < 1e-6 && out.dot(&(other - fixed)) > 0.0, "{sample}");
        swings += 1;
    }
    assert!(swings > 100);
    let mut sample = 0;
    for phase in &walk.schedule.phases {
        sample += phase.samples;
        if let Action::Balance(step) = phase.action {
            let at = walk.motion.centres[sample];
            let feet = walk.schedule.route.stands()[step + 1];
            assert!((at.xy() - feet[0].middle(&feet[1]).point()).norm() < 1e-6, "q_CM5 is half-way between the feet");
        }
    }
}

#[test]
fn words_are_read_and_refused() {
    let read = step_commands("out right, stride  left,in right, turn left 90,turn right 7.5").unwrap();
    assert_eq!(read[0], StepCommand::Out(Side::Right));
    assert_eq!((read[3], read[4]), (StepCommand::Turn(90_f64.to_radians()), StepCommand::Turn(-7.5_f64.to_radians())));
    for wrong in ["", "out", "out up", "hop left", "turn left", "turn left -3", "turn left nan", "out left,,in right"] {
        assert_eq!(step_commands(wrong).unwrap_err().kind(), ErrorKind::Syntax, "{wrong}");
    }
    for (wrong, word) in [
        ("stride left", "command 1"),
        ("out right, in right", "command 2"),
        ("out right, out left", "command 2"),
        ("out right, turn left 10", "command 2"),
        ("turn left 1e9", "command 1"),
    ] {
        let error = Route::of_commands(&step_commands(wrong).unwrap(), &MEASURES).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadValue, "{wrong}");
        assert!(error.to_string().contains(word), "{error}");
    }
    assert!(Route::of_commands(&step_commands("out left").unwrap(), &Measures { length: 0.0, ..MEASURES }).is_err());
    assert!(Route::towards(&Point2::new(f64::NAN, 0.0), None, Side::Left, &MEASURES).is_err());
    assert!(Route::towards(&Point2::new(1e5, 0.0), None, Side::Left, &MEASURES).is_err());
}

#[test]
fn half_a_walk_ends_with_one_foot_ahead() {
    let route = Route::of_commands(&step_commands("out left, stride right").unwrap(), &MEASURES).unwrap();
    let [left, right] = route.stands().pop().unwrap();
    assert!((left.x - 0.16).abs() < 1e-12 && (right.x - 0.32).abs() < 1e-12);
    assert!((route.rests[2].x - 0.24).abs() < 1e-12);
}

proptest! {
    #![proptest_config(crate::cases(256))]

    /// A route to a goal ends there with feet side by side. No step turns more than permitted or is longer than one length.
    #[test]
    fn routes_to_a_goal_arrive(x in -2.0..3.0f64, y in -2.0..2.0f64, right: bool) {
        let goal = Point2::new(x, y);
        let first = if right { Side::Right } else { Side::Left };
        let route = Route::towards(&goal, None, first, &MEASURES).unwrap();
        let [left, right] = route.stands().pop().unwrap();
        let between = left.middle(&right);
        prop_assert!((between.point() - goal).norm() < 1e-3);
        prop_assert!((nalgebra::distance(&left.point(), &right.point()) - 0.224).abs() < 1e-9);
        // Half a turn on the spot, the distance, and twice that for the arcs.
        prop_assert!(route.steps.len() < 2 * ((3.15 / 0.2) as usize + (goal.coords.norm() / 0.16) as usize) + 6);
        let mut side = first;
        let mut yaw = 0.0;
        for step in &route.steps {
            prop_assert_eq!(step.side, side);
            prop_assert!((step.print.yaw - yaw).abs() <= 0.2 + 1e-12);
            (side, yaw) = (side.other(), step.print.yaw);
        }
    }
}

/// TEO's right leg is solved as the mirror image of its left one. Its walk is the mirror image of the walk on the other side, except where the manufacturer's
/// table of masses is asymmetric.
#[test]
fn teo_is_solved_on_both_sides() {
    let (robot, legs) = super::built("teo");
    let sole = |side: Side, y: f64, yaw: f64| {
        let at = robot.feet[side as usize].torso_from_sole.translation.vector;
        let turn = nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Vector3::z_axis(), yaw);
        groebot_robot::spatial::Pose::from_parts((at + nalgebra::Vector3::new(0.05, y, 0.06)).into(), turn)
    };
    let left = legs.solutions(Side::Left, &sole(Side::Left, 0.02, 0.1));
    let right = legs.solutions(Side::Right, &sole(Side::Right, -0.02, -0.1));
    assert_eq!((left.len(), right.len()), (8, 8));
    for (a, b) in left.iter().zip(&right) {
        let mirrored = [-a[0], -a[1], a[2], a[3], a[4], -a[5]];
        assert!(mirrored.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12));
    }
    assert!((robot.model.mass() - 55.9).abs() < 1e-3, "the sum of the maker's table");
}
