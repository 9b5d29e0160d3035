//! From what is asked of feet and centre of mass to joint angles, sample by sample. Main type: [`Motion`].

use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{Point2, Point3, Vector2};

use super::footprint::Footprint;
use super::humanoid::Humanoid;
use super::legs::{Legs, Posture};
use super::reference::Reference;
use crate::{Error, ErrorKind, Result, Watch};

/// How near the centre of mass comes to where it is asked to be \[m\]. What is left varies slowly from sample to sample; where it jumps,
/// the zero moment point moves by at most a thousand times as much, which its margins count.
const NEAR: f64 = 5e-7;
/// How far the centre of mass must move to tell the gains \[m\].
const TELLING: f64 = 1e-7;
/// The most corrections of the torso at a sample; two or three are needed.
const MOST_CORRECTIONS: usize = 30;
/// How much further the torso must move than the centre of mass is to move, at first: the legs lag behind.
const FIRST_GAIN: f64 = 1.25;
/// Between which values the gain is kept as it is measured.
const GAINS: (f64, f64) = (1.0, 2.0);
/// In how many parts a walk is solved, each on a thread of its own; their number does not depend on the machine, so that the same walk
/// comes out everywhere.
const PARTS: usize = 4;
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
    legs: &(impl Legs + Sync),
    references: &[Reference],
    torso_height: f64,
    tick: f64,
    watch: &Watch,
) -> Result<Motion> {
    let done = AtomicUsize::new(0);
    let size = references.len().div_ceil(PARTS).max(1);
    let solve = |(place, part): (usize, &[Reference])| {
        let mut pursuit = Pursuit::new(legs, part);
        let solved = part.iter().enumerate().map(|(sample, reference)| {
            if sample % REPORTED == 0 {
                watch.check()?;
                let done = done.fetch_add(REPORTED.min(part.len() - sample), Ordering::Relaxed);
                watch.report("samples of the walk", done, references.len() - done);
            }
            let time = (place * size + sample) as f64 * tick;
            let centre = pursuit.follow(humanoid, legs, reference, torso_height);
            let centre = centre.map_err(|error| error.with_context(format!("t = {time:.2} s")))?;
            Ok((pursuit.last.clone(), centre))
        });
        solved.collect::<Result<Vec<_>>>()
    };
    let parts: Vec<Result<Vec<_>>> = std::thread::scope(|scope| {
        let spawned: Vec<_> =
            references.chunks(size).enumerate().map(|part| scope.spawn(move || solve(part))).collect();
        let joined = spawned.into_iter().map(|part| part.join());
        joined.map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    let samples = parts.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten();
    let (postures, centres) = samples.unzip();
    Ok(Motion { postures, centres })
}

/// The torso on the way: where it was, and how the centre of mass answers to it.
struct Pursuit {
    /// The posture at the last sample.
    last: Posture,
    /// How far the torso was from the centre of mass that was asked for, at up to four last samples, the latest first.
    leads: Vec<Vector2<f64>>,
    /// How far the torso moves for a move of the centre of mass, along x and y.
    gains: Vector2<f64>,
}

impl Pursuit {
    /// Before the first of `references`: a crouch above the feet.
    fn new(legs: &impl Legs, references: &[Reference]) -> Self {
        let mut last = legs.crouch();
        if let Some(reference) = references.first() {
            let [left, right] = reference.world_from_soles.each_ref().map(|sole| sole.rotation.euler_angles().2);
            let middle = Footprint { yaw: left, ..Footprint::default() }
                .middle(&Footprint { yaw: right, ..Footprint::default() });
            last.world_from_torso = middle.at_height(0.0);
        }
        Pursuit { last, leads: Vec::new(), gains: Vector2::repeat(FIRST_GAIN) }
    }

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
                self.leads.insert(0, torso - reference.centre + miss.component_mul(&self.gains));
                self.leads.truncate(4);
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

    /// How far the torso will be from the centre of mass: by the cubic through the last four samples.
    fn guess(&self) -> Vector2<f64> {
        match self.leads[..] {
            [] => Vector2::zeros(),
            [a] => a,
            [a, b] => a * 2.0 - b,
            [a, b, c] => (a - b) * 3.0 + c,
            [a, b, c, d, ..] => (a + c) * 4.0 - b * 6.0 - d,
        }
    }

    /// Takes the gains from a move of the torso and what it did, where it was large enough to be measured.
    fn learn(&mut self, moved: &Vector2<f64>, answered: &Vector2<f64>) {
        for axis in 0..2 {
            let gain = moved[axis] / answered[axis];
            if answered[axis].abs() > TELLING && gain.is_finite() {
                self.gains[axis] = gain.clamp(GAINS.0, GAINS.1);
            }
        }
    }
}
