//! The traversal of prepared blocks, for any type of number. Main type: [`Run`].

use groebot_runtime as runtime;
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::{Candidates, Found, Number, With};

use super::blocks::{Alternative, Applies, Guard, JointPlace, PreparedCase, PreparedStep, Six};
use super::code::Line;
use super::shaped::Shaped;
use groebot_algebra::roots::MAX_DEGREE;

/// A traversal for one target, or several at once.
pub(super) struct Run<'a, S, N, C> {
    pub solver: &'a Shaped<S>,
    pub memory: &'a mut [Line<N>],
    pub candidates: &'a mut C,
}

impl<S: Storage + 'static, N: Number, C: Candidates<N, Shaped<S>>> Run<'_, S, N, C>
where
    f64: With<N>,
{
    fn at(&self, place: u32) -> N {
        self.memory[place as usize].0
    }

    /// Runs the block with this index and all after it.
    pub fn block(&mut self, index: usize, found: Found<N>) {
        let solver = self.solver;
        let Some(block) = solver.blocks.list.get(index) else {
            let places = &solver.blocks.places;
            let at = Array::by(places.len(), |i| self.at(places[i]));
            return self.candidates.finish(solver, found, &at);
        };
        block.code.run(self.memory);
        let before = self.candidates.count();
        for alternative in &block.alternatives {
            match alternative {
                Alternative::Guarded(case) => {
                    if self.applies(case, before) {
                        self.case(index, case, found);
                    }
                }
                Alternative::Gap(number, case) => {
                    case.code.run(self.memory);
                    let guard = self.guard(&case.guards);
                    self.candidates.is_open(*number, guard);
                }
                Alternative::BestConditioned(members) => {
                    if let Some(case) = self.elect(members) {
                        self.case(index, case, found);
                    }
                }
            }
        }
    }

    fn applies(&mut self, case: &PreparedCase, before: usize) -> bool {
        case.code.run(self.memory);
        if case.guards.is_empty() {
            return true;
        }
        let guard = self.guard(&case.guards);
        match case.applies {
            Applies::Usually => self.candidates.is_usual(guard),
            Applies::Rarely => self.candidates.is_rare(guard),
            Applies::Near => self.candidates.is_due(before, guard),
        }
    }

    /// The mask of targets for which all guards hold.
    fn guard(&self, guards: &[Guard]) -> runtime::Guard<N> {
        let guard = |guard: &Guard| {
            let (value, scale) = (self.at(guard.value), self.at(guard.scale));
            if guard.near { value.near(scale) } else { value.away(scale) }
        };
        guards.iter().map(guard).reduce(|all, one| all & one).unwrap_or_else(|| N::of(1.0).away(N::of(1.0)))
    }

    /// The best conditioned case of a group; its guards' code has run last.
    fn elect<'m>(&mut self, members: &'m [(u32, PreparedCase)]) -> Option<&'m PreparedCase> {
        let mut claims = Vec::with_capacity(members.len());
        for (pivot, case) in members {
            case.code.run(self.memory);
            claims.push(self.guard(&case.guards).claim(self.at(*pivot)));
        }
        let (_, case) = members.get(self.candidates.elect(&claims))?;
        case.code.run(self.memory);
        Some(case)
    }

    fn case(&mut self, index: usize, case: &PreparedCase, found: Found<N>) {
        let found = if index == 0 { Found::first(0, case.last) } else { found };
        self.steps(index, case, &case.steps, found.freeing(case.free), case.first_branch);
    }

    /// Runs the steps, once for each choice of roots and samples, and then the next block; `number` is the code of this
    /// block's choices.
    fn steps(&mut self, index: usize, case: &PreparedCase, steps: &[PreparedStep], found: Found<N>, number: usize) {
        for (done, step) in steps.iter().enumerate() {
            let rest = &steps[done + 1..];
            match step {
                PreparedStep::Compute(code) => code.run(self.memory),
                PreparedStep::Set { unknown, value } => self.memory[*unknown as usize].0 = self.at(*value),
                PreparedStep::Square { unknown, constant, typical, stride, is_pair } => {
                    let (constant, typical) = (self.at(*constant), self.at(*typical));
                    let roots = if self.solver.blocks.grazing {
                        N::grazing_roots(constant, typical)
                    } else {
                        N::square_roots(constant, typical)
                    };
                    if *is_pair {
                        if let Some(root) = roots.as_slice().first() {
                            self.memory[*unknown as usize].0 = *root;
                            self.steps(index, case, rest, found.by_pair(&roots), number);
                        }
                        return;
                    }
                    for (choice, root) in roots.as_slice().iter().enumerate() {
                        self.memory[*unknown as usize].0 = *root;
                        self.steps(index, case, rest, found.by_root(&roots, choice), number + choice * stride);
                    }
                    return;
                }
                PreparedStep::Roots { unknown, polynomials, typical, half_angle, stride } => {
                    let values = |list: &Vec<u32>| list.iter().map(|&place| self.at(place)).collect::<Vec<N>>();
                    let lists: Vec<Vec<N>> = polynomials.iter().map(values).collect();
                    let lists: Vec<&[N]> = lists.iter().map(Vec::as_slice).collect();
                    let typical = self.at(*typical);
                    let roots = match half_angle {
                        true => N::half_angle_roots::<MAX_DEGREE>(lists[0], typical),
                        false => N::real_roots::<MAX_DEGREE>(&lists, typical),
                    };
                    for (choice, root) in roots.as_slice().iter().enumerate() {
                        self.memory[*unknown as usize].0 = *root;
                        self.steps(index, case, rest, found.by_root(&roots, choice), number + choice * stride);
                    }
                    return;
                }
                PreparedStep::Sample { unknowns, rows } => {
                    for row in rows {
                        for (unknown, value) in unknowns.iter().zip(row) {
                            self.memory[*unknown as usize].0 = N::of(*value);
                        }
                        self.steps(index, case, rest, found, number);
                    }
                    return;
                }
                PreparedStep::SixAxes(six) => return self.six_axes(index, case, six, rest, found, number),
            }
        }
        let found = if index == 0 { Found { branch: number, ..found } } else { found.next(self.radix(index), number) };
        self.block(index + 1, found);
    }

    fn radix(&self, index: usize) -> usize {
        self.solver.blocks.list[index].radix
    }

    fn six_axes(
        &mut self,
        index: usize,
        case: &PreparedCase,
        six: &Six,
        rest: &[PreparedStep],
        found: Found<N>,
        number: usize,
    ) {
        let numbers = six.numbers.map(|place| self.at(place));
        let Some(answers) = N::alone(&numbers, |numbers| six.chain.solve_given(&six.given, numbers)) else { return };
        for (choice, answer) in answers.as_slice().iter().enumerate() {
            for (joint, &value) in six.joints.iter().zip(&answer.q) {
                match *joint {
                    JointPlace::Angle([cosine, sine]) => {
                        self.memory[cosine as usize].0 = N::of(value).cos();
                        self.memory[sine as usize].0 = N::of(value).sin();
                    }
                    JointPlace::Length(place) => self.memory[place as usize].0 = N::of(value),
                }
            }
            let found = found.by_answer(&answer.free, answer.lost, six.bits);
            self.steps(index, case, rest, found, number + choice * six.stride);
        }
    }
}
