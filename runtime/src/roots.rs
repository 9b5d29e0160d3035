//! Real roots of polynomials in one unknown. Main type: [`Roots`].

use crate::arithmetic::Arithmetic;
pub use crate::number::Roots;
use crate::number::{Number, Scale};
use crate::quartic;
use crate::tolerances::ROOTS;

/// The sign of `p(x)` is undetermined up to `degree ROUNDING sum |a_i x^i|`.
const ROUNDING: f64 = 2.0 * f64::EPSILON;
/// Maximal number of iterations for each root.
const MAX_STEPS: usize = 256;
/// Maximal degree of a polynomial.
pub const MAX_DEGREE: usize = 16;
pub(crate) const MOST: usize = MAX_DEGREE + 1;

impl<const D: usize> Roots<f64, D> {
    const NONE: Self = Roots { values: [0.0; D], count: 0, doubts: [false; D] };

    fn push(&mut self, x: f64) {
        if x.is_finite() && self.count < D {
            self.values[self.count] = x + 0.0;
            self.count += 1;
        }
    }

    /// The first of them, up to the capacity `L`.
    fn within<const L: usize>(&self) -> Roots<f64, L> {
        let mut roots = Roots::NONE;
        self.as_slice().iter().for_each(|x| roots.push(*x));
        roots.doubts = [self.doubts.first() == Some(&true); L];
        roots
    }
}

/// All real roots of `x^2 + constant`. The tolerance of a negative radicand is relative to the unknown's typical size `scale`.
#[inline(always)]
pub(crate) fn of_square(constant: f64, scale: f64, tangent: f64) -> Roots<f64, 2> {
    let is_met = f64::MIN <= constant && constant <= tangent * constant.greater(scale * scale);
    if !is_met {
        return Roots::NONE;
    }
    if constant >= 0.0 {
        return Roots { values: [0.0; 2], count: 1, doubts: [true; 2] };
    }
    let root = Arithmetic::sqrt(-constant);
    Roots { values: [-root, root], count: 2, doubts: [root <= ROOTS.close * scale; 2] }
}

/// The roots of the first polynomial whose leading coefficient is not negligible, or of the last one.
pub(crate) fn of_the_leading<const D: usize>(polynomials: &[&[f64]], scale: Scale) -> Roots<f64, D> {
    let leads = |coefficients: &&&[f64]| {
        coefficients.last().is_some_and(|lead| lead.abs() > ROOTS.pivot * largest(coefficients))
    };
    let Some((last, earlier)) = polynomials.split_last() else { return Roots::NONE };
    scaled_roots(earlier.iter().find(leads).unwrap_or(last), scale)
}

/// All real roots of the polynomial with these coefficients, constant term first. Roots that agree within rounding are reported once. So is a double root that
/// misses the axis by rounding, relative to the unknown's typical size `scale`.
pub fn real_roots<const D: usize>(coefficients: &[f64], scale: f64) -> Roots<f64, D> {
    scaled_roots(coefficients, Scale::typical(scale))
}

fn scaled_roots<const D: usize>(coefficients: &[f64], scale: Scale) -> Roots<f64, D> {
    if let Some(roots) = coefficients.try_into().ok().and_then(|quartic| quartic::ordinary_roots(quartic, scale)) {
        let mut found = Roots::NONE;
        roots.0[..roots.1].iter().for_each(|x| found.push(*x));
        return found;
    }
    let mut roots = all_real_roots::<MOST>(coefficients, scale);
    let is_double = roots.count > 0 && roots.count % 2 == coefficients.len() % 2;
    let is_close = |pair: &[f64]| pair[1] - pair[0] <= ROOTS.close * scale.at(0.0);
    roots.doubts[0] = is_double || roots.as_slice().windows(2).any(is_close);
    roots.within()
}

