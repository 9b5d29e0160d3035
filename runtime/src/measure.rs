//! Residuals ([`Fits`]) and joint values ([`joints`]) of several candidates at once.

use core::array::from_fn;

use crate::angles::{FAR_APART, acute, unfold};
use crate::approach::abreast;
use crate::counters::Phase;
use crate::lanes::Lanes;
use crate::mechanism::{Abreast, Facts, Joint, Joints, Mechanism, Places};
use crate::number::Number;
use crate::problem::{Problem, everywhere, fit};
use crate::storage::Array;
use crate::tolerances::ACCEPTANCE;

/// Residuals of candidates, and whether a candidate is valid: 1, else 0.
pub(crate) struct Fits<M: Mechanism> {
    pub residual: Abreast<M>,
    pub relative: Abreast<M>,
    pub sound: Abreast<M>,
}

impl<M: Mechanism> Fits<M> {
    /// Measures the first `waiting` candidates. So many of them in a row may have equal residuals.
    #[inline(always)]
    pub fn new<const W: usize>(
        problem: &Problem<'_, M>,
        at: &Places<M, Abreast<M>>,
        waiting: usize,
        alike: usize,
    ) -> Self {
        let _phase = Phase::Waiting.begin();
        let room = problem.facts().candidates;
        let none = || Array::by(room, |_| 0.0);
        let mut fits: Fits<M> = Fits { residual: none(), relative: none(), sound: none() };
        let p = everywhere::<M, W>(problem);
        for first in (0..waiting.min(room)).step_by(W * alike) {
            let at: Places<M, Lanes<W>> = abreast::<M, W>(at, first, alike);
            let [residual, relative] = fit::<M, W>(problem.mechanism, &p, &at);
            let sound = sound::<M, W>(&problem.facts(), &at);
            for k in 0..W * alike {
                fits.residual.as_mut()[first + k] = residual.0[k / alike];
                fits.relative.as_mut()[first + k] = relative.0[k / alike];
                fits.sound.as_mut()[first + k] = sound.0[k / alike];
            }
        }
        fits
    }
}

/// Whether candidates have finite pairs near the unit circle: 1, else 0.
#[inline(always)]
fn sound<M: Mechanism, const W: usize>(facts: &Facts<'_>, at: &Places<M, Lanes<W>>) -> Lanes<W> {
    let (mut sound, at) = (Lanes([1.0; W]), at.as_ref());
    for joint in facts.joints {
        sound = match *joint {
            Joint::Angle([c, s]) => sound.where_below((at[c] * at[c] + at[s] * at[s] - 1.0).abs(), ACCEPTANCE.rounding),
            Joint::Length(place) => sound.where_below(at[place].abs(), f64::MAX),
        };
    }
    if facts.has_extras {
        sound = at.iter().fold(sound, |sound, number| sound.where_below(number.abs(), f64::MAX));
    }
    sound
}

/// The joint values, by joint and candidate. Angles that differ only in sign, as at an ordinary target, are computed once.
#[inline(always)]
pub(crate) fn joints<M: Mechanism, const W: usize>(
    facts: &Facts<'_>,
    at: &Places<M, Abreast<M>>,
    is_ordinary: bool,
) -> Joints<M, Abreast<M>> {
    let mut q: Joints<M, Abreast<M>> = Array::by(facts.joints.len(), |_| Array::by(facts.candidates, |_| 0.0));
    let at = at.as_ref();
    for (i, (joint, q)) in facts.joints.iter().zip(q.as_mut()).enumerate() {
        match *joint {
            Joint::Angle([c, s]) => {
                let alike = if is_ordinary { (facts.runs[i] | (facts.candidates / W)).trailing_zeros() } else { 0 };
                find_angles::<M, W>(at[c].as_ref(), at[s].as_ref(), alike, q.as_mut());
            }
            Joint::Length(place) => q.clone_from(&at[place]),
        }
    }
    q
}

/// Computes angles of which `2^alike` consecutive ones differ only in sign.
#[inline(always)]
fn find_angles<M: Mechanism, const W: usize>(cosines: &[f64], sines: &[f64], alike: u32, angles: &mut [f64]) {
    let room = cosines.len();
    let mut acutes: Abreast<M> = Array::by(room, |_| 0.0);
    let acutes = acutes.as_mut();
    for k in (0..room >> alike).step_by(W) {
        let pair = |row: &[f64]| Lanes::<W>(from_fn(|lane| row[(k + lane) << alike].abs()));
        acutes[k..k + W].copy_from_slice(&acute(pair(cosines), pair(sines)).0);
    }
    for k in (0..room).step_by(W) {
        let pair = |row: &[f64]| Lanes::<W>(from_fn(|lane| row[k + lane]));
        let own = Lanes(from_fn(|lane| acutes[(k + lane) >> alike]));
        angles[k..k + W].copy_from_slice(&unfold(own, pair(cosines), pair(sines)).0);
    }
}

/// Whether two solutions differ in at least one angle.
#[inline(always)]
pub(crate) fn tell_apart<M: Mechanism>(facts: &Facts<'_>, a: &Joints<M, [f64; 2]>, b: &Joints<M, [f64; 2]>) -> bool {
    let (a, b) = (a.as_ref(), b.as_ref());
    for &i in facts.last_first {
        if facts.joints[i].is_angle() && a[i][0] * b[i][0] + a[i][1] * b[i][1] < FAR_APART {
            return true;
        }
    }
    false
}
