//! Solutions within limits of a redundant arm. Main type: [`Arm`].

use std::slice;

use groebot::solver::Program;
use groebot::solver::redundant::{Arc, ArcEnd, ArmTarget, Criterion, RedundantSolver};
use groebot::{Error, ErrorKind, Result};
use serde_json::{Value, json};

/// A redundant arm with the arcs of its last target, within the described limits.
pub struct Arm {
    solver: RedundantSolver,
    joints: Vec<String>,
    last: Option<(ArmTarget, Vec<Arc>)>,
}

impl Arm {
    /// The arm of a program; `None` without redundancy, and for an arm with scanned joints.
    pub fn new(program: &Program) -> Option<Self> {
        let joints = program.joints.iter().map(|joint| joint.name.clone()).collect();
        program.redundant_solver().map(|solver| Arm { solver, joints, last: None })
    }

    /// All arcs of a target, each with its solution that is nearest to the joint values `near`. Without arcs, the reason.
    pub fn arcs(&mut self, target: &[f64], near: &[f64]) -> Result<Value> {
        self.last = None;
        let (target, limits) = (self.solver.target_of_numbers(target)?, self.solver.limits());
        let found = self.solver.arcs(&target, &limits)?;
        let names: Vec<&str> = self.joints.iter().map(String::as_str).collect();
        let criterion = Criterion::nearest(near.to_vec());
        let described = |arc: &Arc| {
            let nearest = self.solver.best_on(&target, &limits, slice::from_ref(arc), &criterion)?;
            let (s, q) = nearest.map_or_else(|| (0.0, arc.start.q.clone()), |best| (best.s, best.q));
            let end = |end: &ArcEnd| json!({ "q": end.q, "limit": end.limit_text(&names) });
            Ok(json!({
                "ends": [end(&arc.start), end(&arc.end)],
                "length": arc.length,
                "closed": arc.is_closed,
                "unsure": arc.is_unsure,
                "s": s,
                "residual": self.solver.residual(&target, &q),
                "q": q,
            }))
        };
        let arcs = found.arcs.iter().map(described).collect::<Result<Vec<Value>>>()?;
        let reason = found.absence.as_ref().map(|absence| absence.text(&names));
        let response =
            json!({ "arcs": arcs, "reason": reason, "unsure": found.is_unsure, "surface": found.is_surface });
        self.last = Some((target, found.arcs));
        Ok(response)
    }

    /// Solutions at distances from the start of an arc of the last target.
    pub fn points(&self, arc: usize, distances: &[f64]) -> Result<Value> {
        let found = self.last.as_ref().and_then(|(target, arcs)| Some((target, arcs.get(arc)?)));
        let unknown = || Error::new(ErrorKind::UnknownName, format!("the last target has no arc {arc}"));
        let ((target, arc), limits) = (found.ok_or_else(unknown)?, self.solver.limits());
        let point = |s: &f64| {
            let q = self.solver.at(target, &limits, arc, *s)?;
            Ok(json!({ "residual": self.solver.residual(target, &q), "q": q }))
        };
        Ok(json!({ "points": distances.iter().map(point).collect::<Result<Vec<Value>>>()? }))
    }
}