fn all_real_roots<const L: usize>(coefficients: &[f64], scale: Scale) -> Roots<f64, L> {
    let Some(p) = Polynomial::new(coefficients, scale) else { return Roots::NONE };
    if p.degree < 2 {
        return p.linear_root();
    }
    let bound = p.root_bound();
    let mut roots = p.derivative(p.degree - 2).quadratic_roots();
    for order in (0..p.degree - 2).rev() {
        roots = p.derivative(order).roots_between(&roots, bound);
    }
    roots
}

fn largest(coefficients: &[f64]) -> f64 {
    coefficients.iter().fold(0.0, |largest, c| f64::max(largest, c.abs()))
}

/// A polynomial with coefficients of magnitude at most one, constant term first.
struct Polynomial {
    a: [f64; MOST],
    degree: usize,
    scale: Scale,
}

impl Polynomial {
    /// Drops negligible leading coefficients and divides by the largest. `None` when the rest is constant.
    fn new(coefficients: &[f64], scale: Scale) -> Option<Self> {
        let largest = largest(coefficients);
        let mut length = coefficients.len();
        while length > 0 && coefficients[length - 1].abs() <= ROOTS.zero * largest {
            length -= 1;
        }
        if length == 0 || length > MOST || !coefficients.iter().all(|c| c.is_finite()) {
            return None;
        }
        let mut a = [0.0; MOST];
        a[..length].copy_from_slice(&coefficients[..length]);
        Some(Polynomial { a, degree: length - 1, scale }.scaled())
    }

    /// The polynomial divided by its largest coefficient.
    fn scaled(mut self) -> Self {
        let largest = largest(&self.a[..=self.degree]);
        for c in &mut self.a[..=self.degree] {
            *c /= largest;
        }
        self
    }

    fn linear_root<const L: usize>(&self) -> Roots<f64, L> {
        let mut roots = Roots::NONE;
        if self.degree == 1 {
            roots.push(-self.a[0] / self.a[1]);
        }
        roots
    }

    /// The roots of a quadratic polynomial without cancellation; a double root is reported once.
    fn quadratic_roots<const L: usize>(&self) -> Roots<f64, L> {
        let mut roots = Roots::NONE;
        let (c, b, a) = (self.a[0], self.a[1], self.a[2]);
        let discriminant = b * b - 4.0 * a * c;
        let size = b * b + (4.0 * a * c).abs();
        let (typical, spread) = (2.0 * a * self.scale.at(0.0), self.scale.spread);
        if discriminant < -ROOTS.tangent * f64::max(size * (spread * spread), typical * typical) {
            return roots;
        }
        if discriminant <= ROUNDING * size {
            roots.push(-b / (2.0 * a));
            return roots;
        }
        let q = -0.5 * (b + Arithmetic::sqrt(discriminant).copysign(b));
        let (first, second) = (q / a, c / q);
        roots.push(f64::min(first, second));
        roots.push(f64::max(first, second));
        roots
    }

    /// A positive multiple of the derivative of `order`.
    fn derivative(&self, order: usize) -> Polynomial {
        let degree = self.degree - order;
        let mut a = [0.0; MOST];
        let mut binomial = 1.0;
        for (i, a) in a.iter_mut().enumerate().take(degree + 1) {
            *a = binomial * self.a[i + order];
            binomial = binomial * (i + 1 + order) as f64 / (i + 1) as f64;
        }
        Polynomial { a, degree, scale: self.scale }.scaled()
    }

    /// Two to four times Cauchy's bound: every root, and every root of a derivative, is well inside.
    fn root_bound(&self) -> f64 {
        let mut radius = 1.0;
        while !self.is_led(radius) {
            radius *= 2.0;
        }
        while self.is_led(0.5 * radius) {
            radius *= 0.5;
        }
        2.0 * radius
    }

    /// Whether `|a_n| r^n` exceeds the sum of all other `|a_i| r^i`: then no root is as large as `r`.
    fn is_led(&self, radius: f64) -> bool {
        let lead = self.a[self.degree].abs();
        self.a[..self.degree].iter().rev().fold(lead, |value, c| value * radius - c.abs()) > 0.0
    }

