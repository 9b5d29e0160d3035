//! All real roots of a polynomial in `f64`: [`real_roots`], one method for every degree, with no allocation. Of most quartics the roots
//! are found by a quicker one first ([`super::quartic`]).
//!
//! Between two neighbouring critical points a polynomial is monotone, so it has at most one root there. The real
//! roots of the derivatives, from the quadratic one up to `p'`, are therefore found one after the other. A root at a
//! critical point (a tangency) shows no change of sign; it is recognised by the size of `p` against rounding.
//!
//! Sources: Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition (2002), section 1.8 (the quadratic)
//! and (5.3) (the error of Horner's rule); Gauss-Lucas (one root bound serves all derivatives).

use super::quartic::ordinary_roots;

/// The highest degree that [`real_roots`] solves.
pub const MAX_DEGREE: usize = 16;

/// A critical point with `|p| <= TANGENT sum |a_i y^i|`, `y` being the larger of `|x|` and the unknown's typical size, counts as
/// a root.
///
/// The coefficients of a derived solver carry relative errors of about `1e-13`; this leaves them three decades.
/// A root added this way is off by about `sqrt(TANGENT) = 1e-5` of that size at most: the caller polishes and checks it.
pub const TANGENT: f64 = 1e-10;

/// Values of `p` up to `degree ROUNDING sum |a_i x^i|` have no sign: Horner's rule and the rounding of the coefficients.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// A leading coefficient that is smaller than this share of the largest coefficient counts as zero.
const NEGLIGIBLE: f64 = 1e-290;

/// Steps per root: a bisection of each kind halves the bits that are open, 64 at most, and a Newton step may follow each.
const MAX_STEPS: usize = 256;

/// Up to [`MAX_DEGREE`] real numbers in ascending order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roots {
    values: [f64; MAX_DEGREE],
    count: usize,
}

impl Roots {
    const NONE: Roots = Roots { values: [0.0; MAX_DEGREE], count: 0 };

    /// The roots, ascending.
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.count]
    }

    fn push(&mut self, x: f64) {
        if x.is_finite() && self.count < MAX_DEGREE {
            self.values[self.count] = x + 0.0;
            self.count += 1;
        }
    }
}

/// All real roots of the polynomial with these coefficients, constant term first, in ascending order.
///
/// A multiple root, or roots that rounding cannot tell apart, are reported once. A polynomial that misses the axis by
/// less than [`TANGENT`] also has a root where it comes closest, so no tangency is lost to rounding: check the residual.
/// `scale` is the typical size of the unknown, against which such a miss is measured: 1 for a cosine, whose `x^2 + 1e-16` is
/// a tangency at 0. Zero measures it against the roots' own sizes.
/// Their number never exceeds the degree.
///
/// Leading coefficients below `1e-290` of the largest one are dropped. Larger ones stay, however small: they add roots
/// far away and lose none. None is returned for constants (zero included), for degrees over [`MAX_DEGREE`] after
/// dropping, and for coefficients that are not finite. Roots below `1e-150` in magnitude may merge.
pub fn real_roots(coefficients: &[f64], scale: f64) -> Roots {
    if let Ok(quartic) = coefficients.try_into()
        && let Some((values, count)) = ordinary_roots(quartic, scale)
    {
        let mut roots = Roots::NONE;
        values[..count].iter().for_each(|&x| roots.push(x));
        return roots;
    }
    let Some(p) = Polynomial::new(coefficients, scale) else { return Roots::NONE };
    if p.degree < 2 {
        return p.linear_root();
    }
    let bound = p.root_bound();
    let mut roots = p.derivative(p.degree - 2).quadratic_roots();
    for order in (0..p.degree - 2).rev() {
        roots = p.derivative(order).roots_between(roots.as_slice(), bound);
    }
    roots
}

/// All real roots of `x^2 + constant` in ascending order, as [`real_roots`] but that a miss is measured against `scale` alone: zero is a root
/// where the constant is no more than `tangent` times its square.
pub fn square_roots(constant: f64, scale: f64, tangent: f64) -> Roots {
    let mut roots = Roots::NONE;
    if constant.is_nan() || constant > tangent * f64::max(constant, scale * scale) {
        return roots;
    }
    if constant >= 0.0 {
        roots.push(0.0);
        return roots;
    }
    let root = (-constant).sqrt();
    roots.push(-root);
    roots.push(root);
    roots
}

/// A polynomial of degree `degree` with coefficients of magnitude one and less, constant term first.
struct Polynomial {
    a: [f64; MAX_DEGREE + 1],
    degree: usize,
    scale: f64,
}

impl Polynomial {
    /// Drops negligible leading coefficients and divides by the largest; `None` when nothing solvable is left.
    fn new(coefficients: &[f64], scale: f64) -> Option<Self> {
        let largest = largest(coefficients);
        let mut length = coefficients.len();
        while length > 0 && coefficients[length - 1].abs() <= NEGLIGIBLE * largest {
            length -= 1;
        }
        if length == 0 || length > MAX_DEGREE + 1 || !coefficients.iter().all(|c| c.is_finite()) {
            return None;
        }
        let mut a = [0.0; MAX_DEGREE + 1];
        a[..length].copy_from_slice(&coefficients[..length]);
        Some(Polynomial { a, degree: length - 1, scale }.scaled())
    }

    /// The polynomial divided by its largest coefficient.
    fn scaled(mut self) -> Self {
        let largest = largest(&self.a);
        for c in &mut self.a {
            *c /= largest;
        }
        self
    }

