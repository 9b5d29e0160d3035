//! The results of checks: [`Report`], its table `6_check.csv` and its summary.

use groebot_robot::kinematics::{Chain, Joint, JointKind, Placed, Solution};
use std::fmt;

/// The origin of a row's target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From random joint values.
    Random,
    /// From a singular configuration, or with one angle at 0 or pi.
    Boundary,
    /// On or near the zero set of factors. The text names it and the distance, such as `pz = 1e-7`.
    Stratum(String),
    /// Out of reach: a reachable target times ten, or ten reaches away.
    Far,
    /// From joint values whose cosines and sines are rational.
    Rational,
    /// From one joint at a multiple of pi/2.
    Special,
    /// From joint values in multiples of 15 or 30 degrees.
    Round,
    /// Parallel to the base frame, at a position on a grid.
    Aligned,
    /// From a singular configuration of a chain.
    Singular,
    /// From a configuration at the distance 10^-k (rad, or a fraction of the reach) from a singular one.
    Near(u32),
    /// The target of a singular configuration moved by 10^-k in a direction in which the tip cannot move: to both sides of the workspace boundary.
    Edge(u32),
    /// An arbitrary target, reachable or not.
    Anywhere,
    /// From joint values within limits: the arcs of a redundant arm.
    Arcs,
    /// A target of the ideal robot, if solutions are polished on the described one.
    OfIdeal(Box<Kind>),
}

impl Kind {
    /// Whether the target is made of round numbers.
    pub fn is_round(&self) -> bool {
        matches!(self, Kind::Round | Kind::Aligned)
    }
}

/// A fault of the solutions at a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The joint values that made the target are not among the solutions.
    Missing,
    /// A solution does not satisfy the equations.
    Residual,
    /// A solution is malformed: not finite, or an angle outside (-pi, pi].
    Range,
    /// Two solutions are equal.
    Duplicate,
    /// There are more solutions than the program's largest case has branches.
    Bound,
    /// A joint is reported as free where the Jacobian is regular.
    Free,
    /// The joint values that made the target belong to a self-motion, and no solution with a free joint represents it.
    SelfMotion,
    /// The number of solutions differs from the exact number of real solutions.
    Count,
    /// The solutions differ from those of the screw solver.
    Screw,
    /// The solutions differ from those of the numeric oracle.
    Oracle,
    /// The slightly moved target has an ordinary solution that is next to none of them.
    Moved,
    /// An end of an arc is beyond limits.
    Limits,
}

/// The result of the checks at a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All checks passed.
    Pass,
    /// The target is on a stratum that the program reports as not covered.
    Open,
    /// Some checks failed.
    Fail(Vec<Fault>),
}

/// The checks at one target.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// The number of the row, from 1.
    pub number: usize,
    /// The origin of the target.
    pub kind: Kind,
    /// The target: one number per input, in the system's unit or rad.
    pub target: Vec<f64>,
    /// The joint values that made it, if any.
    pub joints: Option<Vec<f64>>,
    /// The number of the program's solutions.
    pub solutions: usize,
    /// The exact number of distinct real solutions, if it was counted.
    pub exact: Option<usize>,
    /// The number of the screw solver's solutions, if it applies.
    pub screw: Option<usize>,
    /// The number of the oracle's solutions, if it was used.
    pub oracle: Option<usize>,
    /// The largest value of an equation at a solution, as a fraction of the sum of its terms' sizes.
    pub worst_residual: Option<f64>,
    /// The distance of the nearest solution from `joints`: rad, or a fraction of the typical length.
    pub nearest: Option<f64>,
    /// Whether the target is singular or next to a singular one, by the joint values that made or solve it.
    pub is_singular: bool,
    /// The result of the checks.
    pub verdict: Verdict,
}

impl Row {
    /// The row number `number`, from 0, before any check. Without solutions, it is a gap of the solver.
    pub(super) fn open(
        number: usize,
        kind: Kind,
        target: Vec<f64>,
        joints: Option<Vec<f64>>,
        answers: Option<&[Solution]>,
    ) -> Self {
        Row {
            number: number + 1,
            kind,
            target,
            joints,
            solutions: answers.map_or(0, <[Solution]>::len),
            exact: None,
            screw: None,
            oracle: None,
            worst_residual: None,
            nearest: None,
            is_singular: false,
            verdict: Verdict::Open,
        }
    }
}

