//! Which functions the file of a program needs. Main type: [`Needs`].

use serde::Serialize;

use super::six_axes;
use crate::solver::{Case, Condition, JointValue, Operand, Program, Step, square};

/// Which functions the file needs.
#[derive(Serialize)]
pub(super) struct Needs {
    pub answers: bool,
    pub self_motions: bool,
    pub open: bool,
    pub groups: bool,
    pub rotation: bool,
    pub unit: bool,
    pub near: bool,
    /// Whether strata are told from what is beside them by the candidates.
    pub strata: bool,
    /// The formulas are those of a nearby mechanism.
    pub nearby: bool,
    pub away: bool,
    pub pivot: bool,
    pub squares: bool,
    pub polynomials: bool,
    pub angles: bool,
    pub lengths: bool,
    pub sort: bool,
    /// The target begins with a pose.
    pub frames: bool,
}

impl Needs {
    pub fn new(program: &Program) -> Self {
        let guards = || program.cases().flat_map(|case| &case.guards);
        let angles = program.joints.iter().filter(|joint| is_angle(joint.value)).count();
        Needs {
            answers: program.cases().any(|case| !case.open),
            self_motions: has_self_motions(program),
            open: program.cases().any(|case| case.open),
            groups: program.cases().any(|case| case.pivot.is_some()),
            rotation: program.conditions.iter().any(|condition| matches!(condition, Condition::Rotation(_))),
            unit: program.conditions.iter().any(|condition| matches!(condition, Condition::Unit(_))),
            near: guards().any(|guard| guard.near),
            strata: program.cases().any(Case::is_of_stratum),
            nearby: program.nearby,
            away: guards().any(|guard| !guard.near),
            pivot: root_steps(program).any(|(_, polynomials)| polynomials.len() > 1),
            squares: root_steps(program).any(|(_, polynomials)| square(polynomials).is_some()),
            polynomials: root_steps(program).any(|(_, polynomials)| square(polynomials).is_none()),
            angles: angles > 0,
            lengths: angles < program.joints.len(),
            sort: program.capacity > 1,
            frames: program.conditions.as_slice() == [Condition::Rotation(3)],
        }
    }
}

/// Whether answers can be members of self-motions.
pub(super) fn has_self_motions(program: &Program) -> bool {
    program.cases().any(|case| !case.free.is_empty()) || !six_axes::steps(program).is_empty()
}

/// The root steps that are printed, each with its polynomials.
pub(super) fn root_steps(program: &Program) -> impl Iterator<Item = (&Step, &[Vec<Operand>])> {
    let steps = program.cases().filter(|case| !case.open).flat_map(|case| &case.steps);
    steps.filter_map(|step| match step {
        Step::Roots { polynomials, .. } => Some((step, polynomials.as_slice())),
        _ => None,
    })
}

/// Whether a joint turns.
pub(super) fn is_angle(value: JointValue) -> bool {
    matches!(value, JointValue::Angle { .. })
}
