//! A walker that finds its way. Main type: [`Pilot`].

use nalgebra::Point2;

use super::body::Body;
use super::reach::Reach;
use crate::gait::{
    Action, Footprint, Footstep, Gait, Polygon, Request, Route, Side, Usual, Walk, Walker, plan_actions,
};
use crate::{Error, ErrorKind, Result, Watch};

/// A step that would have to be slower than so many times its pace is not taken: another one is.
const SLOWEST: f64 = 2.0;

/// Every so many samples of a step are looked at to see what the body covers.
const EVERY: usize = 4;

/// A walker with its body, how far it steps, and what it covers of the floor.
#[derive(Clone, Debug)]
pub struct Pilot {
    walker: Walker,
    usual: Usual,
    body: Body,
    reach: Reach,
    /// What the body covers while it steps in its place, seen from the middle of the feet.
    outline: Polygon,
    /// What it covers while it makes its greatest steps and turns.
    stride: Polygon,
    /// How far the body always reaches, whichever way it looks \[m\].
    core: f64,
    /// How far body and soles reach at most \[m\].
    radius: f64,
    /// How far a sole reaches from its origin, left and right \[m\].
    soles: [f64; 2],
}

impl Pilot {
    /// That of a walker that goes by one step goal with these figures. It walks from its crouch, and stands upright before the first and behind the last
    /// step where `is_upright`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for another gait; as [`Reach::of`].
    pub fn new(walker: Walker, usual: Usual, body: Body, is_upright: bool, watch: &Watch) -> Result<Self> {
        if !usual.gait.is_one_step() {
            let text = "steps are planned one by one, so that goal and obstacles may change between them: that takes a gait by one step goal";
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let crouched = crouched(&usual);
        let reach = Reach::of(&walker, &crouched, watch)?;
        let usual = if is_upright { usual.from_upright(&walker.biped) } else { crouched };
        let soles = walker.biped.feet.each_ref().map(|foot| farthest(&foot.corners));
        let mut pilot = Pilot {
            walker,
            usual,
            body,
            reach,
            outline: Polygon::hull(&[Point2::origin()]),
            stride: Polygon::hull(&[Point2::origin()]),
            core: 0.0,
            radius: 0.0,
            soles,
        };
        let stand = pilot.stand(Footprint::default().feet(pilot.half_width()), Action::Rest, watch)?;
        let posture = &stand.motion.postures[0];
        let outline = pilot.body.outline(&pilot.walker.biped, posture)?;
        pilot.core = outline.signed_distance(&Point2::origin()).max(0.0);
        let Reach { ahead, turn, .. } = *pilot.reach();
        pilot.outline = hull(&[&outline, &pilot.covered(&Footprint::default(), watch)?]);
        let turned = pilot.covered(&Footprint { yaw: turn, ..Footprint::default() }, watch)?;
        let strode = pilot.covered(&Footprint { x: ahead, ..Footprint::default() }, watch)?;
        pilot.stride = hull(&[&pilot.outline, &turned, &strode]);
        let feet = Footprint::default().feet(pilot.half_width());
        let soles = [Side::Left, Side::Right].map(|side| pilot.walker.biped.sole_at(side, &feet[side as usize]));
        pilot.radius = soles.iter().chain([&pilot.stride]).map(|own| farthest(own.corners())).fold(0.0, f64::max);
        Ok(pilot)
    }

    /// The same with steps that are no longer than `ahead` \[m\] and turn by no more than `turn` \[rad\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where steps of these measures cannot be walked, with the reason; [`Watch::check`].
    pub fn within(mut self, ahead: f64, turn: f64, watch: &Watch) -> Result<Self> {
        self.reach.bounded(&self.walker, &crouched(&self.usual), (ahead, turn), watch)?;
        Ok(self)
    }

    /// The same with steps that are no longer than `ahead` \[m\] and turn by no more than `turn` \[rad\], without a trial of the greatest ones.
    #[must_use]
    pub fn at_most(mut self, ahead: f64, turn: f64) -> Self {
        self.reach.at_most(ahead, turn);
        self
    }

    /// The walker.
    pub fn walker(&self) -> &Walker {
        &self.walker
    }

    /// Its body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// How far it steps.
    pub fn reach(&self) -> &Reach {
        &self.reach
    }

    /// Half of the way from foot to foot, sideways \[m\].
    pub fn half_width(&self) -> f64 {
        self.usual.half_width(&self.walker.biped)
    }

    /// Whether it stands upright before the first and behind the last step.
    pub fn is_upright(&self) -> bool {
        matches!(self.usual.gait, Gait::OneStep(one_step) if one_step.upright.is_some())
    }

    /// What the body covers while it steps in its place, with the middle of its feet there.
    pub fn outline_at(&self, middle: &Footprint) -> Polygon {
        Polygon::hull(&middle.carry_all(self.outline.corners()))
    }

    /// What the body covers while it steps in its place, and while it makes its greatest steps and turns, seen from the middle of the feet.
    pub(super) fn outlines(&self) -> [&Polygon; 2] {
        [&self.outline, &self.stride]
    }

    /// How far from the middle of its feet it reaches at most, with its body and the soles side by side \[m\].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// How far the sole of a side reaches from its origin \[m\].
    pub(super) fn sole_reach(&self, side: Side) -> f64 {
        self.soles[side as usize]
    }

    /// How far from the middle of its feet its body reaches on every side while it rests: no way that is narrower lets it through \[m\].
    pub fn core(&self) -> f64 {
        self.core
    }

    /// One step of its own, from feet that rest to feet that rest.
    ///
    /// # Errors
    /// As [`crate::gait::plan`].
    pub fn step(&self, feet: [Footprint; 2], step: Footstep, watch: &Watch) -> Result<Walk> {
        let route = Route::new(feet, vec![step])?;
        self.walk(route, &[Action::Shift(0), Action::Swing(0), Action::Balance(0)], watch)
    }

    /// What it does on both feet.
    ///
    /// # Errors
    /// As [`crate::gait::plan`].
    pub fn stand(&self, feet: [Footprint; 2], action: Action, watch: &Watch) -> Result<Walk> {
        self.walk(Route::standing(feet), &[action], watch)
    }

    /// The same with the trunk at another height before it is lowered or when it has risen \[m\].
    pub(super) fn stand_from(
        &self,
        feet: [Footprint; 2],
        height: Option<f64>,
        action: Action,
        watch: &Watch,
    ) -> Result<Walk> {
        let mut request = self.request(Route::standing(feet));
        if let Gait::OneStep(one_step) = &mut request.gait {
            one_step.upright = height;
        }
        plan_actions(&self.walker.biped, &self.walker.legs, &request, &[action], watch)
    }

    /// What the body covers while each foot, one first and then the other one, steps by as much as the lead does, seen from where the middle of the feet is at
    /// each time; steps that cannot be walked are left out.
    fn covered(&self, step: &Footprint, watch: &Watch) -> Result<Polygon> {
        let mut corners = Vec::new();
        for first in [Side::Left, Side::Right] {
            // A foot turns outwards first.
            let step = Footprint { yaw: first.sign() * step.yaw, ..*step };
            let (mut lead, mut feet) = (Footprint::default(), Footprint::default().feet(self.half_width()));
            for side in [first, first.other()] {
                lead = lead.then(&step);
                let print = lead.feet(self.half_width())[side as usize];
                let walk = match self.step(feet, Footstep { side, print }, watch) {
                    Err(error) if error.kind() == ErrorKind::BadValue => break,
                    walk => walk?,
                };
                feet[side as usize] = print;
                for (reference, posture) in walk.references.iter().zip(&walk.motion.postures).step_by(EVERY) {
                    let [left, right] = reference.world_from_soles.each_ref().map(Footprint::below);
                    let world_from_middle = left.middle(&right);
                    let outline = self.body.outline(&self.walker.biped, posture)?;
                    corners.extend(outline.corners().iter().map(|corner| world_from_middle.seen(corner)));
                }
            }
        }
        Ok(Polygon::hull(&corners))
    }

    fn walk(&self, route: Route, actions: &[Action], watch: &Watch) -> Result<Walk> {
        plan_actions(&self.walker.biped, &self.walker.legs, &self.request(route), actions, watch)
    }

    fn request(&self, route: Route) -> Request {
        let request = self.usual.request(&self.walker.biped, route, self.reach.hip_height);
        Request { slowest: SLOWEST, ..request }
    }
}

/// The same figures without lowering and rising.
fn crouched(usual: &Usual) -> Usual {
    let mut usual = usual.clone();
    if let Gait::OneStep(one_step) = &mut usual.gait {
        one_step.upright = None;
    }
    usual
}

/// The hull of polygons.
fn hull(polygons: &[&Polygon]) -> Polygon {
    Polygon::hull(&polygons.iter().flat_map(|polygon| polygon.corners()).copied().collect::<Vec<_>>())
}

/// How far points are from the origin at most.
fn farthest(points: &[Point2<f64>]) -> f64 {
    points.iter().map(|point| point.coords.norm()).fold(0.0, f64::max)
}
