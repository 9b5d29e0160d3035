//! The walk through a program's blocks: every case that applies, every root, every sample.

use smallvec::SmallVec;

use super::answers::Answers;
use super::eigenvalue::SixAxes;
use super::frame::Frame;
use super::instruction::Operand;
use super::joint::JointValue;
use super::path::Path;
use super::program::{Block, Case, Program, Step, square};
use super::{BESIDE, GRAZING, MEETING, NEAR, PIVOT};
use crate::{Error, ErrorKind, Result, roots};

/// The coefficients of a polynomial, constant term first.
type Coefficients = SmallVec<[f64; roots::MAX_DEGREE + 1]>;

/// What is known of a block before it runs.
struct Place {
    /// Where its registers begin.
    base: usize,
    /// Its number of branch numbers.
    radix: usize,
}

/// A run of a program for one target.
pub(super) struct Walk<'a> {
    program: &'a Program,
    places: Vec<Place>,
    frame: Frame<'a>,
    answers: Answers<'a>,
    /// A miss of `x^2 + c` up to this share counts as a root.
    tangent: f64,
}

impl<'a> Walk<'a> {
    pub fn new(program: &'a Program, parameters: &'a [f64], magnitude: f64, answers: Answers<'a>) -> Self {
        let mut registers = 0;
        let place = |block: &Block| {
            let base = registers;
            registers += block.registers();
            Place { base, radix: block.branches() }
        };
        let places = program.blocks.iter().map(place).collect();
        let frame = Frame::new(parameters, magnitude, program.unknowns.len(), registers);
        let tangent = if program.degree() > 2 { GRAZING } else { roots::TANGENT };
        Walk { program, places, frame, answers, tangent }
    }