/// The checks of one program.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The names of the inputs.
    pub inputs: Vec<String>,
    /// The names of the joints.
    pub joints: Vec<String>,
    /// One row for each target.
    pub rows: Vec<Row>,
}

/// The totals of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Summary {
    /// The number of targets.
    pub rows: usize,
    /// The number of rows that failed.
    pub failed: usize,
    /// The number of targets on strata that the program does not cover.
    pub open: usize,
    /// The number of targets whose real solutions were counted exactly.
    pub exact: usize,
    /// The number of targets that the screw solver solved too.
    pub screw: usize,
    /// The number of targets that the oracle solved too.
    pub oracle: usize,
    /// The largest residual of all rows.
    pub worst_residual: f64,
}

impl Row {
    /// The target and its faults as text.
    pub fn weakness(&self) -> String {
        let target: Vec<String> = self.target.iter().map(|value| format!("{value:?}")).collect();
        let faults: Vec<&str> = self.verdict.faults().iter().map(|fault| fault.sentence()).collect();
        format!("{} ({}): {}", self.kind, target.join(","), faults.join("; "))
    }

    /// Whether there are faults at or next to a singular target: a weak spot of the solver. Faults elsewhere are failures.
    pub fn is_weak_spot(&self) -> bool {
        self.is_singular && matches!(self.verdict, Verdict::Fail(_))
    }
}

impl Report {
    /// The rows that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| matches!(row.verdict, Verdict::Fail(_)))
    }

    /// These rows, then those of the ideal robot.
    #[must_use]
    pub(crate) fn with_ideal(mut self, ideal: Report) -> Report {
        for row in ideal.rows {
            self.rows.push(Row { number: self.rows.len() + 1, kind: Kind::OfIdeal(Box::new(row.kind)), ..row });
        }
        self
    }

    /// These rows, then others.
    #[must_use]
    pub(super) fn with_rows(mut self, rows: Vec<Row>) -> Report {
        for row in rows {
            self.rows.push(Row { number: self.rows.len() + 1, ..row });
        }
        self
    }

    /// The failed rows at or next to singular targets.
    pub fn weak_spots(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.is_weak_spot())
    }

    /// Same report, with the angles that made each target moved by whole turns into the limits of `chain`, if possible. Given angles are unchanged.
    pub(super) fn turned(mut self, chain: &Chain) -> Self {
        let given = chain.given();
        let turns = |(place, joint): &(usize, &Joint)| joint.kind == JointKind::Revolute && !given.contains(place);
        for (place, joint) in chain.joints().iter().enumerate().filter(turns) {
            for q in self.rows.iter_mut().filter_map(|row| row.joints.as_mut()) {
                q[place] = Placed::turned(q[place], joint.limits).value;
            }
        }
        self
    }

    /// The totals of the report.
    pub fn summary(&self) -> Summary {
        let count = |holds: fn(&Row) -> bool| self.rows.iter().filter(|row| holds(row)).count();
        Summary {
            rows: self.rows.len(),
            failed: self.failures().count(),
            open: count(|row| row.verdict == Verdict::Open),
            exact: count(|row| row.exact.is_some()),
            screw: count(|row| row.screw.is_some()),
            oracle: count(|row| row.oracle.is_some()),
            worst_residual: self.rows.iter().filter_map(|row| row.worst_residual).fold(0.0, f64::max),
        }
    }

    /// The stage file `6_check.csv`: a header, then one line per row. Residuals and distances are rounded up to a power of ten.
    pub fn to_csv(&self) -> String {
        let heading = ["kind"].into_iter().chain(self.inputs.iter().chain(&self.joints).map(String::as_str));
        let checks = ["solutions", "exact", "screw", "oracle", "worst_residual", "nearest", "verdict"];
        let mut text = line(heading.chain(checks).map(str::to_owned));
        for row in &self.rows {
            text += &row.line(self.joints.len());
        }
        text
    }
}

