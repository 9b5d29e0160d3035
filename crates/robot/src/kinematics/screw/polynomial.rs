//! The zeros of a polynomial of degree four in a displacement, from its values.

use smallvec::SmallVec;

use groebot_algebra::roots::{TANGENT, real_roots};

/// An extremum within this distance of a zero, in units of the size, is not a separate candidate.
const APART: f64 = 1e-3;

/// The displacements at which `f`, a polynomial of degree at most four, is zero or nearly zero. `size` is a typical
/// displacement. Includes extrema where `|f|` is at most `grain`, since rounding may hide a tangency when all of `f` is
/// small.
pub(super) fn zeros(size: f64, grain: f64, f: impl Fn(f64) -> f64) -> SmallVec<[f64; 16]> {
    let [m2, m1, zero, p1, p2] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|x| f(x * size));
    // The polynomial through five equidistant values, by central differences.
    let (odd1, odd2) = ((p1 - m1) / 2.0, (p2 - m2) / 2.0);
    let (even1, even2) = ((p1 + m1) / 2.0 - zero, (p2 + m2) / 2.0 - zero);
    let cubic = (odd2 - 2.0 * odd1) / 6.0;
    let quartic = (even2 - 4.0 * even1) / 12.0;
    let mut coefficients = [zero, odd1 - cubic, even1 - quartic, cubic, quartic];
    // Rounding leaves small coefficients of terms that are absent. They would add distant roots.
    let largest = coefficients.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    for coefficient in coefficients.iter_mut().rev() {
        if coefficient.abs() > 1e-13 * largest {
            break;
        }
        *coefficient = 0.0;
    }
    let mut found: SmallVec<[f64; 16]> = real_roots::<4>(&coefficients, 1.0).as_slice().iter().copied().collect();
    if grain > TANGENT * largest {
        let slope = [1, 2, 3, 4].map(|i| i as f64 * coefficients[i]);
        for &extremum in real_roots::<3>(&slope, 1.0).as_slice() {
            let is_new = found.iter().all(|x| (x - extremum).abs() > APART);
            if is_new && f(extremum * size).abs() <= grain {
                found.push(extremum);
            }
        }
    }
    found.iter().map(|x| x * size).collect()
}