    /// The roots, given the ascending critical points and a bound on all of them. There is one in each interval with a change of sign. Critical points where
    /// `p` touches the axis are roots too.
    fn roots_between<const L: usize>(&self, critical: &Roots<f64, L>, bound: f64) -> Roots<f64, L> {
        let mut roots = Roots::NONE;
        let (mut low, mut low_sign) = (-bound, self.sign(-bound));
        let mut tangency = None;
        for &high in critical.as_slice().iter().chain(&[bound]) {
            let high_sign = self.sign(high);
            let crosses = low_sign * high_sign < 0.0;
            if crosses {
                roots.push(self.root_between(low, high));
            } else if let Some(x) = tangency {
                roots.push(x);
            }
            tangency = if !crosses && self.touches(high) { Some(high) } else { None };
            (low, low_sign) = (high, high_sign);
        }
        roots
    }

    /// The sign of `p(x)`: `-1`, `0` or `1`; zero where rounding determines it.
    fn sign(&self, x: f64) -> f64 {
        let (value, size) = self.value_and_size(x, x.abs());
        let noise = ROUNDING * self.degree as f64 * size;
        if value == 0.0 || (noise.is_finite() && value.abs() <= noise) { 0.0 } else { 1.0_f64.copysign(value) }
    }

    /// Whether `p(x)` is negligible.
    fn touches(&self, x: f64) -> bool {
        let (value, size) = self.value_and_size(x, self.scale.at(x));
        size.is_finite() && value.abs() <= ROOTS.tangent * size
    }

    /// `p(x)` and `sum |a_i y^i|`.
    fn value_and_size(&self, x: f64, y: f64) -> (f64, f64) {
        let (mut value, mut size) = (0.0, 0.0);
        for a in self.a[..=self.degree].iter().rev() {
            value = value * x + a;
            size = size * y + a.abs();
        }
        (value, size)
    }

    /// `p(x)` and `p'(x)`.
    fn value_and_slope(&self, x: f64) -> (f64, f64) {
        let (mut value, mut slope) = (0.0, 0.0);
        for a in self.a[..=self.degree].iter().rev() {
            slope = slope * x + value;
            value = value * x + a;
        }
        (value, slope)
    }

    /// The root between two points where `p` is monotone and changes its sign. Newton's method is used while it reduces its steps to a quarter and stays
    /// inside, else bisection.
    fn root_between(&self, mut low: f64, mut high: f64) -> f64 {
        let rising = self.sign(high) > 0.0;
        let mut x = 0.5 * low + 0.5 * high;
        let mut step = high - low;
        let mut arithmetic = true;
        for _ in 0..MAX_STEPS {
            let (value, slope) = self.value_and_slope(x);
            if value == 0.0 {
                return x;
            }
            if (value > 0.0) == rising {
                high = x;
            } else {
                low = x;
            }
            let newton = x - value / slope;
            if (newton - x).abs() <= f64::EPSILON * x.abs() {
                return f64::min(f64::max(newton, low), high);
            }
            let next = if low < newton && newton < high && 4.0 * (newton - x).abs() <= step {
                newton
            } else {
                arithmetic = !arithmetic;
                middle(low, high, arithmetic)
            };
            if next <= low || next >= high {
                return x;
            }
            step = (next - x).abs();
            x = next;
        }
        x
    }
}

/// The arithmetic mean, or one of the exponents: bounds may differ by hundreds of decades.
fn middle(low: f64, high: f64, arithmetic: bool) -> f64 {
    if arithmetic {
        return 0.5 * low + 0.5 * high;
    }
    if low < 0.0 && high > 0.0 {
        return 0.0;
    }
    let root = |bound: f64| Arithmetic::sqrt(f64::max(bound.abs(), f64::MIN_POSITIVE));
    (root(low) * root(high)).copysign(low + high)
}
