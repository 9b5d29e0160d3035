//! TEO: the posture that its walks start from, and their figures.

use super::humanoid::{Humanoid, Outline};
use super::legs::{Legs, posture};
use super::one_step::{Laws, OneStep};
use super::plan::Gait;
use super::usual::Usual;
use crate::{Result, robots};

/// Bent knees \[rad\].
const CROUCH: [(&str, f64); 3] = [("HipPitch", -0.3), ("KneePitch", 0.6), ("AnklePitch", -0.3)];

/// TEO and the solver of its legs.
///
/// # Errors
/// None with the crate's own data; those of [`Humanoid::new`] and [`Legs::new`] otherwise.
pub fn teo(outline: Outline) -> Result<(Humanoid, Legs)> {
    let whole = robots::teo();
    let crouch = posture(&whole, |_| CROUCH)?;
    Ok((Humanoid::new(&whole, outline)?, Legs::new(&whole, crouch, "Knee")?))
}

/// One step goal by the generic laws of RH0 3.3, on a circle of 30 mm about the point below the ankle; all figures are ours.
pub const TEO_ONE_STEP: Usual = Usual {
    gait: Gait::OneStep(OneStep { laws: Laws::Generic, dip: 0.004, pitch: 0.0, upright: None }),
    length: 0.1,
    lift: 0.04,
    half_width: None,
    amplitude: 0.0985,
    ahead: 0.0,
    hip_heights: &[0.735, 0.73, 0.725, 0.72, 0.71, 0.7],
    upright_hip: 0.745,
    period: 4.0,
    double_support: 0.5,
    rest: 0.0,
    margin: 0.02,
    speed_share: 0.9,
    most_turn: 0.15,
    tick: 0.02,
};