impl Row {
    fn line(&self, joints: usize) -> String {
        let count = |count: Option<usize>| count.map(|count| count.to_string()).unwrap_or_default();
        let mut cells = vec![self.kind.to_string()];
        cells.extend(self.target.iter().map(|value| format!("{value:.16e}")));
        match &self.joints {
            Some(q) => cells.extend(q.iter().map(|value| format!("{value:.8e}"))),
            None => cells.extend(vec![String::new(); joints]),
        }
        cells.extend([self.solutions.to_string(), count(self.exact), count(self.screw), count(self.oracle)]);
        cells.extend([self.worst_residual, self.nearest].map(|value| value.map(decade).unwrap_or_default()));
        cells.push(self.verdict.to_string());
        line(cells.into_iter())
    }
}

/// One line of a CSV file (RFC 4180), ending in a line feed.
fn line(cells: impl Iterator<Item = String>) -> String {
    let quoted = |cell: String| {
        if cell.contains([',', '"', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
    };
    cells.map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

/// The least power of ten that is not less than `value`, such as `1e-15`; `0` for zero.
pub(super) fn decade(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value if value.is_finite() => format!("1e{}", value.log10().ceil()),
        _ => "inf".to_owned(),
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Kind::Random => f.write_str("random"),
            Kind::Boundary => f.write_str("boundary"),
            Kind::Stratum(text) => f.write_str(text),
            Kind::Far => f.write_str("far"),
            Kind::Rational => f.write_str("rational"),
            Kind::Special => f.write_str("special"),
            Kind::Round => f.write_str("round"),
            Kind::Aligned => f.write_str("aligned"),
            Kind::Singular => f.write_str("singular"),
            Kind::Near(k) => write!(f, "1e-{k} of singular"),
            Kind::Edge(k) => write!(f, "1e-{k} of the edge"),
            Kind::Anywhere => f.write_str("anywhere"),
            Kind::Arcs => f.write_str("arcs"),
            Kind::OfIdeal(kind) => write!(f, "ideal robot: {kind}"),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Fault::Missing => "missing",
            Fault::Residual => "residual",
            Fault::Range => "range",
            Fault::Duplicate => "duplicate",
            Fault::Bound => "bound",
            Fault::Free => "free",
            Fault::SelfMotion => "self-motion",
            Fault::Count => "count",
            Fault::Screw => "screw",
            Fault::Oracle => "oracle",
            Fault::Moved => "moved",
            Fault::Limits => "limits",
        })
    }
}

impl Fault {
    /// The fault as text.
    pub fn sentence(self) -> &'static str {
        match self {
            Fault::Missing => "the joint values from which the target was computed are missing",
            Fault::Residual => "a solution does not reach the target",
            Fault::Range => "a solution is not finite, or has an angle outside (-pi, pi]",
            Fault::Duplicate => "two solutions are equal",
            Fault::Bound => "there are more solutions than the certified number of complex ones",
            Fault::Free => "a joint is reported free but cannot move there",
            Fault::SelfMotion => "the target has a self-motion, and no solution with a free joint represents it",
            Fault::Count => "the number of solutions differs from the exact count of real roots",
            Fault::Screw => "the screw solver (Paden-Kahan) has other solutions",
            Fault::Oracle => "damped least squares from many seeds has other solutions",
            Fault::Moved => "the target moved by 1e-7 has other solutions",
            Fault::Limits => "an end of an arc is beyond limits",
        }
    }
}

impl Verdict {
    /// The faults; empty if there are none.
    pub fn faults(&self) -> &[Fault] {
        if let Verdict::Fail(faults) = self { faults } else { &[] }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Pass => f.write_str("pass"),
            Verdict::Open => f.write_str("open"),
            Verdict::Fail(faults) => {
                let words: Vec<String> = faults.iter().map(Fault::to_string).collect();
                write!(f, "FAIL {}", words.join(" "))
            }
        }
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "row {}, {}, target {:?}: {}", self.number, self.kind, self.target, self.verdict)
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let worst = decade(self.worst_residual);
        write!(f, "{} targets, {} failed, {} open; ", self.rows, self.failed, self.open)?;
        write!(f, "{} counted exactly, {} by screws, {} by the oracle; ", self.exact, self.screw, self.oracle)?;
        write!(f, "residuals up to {worst}")
    }
}
