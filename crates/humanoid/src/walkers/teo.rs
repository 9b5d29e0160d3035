//! TEO: the initial posture of its walks, and their parameters.

use std::borrow::Cow;
use std::sync::Arc;

use super::posture;
use super::printed::TEO_LEFT_LEG;
use crate::Result;
use crate::gait::{Biped, Gait, GaitDefaults, Laws, LegSolver, Legs, Mirrored, OneStep, Walker, preview_defaults};
use groebot_robot::model::Meshes;
use groebot_robot::robots::teo;

/// Bent knees \[rad\].
const CROUCH: [(&str, f64); 3] = [("HipPitch", -0.3), ("KneePitch", 0.6), ("AnklePitch", -0.3)];

/// The value of the right leg's joint for the value 1 of the left one's: yaw and rolls have the opposite sign.
const SENSES: [f64; 6] = [-1.0, -1.0, 1.0, 1.0, 1.0, -1.0];

/// TEO with the derived solver of its left leg; the right leg is the mirror image.
///
/// # Errors
/// None with the crate's own data; those of [`Biped::new`] and [`Legs::new`] otherwise.
pub fn teo_walker() -> Result<Walker> {
    let biped = Biped::new(&teo(), ["l_sole", "r_sole"], &Meshes::default())?;
    let crouch = posture(&biped, |_| CROUCH)?;
    let left: LegSolver = Arc::new(TEO_LEFT_LEG);
    let right = Arc::new(Mirrored::new(Arc::clone(&left), SENSES.to_vec()));
    let legs = Legs::new(&biped, [left, right], crouch)?;
    let gaits = vec![("osg", TEO_ONE_STEP), ("preview", preview_defaults(&biped))];
    Ok(Walker { biped, legs, gaits })
}

/// One step goal by the generic laws of RH0 3.3, on a circle of 30 mm about the point below the ankle. All parameters
/// are our own.
pub const TEO_ONE_STEP: GaitDefaults = GaitDefaults {
    gait: Gait::OneStep(OneStep { laws: Laws::Generic, dip: 0.004, pitch: 0.0, upright: None }),
    length: 0.1,
    lift: 0.04,
    half_width: None,
    amplitude: 0.0985,
    ahead: 0.0,
    hip_heights: Cow::Borrowed(&[0.735, 0.73, 0.725, 0.72, 0.71, 0.7]),
    upright_hip: 0.745,
    period: 4.0,
    double_support: 0.5,
    rest: 0.0,
    margin: 0.02,
    speed_share: 0.9,
    most_turn: 0.15,
    tick: 0.02,
};
