//! Functions that printed equations of motion use: cosines and sines of all joints at once.

use core::f64::consts::TAU;

use crate::six_axes::vector;

/// An angle beyond this is first reduced by whole turns \[rad\].
const FAR: f64 = 1e6;

/// The cosines and the sines of angles in rad, each within one unit of its last place up to a million rad.
#[inline(always)]
pub fn cosines_and_sines<const N: usize>(angles: &[f64; N]) -> [[f64; N]; 2] {
    let mut near = *angles;
    for angle in &mut near {
        if !(-FAR..=FAR).contains(angle) {
            *angle %= TAU;
        }
    }
    vector::cosines_and_sines(&near)
}
