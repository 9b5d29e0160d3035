//! What the quicker way to the roots of a quartic (`src/roots/quartic.rs`) needs in the skeletons `quartic.*.txt`.

use serde::Serialize;

use super::needs::root_steps;
use super::printer::number;
use crate::solver::Program;
use crate::solver::quartic::{DISTINCT, FACTORED, LED, RESOLVED, RESOLVENT_STEPS, SETTLED};

/// The skeletons' parts, by the names with which they are included.
pub(super) const PARTS: [(&str, &str); 2] =
    [("quartic.rs", include_str!("skeleton/quartic.rs.txt")), ("quartic.c", include_str!("skeleton/quartic.c.txt"))];

/// Its limits.
#[derive(Serialize)]
pub(super) struct Quartic {
    led: String,
    factored: String,
    distinct: String,
    settled: String,
    resolved: String,
    steps: usize,
}

impl Quartic {
    /// `None` for a program without a quartic.
    pub fn of(program: &Program) -> Option<Self> {
        root_steps(program).any(|(step, _)| step.slots() == 4).then(|| Quartic {
            led: number(LED),
            factored: number(FACTORED),
            distinct: number(DISTINCT),
            settled: number(SETTLED),
            resolved: number(RESOLVED),
            steps: RESOLVENT_STEPS,
        })
    }
}
