//! `groebot ik`: all joint values that move a tip to a target, by screw theory (Paden-Kahan subproblems) without a
//! derivation, or by numeric search.

mod page;
pub mod target;

use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::Path;

use super::derive::choice_text;
use super::ends::TipLink;
use super::plan::Mechanism;
use super::targets::{self, Row};
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::numeric::NumericSolver;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, InverseKinematics, Solution};
use page::{Page, Question, turned};

const EXAMPLES: &str = "Examples:
  groebot ik ur5 --target 0.4,0.1,0.5,0,180,0 --degrees      position, then roll, pitch, yaw
  groebot ik puma --target 0.3,1.1,0.4,0,0,0,1               position, then the quaternion x, y, z, w
  groebot ik nao_left_leg --q 0.1,0.2,-0.3,0.5,-0.1,0.2      the pose of these joint values
  groebot ik robot.urdf --base base_link --tip tool0 --q 0,-90,90,0,0,0 --degrees
  groebot ik general_arm.toml --numeric --target 0.3,1.1,0.4,0,0,0,1
  groebot fk robot.urdf < joints.csv | groebot ik robot.urdf > answers.csv

Positions are in the length unit of the description, in its base frame. A rotation is Rz(yaw)
Ry(pitch) Rx(roll), as in a URDF.

Other tasks have fewer numbers: x,y,z for a position, and then a direction for a ray; a direction
alone, or angles or a quaternion alone; two coordinates in a plane, or those and the angle about its
normal. Values of given joints come last. If a task leaves one joint too many and none is given, the
planner chooses it; `derive` and `solve` find the solutions for all of its values. Angles of solutions
are moved into their joint's limits by whole turns where possible.

A CSV may start with a line of names: px, py, pz (or x_m, x_mm), then qx to qw, r11 to r33, or roll,
pitch, yaw (or roll_deg); dx, dy, dz, phi, and given joints. Other columns that `fk`, `ik` and
`solve` write are ignored; unknown names are errors.

A target out of reach is not an error. The output is \"no solution\".";

/// The name of the method without a guarantee that it finds all solutions.
const NUMERIC: &str = "numeric, maybe not all";

/// Computes all joint values for a target by screw theory (Paden-Kahan subproblems), each checked by forward kinematics
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    mechanism: Mechanism,
    /// The target, numbers separated by commas (repeatable); `-`, or neither this nor --q: CSV from standard input
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    target: Vec<String>,
    /// Joint values whose pose is the target (repeatable)
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    q: Vec<String>,
    /// Use a numeric search for any chain instead: damped least squares from 300 starts; each solution is checked, but
    /// some may be missing
    #[arg(long)]
    numeric: bool,
    /// Print JSON: one object per target
    #[arg(long)]
    json: bool,
    /// Use degrees instead of radians in targets, joint values and JSON (text has both)
    #[arg(long)]
    degrees: bool,
}

/// Prints the solutions of each target.
pub fn run(arguments: &Arguments) -> Outcome {
    let requested =
        if arguments.numeric { arguments.mechanism.searched()? } else { arguments.mechanism.requested()? };
    let method = if arguments.numeric {
        Method::numeric(requested.chain()?)?
    } else {
        Method::Screws(Box::new(requested.solver()?))
    };
    let question = Question {
        chain: requested.chain()?,
        method: method.name(),
        tip: requested.tip(),
        choice: requested.choice.as_ref(),
        notes: requested.notes(),
        degrees: arguments.degrees,
    };
    if !arguments.json {
        console::print_notes(requested.notes());
    }
    let session = Session { question: &question, solver: method.solver(), as_json: arguments.json };
    let nothing = arguments.target.is_empty() && arguments.q.is_empty();
    match arguments.target.as_slice() {
        [] if nothing && io::stdin().is_terminal() => Err(no_target().into()),
        [dash] if dash == "-" => session.stream(arguments.mechanism.input()),
        [] if nothing => session.stream(arguments.mechanism.input()),
        _ => session.listed(arguments),
    }
}

