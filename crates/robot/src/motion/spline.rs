//! A motion that is continuous up to the acceleration. Main type: [`Spline`].

use crate::{Error, ErrorKind, Result};

/// A motion of joints through knots with position, velocity and acceleration. Polynomials of degree five between the
/// knots make all three continuous.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    times: Vec<f64>,
    /// For each knot: configuration, velocity, acceleration.
    knots: Vec<[Vec<f64>; 3]>,
}

impl Spline {
    /// Builds the spline through knots. Each has a time \[s\], a configuration, a velocity and an acceleration.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for fewer than two knots, times that do not increase, lists of different lengths, and
    /// numbers that are not finite.
    pub fn new(times: Vec<f64>, knots: Vec<[Vec<f64>; 3]>) -> Result<Self> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if times.len() < 2 || times.len() != knots.len() {
            return bad(format!(
                "{} times and {} places are given; give two or more of each",
                times.len(),
                knots.len()
            ));
        }
        let count = knots[0][0].len();
        for (row, (time, knot)) in times.iter().zip(&knots).enumerate() {
            let lists_are_right = knot.iter().all(|list| list.len() == count && list.iter().all(|x| x.is_finite()));
            if !time.is_finite() || !lists_are_right {
                return bad(format!("row {}: give a time and {count} finite numbers in each list", row + 1));
            }
            if row > 0 && *time <= times[row - 1] {
                return bad(format!("row {}: the time {time} is not after {}", row + 1, times[row - 1]));
            }
        }
        Ok(Spline { times, knots })
    }

    /// Builds the spline through positions only: the natural cubic spline, whose acceleration is zero at both ends.
    ///
    /// # Errors
    /// Those of [`Spline::new`].
    pub fn through(times: Vec<f64>, places: Vec<Vec<f64>>) -> Result<Self> {
        let still = |q: Vec<f64>| {
            let zeros = vec![0.0; q.len()];
            [q, zeros.clone(), zeros]
        };
        let mut spline = Spline::new(times, places.into_iter().map(still).collect())?;
        for joint in 0..spline.joints() {
            spline.fit(joint);
        }
        Ok(spline)
    }

    /// Velocities and accelerations of a joint by the natural cubic spline: a tridiagonal system for the accelerations.
    fn fit(&mut self, joint: usize) {
        let (times, last) = (&self.times, self.times.len() - 1);
        let q = |at: usize| self.knots[at][0][joint];
        let width = |at: usize| times[at + 1] - times[at];
        let slope = |at: usize| (q(at + 1) - q(at)) / width(at);
        let (mut factors, mut right) = (vec![0.0; last + 1], vec![0.0; last + 1]);
        for at in 1..last {
            let pivot = 2.0 * (width(at - 1) + width(at)) - width(at - 1) * factors[at - 1];
            factors[at] = width(at) / pivot;
            right[at] = (6.0 * (slope(at) - slope(at - 1)) - width(at - 1) * right[at - 1]) / pivot;
        }
        for at in (1..last).rev() {
            right[at] -= factors[at] * right[at + 1];
        }
        let rate = |at: usize| slope(at) - width(at) * (2.0 * right[at] + right[at + 1]) / 6.0;
        let mut rates: Vec<f64> = (0..last).map(rate).collect();
        rates.push(slope(last - 1) + width(last - 1) * (right[last - 1] + 2.0 * right[last]) / 6.0);
        for (at, (rate, change)) in rates.into_iter().zip(right).enumerate() {
            (self.knots[at][1][joint], self.knots[at][2][joint]) = (rate, change);
        }
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.knots[0][0].len()
    }

    /// Start and end time \[s\].
    pub fn times(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// Configuration, velocity and acceleration at a time \[s\]. Before the start and after the end the motion is at
    /// rest.
    pub fn at(&self, time: f64) -> [Vec<f64>; 3] {
        let [begin, end] = self.times();
        if !(begin..=end).contains(&time) {
            let knot = if time < begin { &self.knots[0] } else { &self.knots[self.knots.len() - 1] };
            let zeros = vec![0.0; self.joints()];
            return [knot[0].clone(), zeros.clone(), zeros];
        }
        let next = self.times.partition_point(|knot| *knot <= time).clamp(1, self.times.len() - 1);
        let (from, to) = (&self.knots[next - 1], &self.knots[next]);
        let width = self.times[next] - self.times[next - 1];
        let share = (time - self.times[next - 1]) / width;
        let mut all = [0; 3].map(|_| Vec::with_capacity(self.joints()));
        for joint in 0..self.joints() {
            let ends = [from, to].map(|knot| [knot[0][joint], knot[1][joint] * width, knot[2][joint] * width * width]);
            let [q, rate, change] = quintic(ends, share);
            all[0].push(q);
            all[1].push(rate / width);
            all[2].push(change / (width * width));
        }
        all
    }
}

/// Value, first and second derivative, at the parameter `t` in \[0, 1\], of the polynomial of degree five with these
/// values at both ends.
fn quintic([[p, v, a], [q, w, b]]: [[f64; 3]; 2], t: f64) -> [f64; 3] {
    let (d, dv, da) = (q - p - v - 0.5 * a, w - v - a, b - a);
    let c = [10.0 * d - 4.0 * dv + 0.5 * da, -15.0 * d + 7.0 * dv - da, 6.0 * d - 3.0 * dv + 0.5 * da];
    let cubic = t * t * t;
    [
        p + t * (v + 0.5 * a * t) + cubic * (c[0] + t * (c[1] + t * c[2])),
        v + a * t + t * t * (3.0 * c[0] + t * (4.0 * c[1] + 5.0 * t * c[2])),
        a + t * (6.0 * c[0] + t * (12.0 * c[1] + 20.0 * t * c[2])),
    ]
}
