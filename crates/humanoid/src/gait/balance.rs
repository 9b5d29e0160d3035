//! Balance of a motion at each sample: the zero moment point (ZMP), the support polygon and the stability margins of RH0 3.1.1. Main type: [`Balance`].

use nalgebra::{Point2, Vector3};

use super::biped::Biped;
use super::footprint::Side;
use super::legs::Legs;
use super::motion::{Motion, Samples, realise};
use super::parts::in_parts;
use super::polygon::Polygon;
use super::reference::Reference;
use super::zmp::{Configuration, momentum_between, of_pendulum, zero_moment_point};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::dynamics::Momentum;
use groebot_robot::spatial::Pose;

/// Corners of a supporting sole within this height of its lowest corner count as contacts \[m\].
const TOUCH: f64 = 1e-6;

/// The balance at one sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Balance {
    /// The support polygon.
    pub support: Polygon,
    /// The zero moment point of the whole multibody \[m\].
    pub zmp: Point2<f64>,
    /// The zero moment point of the linear inverted pendulum with the same centre of mass \[m\].
    pub pendulum: Point2<f64>,
    /// The centre of pressure of the robot at rest in this posture: the ground projection of the centre of mass \[m\].
    pub pressure: Point2<f64>,
    /// The static margin \[m\], RH0 (3-1): the signed distance from the border of the support polygon to the projection
    /// of the centre of mass. Positive inside.
    pub static_margin: f64,
    /// The dynamic margin \[m\], RH0 (3-5): the signed distance from the border of the support polygon to the zero
    /// moment point. Positive inside.
    pub margin: f64,
}

/// Computes the balance at every sample of a motion that starts and ends at rest.
///
/// # Errors
/// [`ErrorKind::BadValue`] when the robot is in free fall, where no zero moment point exists.
pub fn balance(biped: &Biped, references: &[Reference], motion: &Motion, tick: f64) -> Result<Vec<Balance>> {
    let momenta = momenta(biped, motion, tick)?;
    let last = motion.postures.len().saturating_sub(1);
    let at = |sample: usize| {
        let centre = motion.centres[sample];
        let (before, after) = (&momenta[sample], &momenta[sample + 1]);
        let rate = Momentum {
            linear: (after.linear - before.linear) / tick,
            angular: (after.angular - before.angular) / tick,
        };
        let falls = || {
            let time = sample as f64 * tick;
            let text = format!("no force presses the robot to the floor; walk slower (--period) (t = {time:.2} s)");
            Error::new(ErrorKind::BadValue, text)
        };
        let zmp = zero_moment_point(biped.model.mass(), &centre, &rate).ok_or_else(falls)?;
        let [earlier, later] = [sample.saturating_sub(1), (sample + 1).min(last)].map(|near| motion.centres[near]);
        let acceleration: Vector3<f64> = ((later - centre) - (centre - earlier)) / (tick * tick);
        let support = support(biped, &references[sample]);
        Ok(Balance {
            zmp,
            pendulum: of_pendulum(&centre, &acceleration),
            pressure: centre.xy(),
            static_margin: support.signed_distance(&centre.xy()),
            margin: support.signed_distance(&zmp),
            support,
        })
    };
    (0..motion.postures.len()).map(at).collect()
}

/// Solves the motion of the given references and computes its balance.
///
/// # Errors
/// Those of [`realise`] and [`balance`].
pub(super) fn realised(
    biped: &Biped,
    legs: &Legs,
    samples: &Samples<'_>,
    watch: &Watch,
) -> Result<(Motion, Vec<Balance>)> {
    let motion = realise(biped, legs, samples, watch)?;
    let balances = balance(biped, samples.references, &motion, samples.tick)?;
    Ok((motion, balances))
}

/// The support polygon of a reference.
pub fn support(biped: &Biped, reference: &Reference) -> Polygon {
    let supporting: Vec<(Side, Pose)> = [Side::Left, Side::Right]
        .into_iter()
        .filter(|side| reference.stands[*side as usize])
        .map(|side| (side, reference.world_from_soles[side as usize]))
        .collect();
    biped.support(&supporting, TOUCH)
}

/// The momenta between consecutive samples, with rest before the first and after the last: one more than there are
/// samples.
fn momenta(biped: &Biped, motion: &Motion, tick: f64) -> Result<Vec<Momentum>> {
    let configuration = |sample: usize| {
        let posture = &motion.postures[sample];
        Configuration { world_from_base: &posture.world_from_torso, q: &posture.q }
    };
    let between =
        |sample: usize| momentum_between(&biped.model, configuration(sample), configuration(sample + 1), tick);
    let moving = motion.postures.len().saturating_sub(1);
    let mut momenta = vec![Momentum::zero()];
    momenta.extend(in_parts(moving, &Watch::none(), |samples| samples.map(&between))?);
    momenta.push(Momentum::zero());
    Ok(momenta)
}
