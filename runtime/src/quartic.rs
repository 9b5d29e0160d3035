//! The real roots of an ordinary quartic, several times faster than by [`crate::roots::real_roots`]. Ferrari's method gives two quadratics (Cardano, Ars Magna,
//! 1545), then two Newton steps improve all roots at once. Whether a quartic is ordinary is tested. Where a quantity is near a limit, the result is `None`, and
//! the caller uses the general method.

use crate::arithmetic::Arithmetic;
use crate::number::Scale;
use crate::tolerances::{POLISHING, ROOTS};

/// The leading coefficient of an ordinary quartic exceeds this fraction of the largest coefficient. Then the division by it costs few digits.
const ORDINARY_LEAD: f64 = 1e-2;
/// Maximal number of Newton steps for the resolvent.
const RESOLVENT_STEPS: usize = 24;

/// Real roots in ascending order, and their number.
type Ordinary = ([f64; 4], usize);

/// All real roots of the quartic with these coefficients, constant term first. `scale` has the typical size of the unknown. `None` where the quartic is not
/// ordinary: its leading coefficient is small, roots are close to each other, complex roots are close to the real axis, or the steps do not converge.
pub(crate) fn ordinary_roots(coefficients: &[f64; 5], scale: Scale) -> Option<Ordinary> {
    let [e, d, c, b, lead] = *coefficients;
    let largest = coefficients.iter().fold(0.0, |largest, c| f64::max(largest, c.abs()));
    if !(lead.abs() > ORDINARY_LEAD * largest && largest < f64::INFINITY) {
        return None;
    }
    let inverse = 1.0 / lead;
    let monic = [e * inverse, d * inverse, c * inverse, b * inverse];
    let (mut roots, count) = approximate_roots(&monic, scale)?;
    for root in &mut roots {
        *root = settled(&monic, *root, scale.at(0.0));
    }
    if count == 4 {
        let (low, high) = (f64::min(roots[1], roots[3]), f64::max(roots[0], roots[2]));
        roots = [f64::min(roots[0], roots[2]), f64::min(low, high), f64::max(low, high), f64::max(roots[1], roots[3])];
    }
    // A root that has not converged is NaN, and fails every comparison.
    let apart = |pair: &[f64]| pair[1] - pair[0] > ROOTS.distinct * f64::max(scale.at(pair[0]), scale.at(pair[1]));
    roots[..count].windows(2).all(apart).then_some((roots, count))
}

/// The roots of the two real quadratics whose product is `x^4 + b x^3 + c x^2 + d x + e`: two of each, ascending; those of the second follow those of the
/// first.
fn approximate_roots(&[e, d, c, b]: &[f64; 4], scale: Scale) -> Option<Ordinary> {
    // With y = x + b / 4 it is y^4 + p y^2 + q y + r.
    let (quarter, square) = (0.25 * b, b * b);
    let p = c - 0.375 * square;
    let q = d - 0.5 * b * (c - 0.25 * square);
    let r = e - quarter * (d - quarter * (c - 0.1875 * square));
    // (y^2 + h y + f) (y^2 - h y + g) with z = h^2.
    let typical = scale.at(0.0);
    let z = resolved(2.0 * p, p * p - 4.0 * r, q * q, typical * typical)?;
    let h = Arithmetic::sqrt(z);
    let (mean, half) = (0.5 * (p + z), 0.5 * q / h);
    let (f, g) = (mean - half, mean + half);
    let size = f64::max(f64::max(z, f.abs()), g.abs());
    let (mut roots, mut count) = ([0.0; 4], 0);
    for (other, discriminant, middle) in [(g, z - 4.0 * f, -0.5 * h), (f, z - 4.0 * g, 0.5 * h)] {
        let apart = 0.5 * Arithmetic::sqrt(discriminant.abs());
        if discriminant > 0.0 {
            roots[count] = middle - apart - quarter;
            roots[count + 1] = middle + apart - quarter;
            count += 2;
        } else if !(apart > ROOTS.distinct * scale.at(Arithmetic::sqrt(size))
            && (other + 0.75 * z).abs() > ROOTS.distinct * f64::max(size, typical * typical))
        {
            return None;
        }
    }
    Some((roots, count))
}

/// The greatest root of `z^3 + u z^2 + v z - w` for `w > 0`, to half its digits. Newton steps start at an upper bound: a root above `typical` has `z^2 <= -u z
/// - v + w / typical`.
fn resolved(u: f64, v: f64, w: f64, typical: f64) -> Option<f64> {
    let (falling, under) = (f64::max(-u, 0.0), f64::max(-v, 0.0));
    let inside = falling * falling + 4.0 * (under + w / typical);
    let mut z = f64::max(typical, 0.5 * (falling + Arithmetic::sqrt(inside)));
    for _ in 0..RESOLVENT_STEPS {
        let value = ((z + u) * z + v) * z - w;
        let slope = (3.0 * z + 2.0 * u) * z + v;
        let step = value / slope;
        z -= step;
        if step.abs() <= ROOTS.close * z {
            return (w > 0.0).then_some(z);
        }
    }
    None
}

/// Two Newton steps from the approximation of a root. NaN where they do not converge.
fn settled(&[e, d, c, b]: &[f64; 4], mut x: f64, scale: f64) -> f64 {
    let mut step = 0.0;
    for _ in 0..2 {
        let value = (((x + b) * x + c) * x + d) * x + e;
        let slope = ((4.0 * x + 3.0 * b) * x + 2.0 * c) * x + d;
        step = value / slope;
        x -= step;
    }
    if f64::abs(step) <= POLISHING.step * f64::max(scale, x.abs()) { x } else { f64::NAN }
}
