//! Lines and spheres, and the axes of twists.

use groebot_robot::spatial::intersection::{of_line_and_sphere, of_twists};
use groebot_robot::spatial::{Axis, ScrewCoordinates, Twist};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::{axis, direction, vector};

fn screw(direction: Vector3<f64>, point: Point3<f64>, pitch: f64) -> Twist {
    ScrewCoordinates::new(Axis::new(direction, point).unwrap(), pitch, 1.5).unwrap().twist()
}

#[test]
fn bad_spheres_are_not_met() {
    let line = Axis::new(Vector3::x(), Point3::origin()).unwrap();
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(of_line_and_sphere(&line, &Point3::origin(), radius, 0.0), None);
    }
    assert_eq!(of_line_and_sphere(&line, &Point3::new(f64::NAN, 0.0, 0.0), 1.0, 0.0), None);
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn a_line_meets_a_sphere_in_two_points_of_both(line in axis(), centre in vector(2.0), radius in 0.0..4.0_f64) {
        let centre = Point3::from(centre);
        match of_line_and_sphere(&line, &centre, radius, 0.0) {
            Some([a, b]) => {
                for p in [a, b] {
                    prop_assert!(line.distance_to(&p) < 1e-13);
                    let grazing = ((p - centre).norm() - radius).abs();
                    prop_assert!(grazing < 1e-13);
                }
                prop_assert!((b - a).dot(&line.direction()) >= 0.0);
            }
            None => prop_assert!(line.distance_to(&centre) > radius),
        }
        prop_assert_eq!(of_line_and_sphere(&line, &centre, radius, 0.0).is_some(), line.distance_to(&centre) <= radius);
    }

    #[test]
    fn a_point_of_the_line_is_found_again(line in axis(), centre in vector(2.0), along in -2.0..2.0_f64) {
        let p = line.point() + line.direction().scale(along);
        let radius = (p - Point3::from(centre)).norm();
        let ends = of_line_and_sphere(&line, &centre.into(), radius, 1e-12).unwrap();
        let chord = (ends[1] - ends[0]).norm();
        let off = ends.map(|end| (end - p).norm());
        prop_assert!(off[0].min(off[1]) < 1e-13 / chord.max(1e-7), "{off:?}");
    }

    #[test]
    fn a_line_that_passes_closely_touches(line in axis(), centre in vector(2.0), gap in 1e-9..1.0_f64) {
        let centre = Point3::from(centre);
        let distance = line.distance_to(&centre);
        prop_assume!(distance > 2.0 * gap);
        prop_assert_eq!(of_line_and_sphere(&line, &centre, distance - gap, 0.9 * gap), None);
        let [a, b] = of_line_and_sphere(&line, &centre, distance - gap, 1.1 * gap).unwrap();
        prop_assert_eq!(a, b);
        prop_assert!((a - line.foot(&centre)).norm() < 1e-14);
    }

    #[test]
    fn axes_through_one_point_meet_there(
        a in direction(), b in direction(), p in vector(2.0), h in -1.0..1.0_f64, k in -1.0..1.0_f64,
    ) {
        let sine = a.normalize().cross(&b.normalize()).norm();
        prop_assume!(sine > 0.01);
        let p = Point3::from(p);
        let found = of_twists(&screw(a, p, h), &screw(b, p, k), 1e-12);
        prop_assert!((found.expect("they meet") - p).norm() < 1e-13 / sine);
    }

    #[test]
    fn axes_that_do_not_meet_in_one_point_have_none(
        a in direction(), b in direction(), p in vector(2.0), gap in 1e-6..1.0_f64,
    ) {
        let normal = a.normalize().cross(&b.normalize());
        prop_assume!(normal.norm() > 0.01);
        let p = Point3::from(p);
        let beside = p + normal.normalize() * gap;
        prop_assert_eq!(of_twists(&screw(a, p, 0.0), &screw(b, beside, 0.0), 1e-9), None, "skew");
        prop_assert_eq!(of_twists(&screw(a, p, 0.0), &screw(-a, beside, 0.0), 1e-9), None, "parallel");
        prop_assert_eq!(of_twists(&screw(a, p, 0.0), &screw(a, p, 0.0), 1e-9), None, "the same");
        prop_assert_eq!(of_twists(&screw(a, p, 0.0), &screw(b, p, f64::INFINITY), 1e-9), None, "a translation");
        let towards_it = screw(p.coords + Vector3::z() * 1e-30, p, f64::INFINITY);
        prop_assert_eq!(of_twists(&screw(a, p, 0.0), &towards_it, 1e-9), None, "a translation has no place");
        prop_assert_eq!(of_twists(&screw(a, p, 0.0), &Twist::zero(), 1e-9), None);
    }
}
