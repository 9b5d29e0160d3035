//! Roll, pitch and yaw compared with the three matrices of RobotMan's f(2).

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_robot::spatial::RollPitchYaw;
use groebot_robot::spatial::pose::{orientation, position};
use groebot_robot::spatial::roll_pitch_yaw::{coordinates_of_pose, pose_of_coordinates};
use nalgebra::{Matrix3, UnitQuaternion};
use proptest::prelude::*;

use super::{pose, rotation::small};

/// The product of RobotMan's f(2): gst_rot_x * gst_rot_y * gst_rot_z.
pub fn product(angles: &RollPitchYaw) -> Matrix3<f64> {
    let [(sx, cx), (sy, cy), (sz, cz)] = [angles.roll, angles.pitch, angles.yaw].map(f64::sin_cos);
    Matrix3::new(1.0, 0.0, 0.0, 0.0, cx, -sx, 0.0, sx, cx)
        * Matrix3::new(cy, 0.0, sy, 0.0, 1.0, 0.0, -sy, 0.0, cy)
        * Matrix3::new(cz, -sz, 0.0, sz, cz, 0.0, 0.0, 0.0, 1.0)
}

fn matrix(rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
    rotation.to_rotation_matrix().into_inner()
}

fn angles() -> impl Strategy<Value = RollPitchYaw> {
    let pitch =
        prop_oneof![-FRAC_PI_2..FRAC_PI_2, small().prop_map(|d| FRAC_PI_2 - d), small().prop_map(|d| d - FRAC_PI_2)];
    (-PI..PI, pitch, -PI..PI).prop_map(|(roll, pitch, yaw)| RollPitchYaw { roll, pitch, yaw })
}

proptest! {
    #![proptest_config(crate::cases(2000))]

    #[test]
    fn body_coordinates_are_a_position_and_three_turns(angles in angles(), at in prop::array::uniform3(-2.0..2.0_f64)) {
        let [x, y, z] = at;
        let g = pose_of_coordinates(&[x, y, z, angles.roll, angles.pitch, angles.yaw]);
        prop_assert!((orientation(&g) - product(&angles)).norm() < 2e-15);
        prop_assert_eq!(<[f64; 3]>::from(position(&g)), at);
    }

    #[test]
    fn the_coordinates_of_a_pose_make_it_again(g in pose(), angles in angles()) {
        let again = pose_of_coordinates(&coordinates_of_pose(&g));
        prop_assert!((again.to_homogeneous() - g.to_homogeneous()).norm() < 4e-15);
        let near_the_singularity = angles.rotation();
        let found = RollPitchYaw::of(&near_the_singularity);
        prop_assert!((product(&found) - matrix(&near_the_singularity)).norm() < 4e-15);
        prop_assert!(found.pitch.abs() <= FRAC_PI_2);
    }

    #[test]
    fn away_from_the_singularity_the_angles_are_found(roll in -PI..PI, pitch in -1.5..1.5_f64, yaw in -PI..PI) {
        let found = RollPitchYaw::of(&RollPitchYaw { roll, pitch, yaw }.rotation());
        let off = (found.roll - roll).abs().max((found.pitch - pitch).abs()).max((found.yaw - yaw).abs());
        prop_assert!(off < 1e-13, "off by {:e}", off);
    }

    #[test]
    fn the_other_three_angles_are_the_same_rotation(angles in angles()) {
        let other = angles.other();
        prop_assert!((product(&other) - product(&angles)).norm() < 3e-15);
        prop_assert!([other.roll, other.pitch, other.yaw].iter().all(|angle| -PI < *angle && *angle <= PI));
        prop_assert!(other.pitch.abs() >= FRAC_PI_2 - 1e-15);
    }

    #[test]
    fn at_the_singularity_roll_is_zero(roll in -PI..PI, yaw in -PI..PI, up in prop::bool::ANY) {
        let angles = RollPitchYaw { roll, pitch: if up { FRAC_PI_2 } else { -FRAC_PI_2 }, yaw };
        let rotation = angles.rotation();
        let found = RollPitchYaw::of(&rotation);
        prop_assert!((product(&found) - matrix(&rotation)).norm() < 4e-15);
        prop_assert!((found.pitch - angles.pitch).abs() < 4e-15);
        prop_assert_eq!(found.roll, 0.0);
        let sum = groebot_robot::spatial::angle::difference(found.yaw, if up { yaw + roll } else { yaw - roll });
        prop_assert!(sum.abs() < 1e-14);
    }

    #[test]
    fn the_usual_order_is_the_inverse_of_the_opposite_turns(angles in angles()) {
        let usual = UnitQuaternion::from_euler_angles(-angles.roll, -angles.pitch, -angles.yaw);
        prop_assert!((matrix(&usual.inverse()) - product(&angles)).norm() < 3e-15);
    }
}
