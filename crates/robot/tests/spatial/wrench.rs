//! Wrenches: forces and torques on a rigid body.

use groebot_robot::ErrorKind;
use groebot_robot::spatial::Wrench;
use groebot_robot::spatial::pose::coadjoint;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::{pose, twist, vector};

fn wrench() -> impl Strategy<Value = Wrench> {
    (vector(2.0), vector(2.0)).prop_map(|(f, tau)| Wrench { f, tau })
}

#[test]
fn a_wrench_without_force_and_torque_has_no_axis() {
    let zero = Wrench { f: Vector3::zeros(), tau: Vector3::zeros() };
    assert_eq!(zero.axis().unwrap_err().kind(), ErrorKind::BadValue);
    assert!(zero.axis().unwrap_err().message().starts_with("wrench"));
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn power_does_not_depend_on_the_frame(g in pose(), force in wrench(), x in twist()) {
        let power = force.power(&x);
        prop_assert!((force.transform(&g).power(&x.transform(&g)) - power).abs() < 1e-12);
        let moved = Wrench::from_vector(&(coadjoint(&g) * force.to_vector()));
        prop_assert!((moved.to_vector() - force.transform(&g).to_vector()).norm() < 1e-13);
        prop_assert!((force.to_vector().dot(&x.to_vector()) - power).abs() < 1e-13);
    }

    #[test]
    fn a_force_at_a_point_stays_that_force_at_that_point(g in pose(), f in vector(2.0), p in vector(2.0)) {
        let moved = Wrench { f, tau: p.cross(&f) }.transform(&g);
        let (f, p) = (g.rotation * f, (g * Point3::from(p)).coords);
        prop_assert!((moved.f - f).norm() < 1e-13 && (moved.tau - p.cross(&f)).norm() < 1e-12);
    }

    #[test]
    fn the_power_on_a_point_is_force_times_velocity(f in vector(2.0), p in vector(2.0), x in twist()) {
        let power = Wrench { f, tau: p.cross(&f) }.power(&x);
        prop_assert!((power - f.dot(&(x.v + x.w.cross(&p)))).abs() < 1e-12);
    }

    #[test]
    fn about_its_axis_a_wrench_twists_along_it_only(force in wrench(), along in -3.0..3.0_f64) {
        let axis = force.axis().unwrap();
        let q = axis.point() + axis.direction().scale(along);
        prop_assert!((force.tau - q.coords.cross(&force.f) - force.f * force.pitch()).norm() < 1e-12);
    }

    #[test]
    fn the_direction_of_a_wrench_is_that_of_its_force(force in wrench()) {
        prop_assert!((force.axis().unwrap().direction().scale(force.f.norm()) - force.f).norm() < 1e-14);
        let couple = Wrench { f: Vector3::zeros(), ..force };
        prop_assert!((couple.axis().unwrap().direction().scale(force.tau.norm()) - force.tau).norm() < 1e-14);
    }

    #[test]
    fn the_point_of_a_wrench_is_nearest_to_the_origin(force in wrench()) {
        let q = force.axis().unwrap().point().coords;
        prop_assert!(q.dot(&force.f).abs() < 1e-13 * (1.0 + q.norm()));
        let couple = Wrench { f: Vector3::zeros(), ..force };
        prop_assert_eq!(couple.axis().unwrap().point(), Point3::origin());
    }

    #[test]
    fn the_magnitude_of_a_wrench_is_its_force_or_else_its_torque(force in wrench()) {
        prop_assert!((force.magnitude() - force.f.norm()).abs() < 1e-14);
        let couple = Wrench { f: Vector3::zeros(), ..force };
        prop_assert!((couple.magnitude() - force.tau.norm()).abs() < 1e-14);
    }

    #[test]
    fn the_pitch_of_a_wrench_is_its_torque_per_force(f in vector(2.0), q in vector(2.0), pitch in -3.0..3.0_f64) {
        prop_assume!(f.norm() > 0.1);
        let force = Wrench { f, tau: q.cross(&f) + f * pitch };
        prop_assert!((force.pitch() - pitch).abs() < 1e-12);
        prop_assert_eq!(Wrench { f: Vector3::zeros(), ..force }.pitch(), f64::INFINITY);
    }
}
