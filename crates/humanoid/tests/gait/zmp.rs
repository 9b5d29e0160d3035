//! Zero moment points (ZMP) of motions with known closed-form dynamics.

use std::f64::consts::TAU;

use groebot_humanoid::gait::{Configuration, GRAVITY, momentum_between, of_pendulum, zero_moment_point};
use groebot_robot::dynamics::{Model, Momentum};
use groebot_robot::spatial::{Inertia, Pose, Screw};
use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

use crate::dynamics_parts::{Part, model};

/// A ball on a stick, with a wheel about y at its centre.
fn wheel() -> Model {
    let inertia = |mass, moment| Inertia::new(mass, Point3::origin(), Matrix3::identity() * moment).unwrap();
    let screw = Screw::revolute(Vector3::y(), Point3::origin()).unwrap();
    let wheel = Part { parent: None, screw, base_from_link: Pose::identity(), inertia: inertia(1.0, 0.02) };
    model(Some(&inertia(2.0, 0.01)), &[wheel])
}

/// The zero moment point at time 0, for poses and joint values as functions of time.
fn zmp(body: &Model, tick: f64, at: impl Fn(f64) -> (Pose, f64)) -> nalgebra::Point2<f64> {
    let [before, now, after] = [-tick, 0.0, tick].map(&at);
    let between = |a: &(Pose, f64), b: &(Pose, f64)| {
        let [a, b] = [a, b].map(|(pose, q)| (pose, [*q]));
        let [a, b] = [&a, &b].map(|(pose, q)| Configuration { world_from_base: pose, q });
        momentum_between(body, a, b, tick).unwrap()
    };
    let (first, second) = (between(&before, &now), between(&now, &after));
    let rate =
        Momentum { linear: (second.linear - first.linear) / tick, angular: (second.angular - first.angular) / tick };
    let centre = body.place(&now.0, &[now.1]).unwrap().centre_of_mass();
    zero_moment_point(body.mass(), &centre, &rate).unwrap()
}

#[test]
fn who_stands_still_has_it_below_the_centre_of_mass() {
    let at = |_| (Pose::translation(0.1, -0.2, 0.3), 0.4);
    let point = zmp(&wheel(), 0.01, at);
    assert!((point - nalgebra::Point2::new(0.1, -0.2)).norm() < 1e-15);
}

/// x = a sin(w t + p): the zero moment point of the pendulum is x - h/g x'' = (1 + h w^2 / g) x.
#[test]
fn a_swinging_mass_has_that_of_the_pendulum() {
    let (a, w, p, h) = (0.05, TAU * 0.8, 0.7_f64, 0.3);
    let at = |time: f64| (Pose::translation(0.2, a * (w * time + p).sin(), h), 0.0);
    let expected = (1.0 + h * w * w / GRAVITY) * a * p.sin();
    let error = |tick: f64| (zmp(&wheel(), tick, at).y - expected).abs();
    // The relative error of the second difference of a sine is w^2 tick^2 / 12.
    let share = (w * 0.01_f64).powi(2) / 12.0;
    assert!(error(0.01) < 1.1 * share * expected && error(0.01) > 0.5 * share * expected * 0.5, "{}", error(0.01));
    assert!((error(0.01) / error(0.005) - 4.0).abs() < 0.05, "second order");
    let acceleration = Vector3::new(0.0, -w * w * a * p.sin(), 0.0);
    let pendulum = of_pendulum(&Point3::new(0.2, a * p.sin(), h), &acceleration);
    assert!((pendulum.y - expected).abs() < 1e-15 && pendulum.x == 0.2);
}

/// A wheel of inertia I about y with the angular acceleration b needs the moment I b: the ZMP moves back by I b / (m g).
#[test]
fn a_wheel_that_speeds_up_moves_it() {
    let b = 30.0;
    let point = zmp(&wheel(), 0.01, |time| (Pose::translation(0.0, 0.0, 0.3), 0.5 * b * time * time));
    let expected = -0.02 * b / (3.0 * GRAVITY);
    assert!((point.x - expected).abs() < 1e-12 && point.y.abs() < 1e-15, "{}", point.x);
}

/// A base that rotates about y with its wheel: the moment is that of both inertias.
#[test]
fn a_turning_base_carries_its_links() {
    let b = 4.0;
    let at = |time: f64| {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::y() * (0.5 * b * time * time));
        (Pose::from_parts(Vector3::new(0.0, 0.0, 0.3).into(), turn), 0.0)
    };
    let point = zmp(&wheel(), 0.01, at);
    assert!((point.x + (0.01 + 0.02) * b / (3.0 * GRAVITY)).abs() < 1e-9, "{}", point.x);
}

#[test]
fn who_falls_freely_has_none() {
    let rate = Momentum { linear: Vector3::new(0.0, 0.0, -3.0 * GRAVITY), angular: Vector3::zeros() };
    assert_eq!(zero_moment_point(3.0, &Point3::new(0.0, 0.0, 1.0), &rate), None);
}
