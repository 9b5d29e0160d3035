//! Preview control of the zero moment point (ZMP; Kajita and others 2003; Katayama and others 1985). The centre of mass of the cart-table model, a linear
//! inverted pendulum (LIPM), moves so that its ZMP follows a reference with a known future. Main type: [`Preview`].

use nalgebra::{Matrix4, Point2, RowVector4, Vector2, Vector3, Vector4};

use super::balance::{Balance, realised};
use super::biped::Biped;
use super::footprint::Footprint;
use super::legs::Legs;
use super::motion::{Motion, Samples};
use super::reference::{Reference, Style, between_stances, smooth};
use super::request::Request;
use super::schedule::{Action, Schedule};
use super::zmp::GRAVITY;
use crate::{Error, ErrorKind, Result, Watch};

/// The weight of the integrated error of the zero moment point; the weight of jerk is [`JERK_PRICE`]. Kajita's values.
const ERROR_PRICE: f64 = 1.0;
const JERK_PRICE: f64 = 1e-6;
/// The greatest number of iterations of the Riccati recursion.
const MOST_RECURSIONS: usize = 100_000;
/// The greatest relative change of the solution of Riccati's equation at convergence.
const SETTLED: f64 = 1e-13;
/// The greatest number of times that the difference between the zero moment points of multibody and cart is fed back:
/// Kajita's second stage, repeated.
const FEEDBACKS: usize = 3;
/// The distance between the zero moment point and its reference below which nothing is fed back \[m\]: a small part of
/// the soles of all robots.
const NEAR: f64 = 3e-3;

/// The gains of preview control for a height of the centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    height: f64,
    tick: f64,
    /// The feedback gains of the summed error and of position, velocity and acceleration.
    gains: RowVector4<f64>,
    /// The preview gain of the reference one sample in the future.
    next: f64,
    /// The preview gains of the later future: `read`, of a costate `s[k] = closed s[k + 1] + start r[k + 2]`, with the
    /// reference `r`.
    closed: Matrix4<f64>,
    start: Vector4<f64>,
    read: RowVector4<f64>,
}

impl Preview {
    /// Computes the optimal gains for a centre of mass at `height` \[m\] and samples `tick` \[s\] apart.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a number is not positive and finite, or no gains are found.
    pub fn new(height: f64, tick: f64) -> Result<Self> {
        let bad = |text: &str| Error::new(ErrorKind::BadValue, format!("preview control: {text}"));
        if !(height.is_finite() && height > 0.0 && tick.is_finite() && tick > 0.0) {
            return Err(bad("give a positive height and a positive time between samples"));
        }
        let (a, b) = augmented(height, tick);
        let p = riccati(&a, &b).ok_or_else(|| bad("Riccati's equation has no solution"))?;
        let weight = 1.0 / (JERK_PRICE + (b.transpose() * p * b).x);
        let gains: RowVector4<f64> = b.transpose() * p * a * weight;
        let closed = (a - b * gains).transpose();
        let start = -(closed * p * Vector4::x());
        Ok(Preview { height, tick, gains, next: -gains.x, closed, start, read: b.transpose() * weight })
    }

    /// The positions of the centre of mass whose zero moment point follows `reference`, for one coordinate, from rest
    /// above its first value. After its end the reference stays constant.
    pub fn follow(&self, reference: &[f64]) -> Vec<f64> {
        let Some((&first, &last)) = reference.first().zip(reference.last()) else { return Vec::new() };
        let future = self.future(reference);
        let (mut state, mut error) = (Vector3::new(first, 0.0, 0.0), 0.0);
        let mut positions = Vec::with_capacity(reference.len());
        for (sample, wanted) in reference.iter().enumerate() {
            positions.push(state.x);
            let zmp = state.x - self.height / GRAVITY * state.z;
            error += zmp - wanted;
            let next = reference.get(sample + 1).unwrap_or(&last);
            let feedback = self.gains.dot(&RowVector4::new(error, state.x, state.y, state.z));
            let jerk = -feedback - self.next * next - future[sample];
            state = advanced(&state, jerk, self.tick);
        }
        positions
    }

    /// For each sample, the jerk that the reference two and more samples in the future subtracts: the sum of all preview
    /// gains times that reference, by a recursion backward in time.
    fn future(&self, reference: &[f64]) -> Vec<f64> {
        let last = reference.last().copied().unwrap_or_default();
        // The costate of a constant reference.
        let resting = (Matrix4::identity() - self.closed).lu().solve(&self.start).unwrap_or_default() * last;
        let mut costate = resting;
        let mut jerks = vec![0.0; reference.len()];
        for (sample, jerk) in jerks.iter_mut().enumerate().rev() {
            costate = self.closed * costate + self.start * *reference.get(sample + 2).unwrap_or(&last);
            *jerk = (self.read * costate).x;
        }
        jerks
    }
}

