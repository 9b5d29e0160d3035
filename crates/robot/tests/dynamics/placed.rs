//! A tree of bodies on a floating base, compared with numerical differentiation of points.

use groebot_robot::dynamics::Model;
use groebot_robot::robots;
use groebot_robot::spatial::{Inertia, Pose, Screw, Twist};
use nalgebra::{DVector, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::{Part, model};

/// Four point masses: a rigid body whose inertia and centre of mass are known by definition.
const CLOUD: [(f64, [f64; 3]); 4] =
    [(0.4, [0.1, 0.0, 0.02]), (0.3, [-0.05, 0.08, 0.0]), (0.2, [0.0, -0.03, 0.11]), (0.5, [0.04, 0.05, -0.06])];

fn inertia() -> Inertia {
    let mass: f64 = CLOUD.iter().map(|(mass, _)| mass).sum();
    let centre = CLOUD.iter().map(|(mass, p)| Vector3::from(*p) * *mass).sum::<Vector3<f64>>() / mass;
    let inertia = CLOUD.iter().fold(Matrix3::zeros(), |sum, (mass, p)| {
        let r = Vector3::from(*p) - centre;
        sum + (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *mass
    });
    Inertia::new(mass, Point3::from(centre), inertia).unwrap()
}

/// The frame of a body.
fn frame(at: Vector3<f64>) -> Pose {
    Pose::from_parts(at.into(), UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.2, 0.5)))
}

/// A base with two limbs. One has two joints, the second of which comes first in the list.
fn parts() -> [Part; 3] {
    let part = |parent, axis: [f64; 3], at: [f64; 3]| Part {
        parent,
        screw: Screw::revolute(Vector3::from(axis), Point3::from(at)).unwrap(),
        base_from_link: frame(Vector3::from(at)),
        inertia: inertia(),
    };
    [
        part(Some(1), [1.0, 0.0, 0.2], [0.0, 0.1, -0.3]),
        part(None, [0.0, 1.0, -1.0], [0.0, 0.1, -0.1]),
        part(None, [0.0, 0.0, 1.0], [0.1, -0.1, 0.2]),
    ]
}

fn tree() -> Model {
    model(Some(&inertia()), &parts())
}

/// The positions and masses of all points.
fn points(tree: &Model, base: &Pose, q: &[f64]) -> Vec<(f64, Vector3<f64>)> {
    let placed = tree.place(base, q).unwrap();
    let frames = parts().into_iter().enumerate().map(|(body, part)| placed.motion(body + 1) * part.base_from_link);
    let frames = [*base].into_iter().chain(frames);
    frames.flat_map(|frame| CLOUD.map(|(mass, p)| (mass, (frame * Point3::from(p)).coords))).collect()
}

fn pose(numbers: [f64; 6]) -> Pose {
    let [x, y, z, a, b, c] = numbers;
    Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_scaled_axis(Vector3::new(a, b, c)))
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn momentum_is_that_of_the_points(
        at in prop::array::uniform6(-1.0..1.0), twist in prop::array::uniform6(-1.0..1.0),
        q in prop::array::uniform3(-2.0..2.0), rates in prop::array::uniform3(-2.0..2.0),
    ) {
        let (tree, h) = (tree(), 1e-5);
        let twist = Twist { v: Vector3::new(twist[0], twist[1], twist[2]), w: Vector3::new(twist[3], twist[4], twist[5]) };
        let moved = |time: f64| {
            let q: Vec<f64> = q.iter().zip(rates).map(|(q, rate)| q + rate * time).collect();
            points(&tree, &(twist.exp(time) * pose(at)), &q)
        };
        let (before, after, now) = (moved(-h), moved(h), points(&tree, &pose(at), &q));
        let (mut linear, mut angular, mut moment) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        for ((a, b), (mass, p)) in before.iter().zip(&after).zip(&now) {
            let part = (b.1 - a.1) / (2.0 * h) * *mass;
            linear += part;
            angular += p.cross(&part);
            moment += p * *mass;
        }
        let placed = tree.place(&pose(at), &q).unwrap();
        let momentum = placed.momentum(&twist, &rates).unwrap();
        prop_assert!((momentum.linear - linear).norm() < 1e-8);
        prop_assert!((momentum.angular - angular).norm() < 1e-8);
        let centre = placed.centre_of_mass();
        prop_assert!((centre.coords - moment / tree.mass()).norm() < 1e-13);
        let about = angular - centre.coords.cross(&linear);
        prop_assert!((momentum.about(&centre) - about).norm() < 1e-8);
        let rates: Vec<f64> = twist.to_vector().iter().copied().chain(rates).collect();
        let velocity = placed.centre_of_mass_jacobian() * DVector::from_vec(rates);
        prop_assert!((velocity - linear / tree.mass()).norm() < 1e-9);
    }
}

#[test]
fn a_link_is_where_its_chain_puts_it() {
    let robot = robots::nao_v5();
    let model = Model::new(&robot).unwrap();
    let q: Vec<f64> = (0..model.joints().len()).map(|i| 0.3 * (1.7 * i as f64).sin()).collect();
    let base = pose([0.1, 0.2, 0.3, 0.1, -0.2, 0.4]);
    let placed = model.place(&base, &q).unwrap();
    let start = model.joint("RHipYawPitch").unwrap();
    let expected = base * robots::nao_right_leg().forward(&q[start..start + 6]).unwrap();
    let sole = placed.world_from_link(robot.link("r_sole").unwrap());
    assert!((sole.to_homogeneous() - expected.to_homogeneous()).amax() < 1e-14);
}

#[test]
fn values_are_checked() {
    for q in [&[0.0][..], &[f64::NAN, 0.0, 0.0]] {
        assert!(tree().place(&Pose::identity(), q).is_err());
        let tree = tree();
        assert!(
            tree.place(&Pose::identity(), &[0.0; 3])
                .unwrap()
                .momentum(&Twist::from_vector(&Default::default()), q)
                .is_err()
        );
    }
}
