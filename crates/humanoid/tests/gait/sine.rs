//! The sine gait of NAO 6.8.1.

use std::f64::consts::PI;

use groebot_humanoid::gait::{Action, Regular, Side, Walk, arch, smooth};

use super::{regular, request, robot, walk};

/// The permitted distance of the centre of mass from the law \[m\]: the motion is solved to half of it.
const MICROMETRE: f64 = 1e-6;

/// Samples with the action of their phase.
fn actions(walk: &Walk) -> impl Iterator<Item = (usize, Action)> + '_ {
    walk.references.iter().enumerate().map(|(sample, reference)| (sample, walk.schedule.phases[reference.phase].action))
}

/// "When y reaches 50 mm over the right foot, the left foot begins its swing, and vice versa."
#[test]
fn feet_rest_until_the_centre_of_mass_is_displaced_by_50_mm() {
    let walk = walk(&request(&regular())).unwrap();
    let mut swings = 0;
    for (sample, action) in actions(&walk) {
        let y = walk.motion.centres[sample].y;
        match action {
            Action::Swing(step) => {
                let stance = walk.schedule.route.steps[step].side.other();
                assert!((y - stance.sign() * 0.05).abs() < MICROMETRE, "{sample}: {y}");
                swings += 1;
            }
            _ => {
                assert_eq!(walk.references[sample].stands, [true; 2], "{sample}");
                assert!(walk.references[sample].world_from_soles.iter().all(|sole| sole.translation.z == 0.0));
                assert!(y.abs() <= 0.05 + MICROMETRE);
            }
        }
    }
    assert!(swings > 100);
}

/// (6.8.1): y = A sin(pi x / x_d), with x from -x_d/2 to x_d/2 about the middle of the feet, from the right foot to the left one.
#[test]
fn on_both_feet_the_centre_of_mass_follows_the_sine() {
    let walk = walk(&request(&regular())).unwrap();
    let mut followed = 0;
    for (sample, action) in actions(&walk) {
        let Action::Shift(step @ 1..4) = action else { continue };
        let centre = walk.motion.centres[sample];
        // Before step 1 the feet are at 0 and 40 mm, so that their middle is at 20 mm; and so on.
        let x = centre.x - 0.005 - (0.02 + 0.04 * (step as f64 - 1.0));
        let sign = walk.schedule.route.steps[step].side.other().sign();
        assert!((centre.y - sign * 0.05 * (PI * x / 0.04).sin()).abs() < 5.0 * MICROMETRE, "{sample}: {centre}");
        assert!(x.abs() <= 0.02 + MICROMETRE);
        followed += 1;
    }
    assert!(followed > 200);
}

#[test]
fn feet_are_lifted_and_land_where_they_should() {
    let walk = walk(&request(&regular())).unwrap();
    for (step, footstep) in walk.schedule.route.steps.iter().enumerate() {
        let side = footstep.side as usize;
        let swing: Vec<usize> =
            actions(&walk).filter(|(_, action)| *action == Action::Swing(step)).map(|(s, _)| s).collect();
        let height = |sample: &usize| walk.references[*sample].world_from_soles[side].translation.z;
        let highest = swing.iter().map(height).fold(0.0, f64::max);
        assert!(highest > 0.0199 && highest <= 0.02, "{highest}");
        let landed = &walk.references[swing[swing.len() - 1]];
        let at = landed.world_from_soles[side].translation.vector;
        assert_eq!(at.z, 0.0);
        assert!((at.xy() - footstep.print.point().coords).norm() < 1e-15 && landed.stands[side]);
    }
    let last = walk.schedule.route.stands().pop().unwrap();
    assert!(
        (last[0].x - 0.12).abs() < 1e-12 && (last[1].x - 0.12).abs() < 1e-12,
        "four steps lead three lengths ahead"
    );
}

/// A walk that starts with the right foot is the mirror image of one that starts with the left foot, within NAO's own asymmetry: the manufacturer measured
/// knees, ankles and inertias on both sides.
#[test]
fn left_and_right_are_mirror_images() {
    let (nao, _) = robot();
    let [left, right] = [Side::Left, Side::Right].map(|first| walk(&request(&Regular { first, ..regular() })).unwrap());
    assert_eq!(left.balances.len(), right.balances.len());
    for sample in 0..left.balances.len() {
        let (a, b) = (&left.motion.postures[sample], &right.motion.postures[sample]);
        for (place, joint) in nao.joints.iter().enumerate() {
            let Some(name) = joint.name.strip_prefix('L') else { continue };
            let other = nao.joint(&format!("R{name}")).unwrap();
            let mirrored = if name.ends_with("Roll") || name == "ElbowYaw" { -1.0 } else { 1.0 };
            assert!((a.q[place] - mirrored * b.q[other]).abs() < 1e-6, "{sample} {name}");
        }
        let (a, b) = (&left.balances[sample], &right.balances[sample]);
        assert!((a.zmp.x - b.zmp.x).abs() < 2e-4 && (a.zmp.y + b.zmp.y).abs() < 2e-4, "{sample}: {} {}", a.zmp, b.zmp);
        assert!((a.static_margin - b.static_margin).abs() < 1e-6);
    }
}

/// Velocity and acceleration of the profiles are zero at both ends.
#[test]
fn profiles_start_and_end_in_rest() {
    let h = 1e-3;
    for (profile, ends) in [(smooth as fn(f64) -> f64, [0.0, 1.0]), (arch, [0.0, 0.0])] {
        assert_eq!([profile(0.0), profile(1.0)], ends);
        assert!((profile(h) - ends[0]).abs() < 100.0 * h * h * h, "of third order");
        assert!((profile(1.0 - h) - ends[1]).abs() < 100.0 * h * h * h, "of third order");
    }
    assert_eq!((smooth(0.5), arch(0.5)), (0.5, 1.0));
}

/// At the borders of phases, positions and velocities of joints change no more abruptly than elsewhere.
#[test]
fn joints_move_without_jumps() {
    let walk = walk(&request(&Regular { turn: 0.2, length: 0.02, ..regular() })).unwrap();
    let q = |sample: usize, joint: usize| walk.motion.postures[sample].q[joint];
    let count = walk.motion.postures.len();
    let mut border = 0;
    for phase in &walk.schedule.phases[..walk.schedule.phases.len() - 1] {
        border += phase.samples;
        for joint in 0..24 {
            let rate = |sample: usize| (q(sample + 1, joint) - q(sample, joint)) / 0.01;
            // Third differences of the profiles bound the change at a border, where both sides are at rest.
            assert!(
                rate(border - 1).abs() < 0.05 && rate(border).abs() < 0.05,
                "{border} {joint}: {} {}",
                rate(border - 1),
                rate(border)
            );
        }
    }
    for joint in 0..24 {
        for sample in 1..count - 1 {
            let change = q(sample + 1, joint) - 2.0 * q(sample, joint) + q(sample - 1, joint);
            assert!(change.abs() < 0.015, "{sample} {joint}: {change}");
        }
    }
}
