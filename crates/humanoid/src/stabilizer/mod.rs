//! Feedback while walking: joint targets from a planned walk and the measured state. Main type: [`Stabilizer`].
//!
//! The divergent component of motion (DCM) is `x + x' / w` of the centre of mass x, with `w = sqrt(g / height)`. The desired zero moment point (ZMP) is
//! chosen so that the DCM returns to that of the plan. It is distributed between the feet, whose soles turn until the measured centres of pressure are the
//! desired ones (admittance). The torso is kept upright by the inertial sensor, and the heights of the feet are adapted to the measured forces at landing.
//! When the DCM leaves what a foot can hold, the next footstep moves. The slope of the floor is that of the soles that stand; the other foot lands on it.
//!
//! Sources: S. Kajita and others, "Biped walking stabilization based on linear inverted pendulum tracking", IROS 2010; J. Englsberger, C. Ott,
//! A. Albu-Schaeffer, "Three-dimensional bipedal walking control based on divergent component of motion", IEEE Trans. on Robotics 31 (2015);
//! S. Caron, A. Kheddar, O. Tempier, "Stair climbing stabilization of the HRP-4 humanoid robot using whole-body admittance control", ICRA 2019.

mod descent;
mod distribution;
mod estimate;
mod floor;
mod gains;
mod law;
mod planned;
mod sag;
mod state;
mod steps;

pub use gains::StabilizerGains;
pub use law::Stabilizer;
pub use state::{JointTargets, SoleForce, State};
