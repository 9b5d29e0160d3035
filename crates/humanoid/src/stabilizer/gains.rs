//! The gains of a stabiliser.

/// The gains of a stabiliser. They do not depend on the size of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct StabilizerGains {
    /// The rate at which an error of the DCM decays, as a fraction of the pendulum's rate `w`.
    pub dcm: f64,
    /// The rate at which the integral of the DCM's error acts \[1/s\].
    pub integral: f64,
    /// The bandwidth of the soles' admittance \[rad/s\].
    pub ankle: f64,
    /// The rate at which the torso turns upright \[1/s\].
    pub torso: f64,
    /// The rate at which the torso moves until the centre of mass is where it is planned \[1/s\].
    pub sway: f64,
    /// The bandwidth of the admittance of the feet's heights \[rad/s\]. With 15, a foot of TALOS that lands 3 mm too high
    /// carries weight only after 0.3 s; with 80, margins are smaller when masses are 20 % lower.
    pub height: f64,
    /// The fraction of the error of the heading that a footstep corrects; 0 for an inertial sensor without a heading.
    pub heading: f64,
    /// The bandwidth of the observer of the centre of mass \[rad/s\].
    pub observer: f64,
    /// The stiffness of the joints for the admittances, divided by weight times height of the centre of mass \[1/rad\].
    pub stiffness: f64,
}

impl Default for StabilizerGains {
    fn default() -> Self {
        StabilizerGains {
            dcm: 1.0,
            integral: 0.5,
            ankle: 25.0,
            torso: 2.0,
            sway: 0.5,
            height: 60.0,
            heading: 0.5,
            observer: 30.0,
            stiffness: 20.0,
        }
    }
}
