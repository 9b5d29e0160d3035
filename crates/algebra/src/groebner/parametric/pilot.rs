//! Limit and end of a computation with the parameters as variables.
//!
//! The basis at a random point has the leading monomials of the basis over the rational functions. As soon as elements
//! with these leading monomials are found, they are this basis. The remaining pairs only determine where it
//! specialises.

use super::estimate::Estimate;
use super::system::System;
use super::{FEW_TERMS, Ideal, TERMS_OF_POINTS, is_free};
use crate::groebner::f4::Guide;
use crate::poly::Monomial;
use crate::{Error, ErrorKind, Result, Watch};

/// The guide of a computation without prior knowledge. It evaluates points when the computation becomes long.
pub(super) struct Pilot<'a> {
    ideal: &'a Ideal<'a>,
    watch: &'a Watch,
    is_free: bool,
    /// Whether the computation ends when interpolation is cheaper.
    is_bounded: bool,
    system: Option<(System, Estimate)>,
    goal: Option<Vec<Vec<u32>>>,
    /// The computation is worth this many terms, possibly more.
    worth: usize,
    is_refused: bool,
}

impl<'a> Pilot<'a> {
    /// A guide without a limit.
    pub fn unbounded(ideal: &'a Ideal<'a>, watch: &'a Watch) -> Self {
        let is_free = is_free(ideal);
        let (system, goal) = (None, None);
        Pilot { ideal, watch, is_free, is_bounded: false, system, goal, worth: FEW_TERMS, is_refused: false }
    }

    /// A guide that refuses a computation longer than interpolation. The parameters have no relations.
    pub fn bounded(ideal: &'a Ideal<'a>, watch: &'a Watch) -> Self {
        Pilot { is_bounded: true, ..Pilot::unbounded(ideal, watch) }
    }

    /// The leading monomials of the basis, smallest first, if points were evaluated. Two random points agree on them.
    pub fn leads(&self) -> Option<impl Iterator<Item = &Monomial> + Clone> {
        self.system.as_ref().map(|(system, _)| system.leads())
    }

    /// The system, if the computation was refused.
    pub fn into_refused(self) -> Option<System> {
        self.system.filter(|_| self.is_refused).map(|(system, _)| system)
    }

    /// Evaluates points, once.
    fn system(&mut self) -> Result<&mut (System, Estimate)> {
        if self.system.is_none() {
            let system = System::new(self.ideal, self.watch)?;
            let layout = self.ideal.ring.layout();
            self.goal = Some(system.leads().map(|lead| layout.exponents(lead)).collect());
            let parameters = self.ideal.ring.field().ring().variables().len();
            self.system = Some((system, Estimate::new(parameters)));
        }
        Ok(self.system.as_mut().expect("it was filled"))
    }

    /// Evaluates points only for the goal. If they do not agree, there is no goal.
    fn look_ahead(&mut self) -> Result<()> {
        self.worth = usize::MAX;
        match self.system() {
            Err(error) if error.kind() != ErrorKind::BadValue => Err(error),
            _ => Ok(()),
        }
    }
}

impl Guide for Pilot<'_> {
    fn allow(&mut self, terms: usize) -> Result<()> {
        if terms <= self.worth || !self.is_free {
            return Ok(());
        }
        if !self.is_bounded {
            return self.look_ahead();
        }
        let watch = self.watch;
        let (system, estimate) = self.system()?;
        let enough = 2 * terms * TERMS_OF_POINTS / system.terms().max(1);
        self.worth = estimate.points(system, enough, watch)?.saturating_mul(system.terms()) / TERMS_OF_POINTS;
        if terms <= self.worth {
            return Ok(());
        }
        self.is_refused = true;
        Err(Error::new(ErrorKind::Budget, "the computation with the parameters as variables needs too many terms"))
    }

    fn goal(&self) -> Option<&[Vec<u32>]> {
        self.goal.as_deref()
    }

    fn wanted(&self, leads: &[Vec<u32>]) -> Vec<usize> {
        if self.is_free { minimal(self.ideal.ring.variables().len(), leads) } else { (0..leads.len()).collect() }
    }
}

/// Selects elements by the exponents of their leading monomials, smallest first. It takes those without any of the
/// first `unknowns` variables: relations of the parameters, or elements of the unit ideal. Among the others it takes
/// those whose leading monomial in the unknowns is minimal.
pub(super) fn minimal(unknowns: usize, leads: &[Vec<u32>]) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::with_capacity(leads.len());
    for (index, lead) in leads.iter().enumerate() {
        let part = |index: usize| &leads[index][..unknowns];
        let is_constant = |index: usize| part(index).iter().all(|&e| e == 0);
        let divides = |&other: &usize| !is_constant(other) && part(other).iter().zip(lead).all(|(a, b)| a <= b);
        if is_constant(index) || !chosen.iter().any(divides) {
            chosen.push(index);
        }
    }
    chosen
}
