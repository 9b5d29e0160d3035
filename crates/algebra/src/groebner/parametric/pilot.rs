//! How far a computation with the parameters as variables may go, and when it has got far enough.
//!
//! The basis at a random point has the leading monomials of the basis over the rational functions. As soon as elements with these are found,
//! they are that basis: the pairs that are left only say where it specialises.

use super::estimate::Estimate;
use super::system::System;
use super::{FEW_TERMS, Ideal, TERMS_OF_POINTS, is_free};
use crate::groebner::f4::Guide;
use crate::poly::Monomial;
use crate::{Error, ErrorKind, Result, Watch};

/// The guide of a computation that begins without knowing anything, and looks at points when it gets long.
pub(super) struct Pilot<'a> {
    ideal: &'a Ideal<'a>,
    watch: &'a Watch,
    is_free: bool,
    /// Whether the computation ends when interpolation is worth more.
    is_bounded: bool,
    system: Option<(System, Estimate)>,
    goal: Option<Vec<Vec<u32>>>,
    /// So many terms are worth it, and perhaps more.
    worth: usize,
    is_refused: bool,
}

impl<'a> Pilot<'a> {
    /// A pilot that goes on to the end.
    pub fn unbounded(ideal: &'a Ideal<'a>, watch: &'a Watch) -> Self {
        let is_free = is_free(ideal);
        let (system, goal) = (None, None);
        Pilot { ideal, watch, is_free, is_bounded: false, system, goal, worth: FEW_TERMS, is_refused: false }
    }

    /// A pilot that refuses what takes longer than interpolation; the parameters are free.
    pub fn bounded(ideal: &'a Ideal<'a>, watch: &'a Watch) -> Self {
        Pilot { is_bounded: true, ..Pilot::unbounded(ideal, watch) }
    }

    /// The leading monomials of the basis, smallest first, if points were looked at: two random ones agree.
    pub fn leads(&self) -> Option<impl Iterator<Item = &Monomial> + Clone> {
        self.system.as_ref().map(|(system, _)| system.leads())
    }

    /// The system, when the computation was refused.
    pub fn into_refused(self) -> Option<System> {
        self.system.filter(|_| self.is_refused).map(|(system, _)| system)
    }

    /// Looks at points, once.
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

    /// Looks at points for the goal alone: where they do not agree there is none.
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
        Err(Error::new(ErrorKind::Budget, "the parameters as variables take more terms than they are worth"))
    }

    fn goal(&self) -> Option<&[Vec<u32>]> {
        self.goal.as_deref()
    }

    fn wanted(&self, leads: &[Vec<u32>]) -> Vec<usize> {
        if self.is_free { minimal(self.ideal.ring.variables().len(), leads) } else { (0..leads.len()).collect() }
    }
}

/// Of elements with leading monomials of these exponents, smallest first: those without any of the `unknowns` first variables, which relations
/// of the parameters reduce to zero or which make the ideal the whole ring, and of the others those whose leading monomial in the
/// unknowns no smaller one divides.
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
