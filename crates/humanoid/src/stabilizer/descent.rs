//! How much the torso is lowered for a stretched leg. Main type: [`Descent`].

use crate::gait::GRAVITY;

/// How much higher the torso could be where a leg is stretched most, the most by which it is lowered for that, and the accuracy of this, as fractions of the
/// height of the centre of mass.
const ROOM: f64 = 0.002;
const LOWEST: f64 = 0.1;
const EXACT: f64 = 1e-5;
/// The bandwidth of the torso's return, as a multiple of the pendulum's rate.
const RETURN: f64 = 2.0;
/// The greatest vertical acceleration of this return, as a fraction of gravity. A torso that stops at once throws the robot: Atlas, uphill by 3 degrees, left
/// the floor with both feet when its trailing foot had lifted.
const GENTLE: f64 = 0.15;
/// The greatest speed at which the torso continues downwards when the leg is in reach again, as a fraction of the speed of a pendulum, sqrt(gravity height).
const FASTEST: f64 = 0.1;

/// The lowering of the torso and its rate. It is at least what the legs need, and returns with a limited acceleration.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Descent {
    /// \[m\]
    by: f64,
    /// \[m/s\]
    rate: f64,
}

impl Descent {
    /// The lowering `dt` after the last one \[m\]. `needed` is the least one \[m\], `height` that of the centre of mass \[m\].
    pub fn follow(&mut self, needed: f64, height: f64, dt: f64) -> f64 {
        let (before, bandwidth) = (self.by, RETURN * (GRAVITY / height).sqrt());
        let pull = bandwidth * bandwidth * (needed - self.by) - 2.0 * bandwidth * self.rate;
        self.rate += dt * pull.clamp(-GENTLE * GRAVITY, GENTLE * GRAVITY);
        self.by = (self.by + dt * self.rate).min(LOWEST * height);
        if self.by < needed {
            let fastest = FASTEST * (GRAVITY * height).sqrt();
            let rate = if dt > 0.0 { (needed - before) / dt } else { 0.0 };
            (self.by, self.rate) = (needed, rate.min(fastest));
        }
        self.by
    }
}

/// How much the torso is lowered at least: a stretched leg cannot reach a corrected sole. With this much the soles would be in reach of a torso that is higher by
/// a little, so that knees do not become straight. `reaches` says whether they are in reach with the torso lowered by so much \[m\].
pub(super) fn least(height: f64, reaches: impl Fn(f64) -> bool) -> Option<f64> {
    let (room, most) = (ROOM * height, LOWEST * height);
    let (mut short, mut enough, mut step) = (-room, -room, room);
    while !reaches(enough) {
        if enough > most {
            return None;
        }
        (short, enough, step) = (enough, enough + step, 2.0 * step);
    }
    if enough == -room {
        return Some(0.0);
    }
    while enough - short > EXACT * height {
        let middle = 0.5 * (short + enough);
        if reaches(middle) {
            enough = middle;
        } else {
            short = middle;
        }
    }
    Some(enough + room)
}
