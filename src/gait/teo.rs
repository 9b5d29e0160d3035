//! TEO: the posture that its walks start from, and their figures.

use super::footprint::Side;
use super::humanoid::{Humanoid, Outline};
use super::legs::Legs;
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
    let mut crouch = vec![0.0; whole.links.len()];
    for prefix in [Side::Left, Side::Right].map(|side| if side == Side::Left { "L" } else { "R" }) {
        for (name, value) in CROUCH {
            crouch[whole.joint(&format!("{prefix}{name}"))?] = value;
        }
    }
    Ok((Humanoid::new(&whole, outline)?, Legs::new(&whole, crouch, "Knee")?))
}
