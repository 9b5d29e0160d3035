//! Quantiles of Student's t and the chi-square distribution.

use std::f64::consts::PI;

/// Number of degrees of freedom from which on the quantile is computed from its asymptotic expansion, with an error
/// below 1e-8.
const MANY: usize = 1000;
/// Normal quantiles: 95 % within this number of standard deviations, and 99.9 % below the other.
const NORMAL_95: f64 = 1.959_963_984_540_054;
const NORMAL_999: f64 = 3.090_232_306_167_813_5;

/// The bound that contains 95 % of Student's t distribution (M. Abramowitz and I. A. Stegun, Handbook of Mathematical
/// Functions, 26.7.3 to 26.7.5).
pub(super) fn student_95(freedom: usize) -> f64 {
    if freedom > MANY {
        let (z, nu) = (NORMAL_95, freedom as f64);
        return z + (z.powi(3) + z) / (4.0 * nu) + (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / (96.0 * nu * nu);
    }
    let (mut low, mut high) = (1.0, 13.0);
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if student_within(middle, freedom) < 0.95 { low = middle } else { high = middle }
    }
    high
}

/// The probability that Student's t is within a bound.
fn student_within(bound: f64, freedom: usize) -> f64 {
    let angle = (bound / (freedom as f64).sqrt()).atan();
    let (sine, cosine) = angle.sin_cos();
    let is_odd = freedom % 2 == 1;
    let first = if is_odd { cosine } else { 1.0 };
    let (mut sum, mut term, mut at) = (0.0, first, if is_odd { 1 } else { 0 });
    while at + 2 <= freedom {
        sum += term;
        at += 2;
        term *= cosine * cosine * (at - 1) as f64 / at as f64;
    }
    if is_odd { 2.0 / PI * (angle + sine * sum) } else { sine * sum }
}

/// The 99.9 % quantile of the chi-square distribution (E. B. Wilson and M. M. Hilferty, Proc. National Academy of
/// Sciences 17, 1931).
pub(super) fn chi_square_999(freedom: usize) -> f64 {
    let share = 2.0 / (9.0 * freedom as f64);
    freedom as f64 * (1.0 - share + NORMAL_999 * share.sqrt()).powi(3)
}

/// Factor by which bounds widen when the standard deviation is estimated from few values.
pub(super) fn widening(freedom: usize) -> f64 {
    student_95(freedom) / NORMAL_95
}
