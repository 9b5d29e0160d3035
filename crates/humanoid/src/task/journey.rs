//! A walk that grows step by step along a course. Main type: [`Journey`].

use std::borrow::Cow;

use nalgebra::Point2;

use super::course::Course;
use super::floor::Floor;
use super::follow::{Next, next};
use super::lattice::Lattice;
use super::pilot::Pilot;
use super::refusal::{Obstacle, Reason, Refusal, met};
use super::search::{Guide, Refused, Search, key, step_key};
use super::stance::Stances;
use crate::gait::{Action, Footprint, Footstep, MAX_STEPS, Side, Walk};
use crate::nav::{self, Field};
use crate::{Error, ErrorKind, Result, Watch};

/// The number of steps to the first target of a search along the course.
const STEPS_AHEAD: f64 = 6.0;
/// Limits on searches: the number permitted on a course before the first step; the number of steps that permit one more; the number of searches to a place some
/// steps forward.
const MOST_SEARCHES: usize = 60;
const STEPS_A_SEARCH: usize = 4;
const MOST_NEAR: usize = 8;

/// The tolerance of a trunk's height \[m\].
const SAME_HEIGHT: f64 = 1e-9;

/// A walk that grows step by step. Between two steps the robot rests in double support; floor and course may change
/// there.
#[derive(Clone, Debug)]
pub struct Journey<'p> {
    pilot: Cow<'p, Pilot>,
    walk: Walk,
    /// The middle of the feet after the rear one would come beside the other.
    lead: Footprint,
    /// The next swing foot.
    side: Option<Side>,
    /// The index of the corner that it walks to.
    corner: usize,
    /// Steps that were found by a search and are still to be taken.
    searched: Vec<Footstep>,
    /// The lattice that led to the goal, while such steps are left.
    lattice: Option<Lattice>,
    searches: usize,
    refused: Refused,
    refusals: Vec<Refusal>,
}

