//! From what is asked of feet and centre of mass to joint angles, sample by sample. Main type: [`Motion`].

use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

use super::biped::Biped;
use super::footprint::heading_of;
use super::legs::{Legs, Posture};
use super::parts::in_parts;
use super::reference::Reference;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::spatial::{Pose, angle};

/// How near the centre of mass comes to where it is asked to be \[m\]. What is left varies slowly from sample to sample; where it jumps,
/// the zero moment point moves by at most a thousand times as much, which its margins count.
const NEAR: f64 = 5e-7;
/// How far the legs may disagree on a shared actuator \[rad\]: what is left moves a foot by less than a tenth of a nanometre.
const AGREED: f64 = 1e-10;
/// How far the heading is moved to see how the legs' disagreement answers \[rad\].
const ASIDE: f64 = 1e-4;
/// How far the torso must move for its answer to be measured \[m, rad\].
const TELLING: f64 = 1e-8;
/// The most corrections of the torso at a sample; one or two are needed.
const MOST_CORRECTIONS: usize = 40;
/// How many last samples tell where the torso will be: smooth motion is met to its sixth difference.
const LEADS: usize = 6;
/// How much further the torso must move than the centre of mass is to move, at first: the legs lag behind.
const FIRST_GAIN: f64 = 1.25;

/// The postures of a walk, one a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The postures.
    pub postures: Vec<Posture>,
    /// The centre of mass at each \[m\].
    pub centres: Vec<Point3<f64>>,
}

/// Solves the legs for every reference, with the torso moved until the centre of mass of the whole robot is where it is asked to be, and
/// turned until both legs ask the same of an actuator that they share. `alike` is a motion of nearly the same references, if there is one: it
/// tells where to look first.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the time when a foot is out of reach; [`ErrorKind::Cancelled`] and [`ErrorKind::Budget`].
pub fn realise(
    biped: &Biped,
    legs: &Legs,
    references: &[Reference],
    alike: Option<&Motion>,
    tick: f64,
    watch: &Watch,
) -> Result<Motion> {
    let known =
        |sample: usize| alike.map_or(Vector3::zeros(), |motion| motion.lead(sample, references[sample].heading));
    let solved = in_parts(references.len(), watch, |samples| {
        let mut pursuit = Pursuit::new(legs);
        samples.map(move |sample| {
            let centre = pursuit.follow(biped, legs, &references[sample], &known(sample));
            let time = sample as f64 * tick;
            let centre =
                centre.map_err(|error| Error::new(error.kind(), format!("{} (t = {time:.2} s)", error.message())))?;
            Ok((pursuit.last.clone(), centre))
        })
    })?;
    let (postures, centres) = solved.into_iter().unzip();
    Ok(Motion { postures, centres })
}

impl Motion {
    /// How far the torso is ahead of the centre of mass in x and y, and of `heading`.
    fn lead(&self, sample: usize, heading: f64) -> Vector3<f64> {
        let torso = &self.postures[sample].world_from_torso;
        let apart = torso.translation.vector - self.centres[sample].coords;
        Vector3::new(apart.x, apart.y, angle::difference(heading_of(torso), heading))
    }
}

/// The torso on the way: where it was, and how centre of mass and legs answer to it.
///
/// The unknowns are x, y and heading of the torso; to be zero are the miss of the centre of mass in x and y and the legs' disagreement.
struct Pursuit {
    /// The posture at the last sample.
    last: Posture,
    /// How far the torso was from where it was known to be at the last samples, the latest first.
    leads: Vec<Vector3<f64>>,
    /// How far the torso must move for a change of what is to be zero: the inverse Jacobian, kept up by Broyden's rule (1965).
    inverse: Option<Matrix3<f64>>,
}

impl Pursuit {
    fn new(legs: &Legs) -> Self {
        Pursuit { last: legs.crouch(), leads: Vec::new(), inverse: None }
    }

