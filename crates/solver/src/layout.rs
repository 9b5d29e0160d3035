//! Storage of numbers while a program runs: the unknowns that each block finds, those that later blocks read, and the
//! numbers that the equations read. Main type: [`Layout`].

use super::demand::Demand;
use super::joint::JointValue;
use super::mirror::Mirror;
use super::program::{Block, Case, Program, Step};

/// The storage of a program's values.
#[doc(hidden)]
pub struct Layout<'a> {
    pub program: &'a Program,
    /// Unknowns that the equations read and that belong to no joint: cases report their values.
    pub extra: Vec<usize>,
    /// The case whose candidates come in pairs.
    pub mirror: Option<Mirror>,
}

impl<'a> Layout<'a> {
    /// The layout of a valid program.
    pub fn new(program: &'a Program) -> Self {
        let layout = Layout { program, extra: extra_unknowns(program), mirror: None };
        let mirror = Mirror::of(program, &layout.wanted()).filter(|_| layout.extra.is_empty());
        Layout { mirror, ..layout }
    }

    /// By unknown, whether a block before the one with this index finds it.
    pub fn known_before(&self, block: usize) -> Vec<bool> {
        let mut known = vec![false; self.program.unknowns.len()];
        for case in self.program.blocks[..block].iter().flat_map(|block| &block.cases) {
            case.steps.iter().flat_map(found).for_each(|unknown| known[unknown] = true);
        }
        known
    }

    /// The unknowns that the block with this index must find: its own among those of solutions and those that later
    /// blocks read.
    pub fn wanted_of(&self, block: usize) -> Vec<usize> {
        let (before, after) = (self.known_before(block), self.known_before(block + 1));
        let mut wanted = vec![false; self.program.unknowns.len()];
        self.wanted().into_iter().for_each(|unknown| wanted[unknown] = true);
        for later in self.program.blocks[block + 1..].iter().rev() {
            let own: Vec<usize> = (0..wanted.len()).filter(|&unknown| wanted[unknown]).collect();
            for demand in self.block_demands(later, &own) {
                (0..wanted.len()).for_each(|unknown| wanted[unknown] |= demand.wants_unknown(unknown));
            }
        }
        (0..wanted.len()).filter(|&unknown| wanted[unknown] && after[unknown] && !before[unknown]).collect()
    }

    /// The demand of a block's code and cases when these unknowns are wanted.
    pub fn block_demands(&self, block: &Block, wanted: &[usize]) -> Vec<Demand> {
        let mut demands = vec![Demand::of_block(self.program, block, wanted)];
        for case in &block.cases {
            demands.push(Demand::of_case(self.program, case, if case.open { &[] } else { wanted }));
            demands.push(Demand::of_claim(case));
        }
        demands
    }

    /// Whether the case's second root is that of a pair of candidates.
    pub fn is_mirror(&self, case: &Case) -> bool {
        let is_here = |mirror: &Mirror| std::ptr::eq(&self.program.blocks[mirror.block].cases[mirror.case], case);
        self.mirror.as_ref().is_some_and(is_here)
    }

    /// The unknowns that solutions need.
    pub fn wanted(&self) -> Vec<usize> {
        let joints = self.program.joints.iter().flat_map(|joint| match joint.value {
            JointValue::Angle { cosine, sine } => vec![cosine, sine],
            JointValue::Plain(unknown) => vec![unknown],
        });
        joints.chain(self.extra.iter().copied()).collect()
    }

    /// The unknowns that the equations can read, without duplicates.
    pub fn places(&self) -> Vec<usize> {
        let mut places: Vec<usize> = Vec::new();
        for unknown in self.wanted() {
            if !places.contains(&unknown) {
                places.push(unknown);
            }
        }
        places
    }

    /// By joint, the indices of its cosine and sine, or of its value, among the places.
    pub fn joint_places(&self) -> Vec<Vec<usize>> {
        let unknowns = self.program.joints.iter().map(|joint| joint.value.unknowns());
        unknowns.map(|unknowns| unknowns.into_iter().map(|unknown| self.place(unknown)).collect()).collect()
    }

    pub fn place(&self, unknown: usize) -> usize {
        self.places().iter().position(|&other| other == unknown).expect("a joint's unknowns have places")
    }

    /// The index of the block that finds the joint with this index.
    pub fn finder(&self, joint: usize) -> usize {
        let unknowns = self.program.joints[joint].value.unknowns();
        let known = |block: usize| unknowns.iter().all(|&unknown| self.known_before(block + 1)[unknown]);
        (0..self.program.blocks.len()).find(|&block| known(block)).unwrap_or(self.program.blocks.len() - 1)
    }

    /// The joints in the reverse order of solution: solutions differ most in the first of these.
    pub fn last_first(&self) -> Vec<usize> {
        let mut joints: Vec<usize> = (0..self.program.joints.len()).collect();
        joints.sort_by_key(|&joint| std::cmp::Reverse(self.finder(joint)));
        joints
    }
}

/// Unknowns that the checks read and that follow from no joint.
fn extra_unknowns(program: &Program) -> Vec<usize> {
    let checks = &program.checks;
    let results = checks.residuals.iter().chain(&checks.scales).chain(checks.jacobian.iter().flatten());
    let demand = Demand::of_code(&checks.code, results);
    let is_joints = |unknown: usize| {
        program.joints.iter().any(|joint| match joint.value {
            JointValue::Angle { cosine, sine } => cosine == unknown || sine == unknown,
            JointValue::Plain(plain) => plain == unknown,
        })
    };
    (0..program.unknowns.len()).filter(|&unknown| demand.wants_unknown(unknown) && !is_joints(unknown)).collect()
}

/// The unknowns that a step finds.
fn found(step: &Step) -> Vec<usize> {
    match step {
        Step::Compute(_) => vec![],
        Step::Set { unknown, .. } | Step::Roots { unknown, .. } => vec![*unknown],
        Step::Sample { joint, .. } => unknowns(*joint),
        Step::SixAxes(six) => six.parts().joints.iter().flat_map(|joint| unknowns(*joint)).collect(),
    }
}

fn unknowns(joint: JointValue) -> Vec<usize> {
    match joint {
        JointValue::Angle { cosine, sine } => vec![cosine, sine],
        JointValue::Plain(unknown) => vec![unknown],
    }
}
