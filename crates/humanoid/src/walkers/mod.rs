//! Walking humanoids by name: NAO, RH0 and TEO of [`groebot_robot::robots`], with the parameters of their walks and the
//! generated solvers of their legs. Also the sagittal kinematics division of RH0. Main function: [`walker`].

mod nao;
mod printed;
mod rh0;
mod skd;
mod teo;

pub use nao::{NAO_ONE_STEP, NAO_PREVIEW, NAO_SINE, nao_walker};
pub use rh0::{RH0_EXPERIMENT, RH0_GENERIC, RH0_SIMULATION, RH0_STEADY, rh0_walker};
pub use skd::{Manipulator, Real, Virtual, coordinated_arm};
pub use teo::{TEO_ONE_STEP, teo_walker};

use crate::Result;
use crate::gait::{Biped, Side, Walker};

/// The outline of the soles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outline {
    /// As measured on the robot.
    #[default]
    Measured,
    /// As published: 160 x 90 mm for NAO.
    Published,
}

/// The walker of a humanoid of this crate; the names are those of [`groebot_robot::robots::robot`].
pub fn walker(name: &str, outline: Outline) -> Option<Result<Walker>> {
    match name {
        "nao" | "nao_v5" => Some(nao_walker(outline)),
        "rh0" => Some(rh0_walker()),
        "teo" => Some(teo_walker()),
        _ => None,
    }
}

/// The value of each joint of `biped` \[rad\]. `values` gives the values for a side by names without the prefix `L` or
/// `R`; other joints are zero.
///
/// # Errors
/// [`crate::ErrorKind::UnknownName`] when a named joint is missing on one side.
fn posture<V>(biped: &Biped, values: impl Fn(Side) -> V) -> Result<Vec<f64>>
where
    V: IntoIterator<Item = (&'static str, f64)>,
{
    let mut posture = vec![0.0; biped.joints.len()];
    for (side, prefix) in [(Side::Left, 'L'), (Side::Right, 'R')] {
        for (name, value) in values(side) {
            posture[biped.joint(&format!("{prefix}{name}"))?] = value;
        }
    }
    Ok(posture)
}
