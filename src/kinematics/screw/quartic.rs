//! Equations of one joint that are sums of products of two forms: quartics in the displacement, or in the tangent of half the
//! angle, measured from where infinity is no root.

use std::f64::consts::{FRAC_PI_4, PI};

use smallvec::SmallVec;

use super::one_joint::angles_at_height;
use super::values::Reach;
use crate::roots::real_roots;
use crate::spatial::angle;

/// A function of one joint: coefficients of 1, cos q, sin q when it turns, of 1, q, q^2 when it slides.
pub(super) type Form = [f64; 3];

/// How flat a quartic may be, relative to its terms, where it comes near zero without a certain root.
const FLAT: f64 = 1e-3;

/// A quartic whose values are below this share of its terms vanishes identically.
const VANISHING: f64 = 1e-13;

/// `sum weight f g = 0`, an equation for one joint.
pub(super) struct Equation {
    pub turns: bool,
    pub terms: SmallVec<[(f64, Form, Form); 5]>,
}

impl Equation {
    /// Whether every value solves it, to rounding.
    pub fn vanishes(&self) -> bool {
        let (mut sum, mut size) = ([0.0; 5], [0.0; 5]);
        for (weight, f, g) in &self.terms {
            for (i, term) in product(f, g).into_iter().enumerate() {
                sum[i] += weight * term;
            }
            for (i, term) in product(&f.map(f64::abs), &g.map(f64::abs)).into_iter().enumerate() {
                size[i] += weight.abs() * term;
            }
        }
        if self.turns {
            // cos^2 + sin^2 = 1: the products' coefficients are those of 1, c, s (twice) and c^2, c s, s^2.
            let worst = (0..8).map(|i| self.value(FRAC_PI_4 * f64::from(i) + 0.1).abs()).fold(0.0, f64::max);
            return worst <= VANISHING * size.iter().sum::<f64>();
        }
        sum.iter().all(|c| c.abs() <= VANISHING * size.iter().sum::<f64>())
    }

    /// All solutions, and the values between which two solutions may hide: where the quartic is nearly zero and flat.
    pub fn candidates(&self) -> SmallVec<[f64; 16]> {
        if !self.turns {
            return near_roots(&self.quartic(|form| *form));
        }
        let origin = self.farthest() + PI;
        let (sine, cosine) = origin.sin_cos();
        let in_half_tangent = |[one, c, s]: &Form| {
            let (c, s) = (c * cosine + s * sine, s * cosine - c * sine);
            [one + c, 2.0 * s, one - c]
        };
        let tangents = near_roots(&self.quartic(in_half_tangent));
        tangents.into_iter().map(|tangent| angle::wrap(origin + 2.0 * tangent.atan())).collect()
    }

    /// The angle, of eight, where the equation is farthest from holding.
    fn farthest(&self) -> f64 {
        let angles = (0..8).map(|i| FRAC_PI_4 * f64::from(i));
        angles.max_by(|a, b| self.value(*a).abs().total_cmp(&self.value(*b).abs())).unwrap_or(0.0)
    }

    /// The left-hand side at an angle.
    fn value(&self, q: f64) -> f64 {
        let (s, c) = q.sin_cos();
        let at = |form: &Form| form[0] + form[1] * c + form[2] * s;
        self.terms.iter().map(|(weight, f, g)| weight * at(f) * at(g)).sum()
    }

    /// The coefficients, constant term first, of the sum of products of the forms as quadratic polynomials.
    fn quartic(&self, polynomial: impl Fn(&Form) -> Form) -> [f64; 5] {
        let mut sum = [0.0; 5];
        for (weight, f, g) in &self.terms {
            for (c, term) in sum.iter_mut().zip(product(&polynomial(f), &polynomial(g))) {
                *c += weight * term;
            }
        }
        sum
    }
}

/// The values that make one form zero or bring it nearest to zero.
pub(super) fn zeros(form: &Form, turns: bool) -> SmallVec<[f64; 16]> {
    let [one, first, second] = *form;
    if turns {
        let size = one.abs() + first.hypot(second);
        return angles_at_height(first, second, -one, size, Reach::Closest).iter().collect();
    }
    near_roots(&[one, first, second, 0.0, 0.0])
}

/// The product of two quadratic polynomials.
fn product(f: &Form, g: &Form) -> [f64; 5] {
    [
        f[0] * g[0],
        f[0] * g[1] + f[1] * g[0],
        f[0] * g[2] + f[1] * g[1] + f[2] * g[0],
        f[1] * g[2] + f[2] * g[1],
        f[2] * g[2],
    ]
}

/// The real roots of a quartic, its stationary points where it is nearly zero, and where its parabola there has roots.
fn near_roots(quartic: &[f64; 5]) -> SmallVec<[f64; 16]> {
    let mut list: SmallVec<[f64; 16]> = real_roots(quartic, 1.0).as_slice().iter().copied().collect();
    let slope: [f64; 4] = std::array::from_fn(|i| (i + 1) as f64 * quartic[i + 1]);
    for &x in real_roots(&slope, 1.0).as_slice() {
        let powers = [1.0, x, x * x, x.powi(3), x.powi(4)];
        let value: f64 = quartic.iter().zip(powers).map(|(c, power)| c * power).sum();
        let size: f64 = quartic.iter().zip(powers).map(|(c, power)| (c * power).abs()).sum();
        if value.abs() <= FLAT * size {
            let bend = quartic[2] + 3.0 * quartic[3] * x + 6.0 * quartic[4] * x * x;
            let step = (value / bend).abs().sqrt().min(0.1).max(1e-7 * x.abs().max(1.0));
            list.extend([x, x - step, x + step]);
        }
    }
    list
}
