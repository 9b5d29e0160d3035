//! RH0: the initial posture of its walks, and the parameters of RH0 5.3 and 6.2.

use std::borrow::Cow;
use std::f64::consts::PI;

use std::sync::Arc;

use super::posture;
use super::printed::{FromTheFoot, Printed, RH0_LEFT_LEG, RH0_RIGHT_LEG};
use crate::Result;
use crate::gait::{Biped, Gait, GaitDefaults, Laws, Legs, OneStep, Walker, preview_defaults};
use groebot_robot::model::Meshes;
use groebot_robot::robots::rh0;

/// Bent knees \[rad\]: the thesis' joints 2, 3 and 4 of the right leg, 11, 10 and 9 of the left one.
const CROUCH: [(&str, f64); 3] = [("AnklePitch", 0.2), ("KneePitch", -0.4), ("HipPitch", 0.2)];

/// The sagittal coordination, RH0 (3-23), (3-38): joints of the arms, and the joints of the opposite leg whose values
/// they take.
const COORDINATED: [(&str, &str); 6] = [
    ("RClavicle", "LHipPitch"),
    ("RShoulder", "LHipRoll"),
    ("RElbow", "LKneePitch"),
    ("LClavicle", "RHipPitch"),
    ("LShoulder", "RHipRoll"),
    ("LElbow", "RKneePitch"),
];

/// RH0 with its mass as a point at the trunk's frame, and the derived solvers of its legs.
///
/// # Errors
/// None with the crate's own data; those of [`Biped::new`] and [`Legs::new`] otherwise.
pub fn rh0_walker() -> Result<Walker> {
    let robot = rh0();
    let biped = Biped::new(&robot, ["l_sole", "r_sole"], &Meshes::default())?;
    let frame = |name: &str| robot.link(name).map(|link| biped.model.link(link).1);
    let leg = |upwards: Printed, sole: &str, base: &str| -> Result<FromTheFoot> {
        let sole_from_base = frame(sole)?.inv_mul(&frame(base)?);
        Ok(FromTheFoot { upwards, sole_from_base, torso_from_tip: frame("Trunk")? })
    };
    let (left, right) = (leg(RH0_LEFT_LEG, "l_sole", "LS")?, leg(RH0_RIGHT_LEG, "r_sole", "RS")?);
    let crouch = posture(&biped, |_| CROUCH)?;
    let pair = |(follower, leader): &(&str, &str)| Ok((biped.joint(follower)?, biped.joint(leader)?));
    let coordinated = COORDINATED.iter().map(pair).collect::<Result<_>>()?;
    let legs = Legs::new(&biped, [Arc::new(left), Arc::new(right)], crouch)?.with_coordinated(coordinated);
    let gaits = vec![
        ("rh0", RH0_STEADY),
        ("rh0-sim", RH0_SIMULATION),
        ("rh0-real", RH0_EXPERIMENT),
        ("osg", RH0_GENERIC),
        ("preview", preview_defaults(&biped)),
    ];
    Ok(Walker { biped, legs, gaits })
}

/// The height of the ankle above the sole \[m\]: assumed, `crates/robot/src/robots/data/rh0.toml`.
const ANKLE_HEIGHT: f64 = 0.09;
/// The distance from the hip to the trunk's frame \[m\]: inferred and assumed, `crates/robot/src/robots/data/rh0.toml`.
const HIP_TO_TRUNK: f64 = 0.0265;
/// The length of thigh and shank together \[m\]: inferred, `crates/robot/src/robots/data/rh0.toml`.
const LEG: f64 = 0.56;
/// `H_CM`, the height of the centre of mass above the ankles \[m\]: RH0 5.3.1.
const CENTRE_HEIGHT: f64 = 0.58;
/// `W_p`, half of the lateral distance between the feet \[m\]: RH0 5.3.1.
const HALF_WIDTH: f64 = 0.112;
/// Heights of the hip above the floor that are tried in order \[m\]: `H_CM`, and up to 3 mm less where that is out of
/// reach (6.2.1).
const HIP_HEIGHTS: [f64; 4] = {
    let height = ANKLE_HEIGHT + CENTRE_HEIGHT - HIP_TO_TRUNK;
    [height, height - 0.001, height - 0.002, height - 0.003]
};
/// The time between two samples in the simulations and in the experiments \[s\]: RH0 5.3.1, 6.2.1.
const TICKS: [f64; 2] = [0.036, 0.072];
/// The samples of a step in the simulations and in the experiments: RH0 5.3.1, 6.2.1.
const SAMPLES: [f64; 2] = [81.0, 323.0];

/// RH0 5.3: simulated walks.
pub const RH0_SIMULATION: GaitDefaults = GaitDefaults {
    gait: Gait::OneStep(OneStep { laws: Laws::Rh0 { power: 4.0 }, dip: 0.004, pitch: PI / 9.0, upright: None }),
    length: 0.16,
    lift: 0.1,
    half_width: None,
    // RA_AS = 0.06 m: at this distance from the middle of the supporting sole the centre of mass is above it.
    amplitude: HALF_WIDTH - 0.06,
    ahead: 0.0,
    hip_heights: Cow::Borrowed(&HIP_HEIGHTS),
    upright_hip: ANKLE_HEIGHT + LEG,
    period: SAMPLES[0] * TICKS[0],
    // Of 81 samples 17 + 17: the least fraction for which the zero moment point stays inside, with a knee slower than
    // 25 rpm.
    double_support: 0.42,
    rest: 0.0,
    margin: 0.0,
    speed_share: 1.0,
    most_turn: PI / 12.0,
    tick: TICKS[0],
};

/// RH0's laws with other parameters, which keep the robot upright in physics: the centre of mass moves to 22 mm from the
/// middle of the supporting sole, more of a step is in double support, and the swinging foot stays level. The pitched
/// foot of the thesis touches the floor too early when the torso is 7 mm lower than planned.
pub const RH0_STEADY: GaitDefaults = GaitDefaults {
    gait: Gait::OneStep(OneStep { laws: Laws::Rh0 { power: 4.0 }, dip: 0.004, pitch: 0.0, upright: None }),
    amplitude: HALF_WIDTH - 0.022,
    hip_heights: Cow::Borrowed(&LOWER_HIP_HEIGHTS),
    double_support: 0.6,
    margin: 0.005,
    ..RH0_SIMULATION
};

/// RH0 by the generic laws of RH0 3.3.
pub const RH0_GENERIC: GaitDefaults = GaitDefaults {
    gait: Gait::OneStep(OneStep { laws: Laws::Generic, dip: 0.004, pitch: PI / 9.0, upright: None }),
    hip_heights: Cow::Borrowed(&LOWER_HIP_HEIGHTS),
    double_support: 0.5,
    margin: 0.005,
    ..RH0_SIMULATION
};

/// Heights of the hip where the centre of mass moves further to the sides, which needs longer legs \[m\].
const LOWER_HIP_HEIGHTS: [f64; 5] = [0.6435, 0.635, 0.625, 0.615, 0.6];

/// RH0 6.2: walks of the physical robot.
pub const RH0_EXPERIMENT: GaitDefaults = GaitDefaults {
    amplitude: HALF_WIDTH - 0.03,
    period: SAMPLES[1] * TICKS[1],
    most_turn: PI / 18.0,
    tick: TICKS[1],
    ..RH0_SIMULATION
};