    /// Walks all paths.
    pub fn run(mut self) -> Result<Answers<'a>> {
        self.block(0, Path::default())?;
        Ok(self.answers)
    }

    /// Runs block `index`, and all behind it, for the unknowns found so far; behind the last one there is a candidate.
    fn block(&mut self, index: usize, path: Path) -> Result<()> {
        let Some(block) = self.program.blocks.get(index) else {
            self.answers.propose(&path, &self.frame.unknowns);
            return Ok(());
        };
        let outer = std::mem::replace(&mut self.frame.base, self.places[index].base);
        self.frame.run(&block.code);
        let before = self.answers.candidates;
        for first in (0..block.cases.len()).filter(|&case| block.opens_group(case)) {
            if let Some(case) = self.elect(&block.cases, first, before) {
                self.case(index, case, path)?;
            }
        }
        self.frame.base = outer;
        Ok(())
    }

    /// The case with index `first` if its guards hold, or the best of its pivot group; its guards' code has run last. There were
    /// so many candidates `before` the block.
    fn elect(&mut self, cases: &'a [Case], first: usize, before: usize) -> Option<&'a Case> {
        let Some(pivot) = cases[first].pivot else {
            let narrows = cases[first].is_of_stratum() && self.answers.suffice_since(before);
            return self.applies(&cases[first], if narrows { BESIDE } else { NEAR }).then_some(&cases[first]);
        };
        let (mut greatest, mut elected) = (-1.0, None);
        for case in &cases[first..] {
            let Some(claim) = case.pivot.filter(|claim| claim.group == pivot.group) else { continue };
            if self.applies(case, NEAR) && self.frame.value(claim.value).abs() > greatest {
                (greatest, elected) = (self.frame.value(claim.value).abs(), Some(case));
            }
        }
        elected.inspect(|case| self.frame.run(&case.guard_code))
    }

    fn applies(&mut self, case: &Case, near: f64) -> bool {
        self.frame.run(&case.guard_code);
        case.guards.iter().all(|guard| self.frame.holds(guard, near))
    }

    fn case(&mut self, block: usize, case: &Case, mut path: Path) -> Result<()> {
        if case.open {
            let text = format!("the target lies on `{}`, a stratum that could not be derived", case.label);
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let radix = self.places[block].radix;
        path.last = if block == 0 { case.first_branch + Program::branches(case) } else { path.last * radix };
        path.branch = path.branch * radix + case.first_branch;
        path.choice = 0;
        case.free.iter().for_each(|&joint| path.free[joint] = true);
        self.steps(block, &case.steps, path)
    }

    /// Runs the steps, once for each choice of roots and samples, and then the next block.
    fn steps(&mut self, block: usize, steps: &[Step], mut path: Path) -> Result<()> {
        for (index, step) in steps.iter().enumerate() {
            match step {
                Step::Compute(code) => self.frame.run(code),
                Step::Set { unknown, value } => self.frame.unknowns[*unknown] = self.frame.value(*value),
                Step::Roots { unknown, polynomials, typical } => {
                    let (roots, close) = self.find_roots(*unknown, polynomials, *typical);
                    path.close |= close;
                    path.choice *= step.slots();
                    for (choice, root) in roots.as_slice().iter().enumerate() {
                        self.frame.unknowns[*unknown] = *root;
                        let path = Path { choice: path.choice + choice, ..path };
                        self.steps(block, &steps[index + 1..], path)?;
                    }
                    return Ok(());
                }
                Step::SixAxes(six) => {
                    path.choice *= step.slots();
                    return self.six_axes(block, six, &steps[index + 1..], path);
                }
                Step::Sample { joint, values } => {
                    for value in values {
                        self.put(*joint, *value);
                        self.steps(block, &steps[index + 1..], path)?;
                    }
                    return Ok(());
                }
            }
        }
        path.branch += path.choice;
        self.block(block + 1, path)
    }

    /// Runs the steps behind one that finds six angles together, once for each of their solutions.
    fn six_axes(&mut self, block: usize, six: &SixAxes, behind: &[Step], path: Path) -> Result<()> {
        let target = six.parts().target.map(|operand| self.frame.value(operand));
        let (found, answers) = six.solve(&target);
        let lost = answers.lost().iter().map(|q| (*q, [false; 6], true));
        for (choice, (q, free, is_lost)) in found.iter().map(|a| (a.q, a.free, false)).chain(lost).enumerate() {
            let mut path = Path { choice: path.choice + choice, close: path.close || is_lost, ..path };
            for (place, joint) in six.parts().joints.iter().enumerate() {
                self.put(*joint, q[place]);
                let index = self.program.joints.iter().position(|other| other.value == *joint);
                index.into_iter().for_each(|index| path.free[index] |= free[place]);
            }
            self.steps(block, behind, path)?;
        }
        Ok(())
    }

    fn put(&mut self, joint: JointValue, value: f64) {
        match joint {
            JointValue::Angle { cosine, sine } => {
                self.frame.unknowns[cosine] = value.cos();
                self.frame.unknowns[sine] = value.sin();
            }
            JointValue::Plain(unknown) => self.frame.unknowns[unknown] = value,
        }
    }

    /// The real roots of the first polynomial whose leading coefficient is not negligible, and whether some are close to one another.
    fn find_roots(
        &self,
        unknown: usize,
        polynomials: &[Vec<Operand>],
        typical: Option<Operand>,
    ) -> (roots::Roots, bool) {
        let frame = &self.frame;
        let usual = if self.program.is_plain(unknown) { Operand::Magnitude } else { Operand::Constant(1.0) };
        let typical = frame.value(typical.unwrap_or(usual));
        if let Some(constant) = square(polynomials) {
            let roots = roots::square_roots(frame.value(constant), typical, self.tangent);
            return (roots, roots.as_slice().last().is_some_and(|root| *root <= MEETING * typical));
        }
        let coefficients = self.leading(polynomials);
        let roots = roots::real_roots(coefficients.as_slice(), typical);
        let close = are_close(roots.as_slice(), coefficients.len(), typical);
        (roots, close)
    }

    /// The coefficients of the first polynomial whose leading one is not negligible, or of the last.
    fn leading(&self, polynomials: &[Vec<Operand>]) -> Coefficients {
        let values = |list: &Vec<Operand>| list.iter().map(|&operand| self.frame.value(operand)).collect();
        let (last, earlier) = polynomials.split_last().expect("a valid program has a polynomial for each root step");
        let leads = |line: &Coefficients| {
            let largest = line.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            line.last().is_some_and(|lead| lead.abs() > PIVOT * largest)
        };
        earlier.iter().map(values).find(leads).unwrap_or_else(|| values(last))
    }
}

/// Whether roots of a polynomial with so many coefficients are close to one another, or one of them is double.
fn are_close(roots: &[f64], coefficients: usize, typical: f64) -> bool {
    let is_double = !roots.is_empty() && roots.len() % 2 == coefficients % 2;
    is_double || roots.windows(2).any(|pair| pair[1] - pair[0] <= MEETING * typical)
}