impl<'p> Journey<'p> {
    /// Starts from two footprints, left and right; an upright walker lowers its trunk first.
    ///
    /// # Errors
    /// As [`crate::gait::plan`]; [`ErrorKind::BadValue`] for feet or a body on an obstacle.
    pub fn new<'w>(
        pilot: &'p Pilot,
        floor: &Floor,
        feet: [Footprint; 2],
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let action = if pilot.is_upright() { Action::Lower } else { Action::Rest };
        let walk = pilot.stand(feet, action, watch)?;
        if let Some((obstacle, at)) = met(pilot, floor, &walk)? {
            let what = if obstacle == Obstacle::Body { "body" } else { "foot" };
            let text = format!("the {what} would start on an obstacle at ({:.3}, {:.3})", at.x, at.y);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Journey {
            pilot: Cow::Borrowed(pilot),
            walk,
            lead: feet[0].middle(&feet[1]),
            side: None,
            corner: 1,
            searched: Vec::new(),
            lattice: None,
            searches: 0,
            refused: Refused::default(),
            refusals: Vec::new(),
        })
    }

    /// The pilot.
    pub fn pilot(&self) -> &Pilot {
        &self.pilot
    }

    /// The walk up to now.
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// The steps that were planned and not taken, with their reasons.
    pub(crate) fn refusals(&self) -> &[Refusal] {
        &self.refusals
    }

    /// The current footprints, left and right.
    pub fn feet(&self) -> [Footprint; 2] {
        self.walk.schedule.route.end()
    }

    /// The middle of the feet.
    pub fn middle(&self) -> Footprint {
        let [left, right] = self.feet();
        left.middle(&right)
    }

    /// Must be called when the course or the floor has changed: steps of earlier searches become invalid.
    pub fn turn_to_new_course(&mut self) {
        // A course begins at the robot.
        (self.corner, self.searches) = (1, 0);
        self.searched.clear();
        self.lattice = None;
        self.refused = Refused::default();
    }

    /// Changes the gait from the next step on: other lengths, another pace, or another height. A new height is taken at
    /// once, so that the walk grows.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for the pilot of another robot, or another time between samples; as
    /// [`crate::gait::plan`].
    pub fn walk_as<'w>(&mut self, pilot: Pilot, watch: impl Into<Option<&'w Watch>>) -> Result<()> {
        let watch = Watch::or_none(watch);
        let [own, other] = [&*self.pilot, &pilot].map(|pilot| &pilot.walker().biped);
        if own.name != other.name || own.joints != other.joints {
            let text = format!("the walk is that of {}; {} cannot continue it", own.name, other.name);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let height = |walk: &Walk| walk.motion.postures.last().map(|posture| posture.world_from_torso.translation.z);
        let before = height(&self.walk);
        let lowers = pilot.stand_from(self.feet(), before, Action::Lower, watch)?;
        if before.zip(height(&lowers)).is_none_or(|(before, now)| (now - before).abs() > SAME_HEIGHT) {
            self.walk.append(lowers)?;
        }
        self.pilot = Cow::Owned(pilot);
        let last = self.walk.schedule.route.steps.last();
        self.lead = last.filter(|_| self.side.is_some()).map_or(self.middle(), |step| beside(&self.pilot, step));
        self.turn_to_new_course();
        Ok(())
    }

    /// The journey with its own copy of the pilot.
    pub(crate) fn into_owned(self) -> Journey<'static> {
        let Journey { pilot, walk, lead, side, corner, searched, lattice, searches, refused, refusals } = self;
        let pilot = Cow::Owned(pilot.into_owned());
        Journey { pilot, walk, lead, side, corner, searched, lattice, searches, refused, refusals }
    }

    /// Takes the next step along a course; returns false at the goal with the feet side by side.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where no step is feasible, also after searches over many footprints, with the last
    /// reason; [`ErrorKind::Budget`] for too many steps; [`Watch::check`].
    pub fn step<'w>(&mut self, floor: &Floor, course: &Course, watch: impl Into<Option<&'w Watch>>) -> Result<bool> {
        let watch = Watch::or_none(watch);
        if self.walk.schedule.route.steps.len() >= MAX_STEPS {
            return Err(Error::new(ErrorKind::Budget, format!("the walk needs more than {MAX_STEPS} steps")));
        }
        loop {
            if !self.searched.is_empty() {
                let step = self.searched.remove(0);
                if self.take(floor, step, watch)? {
                    self.lead = beside(&self.pilot, &step);
                    if self.searched.is_empty() {
                        self.lattice = None;
                    }
                    return Ok(true);
                }
                self.searched.clear();
            } else {
                let open = self.open();
                let leads = match (next(&self.pilot, &self.lead, course, &mut self.corner), open) {
                    // From feet side by side more steps are feasible than from others.
                    (Next::Lead(leads), Some(_)) => leads.into_iter().chain([self.lead]).collect(),
                    (Next::Lead(leads), None) => leads,
                    (Next::Close, Some(side)) => {
                        self.side = Some(side);
                        vec![self.lead]
                    }
                    (Next::Close, None) => return Ok(false),
                };
                if self.take_one(floor, &leads, watch)? {
                    return Ok(true);
                }
            }
            self.search(floor, course, watch)?;
        }
    }

    /// Ends the walk at the current place; an upright walker rises.
    ///
    /// # Errors
    /// As [`crate::gait::plan`].
    pub fn finish<'w>(mut self, watch: impl Into<Option<&'w Watch>>) -> Result<Walk> {
        let watch = Watch::or_none(watch);
        if self.pilot.is_upright() {
            let rise = self.pilot.stand(self.feet(), Action::Rise, watch)?;
            self.walk.append(rise)?;
        }
        Ok(self.walk)
    }

    /// The foot that is not beside the lead.
    fn open(&self) -> Option<Side> {
        let (own, wanted) = (self.feet(), self.lead.feet(self.pilot.half_width()));
        let is_open = |side: &Side| {
            let (own, wanted) = (&own[*side as usize], &wanted[*side as usize]);
            (own.point() - wanted.point()).norm() > 1e-9 || (own.yaw - wanted.yaw).abs() > 1e-9
        };
        [Side::Left, Side::Right].into_iter().find(is_open)
    }

    /// Takes the first feasible one of some steps.
    fn take_one(&mut self, floor: &Floor, leads: &[Footprint], watch: &Watch) -> Result<bool> {
        // A turn starts with the foot on its side.
        let turns = leads.first().map_or(0.0, |lead| lead.yaw - self.lead.yaw);
        let side = self.side.unwrap_or(if turns < 0.0 { Side::Right } else { Side::Left });
        let step = |lead: &Footprint| Footstep { side, print: lead.feet(self.pilot.half_width())[side as usize] };
        let steps: Vec<_> = leads.iter().map(|lead| (*lead, step(lead))).collect();
        for (lead, step) in steps {
            if self.fits(floor, &step) && self.take(floor, step, watch)? {
                self.lead = lead;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether the floor has room for a foot at its landing pose, and for the body between both feet.
    fn fits(&self, floor: &Floor, step: &Footstep) -> bool {
        let mut feet = self.feet();
        feet[step.side as usize] = step.print;
        let (middle, biped) = (feet[0].middle(&feet[1]), &self.pilot.walker().biped);
        floor.under_sole(&biped.sole_at(step.side, &step.print)).is_none()
            && (floor.is_far(&middle.point(), self.pilot.radius())
                || floor.beside_body(&self.pilot.outline_at(&middle)).is_none())
    }

    /// Takes a step, or notes the reason why it is infeasible.
    fn take(&mut self, floor: &Floor, footstep: Footstep, watch: &Watch) -> Result<bool> {
        let reason = match self.pilot.step(self.feet(), footstep, watch) {
            Ok(walk) => match met(&self.pilot, floor, &walk)? {
                None => {
                    self.walk.append(walk)?;
                    self.side = Some(footstep.side.other());
                    return Ok(true);
                }
                Some((obstacle, at)) => Reason::Obstacle(obstacle, at),
            },
            Err(error) if error.kind() == ErrorKind::BadValue => Reason::Gait(error.message().to_owned()),
            Err(error) => return Err(error),
        };
        let Footstep { side, print } = footstep;
        let (stance, feet) = (side.other(), self.feet());
        if let Reason::Gait(_) = reason {
            self.refused.steps.insert(step_key(&self.pilot, &feet, side, &print));
        }
        let from = key(&self.pilot, stance, &feet[stance as usize]);
        self.refused.pairs.insert((from, key(&self.pilot, side, &print)));
        self.refusals.push(Refusal { step: self.walk.schedule.route.steps.len() + 1, footstep, reason });
        Ok(false)
    }

    /// Searches for steps around obstacles: to a place some steps forward on the course. Where none lead from there to
    /// the goal, it uses stances that reach the goal.
    fn search(&mut self, floor: &Floor, course: &Course, watch: &Watch) -> Result<()> {
        if self.searches >= MOST_SEARCHES + self.walk.schedule.route.steps.len() / STEPS_A_SEARCH {
            return self.stuck("too many searches; no feasible step was found");
        }
        self.searches += 1;
        let sides = self.side.map_or([Side::Left, Side::Right], |side| [side, side.other()]);
        let last = course.path.points.len().saturating_sub(1);
        let stances = Stances::new(&self.pilot, floor)?;
        if self.lattice.is_none()
            && self.searches <= MOST_NEAR
            && let Some((corner, target)) = self.near(floor, course)
        {
            let steps = self.found_by_field(&stances, target, &sides, watch)?;
            if !steps.is_empty() {
                (self.searched, self.corner) = (steps, corner);
                return Ok(());
            }
        }
        let goal = course.goal.place;
        // A lattice that was made farther back is inaccurate far from that place.
        for known in self.lattice.take().map(Some).into_iter().chain([None]) {
            let lattice = known.map_or_else(|| Lattice::new(&stances, &goal, &self.middle(), watch), Ok)?;
            let steps = self.found(&stances, goal, Guide::Lattice(&lattice), &sides, watch)?;
            if !steps.is_empty() {
                (self.searched, self.corner, self.lattice) = (steps, last, Some(lattice));
                return Ok(());
            }
        }
        // Beside the goal a stance may fit at places other than the middles of cells.
        let steps = self.found_by_field(&stances, goal, &sides, watch)?;
        if steps.is_empty() {
            return self.stuck("no step of this robot is feasible");
        }
        (self.searched, self.corner) = (steps, last);
        Ok(())
    }

    /// The steps to a place found by a search with the arrival times at that place as heuristic.
    fn found_by_field(
        &self,
        stances: &Stances<'_>,
        target: Point2<f64>,
        sides: &[Side],
        watch: &Watch,
    ) -> Result<Vec<Footstep>> {
        let map = stances.floor.of_core(&self.pilot)?;
        // A path along a border of cells is beside obstacles; the nearest cell may not be free.
        if map.free_cell_at(&target).is_err() {
            return Ok(Vec::new());
        }
        let field = Field::new(&map, &[target], nav::Method::FastMarching(1), watch)?;
        self.found(stances, target, Guide::Field(&map, &field), sides, watch)
    }

    /// The steps that a search finds, with either foot first.
    fn found(
        &self,
        stances: &Stances<'_>,
        goal: Point2<f64>,
        guide: Guide<'_>,
        sides: &[Side],
        watch: &Watch,
    ) -> Result<Vec<Footstep>> {
        let search = Search::new(stances, goal, guide, &self.refused);
        for first in sides {
            if let Some(steps) = search.steps(self.feet(), *first, watch)?.filter(|steps| !steps.is_empty()) {
                return Ok(steps);
            }
        }
        Ok(Vec::new())
    }

    /// The first place some steps forward on the course where the body has room at the course's heading, and the corner
    /// after it.
    fn near(&self, floor: &Floor, course: &Course) -> Option<(usize, Point2<f64>)> {
        let stride = self.pilot.reach().ahead;
        let has_room = |(corner, at): &(usize, Point2<f64>)| {
            let [from, to] = [corner - 1, *corner].map(|corner| course.path.points[corner]);
            let looks = Footprint { x: at.x, y: at.y, yaw: (to.y - from.y).atan2(to.x - from.x) };
            floor.beside_body(&self.pilot.outline_at(&looks)).is_none()
        };
        let steps = std::iter::successors(Some(STEPS_AHEAD), |steps| Some(steps + 1.0));
        let mut places = steps.map_while(|steps| ahead(course, self.corner, &self.lead, steps * stride));
        places.find(has_room)
    }

    /// The error that no step is feasible, with the last reason.
    fn stuck(&self, text: &str) -> Result<()> {
        let (at, turned) = (self.middle(), self.lead.yaw.to_degrees());
        let reason = self.refusals.last().map_or_else(String::new, |refusal| format!("; {refusal}"));
        let text = format!("{text} from ({:.3}, {:.3}), looking {turned:.0} deg{reason}", at.x, at.y);
        Err(Error::new(ErrorKind::BadValue, text))
    }
}

/// The place at a distance forward on a course \[m\], and the corner after it; `None` beyond its end.
fn ahead(course: &Course, corner: usize, lead: &Footprint, mut distance: f64) -> Option<(usize, Point2<f64>)> {
    let mut at = lead.point();
    for (place, point) in course.path.points.iter().enumerate().skip(corner) {
        let piece = (point - at).norm();
        if piece >= distance {
            return Some((place, at + (point - at) * (distance / piece)));
        }
        (at, distance) = (*point, distance - piece);
    }
    None
}

/// The middle of the feet after the other one would come beside a step.
fn beside(pilot: &Pilot, step: &Footstep) -> Footprint {
    step.print.then(&Footprint { y: -step.side.sign() * pilot.half_width(), ..Footprint::default() })
}
