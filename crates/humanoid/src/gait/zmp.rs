//! The zero moment point (ZMP; Vukobratovic and Stepanenko 1972), NAO 6.4: the point on the floor at which inertia and
//! gravity have no horizontal moment.
//!
//! The momentum between two samples is that of the multibody at the mean of their joint values. The pose of the base is
//! the middle of its screw motion, and the rates are those between the samples. The difference of two consecutive momenta gives the rate of change
//! at the sample between them. These are central differences over three samples, exact to the second order in the time
//! step.

use nalgebra::{Point2, Point3, Vector3};

use crate::Result;
use groebot_robot::dynamics::{Model, Momentum};
use groebot_robot::spatial::{Pose, pose};

/// Standard gravity \[m/s^2\].
pub const GRAVITY: f64 = 9.80665;

/// A configuration of a robot with a free base.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'q> {
    /// The pose of the base in the world.
    pub world_from_base: &'q Pose,
    /// The joint values.
    pub q: &'q [f64],
}

/// The momentum during the motion from one configuration to another in `time` \[s\].
///
/// # Errors
/// [`crate::ErrorKind::BadValue`] when a configuration does not have one finite value per joint.
pub fn momentum_between(body: &Model, from: Configuration<'_>, to: Configuration<'_>, time: f64) -> Result<Momentum> {
    let motion = to.world_from_base * from.world_from_base.inverse();
    let twist = pose::log(&motion) * (1.0 / time);
    let middle = twist.exp(time / 2.0) * from.world_from_base;
    let mean: Vec<f64> = from.q.iter().zip(to.q).map(|(a, b)| (a + b) / 2.0).collect();
    let rates: Vec<f64> = from.q.iter().zip(to.q).map(|(a, b)| (b - a) / time).collect();
    body.place(&middle, &mean)?.momentum(&twist, &rates)
}

/// The zero moment point of a system of mass `mass` \[kg\] with its centre at `centre` \[m\] while its momentum changes
/// at `rate` (\[N\], \[N m\] about the origin). `None` when no force presses it to the floor.
pub fn zero_moment_point(mass: f64, centre: &Point3<f64>, rate: &Momentum) -> Option<Point2<f64>> {
    let weight = Vector3::new(0.0, 0.0, mass * GRAVITY);
    let force = rate.linear + weight;
    let moment = rate.angular + centre.coords.cross(&weight);
    (force.z > 0.0).then(|| Point2::new(-moment.y / force.z, moment.x / force.z))
}

/// The zero moment point of the linear inverted pendulum (Kajita and others 2001): a mass at the height of `centre`
/// \[m\] whose acceleration \[m/s^2\] is horizontal.
pub fn of_pendulum(centre: &Point3<f64>, acceleration: &Vector3<f64>) -> Point2<f64> {
    let share = centre.z / GRAVITY;
    Point2::new(centre.x - share * acceleration.x, centre.y - share * acceleration.y)
}
