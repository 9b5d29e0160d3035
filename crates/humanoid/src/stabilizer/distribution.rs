//! Distribution of the zero moment point between the feet. Main function: [`distribute`].

use nalgebra::{Point2, Vector2};

use crate::gait::{Biped, Footprint, Polygon, Side};

/// The number of halvings with which a point is moved into a polygon.
const HALVINGS: usize = 20;

/// The share of the weight and the centre of pressure of a sole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// The share of the weight.
    pub share: f64,
    /// The centre of pressure, in the frame of the sole \[m\].
    pub pressure: Point2<f64>,
}

/// The point between `inside` and `wanted` that is nearest to `wanted` and at least `margin` inside the polygon.
pub(super) fn within(polygon: &Polygon, inside: &Point2<f64>, wanted: &Point2<f64>, margin: f64) -> Point2<f64> {
    if polygon.signed_distance(wanted) >= margin {
        return *wanted;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if polygon.signed_distance(&(inside + middle * (wanted - inside))) >= margin {
            low = middle;
        } else {
            high = middle;
        }
    }
    inside + low * (wanted - inside)
}

/// The middle of a sole in its frame \[m\].
pub(super) fn middle(biped: &Biped, side: usize) -> Vector2<f64> {
    let [low, high] = extent(biped, side);
    (low + high) / 2.0
}

/// The least and the greatest coordinates of a sole in its frame \[m\].
pub(super) fn extent(biped: &Biped, side: usize) -> [Vector2<f64>; 2] {
    let corners = &biped.feet[side].corners;
    let far = Vector2::repeat(f64::INFINITY);
    corners.iter().fold([far, -far], |[low, high], corner| [low.inf(&corner.coords), high.sup(&corner.coords)])
}

/// Distributes the zero moment point between the soles that stand on `prints`. Between two feet the weight is shared by the projection onto the line between
/// the middles of the soles; what remains is the same displacement of both centres of pressure, which stay `margin` inside the soles.
pub(super) fn distribute(
    biped: &Biped,
    prints: &[Footprint; 2],
    stands: [bool; 2],
    zmp: &Point2<f64>,
    margin: f64,
) -> [Part; 2] {
    let middles = [0, 1].map(|side| prints[side].carry(&Point2::from(middle(biped, side))));
    let line = middles[1] - middles[0];
    let right = match stands {
        [true, false] => 0.0,
        [false, true] => 1.0,
        _ => ((zmp - middles[0]).dot(&line) / line.norm_squared()).clamp(0.0, 1.0),
    };
    let remains = zmp - (middles[0] + right * line);
    [Side::Left, Side::Right].map(|side| {
        let index = side as usize;
        let at = prints[index].seen(&(middles[index] + remains));
        let [low, high] = extent(biped, index);
        let room = Vector2::repeat(margin).inf(&((high - low) / 2.0));
        let pressure = at.coords.sup(&(low + room)).inf(&(high - room));
        Part { share: if index == 1 { right } else { 1.0 - right }, pressure: Point2::from(pressure) }
    })
}
