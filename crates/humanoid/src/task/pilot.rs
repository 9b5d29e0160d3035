//! A walker that plans its path. Main type: [`Pilot`].

use nalgebra::Point2;

use super::body::Body;
use super::reach::Reach;
use crate::gait::{
    Action, Footprint, Footstep, Gait, GaitDefaults, Polygon, Request, Route, Side, Walk, Walker, plan_actions,
};
use crate::{Error, ErrorKind, Result, Watch};

/// A step is infeasible if it would have to be slower than its pace by more than this factor.
const SLOWEST: f64 = 2.0;

/// The number of samples between two outlines of the body in a step.
const EVERY: usize = 4;

/// A walker with its body, its step limits, and the area that it covers.
#[derive(Clone, Debug)]
pub struct Pilot {
    walker: Walker,
    defaults: GaitDefaults,
    body: Body,
    reach: Reach,
    /// The area that the body covers while it steps on the spot, in the frame of the middle of the feet.
    outline: Polygon,
    /// The area that it covers during its greatest steps and turns.
    stride: Polygon,
    /// The radius of the largest circle inside the body at every heading \[m\].
    core: f64,
    /// The greatest distance of body and soles from the middle of the feet \[m\].
    radius: f64,
    /// The greatest distance of a sole's points from its origin, left and right \[m\].
    soles: [f64; 2],
}

impl Pilot {
    /// Makes the pilot of a walker that walks by one step goal with these parameters. It walks in its crouch. With
    /// `is_upright` it stands upright before the first and after the last step.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for another gait; as [`Reach::of`].
    pub fn new<'w>(
        walker: Walker,
        defaults: GaitDefaults,
        body: Body,
        is_upright: bool,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Self> {
        let watch = Watch::or_none(watch);
        if !defaults.gait.is_one_step() {
            let text = "steps are planned one by one, so that goal and obstacles may change between them: this needs a gait by one step goal";
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let crouched = crouched(&defaults);
        let reach = Reach::of(&walker, &crouched, watch)?;
        let defaults = if is_upright { defaults.from_upright(&walker.biped) } else { crouched };
        let soles = walker.biped.feet.each_ref().map(|foot| farthest(&foot.corners));
        let mut pilot = Pilot {
            walker,
            defaults,
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

    /// Limits steps to `ahead` \[m\] and turns to `turn` \[rad\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where steps of these limits are infeasible, with the reason; [`Watch::check`].
    pub fn within<'w>(mut self, ahead: f64, turn: f64, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        self.reach.bounded(&self.walker, &crouched(&self.defaults), (ahead, turn), watch)?;
        Ok(self)
    }

    /// Same as [`Pilot::within`], but without a test of the greatest steps.
    #[must_use]
    pub(crate) fn at_most(mut self, ahead: f64, turn: f64) -> Self {
        self.reach.at_most(ahead, turn);
        self
    }

    /// Limits steps and turns to those of a gait that walks the planned footsteps without rests.
    #[must_use]
    pub fn for_gait(self, gait: &GaitDefaults) -> Self {
        self.at_most(gait.length, gait.most_turn)
    }

    /// The walker.
    pub fn walker(&self) -> &Walker {
        &self.walker
    }

    /// Its body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Its step limits.
    pub fn reach(&self) -> &Reach {
        &self.reach
    }

    /// Half of the lateral distance between the feet \[m\].
    pub fn half_width(&self) -> f64 {
        self.defaults.half_width(&self.walker.biped)
    }

    /// The parameters of its gait.
    pub(super) fn defaults(&self) -> &GaitDefaults {
        &self.defaults
    }

    /// Whether it stands upright before the first and after the last step.
    pub fn is_upright(&self) -> bool {
        matches!(self.defaults.gait, Gait::OneStep(one_step) if one_step.upright.is_some())
    }

    /// The area that the body covers while it steps on the spot, with the middle of its feet at a place.
    pub fn outline_at(&self, middle: &Footprint) -> Polygon {
        Polygon::hull(&middle.carry_all(self.outline.corners()))
    }

    /// The areas that the body covers, in the frame of the middle of the feet: while it steps on the spot, and during its greatest steps and turns.
    pub(super) fn outlines(&self) -> [&Polygon; 2] {
        [&self.outline, &self.stride]
    }

    /// The greatest distance of the body, and of the soles side by side, from the middle of its feet \[m\].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The greatest distance of a sole's points from its origin \[m\].
    pub(super) fn sole_reach(&self, side: Side) -> f64 {
        self.soles[side as usize]
    }

    /// The radius around the middle of its feet that its body covers on every side at rest \[m\]: no narrower passage
    /// is feasible.
    pub fn core(&self) -> f64 {
        self.core
    }

    /// One step as a walk of its own, from rest to rest.
    ///
    /// # Errors
    /// As [`crate::gait::plan`].
    pub fn step<'w>(&self, feet: [Footprint; 2], step: Footstep, watch: impl Into<Option<&'w Watch>>) -> Result<Walk> {
        let watch = Watch::or_none(watch);
        let route = Route::new(feet, vec![step])?;
        self.walk(route, &[Action::Shift(0), Action::Swing(0), Action::Balance(0)], watch)
    }

    /// A phase in double support as a walk of its own.
    ///
    /// # Errors
    /// As [`crate::gait::plan`].
    pub(crate) fn stand<'w>(
        &self,
        feet: [Footprint; 2],
        action: Action,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Walk> {
        let watch = Watch::or_none(watch);
        self.walk(Route::at_rest(feet), &[action], watch)
    }

    /// Same as [`Pilot::stand`], but with another height of the upright trunk \[m\].
    pub(super) fn stand_from(
        &self,
        feet: [Footprint; 2],
        height: Option<f64>,
        action: Action,
        watch: &Watch,
    ) -> Result<Walk> {
        let mut request = self.request(Route::at_rest(feet));
        if let Gait::OneStep(one_step) = &mut request.gait {
            one_step.upright = height;
        }
        plan_actions(&self.walker.biped, &self.walker.legs, &request, &[action], watch)
    }

    /// The area that the body covers while both feet make the step of the lead, one after the other. It is in the moving frame of the middle of the feet.
    /// Infeasible steps are ignored.
    fn covered(&self, step: &Footprint, watch: &Watch) -> Result<Polygon> {
        let mut corners = Vec::new();
        for first in [Side::Left, Side::Right] {
            // The outer foot of a turn moves first.
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
        let request = self.defaults.request(&self.walker.biped, route, self.reach.hip_height);
        Request { slowest: SLOWEST, ..request }
    }
}

/// The parameters without lowering and rising.
fn crouched(defaults: &GaitDefaults) -> GaitDefaults {
    let mut defaults = defaults.clone();
    if let Gait::OneStep(one_step) = &mut defaults.gait {
        one_step.upright = None;
    }
    defaults
}

/// The convex hull of polygons.
fn hull(polygons: &[&Polygon]) -> Polygon {
    Polygon::hull(&polygons.iter().flat_map(|polygon| polygon.corners()).copied().collect::<Vec<_>>())
}

/// The greatest distance of points from the origin.
fn farthest(points: &[Point2<f64>]) -> f64 {
    points.iter().map(|point| point.coords.norm()).fold(0.0, f64::max)
}
