//! Screws as axis, pitch and magnitude, compared with rotations, translations, forces and couples.

use groebot_robot::ErrorKind;
use groebot_robot::spatial::{Axis, ScrewCoordinates};
use nalgebra::{Point3, Translation3, Vector3};
use proptest::prelude::*;

use super::{axis, vector};

fn screw() -> impl Strategy<Value = ScrewCoordinates> {
    let pitch = prop_oneof![Just(0.0), Just(f64::INFINITY), -2.0..2.0_f64];
    (axis(), pitch, 0.1..3.0_f64)
        .prop_map(|(axis, pitch, magnitude)| ScrewCoordinates::new(axis, pitch, magnitude).unwrap())
}

/// Whether two directed lines are equal. Those of pure translations and couples have no position.
fn same_line(a: &Axis, b: &Axis, has_place: bool) -> bool {
    let parallel = (a.direction().into_inner() - b.direction().into_inner()).norm() < 1e-12;
    parallel && (!has_place || a.distance_to(&b.point()) < 1e-12)
}

fn assert_same(found: &ScrewCoordinates, screw: &ScrewCoordinates) {
    assert!(same_line(&found.axis(), &screw.axis(), screw.pitch().is_finite()), "{found:?} is not {screw:?}");
    assert!((found.magnitude() - screw.magnitude()).abs() < 1e-14);
    assert!(found.pitch() == screw.pitch() || (found.pitch() - screw.pitch()).abs() < 1e-12);
}

#[test]
fn pitch_and_magnitude_are_checked() {
    let axis = Axis::new(Vector3::x(), Point3::origin()).unwrap();
    for (pitch, magnitude) in [(f64::NAN, 1.0), (f64::NEG_INFINITY, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
        assert_eq!(ScrewCoordinates::new(axis, pitch, magnitude).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn a_screw_turns_about_its_axis_and_advances_along_it(screw in screw(), p in vector(2.0)) {
        let (axis, magnitude) = (screw.axis(), screw.magnitude());
        let advance = if screw.pitch().is_finite() { screw.pitch() * magnitude } else { magnitude };
        let turned = if screw.pitch().is_finite() { axis.rotate(magnitude, &p.into()) } else { p.into() };
        let expected = Translation3::from(axis.direction().scale(advance)) * turned;
        prop_assert!((screw.twist().exp(1.0) * Point3::from(p) - expected).norm() < 1e-13);
    }

    #[test]
    fn a_screw_is_a_force_along_its_axis_and_a_couple_about_it(screw in screw(), about in vector(2.0)) {
        let (wrench, n) = (screw.wrench(), screw.axis().direction().into_inner());
        let (force, couple) = match screw.pitch() {
            pitch if pitch.is_finite() => (n * screw.magnitude(), n * (screw.magnitude() * pitch)),
            _ => (Vector3::zeros(), n * screw.magnitude()),
        };
        prop_assert!((wrench.f - force).norm() < 1e-14);
        let torque_about = wrench.tau - about.cross(&wrench.f);
        let lever = screw.axis().point().coords - about;
        prop_assert!((torque_about - lever.cross(&force) - couple).norm() < 1e-12);
    }

    #[test]
    fn twists_and_wrenches_keep_their_screw(screw in screw()) {
        assert_same(&ScrewCoordinates::of_twist(&screw.twist()).unwrap(), &screw);
        assert_same(&ScrewCoordinates::of_wrench(&screw.wrench()).unwrap(), &screw);
    }

    #[test]
    fn a_negative_magnitude_is_the_opposite_direction(screw in screw()) {
        let back = ScrewCoordinates::new(screw.axis(), screw.pitch(), -screw.magnitude()).unwrap();
        prop_assert_eq!(back.twist(), -screw.twist());
        let found = ScrewCoordinates::of_twist(&back.twist()).unwrap();
        prop_assert!(found.magnitude() > 0.0 && found.axis().direction().dot(&screw.axis().direction()) < 0.0);
    }
}
