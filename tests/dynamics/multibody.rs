//! A tree of bodies on a free base, against points whose places are differentiated.

use groebot::ErrorKind;
use groebot::dynamics::{Body, Limb, LinkInertia, Multibody};
use groebot::robots;
use groebot::spatial::{Pose, Screw, Twist};
use nalgebra::{DVector, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// Four points with masses, a rigid body of which inertia and centre are known by their definition.
const CLOUD: [(f64, [f64; 3]); 4] =
    [(0.4, [0.1, 0.0, 0.02]), (0.3, [-0.05, 0.08, 0.0]), (0.2, [0.0, -0.03, 0.11]), (0.5, [0.04, 0.05, -0.06])];

fn body(at: Vector3<f64>) -> Body {
    let mass: f64 = CLOUD.iter().map(|(mass, _)| mass).sum();
    let centre = CLOUD.iter().map(|(mass, p)| Vector3::from(*p) * *mass).sum::<Vector3<f64>>() / mass;
    let inertia = CLOUD.iter().fold(Matrix3::zeros(), |sum, (mass, p)| {
        let r = Vector3::from(*p) - centre;
        sum + (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *mass
    });
    let base_from_link = Pose::from_parts(at.into(), UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.2, 0.5)));
    Body { base_from_link, inertia: LinkInertia::new(mass, Point3::from(centre), inertia).unwrap() }
}

/// A base with two limbs, one of two joints.
fn tree() -> Multibody {
    let limb = |parent, axis: [f64; 3], at: [f64; 3]| Limb {
        parent,
        screw: Screw::revolute(Vector3::from(axis), Point3::from(at)).unwrap(),
        body: body(Vector3::from(at)),
    };
    let limbs = vec![
        limb(None, [0.0, 1.0, -1.0], [0.0, 0.1, -0.1]),
        limb(Some(0), [1.0, 0.0, 0.2], [0.0, 0.1, -0.3]),
        limb(None, [0.0, 0.0, 1.0], [0.1, -0.1, 0.2]),
    ];
    Multibody::new(body(Vector3::zeros()), limbs).unwrap()
}

/// The places and masses of all points.
fn points(tree: &Multibody, base: &Pose, q: &[f64]) -> Vec<(f64, Vector3<f64>)> {
    let placed = tree.place(base, q).unwrap();
    let frames = (0..tree.limbs().len()).map(|link| placed.world_from_link(link));
    let frames = [base * body(Vector3::zeros()).base_from_link].into_iter().chain(frames);
    frames.flat_map(|frame| CLOUD.map(|(mass, p)| (mass, (frame * Point3::from(p)).coords))).collect()
}

fn pose(numbers: [f64; 6]) -> Pose {
    let [x, y, z, a, b, c] = numbers;
    Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_scaled_axis(Vector3::new(a, b, c)))
}

proptest! {
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
    let whole = robots::nao_v5();
    let humanoid = groebot::gait::Humanoid::new(&whole, Default::default()).unwrap();
    let q: Vec<f64> = (0..whole.links.len()).map(|i| 0.3 * (1.7 * i as f64).sin()).collect();
    let base = pose([0.1, 0.2, 0.3, 0.1, -0.2, 0.4]);
    let placed = humanoid.body.place(&base, &q).unwrap();
    let start = whole.joint("RHipYawPitch").unwrap();
    let expected = base * robots::nao_right_leg().forward(&q[start..start + 6]).unwrap();
    let foot = &humanoid.feet[1];
    let sole = placed.motion(foot.link) * foot.torso_from_sole;
    assert!((sole.to_homogeneous() - expected.to_homogeneous()).amax() < 1e-14);
}

#[test]
fn what_is_no_tree_is_refused() {
    let limb = Limb { parent: Some(0), screw: Screw::prismatic(Vector3::x()).unwrap(), body: body(Vector3::zeros()) };
    let base = body(Vector3::zeros());
    assert_eq!(Multibody::new(base, vec![limb]).unwrap_err().kind(), ErrorKind::BadValue);
    let nowhere = Body { base_from_link: Pose::translation(f64::NAN, 0.0, 0.0), ..base };
    assert!(Multibody::new(nowhere, vec![]).is_err());
    for q in [&[0.0][..], &[f64::NAN, 0.0, 0.0]] {
        assert!(tree().place(&Pose::identity(), q).is_err());
    }
}
