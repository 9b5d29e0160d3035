//! Candidates for members of self-motions.

use crate::answers::Answers;
use crate::connection::Member;
use crate::counters::Phase;
use crate::mechanism::{Found, Joints, Mechanism};
use crate::problem::End;
use crate::solution::Solution;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS, SELF_MOTIONS, STRATA};

impl<M: Mechanism> Answers<'_, M> {
    /// Keeps a member of a self-motion. It is moved along the self-motion only if its residual exceeds rounding. This happens where the self-motion covers only
    /// a part of the circle, or where there is none and an isolated solution is nearby.
    pub fn refine_member(&mut self, found: &Found, q: Joints<M>) {
        let _phase = Phase::Member.begin();
        let is_known = self.merged.contains(found) || self.out[..self.count].iter().any(|a| is_member_of(a, found));
        if is_known && (!found.free.is_power_of_two() || self.problem.steps.are_spent()) {
            return;
        }
        if self.members.contains(&self.problem.facts(), &q, found.free, MERGING.joints) {
            return;
        }
        let mut end = self.problem.measured(q);
        let missed = end.1.relative;
        if self.suffices && (missed > ACCEPTANCE.unsettled || self.rejected.are_known(found, missed)) {
            return self.miss(end);
        }
        // Repeated to find a solution next to a self-motion's end, but not where that end is far.
        if missed > STRATA.near && self.rejected.are_rejected(found) {
            return self.miss(end);
        }
        if self.problem.steps.are_spent() {
            return self.keep(found, end);
        }
        let may_miss = self.problem.facts().nearby.is_some() && found.free.is_power_of_two() && !is_known;
        if may_miss && missed > ACCEPTANCE.rounding && self.begin_curve(found, &end.0) {
            return;
        }
        if (ACCEPTANCE.rounding..=ACCEPTANCE.unsettled).contains(&missed) {
            end = self.problem.polish(end, found.free);
        }
        if end.1.relative > ACCEPTANCE.rounding && self.has_member_of_branch(found) {
            return;
        }
        if is_known && self.is_on_known(found, &end) {
            return;
        }
        self.is_another = is_known;
        let is_done =
            if self.suffices { self.keep_long_member(found, &end, is_known) } else { self.keep_member(found, &end) };
        self.is_another = false;
        if is_done || is_known {
            return;
        }
        end = self.problem.polish(end, 0);
        if self.is_joined_to_listed(&end) {
            return;
        }
        if !self.keep_member(found, &end) {
            self.keep_alone(found, end, missed);
        }
    }

    /// Keeps a member of a long self-motion within rounding if no solution is lost without further tests. Returns whether it was kept.
    fn keep_long_member(&mut self, found: &Found, end: &End<M>, is_known: bool) -> bool {
        if end.1.relative <= ACCEPTANCE.rounding && self.problem.is_on_long_self_motion(&end.0, found.free) {
            self.keep_remembered(found, end.clone());
            return true;
        }
        if !is_known {
            self.rejected.mark(found);
        }
        self.miss(end.clone());
        true
    }

    /// Where several joints are free, records that members of a candidate's branch are on a self-motion in the list.
    pub fn remember_merged(&mut self, i: usize, relative: f64, found: &Found) {
        let are_sharp = f64::max(self.out[i].relative, relative) <= ACCEPTANCE.rounding;
        if are_sharp && self.out[i].free == found.free && found.free.count_ones() > 1 {
            self.merged.remember(found);
        }
    }

    /// Whether a member is on a known self-motion of its branch: a continuous motion connects them. Where further joints are free, it is assumed to be on one,
    /// and this is recorded.
    fn is_on_known(&mut self, found: &Found, (q, fit): &End<M>) -> bool {
        let Answers { problem, out, count, members, .. } = self;
        let last = members.last(found.branch, |free| free == found.free);
        // First, because it is the fastest test.
        if fit.relative > ACCEPTANCE.rounding
            || last.is_some_and(|last| problem.leads_straight_to(&last.q, q, found.free))
        {
            members.remember(found, q, None);
            return true;
        }
        let tangent = problem.tangent(q, found.free);
        let member = |q, tangent: &Option<Joints<M>>| Member { q, tangent: tangent.clone() };
        let joins = tangent.is_none()
            || last.is_some_and(|last| {
                problem.leads_round_to(member(&last.q, &last.tangent), member(q, &tangent), found.free)
            })
            || out[..*count].iter().rev().any(|a| is_member_of(a, found) && problem.leads_to(&a.q, q, found.free));
        if joins {
            members.remember(found, q, tangent);
        }
        joins
    }

    /// Whether an isolated solution with these joints is in the list.
    pub fn is_listed(&self, q: &Joints<M>) -> bool {
        let is_same =
            |answer: &Solution<M>| self.problem.facts().is_within(answer.q.as_ref(), q.as_ref(), MERGING.joints);
        self.out[..self.count].iter().any(|answer| answer.is_isolated() && is_same(answer))
    }

    /// Whether the list has a member with the branch and the one free joint of a candidate. All members with residuals above rounding count as of one branch.
    fn has_member_of_branch(&self, found: &Found) -> bool {
        let is_of_branch = |a: &Solution<M>| a.branch == found.branch && a.free == found.free;
        found.free.is_power_of_two() && self.out[..self.count].iter().any(is_of_branch)
    }

    /// Whether joints with residuals within rounding are the same singular configuration as an isolated solution in the list.
    fn is_joined_to_listed(&mut self, (q, fit): &End<M>) -> bool {
        let Answers { problem, out, count, .. } = self;
        fit.relative <= ACCEPTANCE.rounding
            && out[..*count]
                .iter()
                .any(|a| a.is_isolated() && problem.are_blurred((&a.q, a.relative), (q, fit.relative)))
    }

    /// Keeps the end of the steps from a candidate for a member of a self-motion. It is either a member of another self-motion, of one joint that a case frees,
    /// or an isolated solution. A new isolated solution may have a second one next to it.
    fn keep_alone(&mut self, found: &Found, end: End<M>, missed: f64) {
        if end.1.relative > SELF_MOTIONS.member {
            return self.miss(end);
        }
        let is_listed = self.is_listed(&end.0);
        if !is_listed && self.is_on_remembered(found, &end.0) {
            return;
        }
        let joint = if is_listed { None } else { self.problem.joint_on_self_motion(&end.0, end.1.relative) };
        let alone = Found { free: joint.unwrap_or(0), ..*found };
        let known = self.count;
        self.keep_remembered(&alone, end.clone());
        if joint.is_none() && self.count > known && (ACCEPTANCE.rounding..=STRATA.near).contains(&missed) {
            self.around(&alone, &end, missed);
        }
    }

    /// Keeps a candidate if it is a member of a self-motion. Returns whether it is.
    fn keep_member(&mut self, found: &Found, end: &End<M>) -> bool {
        let is_member = end.1.accepted && self.problem.is_on_self_motion(&end.0, found.free, end.1.relative);
        if is_member {
            self.keep_remembered(found, end.clone());
        }
        is_member
    }

    /// Keeps a solution, and records a member.
    fn keep_remembered(&mut self, found: &Found, end: End<M>) {
        if found.free != 0 {
            self.members.remember(found, &end.0, None);
        }
        self.keep(found, end);
    }

    /// Whether joints are on a self-motion of one joint that recent candidates of this branch have led to.
    fn is_on_remembered(&mut self, found: &Found, q: &Joints<M>) -> bool {
        let Answers { problem, members, .. } = self;
        let Some(last) = members.last(found.branch, u32::is_power_of_two) else { return false };
        let free = last.free;
        let is_on = problem.regularity(q) <= PIVOTS.regular && problem.leads_to(&last.q, q, free);
        if is_on {
            members.remember(&Found { free, ..*found }, q, None);
        }
        is_on
    }
}

/// Whether a solution is a member of a self-motion within rounding, with the branch and the free joints of a candidate.
fn is_member_of<M: Mechanism>(a: &Solution<M>, found: &Found) -> bool {
    a.relative <= ACCEPTANCE.rounding && a.branch == found.branch && a.free == found.free
}