/// The chain and its solver.
struct Session<'a> {
    question: &'a Question<'a>,
    solver: &'a dyn InverseKinematics,
    as_json: bool,
}

impl Session<'_> {
    /// The solutions of a target, moved into limits by whole turns.
    fn solve(&self, (target, given): &target::Aim) -> Result<Vec<Solution>> {
        let mut answers = Vec::new();
        self.solver.solve(target, given, &mut answers)?;
        turned(self.question.chain, &mut answers);
        Ok(answers)
    }

    /// Solves the targets and joint values of the command line; prints text, or JSON.
    fn listed(&self, arguments: &Arguments) -> Outcome {
        let Question { chain, tip, choice, degrees, .. } = self.question;
        let given = arguments.target.iter().map(|text| (text, target::target(chain, text, *degrees)));
        let reached = arguments.q.iter().map(|text| (text, target::reached(chain, text, *degrees)));
        let heading = || TipLink::line(tip.as_ref()) + &choice.map(choice_text).unwrap_or_default();
        let mut page = if self.as_json { String::new() } else { heading() };
        for (text, aim) in given.chain(reached) {
            let context = |error: Error| error.with_context(format!("`{}`", targets::shown(text)));
            let aim = aim.map_err(context)?;
            let answers = self.solve(&aim).map_err(context)?;
            let page_of = Page { question: self.question, text, target: &aim.0, given: &aim.1, answers: &answers };
            page += &if self.as_json { page_of.json(true) } else { page_of.table() };
        }
        console::print(&page)
    }

    /// Solves the targets of a table on standard input, while `mechanism` is read from another file. Writes CSV, or one
    /// JSON object per line.
    fn stream(&self, mechanism: &Path) -> Outcome {
        targets::is_free(mechanism, "--target or --q")?;
        let mut out = BufWriter::new(io::stdout().lock());
        let columns = target::columns(self.question.chain, self.question.degrees);
        let mut rows = targets::Reader::new(columns, io::stdin().lock(), Path::new(targets::STDIN));
        let mut index = 0;
        let outcome = loop {
            let Some(row) = rows.next() else { break if index > 0 { Ok(()) } else { Err(no_target()) } };
            let start = if index == 0 && !self.as_json { self.question.csv_header() } else { String::new() };
            index += 1;
            match row.and_then(|row| self.answered(&row, index)) {
                Ok(text) => out.write_all((start + &text).as_bytes()).map_err(|error| console::unwritten(&error))?,
                Err(error) => break Err(error),
            }
        };
        out.flush().map_err(|error| console::unwritten(&error))?;
        Ok(outcome?)
    }

    /// The solutions for a row of the table.
    fn answered(&self, row: &Row, index: usize) -> Result<String> {
        let at = |error: Error| error.at_line(row.line).in_file(Path::new(targets::STDIN));
        let aim = target::aim(self.question.chain, &row.target, self.question.degrees).map_err(at)?;
        let answers = self.solve(&aim).map_err(at)?;
        let text = row.target.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let page = Page { question: self.question, text: &text, target: &aim.0, given: &aim.1, answers: &answers };
        Ok(if self.as_json { page.json(false) } else { page.csv(index) })
    }
}

fn no_target() -> Error {
    let text = "no target; give one by --target, joint values by --q, or CSV on standard input";
    Error::new(ErrorKind::MissingKey, text)
}

/// The method of solution.
enum Method {
    Screws(Box<ScrewSolver>),
    Numeric(Box<NumericSolver>),
}

impl Method {
    fn numeric(chain: &Chain) -> Result<Self> {
        NumericSolver::new(chain).map(|solver| Method::Numeric(Box::new(solver)))
    }

    fn solver(&self) -> &dyn InverseKinematics {
        match self {
            Method::Screws(solver) => solver.as_ref(),
            Method::Numeric(solver) => solver.as_ref(),
        }
    }

    /// Its name in JSON.
    fn name(&self) -> &'static str {
        match self {
            Method::Screws(_) => "screw theory",
            Method::Numeric(_) => NUMERIC,
        }
    }
}
