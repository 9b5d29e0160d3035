//! How far a walker steps. Main type: [`Reach`].

use nalgebra::Point2;

use crate::gait::{Action, Footprint, Footstep, Route, Side, Usual, Walk, Walker, plan_actions};
use crate::{Error, ErrorKind, Result, Watch};

/// How often an interval is halved to find how far a step can be.
const HALVINGS: usize = 5;
/// Samples of a trial are so many times as far apart as those of a walk.
const COARSER: f64 = 4.0;
/// How far a turn is tried \[rad\].
const MOST_TURN: f64 = 1.0;
/// What of what was found is stepped: walks of other shapes than the trials are nearer to the limits.
const KEPT: f64 = 0.9;

/// How far a walker steps by one step goal: found on its legs, with their limits, at the gait's pace. Metres, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// How far ahead of the standing foot the other one lands.
    pub ahead: f64,
    /// How far behind it.
    pub back: f64,
    /// How far out to its side, beyond where both are side by side.
    pub aside: f64,
    /// How far against the standing foot it is turned.
    pub turn: f64,
    /// The height of the axes of the hip over the floor.
    pub hip_height: f64,
}

impl Reach {
    /// That of a walker with these figures of its gait: at the first of their heights at which it steps as far as they have it, or a part of that, trial walks of
    /// four steps tell how far it can go each way before a joint meets a limit of place or speed, a sole is out of reach, or the balance is lost.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where no step can be walked; [`Watch::check`].
    pub fn of(walker: &Walker, usual: &Usual, watch: &Watch) -> Result<Self> {
        let mut last = None;
        for share in [1.0, 0.5, 0.25] {
            for &hip_height in usual.hip_heights.iter() {
                let trials = Trials { walker, usual, hip_height, watch };
                match trials.steps(usual.length * share, 0.0, 0.0) {
                    Ok(()) => return trials.reach(),
                    Err(error) if error.kind() == ErrorKind::BadValue => last = last.or(Some(error)),
                    Err(error) => return Err(error),
                }
            }
        }
        let text = "this gait has no height of the hip";
        Err(last.unwrap_or_else(|| Error::new(ErrorKind::BadValue, text)))
    }
}

impl Reach {
    /// Bounds how far it steps ahead \[m\] and turns \[rad\], where such steps can be walked.
    ///
    /// # Errors
    /// As [`Reach::of`].
    pub(super) fn bounded(
        &mut self,
        walker: &Walker,
        usual: &Usual,
        (ahead, turn): (f64, f64),
        watch: &Watch,
    ) -> Result<()> {
        let trials = Trials { walker, usual, hip_height: self.hip_height, watch };
        trials.steps(ahead, 0.0, 0.0)?;
        trials.steps(0.0, 0.0, turn)?;
        self.at_most(ahead, turn);
        Ok(())
    }

    /// Bounds how far it steps ahead \[m\] and turns \[rad\].
    pub(super) fn at_most(&mut self, ahead: f64, turn: f64) {
        (self.ahead, self.back, self.turn) = (self.ahead.min(ahead), self.back.min(ahead), self.turn.min(turn));
    }
}

/// Trial walks at a height of the hip.
struct Trials<'a> {
    walker: &'a Walker,
    usual: &'a Usual,
    hip_height: f64,
    watch: &'a Watch,
}

impl Trials<'_> {
    fn reach(&self) -> Result<Reach> {
        let most = self.hip_height;
        let width = self.usual.half_width(&self.walker.biped);
        Ok(Reach {
            ahead: self.farthest(most, |length| (length, 0.0, 0.0))?,
            back: self.farthest(most, |length| (-length, 0.0, 0.0))?,
            aside: self.farthest(2.0 * width, |aside| (0.0, aside, 0.0))?,
            turn: self.farthest(MOST_TURN, |turn| (0.0, 0.0, turn))?,
            hip_height: self.hip_height,
        })
    }

    /// The greatest measure up to `most`, nearly, with which steps can be walked.
    fn farthest(&self, most: f64, step: impl Fn(f64) -> (f64, f64, f64)) -> Result<f64> {
        let (mut low, mut high) = (0.0, most);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            let (ahead, aside, turn) = step(middle);
            match self.steps(ahead, aside, turn) {
                Ok(()) => low = middle,
                Err(error) if error.kind() == ErrorKind::BadValue => high = middle,
                Err(error) => return Err(error),
            }
        }
        Ok(KEPT * low)
    }

    /// Three steps of these measures, the last two of them from behind, and one that closes the feet; sideways the other foot closes each time.
    fn steps(&self, ahead: f64, aside: f64, turn: f64) -> Result<()> {
        let half = self.usual.half_width(&self.walker.biped);
        let mut lead = Footprint::default();
        let start = lead.feet(half);
        let mut steps = Vec::new();
        for place in 0..4 {
            let side = if place % 2 == 0 { Side::Left } else { Side::Right };
            let goes_on = if aside == 0.0 { place < 3 } else { side == Side::Left };
            if goes_on {
                lead = lead.then(&Footprint { x: ahead, y: aside, yaw: turn });
            }
            steps.push(Footstep { side, print: lead.feet(half)[side as usize] });
        }
        self.walk(Route::new(start, steps)?).map(drop)
    }

    fn walk(&self, route: Route) -> Result<Walk> {
        let Walker { biped, legs, .. } = self.walker;
        let actions: Vec<Action> = self.usual.gait.actions(route.steps.len());
        let mut request = self.usual.request(biped, route, self.hip_height);
        request.tick *= COARSER;
        request.slowest = 1.0;
        plan_actions(biped, legs, &request, &actions, self.watch)
    }
}

/// Where a walker with its middle at a place looks to another one from \[rad\].
pub(super) fn bearing(from: &Footprint, to: &Point2<f64>) -> f64 {
    let way = to - from.point();
    groebot_robot::spatial::angle::difference(way.y.atan2(way.x), from.yaw)
}
