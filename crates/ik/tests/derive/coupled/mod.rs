//! Tests of `groebot_ik::derive::coupled`.

mod humanoid;
mod order;
mod reader;
mod yaw;

/// Knuth's linear congruential generator (The Art of Computer Programming 2, 3.3.4).
struct Random(u64);

impl Random {
    /// Angles in (-pi, pi).
    fn angles(&mut self, count: usize) -> Vec<f64> {
        let mut angle = || {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            std::f64::consts::PI * ((self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
        };
        (0..count).map(|_| angle()).collect()
    }
}

/// The largest difference of two vectors of angles.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let turn = std::f64::consts::TAU;
    let one = |(a, b): (&f64, &f64)| ((a - b) - turn * ((a - b) / turn).round()).abs();
    a.iter().zip(b).map(one).fold(0.0, f64::max)
}
