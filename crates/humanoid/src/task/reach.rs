//! The step limits of a walker. Main type: [`Reach`].

use nalgebra::Point2;

use crate::gait::{Action, Footprint, Footstep, GaitDefaults, Route, Side, Walk, Walker, plan_actions};
use crate::{Error, ErrorKind, Result, Watch};

/// The number of bisections that find the greatest step.
const HALVINGS: usize = 5;
/// The factor between the time between samples of a trial and that of a walk.
const TICK_FACTOR: f64 = 4.0;
/// The greatest turn that is tried \[rad\].
const MOST_TURN: f64 = 1.0;
/// The fraction of the found limits that is used: walks of other shapes than the trials are nearer to the limits.
const USED_FRACTION: f64 = 0.9;

/// The step limits of a walker with one step goal, from the joint limits of its legs at the gait's pace. Metres,
/// radians.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reach {
    /// The greatest distance forward from the supporting foot to the landing foot.
    pub ahead: f64,
    /// The greatest distance backward.
    pub back: f64,
    /// The greatest lateral distance outwards, beyond the parallel stance.
    pub aside: f64,
    /// The greatest angle between landing and supporting foot.
    pub turn: f64,
    /// The height of the hip axes above the floor.
    pub hip_height: f64,
}

impl Reach {
    /// Determines the limits for the parameters of a gait. The hip height is the first one at which steps of full
    /// length, or of a fraction of it, are feasible. Trial walks of four steps then give the limit in each direction,
    /// before a joint exceeds its limits, a sole is out of reach, or the balance is lost.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where no step is feasible; [`Watch::check`].
    pub fn of<'w>(walker: &Walker, defaults: &GaitDefaults, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let mut last = None;
        for share in [1.0, 0.5, 0.25] {
            for &hip_height in defaults.hip_heights.iter() {
                let trials = Trials { walker, defaults, hip_height, watch };
                match trials.steps(defaults.length * share, 0.0, 0.0) {
                    Ok(()) => return trials.reach(),
                    Err(error) if error.kind() == ErrorKind::BadValue => last = last.or(Some(error)),
                    Err(error) => return Err(error),
                }
            }
        }
        let text = "this gait has no hip height";
        Err(last.unwrap_or_else(|| Error::new(ErrorKind::BadValue, text)))
    }
}

impl Reach {
    /// Limits steps forward \[m\] and turns \[rad\], where such steps are feasible.
    ///
    /// # Errors
    /// As [`Reach::of`].
    pub(super) fn bounded(
        &mut self,
        walker: &Walker,
        defaults: &GaitDefaults,
        (ahead, turn): (f64, f64),
        watch: &Watch,
    ) -> Result<()> {
        let trials = Trials { walker, defaults, hip_height: self.hip_height, watch };
        trials.steps(ahead, 0.0, 0.0)?;
        trials.steps(0.0, 0.0, turn)?;
        self.at_most(ahead, turn);
        Ok(())
    }

    /// Limits steps forward \[m\] and turns \[rad\].
    pub(super) fn at_most(&mut self, ahead: f64, turn: f64) {
        (self.ahead, self.back, self.turn) = (self.ahead.min(ahead), self.back.min(ahead), self.turn.min(turn));
    }
}

/// Trial walks at a hip height.
struct Trials<'a> {
    walker: &'a Walker,
    defaults: &'a GaitDefaults,
    hip_height: f64,
    watch: &'a Watch,
}

impl Trials<'_> {
    fn reach(&self) -> Result<Reach> {
        let most = self.hip_height;
        let width = self.defaults.half_width(&self.walker.biped);
        Ok(Reach {
            ahead: self.farthest(most, |length| (length, 0.0, 0.0))?,
            back: self.farthest(most, |length| (-length, 0.0, 0.0))?,
            aside: self.farthest(2.0 * width, |aside| (0.0, aside, 0.0))?,
            turn: self.farthest(MOST_TURN, |turn| (0.0, 0.0, turn))?,
            hip_height: self.hip_height,
        })
    }

    /// The approximate greatest value up to `most` with which steps are feasible.
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
        Ok(USED_FRACTION * low)
    }

    /// Tries three steps of these dimensions, the last two of them from the rear, and one that closes the feet. In
    /// lateral walks the other foot closes each time.
    fn steps(&self, ahead: f64, aside: f64, turn: f64) -> Result<()> {
        let half = self.defaults.half_width(&self.walker.biped);
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
        let actions: Vec<Action> = self.defaults.gait.actions(route.steps.len());
        let mut request = self.defaults.request(biped, route, self.hip_height);
        request.tick *= TICK_FACTOR;
        request.slowest = 1.0;
        plan_actions(biped, legs, &request, &actions, self.watch)
    }
}

/// The bearing of a point from a pose \[rad\].
pub(super) fn bearing(from: &Footprint, to: &Point2<f64>) -> f64 {
    let offset = to - from.point();
    groebot_robot::spatial::angle::difference(offset.y.atan2(offset.x), from.yaw)
}
