//! From what is asked of feet and centre of mass to joint angles, sample by sample. Main type: [`Motion`].

use nalgebra::{Point2, Point3, Vector2};

use super::humanoid::Humanoid;
use super::legs::{Legs, Posture};
use super::reference::Reference;
use crate::{Error, ErrorKind, Result, Watch};

/// How near the centre of mass comes to where it is asked to be \[m\]. What is left moves the zero moment point by about a thousand
/// times as much.
const NEAR: f64 = 1e-8;
/// The most corrections of the torso at a sample; two or three are needed.
const MOST_CORRECTIONS: usize = 30;
/// How much further the torso must move than the centre of mass is to move, at first: the legs lag behind.
const FIRST_GAIN: f64 = 1.25;
/// Between which values the gain is kept as it is measured.
const GAINS: (f64, f64) = (1.0, 2.0);
/// After how many samples progress is told.
const REPORTED: usize = 64;

/// The postures of a walk, one a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The postures.
    pub postures: Vec<Posture>,
    /// The centre of mass at each \[m\].
    pub centres: Vec<Point3<f64>>,
}

/// Solves the legs for every reference, with the torso's origin at height `torso_height` \[m\] and moved until the centre of mass of the
/// whole robot is where it is asked to be.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the time when a foot is out of reach; [`ErrorKind::Cancelled`] and [`ErrorKind::Budget`].
pub fn realise(
    humanoid: &Humanoid,
    legs: &impl Legs,
    references: &[Reference],
    torso_height: f64,
    tick: f64,
    watch: &Watch,
) -> Result<Motion> {
    let count = references.len();
    let mut motion = Motion { postures: Vec::with_capacity(count), centres: Vec::with_capacity(count) };
    let mut pursuit = Pursuit { last: legs.crouch(), leads: Vec::new(), gains: Vector2::repeat(FIRST_GAIN) };
    for (sample, reference) in references.iter().enumerate() {
        if sample % REPORTED == 0 {
            watch.check()?;
            watch.report("samples of the walk", sample, count - sample);
        }
        let centre = pursuit
            .follow(humanoid, legs, reference, torso_height)
            .map_err(|error| error.with_context(format!("t = {:.2} s", sample as f64 * tick)))?;
        motion.postures.push(pursuit.last.clone());
        motion.centres.push(centre);
    }
    Ok(motion)
}

/// The torso on the way: where it was, and how the centre of mass answers to it.
struct Pursuit {
    /// The posture at the last sample.
    last: Posture,
    /// How far the torso was from the centre of mass that was asked for, at up to three last samples, the latest first.
    leads: Vec<Vector2<f64>>,
    /// How far the torso moves for a move of the centre of mass, along x and y.
    gains: Vector2<f64>,
}

impl Pursuit {
    /// Moves the torso until the centre of mass is where `reference` asks for it, by secants; returns the centre of mass.
    fn follow(
        &mut self,
        humanoid: &Humanoid,
        legs: &impl Legs,
        reference: &Reference,
        torso_height: f64,
    ) -> Result<Point3<f64>> {
        let mut torso = reference.centre + self.guess();
        let mut before: Option<(Point2<f64>, Point2<f64>)> = None;
        for _ in 0..MOST_CORRECTIONS {
            let at = Point3::new(torso.x, torso.y, torso_height);
            self.last = legs.stand(&reference.world_from_soles, &at, &self.last)?;
            let centre = humanoid.body.place(&self.last.world_from_torso, &self.last.q)?.centre_of_mass();
            let miss = reference.centre - centre.xy();
            if miss.norm() <= NEAR {
                self.leads.insert(0, torso - reference.centre);
                self.leads.truncate(3);
                return Ok(centre);
            }
            if let Some((torso_before, centre_before)) = before {
                self.learn(&(torso - torso_before), &(centre.xy() - centre_before));
            }
            before = Some((torso, centre.xy()));
            torso += miss.component_mul(&self.gains);
        }
        let text =
            "the centre of mass cannot be brought to where the gait asks for it; lower the hip or shorten the steps";
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// How far the torso will be from the centre of mass: by the parabola through the last three samples.
    fn guess(&self) -> Vector2<f64> {
        match self.leads[..] {
            [] => Vector2::zeros(),
            [a] => a,
            [a, b] => a * 2.0 - b,
            [a, b, c, ..] => (a - b) * 3.0 + c,
        }
    }

    /// Takes the gains from a move of the torso and what it did, where it was large enough to be measured.
    fn learn(&mut self, moved: &Vector2<f64>, answered: &Vector2<f64>) {
        for axis in 0..2 {
            let gain = moved[axis] / answered[axis];
            if answered[axis].abs() > NEAR && gain.is_finite() {
                self.gains[axis] = gain.clamp(GAINS.0, GAINS.1);
            }
        }
    }
}
