//! What the checks found: [`Report`], its table `6_check.csv` and its summary.

use groebot_robot::kinematics::{Chain, Joint, JointKind, Placed, Solution};
use std::fmt;

/// How a row's target was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From random joint values.
    Random,
    /// From a singular configuration, or with one angle at 0 or pi.
    Boundary,
    /// On or near the zero set of factors; the text says which and how near, such as `pz = 1e-7`.
    Stratum(String),
    /// Out of reach: a reachable target times ten, or ten reaches further away.
    Far,
    /// From joint values whose cosines and sines are rational.
    Rational,
    /// From one joint at a multiple of a right angle.
    Special,
    /// From joint values in steps of 15 or 30 degrees.
    Round,
    /// Axes along those of the base, at a position on a grid.
    Aligned,
    /// From a singular configuration of a chain.
    Singular,
    /// From a configuration 10^-k (rad, or a share of the reach) away from a singular one.
    Near(u32),
    /// The target of a singular configuration moved by 10^-k where the tip cannot go: to either side of the boundary of the workspace.
    Edge(u32),
    /// Any target, reachable or not.
    Anywhere,
    /// The same of the ideal robot, where answers are polished on the one described.
    OfIdeal(Box<Kind>),
}

impl Kind {
    /// Whether the target is made of round numbers.
    pub fn is_round(&self) -> bool {
        matches!(self, Kind::Round | Kind::Aligned)
    }
}

/// What is wrong with the answers at a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The joint values that made the target are not among the answers.
    Missing,
    /// An answer does not satisfy the equations.
    Residual,
    /// An answer is malformed: not finite, or an angle outside (-pi, pi].
    Range,
    /// Two answers are the same.
    Duplicate,
    /// There are more answers than the program's largest case has branches.
    Bound,
    /// A joint is called free where the Jacobian is regular.
    Free,
    /// The joint values that made the target belong to a self-motion, and no answer with a free joint represents it.
    SelfMotion,
    /// The number of answers differs from the exact number of real solutions.
    Count,
    /// The answers differ from those of the screw solver.
    Screw,
    /// The answers differ from those of the numeric oracle.
    Oracle,
    /// The target moved a little has an ordinary answer that is next to none of them.
    Moved,
}

/// Whether the answers at a target are right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All checks passed.
    Pass,
    /// The target lies on a stratum that the program says it does not cover.
    Open,
    /// Some checks failed.
    Fail(Vec<Fault>),
}

/// The checks at one target.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The number of the row, from 1.
    pub number: usize,
    /// How the target was made.
    pub kind: Kind,
    /// The target: one number an input, in the system's unit or radians.
    pub target: Vec<f64>,
    /// The joint values that it was made from.
    pub joints: Option<Vec<f64>>,
    /// The number of the program's answers.
    pub solutions: usize,
    /// The exact number of distinct real solutions, where it was counted.
    pub exact: Option<usize>,
    /// The number of the screw solver's answers, where it applies.
    pub screw: Option<usize>,
    /// The number of the oracle's answers, where it was asked.
    pub oracle: Option<usize>,
    /// The largest value of an equation at an answer, as a share of the sum of its terms' sizes.
    pub worst_residual: Option<f64>,
    /// The distance of the nearest answer from `joints`: radians, or a share of the typical length.
    pub nearest: Option<f64>,
    /// Whether the target is singular or next to such: joint values that made it or solve it are.
    pub is_singular: bool,
    /// Whether all is right.
    pub verdict: Verdict,
}

impl Row {
    /// The row with this number from 0, before anything is checked; no answers are a gap of the solver.
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
pub struct Report {
    /// The names of the inputs.
    pub inputs: Vec<String>,
    /// The names of the joints.
    pub joints: Vec<String>,
    /// One row for each target.
    pub rows: Vec<Row>,
}

/// A report in a few numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Summary {
    /// Targets.
    pub rows: usize,
    /// Rows that failed.
    pub failed: usize,
    /// Targets on a stratum that the program does not cover.
    pub open: usize,
    /// Targets whose real solutions were counted exactly.
    pub exact: usize,
    /// Targets that the screw solver solved too.
    pub screw: usize,
    /// Targets that the oracle solved too.
    pub oracle: usize,
    /// The largest residual of all rows.
    pub worst_residual: f64,
}

impl Row {
    /// What is wrong, in words, with the target.
    pub fn weakness(&self) -> String {
        let target: Vec<String> = self.target.iter().map(|value| format!("{value:?}")).collect();
        let faults: Vec<&str> = self.verdict.faults().iter().map(|fault| fault.sentence()).collect();
        format!("{} ({}): {}", self.kind, target.join(","), faults.join("; "))
    }

    /// Whether something is wrong at a singular target, or next to one: a weak spot of the solver. Anywhere else it is a failure.
    pub fn is_weak_spot(&self) -> bool {
        self.is_singular && matches!(self.verdict, Verdict::Fail(_))
    }
}

impl Report {
    /// The rows that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| matches!(row.verdict, Verdict::Fail(_)))
    }

    /// These rows, and behind them those of the ideal robot.
    #[must_use]
    pub fn with_ideal(mut self, ideal: Report) -> Report {
        for row in ideal.rows {
            self.rows.push(Row { number: self.rows.len() + 1, kind: Kind::OfIdeal(Box::new(row.kind)), ..row });
        }
        self
    }

    /// The failures that are singular targets, or next to such.
    pub fn weak_spots(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.is_weak_spot())
    }

    /// The same with the angles that made each target turned into the limits of `chain`, where whole turns do that; given ones stay unchanged.
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

    /// The report in a few numbers.
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

    /// The stage file `6_check.csv`: a heading, then one line a row. Residuals and distances are rounded up to a power of ten.
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

/// The least power of ten that is not less than `value`: `1e-15`; `0` for zero.
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
        })
    }
}

impl Fault {
    /// What is wrong, in words.
    pub fn sentence(self) -> &'static str {
        match self {
            Fault::Missing => "the joint values that made the target are not among them",
            Fault::Residual => "one does not bring the tip to the target",
            Fault::Range => "one is not finite, or has an angle outside (-pi, pi]",
            Fault::Duplicate => "two are the same",
            Fault::Bound => "there are more than the certified number of complex solutions",
            Fault::Free => "a joint is called free that cannot move there",
            Fault::SelfMotion => "the target has a self-motion, and none has a free joint that represents it",
            Fault::Count => "there are not as many as exact real roots",
            Fault::Screw => "the screw solver (Paden-Kahan) has others",
            Fault::Oracle => "damped least squares from many seeds has others",
            Fault::Moved => "the target moved by 1e-7 has others",
        }
    }
}

impl Verdict {
    /// What is wrong; empty where nothing is.
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
