use groebot_humanoid::gait::{Footprint, Polygon, Side};
use nalgebra::{Point2, Point3};
use proptest::prelude::*;

use super::robot;
use groebot_robot::spatial::Pose;

fn points(list: &[(f64, f64)]) -> Vec<Point2<f64>> {
    list.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
}

#[test]
fn a_square_has_its_corners_and_distances() {
    let square =
        Polygon::hull(&points(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)]));
    assert_eq!(square.corners().len(), 4);
    assert_eq!(square.area(), 4.0);
    let distance = |x, y| square.signed_distance(&Point2::new(x, y));
    assert_eq!((distance(1.0, 1.0), distance(0.5, 1.2)), (1.0, 0.5));
    assert_eq!((distance(3.0, 1.0), distance(5.0, 6.0), distance(2.0, 1.0)), (-1.0, -5.0, 0.0));
}

#[test]
fn segments_points_and_nothing_are_polygons_too() {
    let segment = Polygon::hull(&points(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.0)]));
    assert_eq!(segment.signed_distance(&Point2::new(0.5, 2.0)), -2.0);
    let point = Polygon::hull(&points(&[(1.0, 1.0)]));
    assert_eq!(point.signed_distance(&Point2::new(4.0, 5.0)), -5.0);
    let nothing = Polygon::hull(&points(&[(f64::NAN, 0.0)]));
    assert_eq!(nothing.signed_distance(&Point2::origin()), f64::NEG_INFINITY);
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn a_hull_holds_its_points_and_only_their_mixtures(
        list in prop::collection::vec((-1.0..1.0, -1.0..1.0), 3..20), shares in prop::collection::vec(0.0..1.0f64, 20),
        far in (0.0..std::f64::consts::TAU, 1.5..3.0),
    ) {
        let given = points(&list);
        let hull = Polygon::hull(&given);
        for point in &given {
            prop_assert!(hull.signed_distance(point) >= -1e-12);
        }
        for corner in hull.corners() {
            prop_assert!(given.contains(corner));
        }
        let total: f64 = shares[..given.len()].iter().sum::<f64>() + 1e-9;
        let mixture = given.iter().zip(&shares).map(|(p, share)| p.coords * (share / total)).sum::<nalgebra::Vector2<f64>>();
        if total > 0.1 {
            prop_assert!(hull.signed_distance(&Point2::from(mixture)) >= -1e-8);
        }
        let outside = Point2::new(far.1 * far.0.cos(), far.1 * far.0.sin());
        prop_assert!(hull.signed_distance(&outside) < 0.0);
    }

    #[test]
    fn distance_is_the_least_over_the_border(
        list in prop::collection::vec((-1.0..1.0, -1.0..1.0), 4..12), at in (-2.0..2.0, -2.0..2.0),
    ) {
        let hull = Polygon::hull(&points(&list));
        let at = Point2::new(at.0, at.1);
        let corners = hull.corners();
        let border = (0..corners.len()).flat_map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            (0..=2000).map(move |k| nalgebra::distance(&at, &(a + (b - a) * (f64::from(k) / 2000.0))))
        });
        let least = border.fold(f64::INFINITY, f64::min);
        prop_assert!((hull.signed_distance(&at).abs() - least).abs() < 2e-3);
    }

    #[test]
    fn polygons_that_are_moved_apart_have_the_distance_between(shift in 0.0..1.0f64, along in -0.5..0.5f64) {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let moved = square.map(|(x, y)| (x + 1.0 + shift, y + along));
        let [a, b] = [square, moved].map(|corners| Polygon::hull(&points(&corners)));
        prop_assert!((a.distance_to(&b) - shift).abs() < 1e-12);
        prop_assert_eq!(a.distance_to(&Polygon::hull(&points(&square.map(|(x, y)| (0.5 * x + along, y))))), 0.0);
    }
}

#[test]
fn the_support_of_two_feet_is_the_hull_of_both_soles() {
    let (nao, _) = robot();
    let feet = [
        (Side::Left, Footprint { x: 0.04, y: 0.05, yaw: 0.1 }),
        (Side::Right, Footprint { y: -0.05, ..Default::default() }),
    ];
    let soles = feet.map(|(side, print)| (side, print.at_height(0.0)));
    let both = nao.support(&soles, 1e-6);
    let one = nao.support(&soles[..1], 1e-6);
    assert!((one.area() - 0.15014 * 0.08879).abs() < 1e-12, "the measured sole");
    assert!(both.area() > 2.0 * one.area());
    for (side, print) in feet {
        for corner in nao.sole_at(side, &print).corners() {
            assert!(both.signed_distance(corner) >= -1e-12);
        }
    }
    let toes = Pose::rotation(nalgebra::Vector3::new(0.0, 0.2, 0.0));
    let touching = nao.support(&[(Side::Left, toes)], 1e-6);
    assert_eq!(touching.corners().len(), 2, "a tilted sole stands on its edge");
    let tip = toes * Point3::new(0.09942, 0.05002, 0.0);
    assert!(touching.corners().iter().any(|corner| (corner - tip.xy()).norm() < 1e-12));
}
