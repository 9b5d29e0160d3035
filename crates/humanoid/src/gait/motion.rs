//! Joint angles from the references of feet and centre of mass, sample by sample: inverse kinematics of the legs, and a quasi-Newton search (Broyden) for the
//! torso. Main type: [`Motion`].

use nalgebra::{Matrix3, Point3, Rotation2, UnitQuaternion, Vector3};

use super::biped::Biped;
use super::footprint::heading_of;
use super::legs::{Legs, Posture};
use super::parts::in_parts;
use super::reference::Reference;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::spatial::{Pose, angle};

/// The tolerance of the centre of mass \[m\]. The remaining error varies slowly from sample to sample. Where it jumps,
/// the zero moment point moves by at most a thousand times as much, which its margins include.
const NEAR: f64 = 5e-7;
/// The tolerance of the legs' values of a shared actuator \[rad\]: the remaining difference moves a foot by less than a
/// tenth of a nanometre.
const AGREED: f64 = 1e-10;
/// The change of the heading with which the derivative of the legs' disagreement is measured \[rad\].
const ASIDE: f64 = 1e-4;
/// The least move of the torso from which a derivative can be measured \[m, rad\].
const LEAST_MOVE: f64 = 1e-8;
/// The greatest number of corrections of the torso at a sample; one or two are usual.
const MOST_CORRECTIONS: usize = 40;
/// The number of last samples that extrapolate the torso's position: a smooth motion is met to its sixth difference.
const LEADS: usize = 6;
/// The initial ratio of the torso's move to the move of the centre of mass: the legs lag.
const FIRST_GAIN: f64 = 1.25;

/// The postures of a walk, one per sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Motion {
    /// The postures.
    pub postures: Vec<Posture>,
    /// The centre of mass at each sample \[m\].
    pub centres: Vec<Point3<f64>>,
}

/// The references of a walk, one per sample.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Samples<'a> {
    /// The references.
    pub references: &'a [Reference],
    /// The time between two samples \[s\].
    pub tick: f64,
    /// A motion of nearly the same references, from which the search starts.
    pub alike: Option<&'a Motion>,
}

impl<'a> Samples<'a> {
    /// References with this time between them \[s\].
    pub fn new(references: &'a [Reference], tick: f64) -> Self {
        Samples { references, tick, alike: None }
    }

    /// Sets a motion of nearly the same references.
    #[must_use]
    pub fn alike(mut self, motion: &'a Motion) -> Self {
        self.alike = Some(motion);
        self
    }
}

/// Solves the legs for every reference. The torso moves until the centre of mass of the whole robot is at its
/// reference, and turns until both legs agree on a shared actuator.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the time when a foot is out of reach; [`ErrorKind::Cancelled`] and
/// [`ErrorKind::Budget`].
pub(crate) fn realise<'w>(
    biped: &Biped,
    legs: &Legs,
    samples: &Samples<'_>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Motion> {
    let watch = Watch::or_none(watch);
    let Samples { references, tick, alike } = *samples;
    let known =
        |sample: usize| alike.map_or(Vector3::zeros(), |motion| motion.lead(sample, references[sample].heading));
    let solved = in_parts(references.len(), watch, |samples| {
        let mut search = TorsoSearch::new(legs);
        samples.map(move |sample| {
            let centre = search.follow(biped, legs, &references[sample], &known(sample));
            let time = sample as f64 * tick;
            let centre =
                centre.map_err(|error| Error::new(error.kind(), format!("{} (t = {time:.2} s)", error.message())))?;
            Ok((search.last.clone(), centre))
        })
    })?;
    let (postures, centres) = solved.into_iter().unzip();
    Ok(Motion { postures, centres })
}

impl Motion {
    /// The offset of the torso from the centre of mass in x and y, and from `heading`.
    fn lead(&self, sample: usize, heading: f64) -> Vector3<f64> {
        let torso = &self.postures[sample].world_from_torso;
        let apart = torso.translation.vector - self.centres[sample].coords;
        Vector3::new(apart.x, apart.y, angle::difference(heading_of(torso), heading))
    }
}

/// State of the search for the torso's pose: its last offsets, and the derivatives of centre of mass and legs.
///
/// The unknowns are x, y and heading of the torso. The residuals are the error of the centre of mass in x and y and the
/// legs' disagreement.
struct TorsoSearch {
    /// The posture at the last sample.
    last: Posture,
    /// The torso's offsets from its known pose at the last samples, the latest first.
    leads: Vec<Vector3<f64>>,
    /// The inverse Jacobian from residuals to moves of the torso, updated by Broyden's method (1965).
    inverse: Option<Matrix3<f64>>,
}

impl TorsoSearch {
    fn new(legs: &Legs) -> Self {
        TorsoSearch { last: legs.crouch(), leads: Vec::new(), inverse: None }
    }

    /// Moves the torso until `reference` is met, starting from the pose `known`; returns the centre of mass.
    fn follow(
        &mut self,
        biped: &Biped,
        legs: &Legs,
        reference: &Reference,
        known: &Vector3<f64>,
    ) -> Result<Point3<f64>> {
        let origin = Vector3::new(reference.centre.x, reference.centre.y, reference.heading) + known;
        let mut torso = origin + self.guess();
        if self.leads.is_empty() && *known == Vector3::zeros() && self.stand(legs, reference, &torso).is_err() {
            // The legs do not reach with the torso's origin above the centre of mass.
            torso += (Rotation2::new(reference.heading) * legs.lead()).push(0.0);
        }
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

    /// The initial inverse Jacobian: the legs lag by a fixed ratio, and the derivative of the disagreement is measured.
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

    /// Extrapolates the torso's offset by the polynomial through the last samples.
    fn guess(&self) -> Vector3<f64> {
        let count = self.leads.len();
        let mut factor = -1.0;
        let term = |(place, lead): (usize, &Vector3<f64>)| {
            // Binomial coefficients with alternating signs, starting with `count`.
            factor *= -((count - place) as f64) / (place + 1) as f64;
            lead * factor
        };
        self.leads.iter().enumerate().map(term).sum()
    }

    fn failure(&self, legs: &Legs) -> Error {
        let text = if legs.disagreement(&self.last).abs() > AGREED {
            "no heading of the torso lets both legs share the actuator that turns them; turn the feet less relative to each other (--max-turn)"
        } else {
            "the centre of mass cannot reach the position that the gait requires; lower the hip (--hip-height) or shorten the steps (--length)"
        };
        Error::new(ErrorKind::BadValue, text)
    }
}

/// The inverse Jacobian after Broyden's update by a move and the change of the residuals. It is unchanged when the move
/// is too small.
fn broyden(inverse: &Matrix3<f64>, moved: &Vector3<f64>, answered: &Vector3<f64>) -> Matrix3<f64> {
    let expected = inverse * answered;
    let along = moved.dot(&expected);
    if moved.norm() < LEAST_MOVE || along <= 0.1 * moved.norm_squared() {
        return *inverse;
    }
    inverse + (moved - expected) * (moved.transpose() * inverse) / along
}
