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
/// How much further the torso is moved than the centre of mass is to move: the legs lag behind. Any value from one to two converges.
const LEAD: f64 = 1.25;
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
    let mut motion = Motion { postures: Vec::with_capacity(references.len()), centres: Vec::with_capacity(references.len()) };
    let mut last = legs.crouch();
    let mut leads = [Vector2::zeros(); 2];
    for (sample, reference) in references.iter().enumerate() {
        if sample % REPORTED == 0 {
            watch.check()?;
            watch.report("samples of the walk", sample, references.len() - sample);
        }
        let guess = if sample == 1 { leads[1] } else { leads[1] * 2.0 - leads[0] };
        let (posture, centre) = follow(humanoid, legs, reference, torso_height, guess, last)
            .map_err(|error| error.with_context(format!("t = {:.2} s", sample as f64 * tick)))?;
        leads = [leads[1], posture.world_from_torso.translation.vector.xy() - reference.centre.coords];
        last = posture.clone();
        motion.postures.push(posture);
        motion.centres.push(centre);
    }
    Ok(motion)
}

/// The posture whose centre of mass is where `reference` asks for it; `lead` is how far the torso may be from there.
fn follow(
    humanoid: &Humanoid,
    legs: &impl Legs,
    reference: &Reference,
    torso_height: f64,
    lead: Vector2<f64>,
    mut last: Posture,
) -> Result<(Posture, Point3<f64>)> {
    let mut torso: Point2<f64> = reference.centre + lead;
    for _ in 0..MOST_CORRECTIONS {
        let at = Point3::new(torso.x, torso.y, torso_height);
        last = legs.stand(&reference.world_from_soles, &at, &last)?;
        let centre = humanoid.body.place(&last.world_from_torso, &last.q)?.centre_of_mass();
        let miss = reference.centre - centre.xy();
        if miss.norm() <= NEAR {
            return Ok((last, centre));
        }
        torso += miss * LEAD;
    }
    let text = "the centre of mass cannot be brought to where the gait asks for it; lower the hip or shorten the steps";
    Err(Error::new(ErrorKind::BadValue, text))
}
