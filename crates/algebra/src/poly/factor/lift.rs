//! Multivariate Hensel lifting: extends the factors of an image in one variable to all variables, one variable at a
//! time (Monagan and Tuncer, Using sparse interpolation in Hensel lifting, 2016).
//!
//! Every factor is scaled to the leading coefficient of the whole polynomial, so that its coefficients are polynomials.
//! Its content is removed at the end. At each point of the variables lifted before, the factors are lifted in the next
//! variable alone ([`SeriesFactors`]). Their coefficients are interpolated with the monomials known from the variables
//! before.

use super::series::SeriesFactors;
use crate::poly::gcd::modular::Search;
use crate::poly::words::dense::{self, Dense};
use crate::poly::words::skeleton::{Orbit, Rows, Skeleton, base_point};
use crate::poly::words::{Flat, Packing, WordField};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// The variables of a lifting.
pub struct Variables<'a> {
    /// The variable of the image.
    pub main: usize,
    /// The variables that are lifted, in this order.
    pub others: &'a [usize],
    /// The values of the others at the point of the image.
    pub anchor: Vec<u64>,
}

/// A polynomial and the point where its factors are known: the invariant data of a lifting.
pub struct Lifting<'a, K> {
    field: &'a K,
    packing: &'a Packing,
    main: usize,
    others: Vec<usize>,
    anchor: Vec<u64>,
    levels: Vec<Flat>,
    leads: Vec<Flat>,
}

impl<'a, K: WordField> Lifting<'a, K> {
    /// Starts the lifting of `f`, primitive in `main`, from the point `anchor` of the variables `others`. Returns
    /// `None` when the degree in `main` drops there or the image has multiple factors.
    pub fn new(field: &'a K, packing: &'a Packing, f: &Flat, variables: Variables<'_>) -> Option<Self> {
        let Variables { main, others, anchor } = variables;
        let others = others.to_vec();
        let nothing_stops = Watch::none();
        let search = Search::new(field, packing, &nothing_stops);
        let levels = search.restrictions(f, &others, &anchor);
        let leads = search.restrictions(&f.leading_in(packing, main), &others, &anchor);
        let lifting = Lifting { field, packing, main, others, anchor, levels, leads };
        let line = lifting.line();
        let square_free = dense::gcd(field, &line, &dense::derivative(field, &line)).len() == 1;
        (square_free && !lifting.leads[0].is_zero()).then_some(lifting)
    }

    /// The univariate image in the main variable.
    pub fn line(&self) -> Dense {
        self.levels[0].dense(self.packing, self.main)
    }

    /// The finest partition of the factors of the image in which each part belongs to a factor in one more variable.
    pub fn partition(&self, factors: &[Dense], watch: &Watch) -> Result<Option<Vec<Vec<usize>>>> {
        let rows = |f: &Flat| Orbit::new(self.field, self.packing, f, &[], [self.main, self.others[0]]).rows();
        let (f, lead) = (rows(&self.levels[1]), rows(&self.leads[1]));
        let Some(series) = SeriesFactors::new(self.field, &f, &lead, factors, self.anchor[0]) else { return Ok(None) };
        let mut open: Vec<usize> = (0..factors.len()).collect();
        let (mut parts, mut size) = (Vec::new(), 1);
        while 2 * size <= open.len() {
            match first_subset(&open, size, watch, |chosen| series.is_factor(chosen))? {
                Some(part) => {
                    open.retain(|i| !part.contains(i));
                    parts.push(part);
                }
                None => size += 1,
            }
        }
        parts.push(open);
        Ok(Some(parts))
    }

    /// Lifts the factors of the image to the monic factors of `f`; `None` when the point was unlucky.
    pub fn factors(&self, images: &[Dense], random: &mut SplitMix64, watch: &Watch) -> Result<Option<Vec<Flat>>> {
        let lead = self.leads[0].values.first().copied().unwrap_or(0);
        let scaled = |image: &Dense| {
            Flat::from_dense(self.packing, self.main, &dense::scale(self.field, &dense::monic(self.field, image), lead))
        };
        let mut known: Vec<Flat> = images.iter().map(scaled).collect();
        for level in 0..self.others.len() {
            match self.extended(level, &known, random, watch)? {
                Some(next) => known = next,
                None => return Ok(None),
            }
        }
        let mut search = Search::new(self.field, self.packing, watch);
        let lead = &self.leads[self.others.len()];
        let primitive = known.iter().map(|h| Some(search.primitive_part(h, lead, self.main)?.monic(self.field)));
        let primitive = primitive.collect();
        watch.check()?;
        Ok(primitive)
    }

    /// Lifts the scaled factors to one more variable.
    fn extended(
        &self,
        level: usize,
        known: &[Flat],
        random: &mut SplitMix64,
        watch: &Watch,
    ) -> Result<Option<Vec<Flat>>> {
        let (field, packing) = (self.field, self.packing);
        let pair = [self.main, self.others[level]];
        let degrees = |f: &Flat| f.degrees(packing);
        let mut tops = degrees(&self.levels[level + 1]);
        known.iter().for_each(|f| tops.iter_mut().zip(degrees(f)).for_each(|(top, degree)| *top = degree.max(*top)));
        let tables = base_point(field, random, &self.others[..level], &tops);
        let skeletons = known.iter().map(|f| Skeleton::new(field, packing, f, &tables, self.main));
        let Some(skeletons) = skeletons.collect::<Option<Vec<_>>>() else { return Ok(None) };
        let orbit = |f: &Flat| Orbit::new(field, packing, f, &tables, pair);
        let (mut f, mut lead) = (orbit(&self.levels[level + 1]), orbit(&self.leads[level + 1]));
        let mut lines: Vec<Orbit> = known.iter().map(orbit).collect();
        let mut images: Vec<Vec<Rows>> = vec![Vec::new(); known.len()];
        for _ in 0..skeletons.iter().map(Skeleton::points).max().unwrap_or(0) {
            watch.check()?;
            let line: Vec<Dense> = lines.iter_mut().map(|orbit| orbit.advance(field).swap_remove(0)).collect();
            let series = SeriesFactors::new(field, &f.advance(field), &lead.advance(field), &line, self.anchor[level]);
            let Some(rows) = series.and_then(|series| series.polynomials()) else { return Ok(None) };
            images.iter_mut().zip(rows).for_each(|(images, rows)| images.push(rows));
        }
        let solve = |(skeleton, images): (&Skeleton, &Vec<Rows>)| skeleton.solve(field, packing, images, pair);
        Ok(Some(skeletons.iter().zip(&images).map(solve).collect()))
    }
}

/// The first subset of `size` of the `open` indices that `accept` accepts, in lexicographic order.
pub fn first_subset(
    open: &[usize],
    size: usize,
    watch: &Watch,
    mut accept: impl FnMut(&[usize]) -> bool,
) -> Result<Option<Vec<usize>>> {
    let mut places: Vec<usize> = (0..size).collect();
    loop {
        watch.check()?;
        let chosen: Vec<usize> = places.iter().map(|&place| open[place]).collect();
        if accept(&chosen) {
            return Ok(Some(chosen));
        }
        let Some(last) = (0..size).rev().find(|&i| places[i] < open.len() - size + i) else { return Ok(None) };
        places[last] += 1;
        (last + 1..size).for_each(|i| places[i] = places[i - 1] + 1);
    }
}