    /// Moves the torso to where `reference` asks for it, by about `known` from there; returns the centre of mass.
    fn follow(
        &mut self,
        biped: &Biped,
        legs: &Legs,
        reference: &Reference,
        known: &Vector3<f64>,
    ) -> Result<Point3<f64>> {
        let origin = Vector3::new(reference.centre.x, reference.centre.y, reference.heading) + known;
        let mut torso = origin + self.guess();
        let mut before: Option<(Vector3<f64>, Vector3<f64>)> = None;
        for _ in 0..MOST_CORRECTIONS {
            let mut posture = self.stand(legs, reference, &torso)?;
            let apart = legs.disagreement(&posture);
            if apart.abs() <= AGREED {
                legs.agree(&mut posture);
            }
            let centre = biped.model.place(&posture.world_from_torso, &posture.q)?.centre_of_mass();
            let off = centre.xy() - reference.centre;
            let miss = Vector3::new(off.x, off.y, apart);
            let inverse = match self.inverse {
                Some(inverse) => inverse,
                None => self.first_inverse(legs, reference, &torso, apart)?,
            };
            self.last = posture;
            let inverse = before.map_or(inverse, |(moved, was)| broyden(&inverse, &moved, &(miss - was)));
            self.inverse = Some(inverse);
            let step = -(inverse * miss);
            if off.norm() <= NEAR && apart.abs() <= AGREED {
                self.leads.insert(0, torso - origin + step);
                self.leads.truncate(LEADS);
                return Ok(centre);
            }
            before = Some((step, miss));
            torso += step;
        }
        Err(self.failure(legs))
    }

    /// The posture with the torso at x, y and heading `torso`.
    fn stand(&self, legs: &Legs, reference: &Reference, torso: &Vector3<f64>) -> Result<Posture> {
        let at = Vector3::new(torso.x, torso.y, reference.torso_height);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), torso.z);
        legs.stand(&reference.world_from_soles, &Pose::from_parts(at.into(), turn), &self.last)
    }

    /// The inverse Jacobian to start with: the legs lag behind by a fixed share; how the disagreement answers is measured.
    fn first_inverse(
        &self,
        legs: &Legs,
        reference: &Reference,
        torso: &Vector3<f64>,
        apart: f64,
    ) -> Result<Matrix3<f64>> {
        let mut diagonal = Vector3::new(FIRST_GAIN, FIRST_GAIN, 0.0);
        if legs.share_an_actuator() {
            let aside = self.stand(legs, reference, &(torso + Vector3::z() * ASIDE))?;
            let slope = angle::difference(legs.disagreement(&aside), apart) / ASIDE;
            diagonal.z = if slope == 0.0 { 0.0 } else { 1.0 / slope };
        }
        Ok(Matrix3::from_diagonal(&diagonal))
    }

    /// How far the torso will be from where it is known to be: by the polynomial through the last samples.
    fn guess(&self) -> Vector3<f64> {
        let count = self.leads.len();
        let mut factor = -1.0;
        let term = |(place, lead): (usize, &Vector3<f64>)| {
            // Binomial coefficients with alternating signs, from `count` on.
            factor *= -((count - place) as f64) / (place + 1) as f64;
            lead * factor
        };
        self.leads.iter().enumerate().map(term).sum()
    }

    fn failure(&self, legs: &Legs) -> Error {
        let text = if legs.disagreement(&self.last).abs() > AGREED {
            "no heading of the torso lets both legs share the actuator that turns them; turn the feet less against one another (--max-turn)"
        } else {
            "the centre of mass cannot be brought to where the gait asks for it; lower the hip (--hip-height) or shorten the steps (--length)"
        };
        Error::new(ErrorKind::BadValue, text)
    }
}

/// The inverse Jacobian corrected by a move and its answer; as it was where the move was too small to tell.
fn broyden(inverse: &Matrix3<f64>, moved: &Vector3<f64>, answered: &Vector3<f64>) -> Matrix3<f64> {
    let expected = inverse * answered;
    let along = moved.dot(&expected);
    if moved.norm() < TELLING || along <= 0.1 * moved.norm_squared() {
        return *inverse;
    }
    inverse + (moved - expected) * (moved.transpose() * inverse) / along
}