/// The state of the cart after a tick of constant jerk.
fn advanced(state: &Vector3<f64>, jerk: f64, tick: f64) -> Vector3<f64> {
    let (x, v, a) = (state.x, state.y, state.z);
    Vector3::new(
        x + tick * (v + tick * (a / 2.0 + tick * jerk / 6.0)),
        v + tick * (a + tick * jerk / 2.0),
        a + tick * jerk,
    )
}

/// The linear system of summed error and cart: its state matrix and its input vector for jerk.
fn augmented(height: f64, tick: f64) -> (Matrix4<f64>, Vector4<f64>) {
    let share = height / GRAVITY;
    let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|unit| advanced(&unit, 0.0, tick));
    let zmp = |state: &Vector3<f64>| state.x - share * state.z;
    let column = |state: &Vector3<f64>| Vector4::new(zmp(state), state.x, state.y, state.z);
    let pushed = advanced(&Vector3::zeros(), 1.0, tick);
    let a = Matrix4::from_columns(&[Vector4::x(), column(&columns[0]), column(&columns[1]), column(&columns[2])]);
    (a, column(&pushed))
}

/// Solves the discrete algebraic Riccati equation by its recursion.
fn riccati(a: &Matrix4<f64>, b: &Vector4<f64>) -> Option<Matrix4<f64>> {
    let price = Matrix4::from_diagonal(&Vector4::new(ERROR_PRICE, 0.0, 0.0, 0.0));
    let mut p = price;
    for _ in 0..MOST_RECURSIONS {
        let pb = p * b;
        let gain = pb.transpose() * a / (JERK_PRICE + b.dot(&pb));
        let next = price + a.transpose() * p * a - (a.transpose() * pb) * gain;
        let next = (next + next.transpose()) / 2.0;
        let change = (next - p).norm();
        p = next;
        if change <= SETTLED * p.norm() {
            return p.iter().all(|x| x.is_finite()).then_some(p);
        }
    }
    None
}

/// The reference of the zero moment point: above the supporting foot in single support, and on a smooth path from foot
/// to foot in double support.
pub(crate) fn zmp_reference(
    style: &Style,
    schedule: &Schedule,
    action: Action,
    feet: &[Footprint; 2],
    share: f64,
) -> Point2<f64> {
    between_stances(style, schedule, action, feet, |_, [from, to]| from + (to - from) * smooth(share))
}

/// The reference of the zero moment point at each sample.
pub(super) fn wanted(style: &Style, schedule: &Schedule) -> Vec<Point2<f64>> {
    let stands = schedule.route.stands();
    let at = |(phase, share): (usize, f64)| {
        let action = schedule.phases[phase].action;
        zmp_reference(style, schedule, action, &Schedule::feet(&stands, action, phase == 0), share)
    };
    schedule.instants().map(at).collect()
}

/// The motion whose zero moment point follows its reference by preview control. The centres of `references` become
/// those of the walk.
///
/// # Errors
/// Those of [`super::motion::realise`].
pub(super) fn moved(
    biped: &Biped,
    legs: &Legs,
    request: &Request,
    schedule: &Schedule,
    references: &mut [Reference],
    watch: &Watch,
) -> Result<(Motion, Vec<Balance>)> {
    let (wanted, tick) = (wanted(&request.style, schedule), request.tick);
    let resting = realised(biped, legs, &Samples::new(&references[..1], request.tick), watch)?;
    let preview = Preview::new(resting.0.centres[0].z, request.tick)?;
    let follow = |positions: &[Vector2<f64>]| -> Vec<Vector2<f64>> {
        let [x, y] = [0, 1].map(|axis| preview.follow(&positions.iter().map(|point| point[axis]).collect::<Vec<_>>()));
        x.into_iter().zip(y).map(|(x, y)| Vector2::new(x, y)).collect()
    };
    let mut centres = follow(&wanted.iter().map(|point| point.coords).collect::<Vec<_>>());
    aim(references, &centres);
    let (mut motion, mut balances) = realised(biped, legs, &Samples::new(references, tick), watch)?;
    for _ in 0..FEEDBACKS {
        let missing: Vec<Vector2<f64>> = wanted
            .iter()
            .zip(&balances)
            .zip(&*references)
            .map(|((wanted, balance), reference)| match schedule.phases[reference.phase].action {
                // There the models agree, except at the jumps of the first and the last sample.
                Action::Rest => Vector2::zeros(),
                _ => wanted - balance.zmp,
            })
            .collect();
        if missing.iter().all(|missing| missing.norm() <= NEAR) {
            break;
        }
        for (centre, correction) in centres.iter_mut().zip(follow(&missing)) {
            *centre += correction;
        }
        aim(references, &centres);
        (motion, balances) = realised(biped, legs, &Samples::new(references, tick).alike(&motion), watch)?;
    }
    Ok((motion, balances))
}

/// Sets these centres of mass in the references.
fn aim(references: &mut [Reference], centres: &[Vector2<f64>]) {
    for (reference, centre) in references.iter_mut().zip(centres) {
        reference.centre = Point2::from(*centre);
    }
}
