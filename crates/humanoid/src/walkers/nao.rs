//! NAO V5: the initial posture of its walks, and their default parameters.

use std::borrow::Cow;
use std::sync::Arc;

use nalgebra::{Point2, Vector2};

use super::printed::{NAO_LEFT_LEG, NAO_RIGHT_LEG};
use super::{Outline, posture};
use crate::Result;
use crate::gait::{Biped, Gait, GaitDefaults, Laws, Legs, OneStep, Side, TICK, Walker};
use groebot_robot::model::Meshes;
use groebot_robot::robots::nao_v5;

/// Bent knees, soles below the hips \[rad\].
const CROUCH: [(&str, f64); 3] = [("HipPitch", -0.5), ("KneePitch", 1.0), ("AnklePitch", -0.5)];
/// Arms near the trunk, NAO 6.8: the values of the left arm \[rad\]. The right one has the opposite sign in all but the
/// first.
const ARM: [(&str, f64); 5] =
    [("ShoulderPitch", 1.55), ("ShoulderRoll", 0.15), ("ElbowYaw", -1.2), ("ElbowRoll", -0.5), ("WristYaw", 0.0)];

/// The published rectangle of the sole \[m\], NAO 6.8. The source gives no position; it is placed about the centre of
/// the measured sole.
const PUBLISHED_SOLE: (f64, f64) = (0.160, 0.090);

/// NAO V5 with the measured or the published soles, and the derived solvers of its legs.
///
/// # Errors
/// None with the crate's own data; those of [`Biped::new`] and [`Legs::new`] otherwise.
pub fn nao_walker(outline: Outline) -> Result<Walker> {
    let robot = nao_v5();
    let soles = ["l_sole", "r_sole"];
    let mut biped = Biped::new(&robot, soles, &Meshes::default())?;
    if outline == Outline::Published {
        let outlines = biped.feet.each_ref().map(|foot| {
            let middle =
                foot.corners.iter().map(|corner| corner.coords).sum::<Vector2<f64>>() / foot.corners.len() as f64;
            let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
            corners
                .map(|(x, y)| Point2::from(middle + Vector2::new(x * PUBLISHED_SOLE.0, y * PUBLISHED_SOLE.1)))
                .to_vec()
        });
        biped = Biped::on_outlines(&robot, soles, 0.0, outlines)?;
    }
    let values = |side: Side| {
        let mirrored = move |(name, value)| (name, if name == "ShoulderPitch" { value } else { side.sign() * value });
        CROUCH.into_iter().chain(ARM.into_iter().map(mirrored))
    };
    let crouch = posture(&biped, values)?;
    let legs = Legs::new(&biped, [Arc::new(NAO_LEFT_LEG), Arc::new(NAO_RIGHT_LEG)], crouch)?;
    let gaits = vec![("sine", NAO_SINE), ("preview", NAO_PREVIEW), ("osg", NAO_ONE_STEP)];
    Ok(Walker { biped, legs, gaits })
}

/// Heights of the hip that are tried in order \[m\]. Greater heights leave more range for the ankles' roll, smaller
/// ones have a longer reach.
const HIP_HEIGHTS: [f64; 6] = [0.228, 0.225, 0.232, 0.222, 0.215, 0.205];

/// The sine gait of NAO (6.8.1).
pub const NAO_SINE: GaitDefaults = GaitDefaults {
    gait: Gait::Sine,
    length: 0.04,
    lift: 0.02,
    half_width: None,
    amplitude: 0.05,
    ahead: 0.005,
    hip_heights: Cow::Borrowed(&HIP_HEIGHTS),
    upright_hip: 0.24,
    period: 1.6,
    double_support: 0.66,
    rest: 0.5,
    margin: 0.01,
    speed_share: 0.9,
    // At 0.14 rad the AnkleRoll of a swing foot reaches its limit on the path to some goals; at 0.2 rad the feet
    // collide.
    most_turn: 0.1,
    tick: TICK,
};

/// One step goal by the generic laws of RH0 3.3, on a circle of 10 mm about the ankle.
pub const NAO_ONE_STEP: GaitDefaults = GaitDefaults {
    gait: Gait::OneStep(OneStep { laws: Laws::Generic, dip: 0.001, pitch: 0.0, upright: None }),
    amplitude: 0.04,
    period: 2.4,
    rest: 0.0,
    ..NAO_SINE
};

/// Preview control. The knee reaches 85 % of its greatest rate, of which nine tenths are permitted.
pub const NAO_PREVIEW: GaitDefaults = GaitDefaults {
    gait: Gait::Preview,
    length: 0.06,
    lift: 0.025,
    period: 0.6,
    double_support: 0.3,
    rest: 1.0,
    most_turn: 0.15,
    ..NAO_SINE
};
