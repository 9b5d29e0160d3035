//! One guarded Newton step on a root of a polynomial.

/// The point `x - p(x)/p'(x)` if `|p|` is smaller there, else `x`; `coefficients` has the constant term first.
///
/// It never increases `|p|` as evaluated by Horner's rule, and returns `x` when anything is not finite.
pub fn polish(coefficients: &[f64], x: f64) -> f64 {
    let (mut value, mut slope) = (0.0, 0.0);
    for c in coefficients.iter().rev() {
        slope = slope * x + value;
        value = value * x + c;
    }
    let next = x - value / slope;
    let next_value = coefficients.iter().rev().fold(0.0, |value, c| value * next + c);
    if next.is_finite() && next_value.abs() < value.abs() { next } else { x }
}
