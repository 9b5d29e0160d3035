//! The desired state at a time ([`Desired`]). A whole motion is a [spline](crate::motion::Spline).

/// The desired configuration, velocity and acceleration.
#[derive(Clone, Copy, Debug)]
pub struct Desired<'a> {
    /// The configuration.
    pub q: &'a [f64],
    /// The velocity.
    pub velocity: &'a [f64],
    /// The acceleration.
    pub acceleration: &'a [f64],
}
