//! Parts of RH0 3.5 that cannot be walked as printed: the checks for docs/errata.md.

use groebot_humanoid::gait::Side;
use groebot_humanoid::walkers::{Manipulator, Virtual};
use groebot_robot::spatial::Pose;
use nalgebra::{Rotation3, Vector3};

/// The parameters of RH0 5.3.1 \[m\].
const LENGTH: f64 = 0.16;
const HALF_WIDTH: f64 = 0.112;
const RADIUS: f64 = 0.06;
const HEIGHT: f64 = 0.58;
const DIP: f64 = 0.004;

/// Whether a leg reaches the trunk at x (left), y (up), z (forward) when its foot is moved forward by `ahead`.
fn reaches(side: Side, trunk: [f64; 3], ahead: f64) -> bool {
    let half = Manipulator::rh0(side).unwrap();
    let foot: Virtual = [0.0, 0.0, ahead, 0.0, 0.0, 0.0];
    !half.legs(&foot, &Pose::translation(trunk[0], trunk[1], trunk[2])).unwrap().is_empty()
}

/// (3-46), (3-48), (3-50), (3-52), first component, measured outwards from the supporting foot.
fn printed_aside(x: f64) -> f64 {
    RADIUS - (HALF_WIDTH + RADIUS) / LENGTH.powi(4) * x.powi(4)
}

#[test]
fn ten_motors_do_not_turn_an_upright_trunk_over_a_level_foot() {
    // RH0 6.2.2 uses joints 1 to 5 and 12 to 8: a roll, three pitches (of which only the sum matters), and a roll. The result is the greatest heading of a
    // level foot within 40 degrees of roll.
    let turn = |axis: Vector3<f64>, degrees: i32| Rotation3::new(axis * f64::from(degrees).to_radians());
    let (mut level, mut widest) = (0, 0.0_f64);
    for (first, pitch) in (-8..=8).flat_map(|first| (-18..=18).map(move |pitch| (5 * first, 5 * pitch))) {
        for last in (-8..=8).map(|last| 5 * last) {
            let leg = turn(Vector3::x(), first) * turn(Vector3::y(), pitch) * turn(Vector3::x(), last);
            if (leg * Vector3::z() - Vector3::z()).norm() < 1e-9 {
                level += 1;
                widest = widest.max((leg * Vector3::x()).y.abs());
            }
        }
    }
    assert!(level > 0 && widest < 1e-12, "{level} postures, {widest}");
}

#[test]
fn the_printed_lateral_motion_does_not_return_to_the_middle() {
    // The middle is W_p inwards from the supporting foot.
    let end = printed_aside(LENGTH / 2.0);
    assert!((end + HALF_WIDTH).abs() > 0.15 && end > 0.0, "at both ends the trunk is still beyond the foot: {end}");
    // With the whole interval from -1 to 1 in place of x / L_p the leg reaches.
    let repaired = RADIUS - (HALF_WIDTH + RADIUS) * (2.0 * (LENGTH / 2.0) / LENGTH).powi(4);
    assert!((repaired + HALF_WIDTH).abs() < 1e-15);
}

#[test]
fn the_other_foot_does_not_reach_the_printed_apex() {
    // RA_AS outwards from the middle of the left sole, with feet side by side and the trunk at its lowest height by the law.
    assert!(!reaches(Side::Right, [HALF_WIDTH + RADIUS, HEIGHT - DIP, 0.0], 0.0));
    // RA_AS inwards from it, where the circle of support begins, the leg reaches.
    assert!(reaches(Side::Right, [HALF_WIDTH - RADIUS, HEIGHT - DIP, 0.0], 0.0));
}

#[test]
fn the_printed_height_is_greatest_where_it_should_be_least() {
    let printed = |angle: f64| HEIGHT - DIP * angle.cos();
    // cos from 0 to pi between q_CM1 and q_CM2: lift-off.
    assert!(printed(std::f64::consts::PI) > HEIGHT && printed(0.0) < HEIGHT);
    // In a stride the trailing foot is one length behind the supporting one. The trunk is half-way, and RA_AS inwards from the supporting foot.
    let (aside, behind) = (HALF_WIDTH - RADIUS, -LENGTH / 2.0);
    assert!(!reaches(Side::Right, [aside, printed(std::f64::consts::PI), 0.0], behind));
    assert!(reaches(Side::Right, [aside, HEIGHT - 2.0 * DIP, 0.0], behind), "repaired");
}

/// With a constant speed from -L_p/2 to L_p/2 over the whole step, the trunk is more than half a length forward of the trailing foot at lift-off. The leg is
/// too short at the mean height and at the printed one.
#[test]
fn constant_speed_ahead_is_out_of_reach() {
    let share = 17.0 / 81.0;
    let ahead = LENGTH * share;
    let aside = (HALF_WIDTH - RADIUS) * (1.0 - (2.0 * share - 1.0_f64).powi(4));
    for height in [HEIGHT + DIP, HEIGHT, HEIGHT - DIP] {
        assert!(!reaches(Side::Right, [aside, height, 0.0], -LENGTH / 2.0 - ahead), "{height}");
    }
}

/// (3-52), (3-53) rotate by the fifth virtual joint. By (3-10) its axis points forward, and the fourth one is vertical.
#[test]
fn turning_is_the_fourth_virtual_joint() {
    let half = Manipulator::rh0(Side::Right).unwrap();
    let up = |joint: usize| {
        let mut values: Virtual = [0.0; 6];
        values[joint - 1] = 15_f64.to_radians();
        half.foot(&values).rotation * Vector3::y()
    };
    assert!((up(4) - Vector3::y()).norm() < 1e-15);
    assert!((up(5) - Vector3::y()).norm() > 0.2, "the fifth tips the foot over");
}