    /// A positive multiple of the derivative of `order`.
    fn derivative(&self, order: usize) -> Polynomial {
        let degree = self.degree - order;
        let mut a = [0.0; MAX_DEGREE + 1];
        let mut binomial = 1.0;
        for (i, target) in a[..=degree].iter_mut().enumerate() {
            *target = binomial * self.a[i + order];
            binomial = binomial * (i + 1 + order) as f64 / (i + 1) as f64;
        }
        Polynomial { a, degree, scale: self.scale }.scaled()
    }

    /// Two to four times Cauchy's radius: every root, and every root of a derivative, is well inside.
    fn root_bound(&self) -> f64 {
        let mut radius = 1.0;
        while !self.leads(radius) {
            radius *= 2.0;
        }
        while self.leads(0.5 * radius) {
            radius *= 0.5;
        }
        2.0 * radius
    }

    /// Whether `|a_n| r^n` is more than all other `|a_i| r^i` together: then no root is as large as `r`.
    fn leads(&self, radius: f64) -> bool {
        let mut value = self.a[self.degree].abs();
        for c in self.a[..self.degree].iter().rev() {
            value = value * radius - c.abs();
        }
        value > 0.0
    }

    fn linear_root(&self) -> Roots {
        let mut roots = Roots::NONE;
        if self.degree == 1 {
            roots.push(-self.a[0] / self.a[1]);
        }
        roots
    }

    /// The roots of a quadratic polynomial without cancellation, and the double root of a tangency once.
    fn quadratic_roots(&self) -> Roots {
        let mut roots = Roots::NONE;
        let [c, b, a] = [self.a[0], self.a[1], self.a[2]];
        let discriminant = b * b - 4.0 * a * c;
        let size = b * b + (4.0 * a * c).abs();
        let typical = 2.0 * a * self.scale;
        if discriminant < -TANGENT * size.max(typical * typical) {
            return roots;
        }
        if discriminant <= ROUNDING * size {
            roots.push(-b / (2.0 * a));
            return roots;
        }
        let q = -0.5 * (b + discriminant.sqrt().copysign(b));
        let (first, second) = (q / a, c / q);
        roots.push(first.min(second));
        roots.push(first.max(second));
        roots
    }

    /// The roots, given the ascending critical points and a bound on all of them. A tangency counts when `p` crosses
    /// the axis on neither side of it.
    fn roots_between(&self, critical: &[f64], bound: f64) -> Roots {
        let mut roots = Roots::NONE;
        let (mut low, mut low_value) = (-bound, self.signed_value(-bound));
        let mut tangency = None;
        for &high in critical.iter().chain(&[bound]) {
            let high_value = self.signed_value(high);
            let crosses = low_value * high_value < 0.0;
            if crosses {
                roots.push(self.root_between(low, high));
            } else if let Some(x) = tangency {
                roots.push(x);
            }
            tangency = (!crosses && self.touches(high)).then_some(high);
            (low, low_value) = (high, high_value);
        }
        roots
    }

    /// `-1`, `0` or `1`: the sign of `p(x)`, zero when rounding decides it.
    fn signed_value(&self, x: f64) -> f64 {
        let (value, size) = self.value_and_size(x, 0.0);
        let noise = ROUNDING * self.degree as f64 * size;
        if value == 0.0 || (noise.is_finite() && value.abs() <= noise) { 0.0 } else { 1.0_f64.copysign(value) }
    }

    /// Whether `p(x)` is negligible.
    fn touches(&self, x: f64) -> bool {
        let (value, size) = self.value_and_size(x, self.scale);
        size.is_finite() && value.abs() <= TANGENT * size
    }

    /// `p(x)` and `sum |a_i y^i|` for the larger `y` of `|x|` and `scale`.
    fn value_and_size(&self, x: f64, scale: f64) -> (f64, f64) {
        let (mut value, mut size) = (0.0, 0.0);
        for i in (0..=self.degree).rev() {
            value = value * x + self.a[i];
            size = size * x.abs().max(scale) + self.a[i].abs();
        }
        (value, size)
    }

    /// `p(x)` and `p'(x)`.
    fn value_and_slope(&self, x: f64) -> (f64, f64) {
        let (mut value, mut slope) = (0.0, 0.0);
        for i in (0..=self.degree).rev() {
            slope = slope * x + value;
            value = value * x + self.a[i];
        }
        (value, slope)
    }

    /// The root in `(low, high)`, where `p` is monotone and changes its sign: Newton's method, which must cut its
    /// steps to a quarter and stay between the bounds, else bisection.
    fn root_between(&self, mut low: f64, mut high: f64) -> f64 {
        let rising = self.signed_value(high) > 0.0;
        let mut x = 0.5 * low + 0.5 * high;
        let mut step = high - low;
        let mut arithmetic = true;
        for _ in 0..MAX_STEPS {
            let (value, slope) = self.value_and_slope(x);
            if value == 0.0 {
                return x;
            }
            if (value > 0.0) == rising {
                high = x
            } else {
                low = x
            }
            let newton = x - value / slope;
            if (newton - x).abs() <= f64::EPSILON * x.abs() {
                return newton.max(low).min(high);
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

fn largest(coefficients: &[f64]) -> f64 {
    coefficients.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()))
}

/// The arithmetic mean, or one that halves the exponents: bounds may be hundreds of decades apart.
fn middle(low: f64, high: f64, arithmetic: bool) -> f64 {
    if arithmetic {
        return 0.5 * low + 0.5 * high;
    }
    if low < 0.0 && high > 0.0 {
        return 0.0;
    }
    let magnitude = low.abs().max(f64::MIN_POSITIVE).sqrt() * high.abs().max(f64::MIN_POSITIVE).sqrt();
    magnitude.copysign(low + high)
}
