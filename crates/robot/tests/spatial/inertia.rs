//! The inertia of one body.

use groebot_robot::ErrorKind;
use groebot_robot::spatial::Inertia;
use nalgebra::{Matrix3, Matrix6, Point3, Vector3};
use proptest::prelude::*;

use crate::dynamics::cloud;
use crate::spatial::{direction, twist};

#[test]
fn bodies_that_cannot_be_are_refused() {
    let (centre, ball) = (Point3::origin(), Matrix3::identity());
    let refused = |mass, centre, tensor| Inertia::new(mass, centre, tensor).unwrap_err().kind() == ErrorKind::BadValue;
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(mass, centre, ball), "mass {mass}");
    }
    assert!(refused(1.0, Point3::new(f64::NAN, 0.0, 0.0), ball));
    assert!(refused(1.0, centre, ball * f64::NAN) && refused(1.0, centre, -ball));
    assert!(refused(1.0, centre, Matrix3::new(1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)), "not symmetric");
    assert!(refused(1.0, centre, Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.1))), "too long for its width");
    assert!(refused(1.0, centre, Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -0.1))), "negative");
}

#[test]
fn points_rods_and_plates_are_bodies() {
    for moments in [[0.0; 3], [1.0, 1.0, 0.0], [1.0, 2.0, 3.0], [1e-30, 1e-30, 2e-30], [0.1, 0.2, 0.1 + 0.2]] {
        let tensor = Matrix3::from_diagonal(&Vector3::from(moments));
        assert!(Inertia::new(2.0, Point3::origin(), tensor).is_ok(), "{moments:?}");
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn the_generalised_inertia_gives_the_kinetic_energy(cloud in cloud(), x in twist()) {
        let velocity = |place: &Vector3<f64>| x.v + x.w.cross(place);
        let energy: f64 = cloud.0.iter().map(|(mass, place)| velocity(place).norm_squared() * mass / 2.0).sum();
        let found = x.to_vector().dot(&(cloud.inertia().generalised() * x.to_vector())) / 2.0;
        prop_assert!((found - energy).abs() < 1e-13 * (1.0 + energy));
    }

    #[test]
    fn at_the_centre_of_mass_it_is_the_mass_above_the_tensor(cloud in cloud()) {
        let mut expected = Matrix6::identity() * cloud.mass();
        expected.fixed_view_mut::<3, 3>(3, 3).copy_from(&cloud.tensor());
        let inertia = Inertia::new(cloud.mass(), Point3::origin(), cloud.tensor()).unwrap();
        prop_assert!((inertia.generalised() - expected).norm() < 1e-14);
        prop_assert_eq!(inertia.mass(), cloud.mass());
        prop_assert!((cloud.inertia().centre_of_mass().coords - cloud.centre()).norm() == 0.0);
        prop_assert!((cloud.inertia().rotational() - cloud.tensor()).norm() < 1e-15);
    }

    #[test]
    fn principal_moments_obey_the_triangle(w in direction(), a in 0.0..2.0_f64, b in 0.0..2.0_f64, c in 0.0..4.0_f64) {
        let turn = groebot_robot::spatial::rotation::exp(&w).to_rotation_matrix().into_inner();
        let tensor = turn * Matrix3::from_diagonal(&Vector3::new(a, b, c)) * turn.transpose();
        let excess = (c - a - b).max(a - b - c).max(b - a - c) / (a + b + c);
        prop_assume!(!(-1e-6..=3e-4).contains(&excess));
        prop_assert_eq!(Inertia::new(1.0, Point3::origin(), tensor).is_ok(), excess < 0.0);
    }
}
