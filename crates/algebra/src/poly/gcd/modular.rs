//! The gcd over a finite field by sparse interpolation (Zippel, Probabilistic algorithms for sparse polynomials, 1979).
//!
//! One variable is the main one. The gcd is scaled to a known leading coefficient `scale` in it, a multiple of every
//! common divisor's leading coefficient. Its image in the main variable alone is extended by one variable at a time. At
//! each point of the variables before, the two polynomials have a gcd in two variables, found by dense interpolation
//! (Brown 1971). The result is proved: it divides both, and its degrees are upper bounds.

use super::Common;
use crate::Watch;
use crate::poly::words::dense::{self, Dense};
use crate::poly::words::skeleton::{Nodes, Orbit, Rows, Skeleton, base_point, value_at};
use crate::poly::words::{Flat, Packing, WordField};
use crate::random::SplitMix64;

/// Maximum number of attempts after an unlucky choice of points.
const ATTEMPTS: usize = 4;

/// Computation of gcds over one finite field.
pub struct Search<'a, K> {
    field: &'a K,
    packing: &'a Packing,
    random: SplitMix64,
    watch: &'a Watch,
}

impl<'a, K: WordField> Search<'a, K> {
    /// Starts a computation over `field` with exponents in `packing`. It returns nothing after `watch` stops it.
    pub fn new(field: &'a K, packing: &'a Packing, watch: &'a Watch) -> Self {
        Search { field, packing, random: SplitMix64::new(0), watch }
    }

    /// Repeats [`Search::common`] with other points.
    pub fn repeated(&mut self, f: &Flat, g: &Flat) -> Option<Common<Flat>> {
        (0..ATTEMPTS).find_map(|_| self.common(f, g))
    }

    /// The monic gcd of two nonzero polynomials and its cofactors; `None` when the points were unlucky.
    pub fn common(&mut self, f: &Flat, g: &Flat) -> Option<Common<Flat>> {
        self.watch.check().ok()?;
        if f.is_constant() || g.is_constant() {
            return Some(coprime(f, g));
        }
        let bounds = self.degree_bounds(f, g)?;
        if bounds.iter().all(|&bound| bound == 0) {
            return Some(coprime(f, g));
        }
        let degrees = [f.degrees(self.packing), g.degrees(self.packing)];
        let absent = |v: &usize| bounds[*v] == 0 && (degrees[0][*v] > 0 || degrees[1][*v] > 0);
        let absent: Vec<usize> = (0..bounds.len()).filter(absent).collect();
        if !absent.is_empty() {
            return self.without(f, g, &absent);
        }
        if let Some(found) = self.divisor_of_the_other(f, g, &degrees, &bounds) {
            return Some(found);
        }
        let found = self.interpolated(f, g, &bounds).and_then(|h| self.cofactors(f, g, &h))?;
        if found.gcd.degrees(self.packing) == bounds {
            return Some(found);
        }
        self.completed(found)
    }

    /// The complete gcd if the found divisor may lack a factor. The cofactors then share this factor.
    fn completed(&mut self, found: Common<Flat>) -> Option<Common<Flat>> {
        if found.gcd.is_constant() {
            return None;
        }
        let rest = self.common(&found.left, &found.right)?;
        Some(Common { gcd: found.gcd.mul(self.field, &rest.gcd), ..rest })
    }

    /// A bound on the gcd's degree in each variable, from random values of the other variables. The degree of a gcd
    /// cannot drop where a leading coefficient stays nonzero.
    fn degree_bounds(&mut self, f: &Flat, g: &Flat) -> Option<Vec<u32>> {
        let tops: Vec<u32> = (0..self.packing.variables())
            .map(|v| f.degree_in(self.packing, v).max(g.degree_in(self.packing, v)))
            .collect();
        let everything: Vec<usize> = (0..tops.len()).collect();
        let tables = base_point(self.field, &mut self.random, &everything, &tops);
        let lines = [f, g].map(|h| self.lines(h, &tables));
        let bound = |v: usize| {
            let [a, b] = [&lines[0][v], &lines[1][v]];
            let kept =
                a.len() > f.degree_in(self.packing, v) as usize || b.len() > g.degree_in(self.packing, v) as usize;
            if a.is_empty() || b.is_empty() || !kept {
                return None;
            }
            Some(dense::gcd(self.field, a, b).len() as u32 - 1)
        };
        (0..tops.len()).map(bound).collect()
    }

    /// `f` on the lines through the point of `tables` in the direction of each variable, which is scaled by its value.
    fn lines(&self, f: &Flat, tables: &[Vec<u64>]) -> Vec<Dense> {
        let mut lines = vec![Dense::new(); tables.len()];
        for (key, value) in f.terms() {
            let value = self.field.mul(value, self.packing.value(self.field, tables, key));
            for (v, line) in lines.iter_mut().enumerate() {
                let exponent = self.packing.exponent(key, v) as usize;
                if line.len() <= exponent {
                    line.resize(exponent + 1, 0);
                }
                line[exponent] = self.field.add(line[exponent], value);
            }
        }
        lines.iter_mut().for_each(dense::trim);
        lines
    }

    /// The gcd when it is free of the variables `absent`. These are replaced by random values.
    fn without(&mut self, f: &Flat, g: &Flat, absent: &[usize]) -> Option<Common<Flat>> {
        let (mut a, mut b) = (f.clone(), g.clone());
        for &v in absent {
            let [x, y] = [0, 1].map(|_| self.random.unit(self.field.size()));
            a = a.evaluate(self.field, self.packing, v, x);
            b = b.evaluate(self.field, self.packing, v, y);
        }
        if a.is_zero() || b.is_zero() {
            return None;
        }
        let h = self.common(&a, &b)?.gcd;
        self.cofactors(f, g, &h)
    }

    /// The gcd when one of the two polynomials divides the other and has a degree that is not larger.
    fn divisor_of_the_other(
        &self,
        f: &Flat,
        g: &Flat,
        degrees: &[Vec<u32>; 2],
        bounds: &[u32],
    ) -> Option<Common<Flat>> {
        let divisor = [f, g].into_iter().zip(degrees).find(|(_, degrees)| *degrees == bounds)?.0;
        self.cofactors(f, g, &divisor.monic(self.field))
    }

    fn cofactors(&self, f: &Flat, g: &Flat, h: &Flat) -> Option<Common<Flat>> {
        let left = f.exact_div(self.field, self.packing, h)?;
        let right = g.exact_div(self.field, self.packing, h)?;
        Some(Common { gcd: h.clone(), left, right })
    }

    /// The monic gcd of `f` and `g` without its content in the main variable, if the points are lucky.
    fn interpolated(&mut self, f: &Flat, g: &Flat, bounds: &[u32]) -> Option<Flat> {
        let present = (0..bounds.len()).filter(|&v| bounds[v] > 0);
        let leads = |v: usize| [f, g].map(|h| h.leading_in(self.packing, v));
        let main = present.clone().min_by_key(|&v| leads(v).iter().map(|lead| lead.keys.len()).min())?;
        let [a, b] = leads(main);
        let scale = self.common(&a, &b)?.gcd;
        let others: Vec<usize> = present.filter(|&v| v != main).collect();
        let anchor: Vec<u64> = others.iter().map(|_| self.random.unit(self.field.size())).collect();
        let chains = [f, g, &scale].map(|h| self.restrictions(h, &others, &anchor));
        let level = |k: usize| [&chains[0][k], &chains[1][k], &chains[2][k]];
        let [a, b, c] = level(0);
        let line = dense::gcd(self.field, &a.dense(self.packing, main), &b.dense(self.packing, main));
        let value = *c.values.first()?;
        let mut known = Flat::from_dense(self.packing, main, &dense::scale(self.field, &line, value));
        for (k, &inner) in others.iter().enumerate() {
            known = self.extended(level(k + 1), &known, &others[..k], [main, inner], bounds)?;
        }
        Some(self.primitive_part(&known, &scale, main)?.monic(self.field))
    }

    /// `f` with values for all of `others`, then for all but the first, and so on up to `f` itself.
    pub fn restrictions(&self, f: &Flat, others: &[usize], anchor: &[u64]) -> Vec<Flat> {
        let mut chain = vec![f.clone()];
        for (&v, &x) in others.iter().zip(anchor).rev() {
            chain.push(chain[chain.len() - 1].evaluate(self.field, self.packing, v, x));
        }
        chain.reverse();
        chain
    }

    /// Extends the scaled gcd to one more variable, `inner`. `known` is its image without this variable.
    fn extended(
        &mut self,
        [f, g, scale]: [&Flat; 3],
        known: &Flat,
        free: &[usize],
        [main, inner]: [usize; 2],
        bounds: &[u32],
    ) -> Option<Flat> {
        let (field, packing) = (self.field, self.packing);
        let tops: Vec<u32> = (0..bounds.len())
            .map(|v| f.degree_in(packing, v).max(g.degree_in(packing, v)).max(known.degree_in(packing, v)))
            .collect();
        let tables = base_point(field, &mut self.random, free, &tops);
        let skeleton = Skeleton::new(field, packing, known, &tables, main)?;
        let mut orbits = [f, g, scale].map(|h| Orbit::new(field, packing, h, &tables, [main, inner]));
        let count = bounds[inner] + scale.degree_in(packing, inner) + 1;
        let nodes = Nodes::new(field, &mut self.random, count as usize)?;
        let degrees = [f.degree_in(packing, main), g.degree_in(packing, main), bounds[main]];
        let watch = self.watch;
        let mut image = || {
            watch.check().ok()?;
            gcd_rows(field, &nodes, orbits.each_mut().map(|orbit| orbit.advance(field)), degrees)
        };
        let images = (0..skeleton.points()).map(|_| image()).collect::<Option<Vec<_>>>()?;
        Some(skeleton.solve(field, packing, &images, [main, inner]))
    }

    /// Divides `h` by its content in `main`. The leading coefficient of `h` is a constant times `lead`.
    pub fn primitive_part(&mut self, h: &Flat, lead: &Flat, main: usize) -> Option<Flat> {
        if lead.is_constant() {
            return Some(h.clone());
        }
        let mut mixed = Vec::new();
        for part in h.coefficients_in(self.packing, main) {
            let factor = self.random.unit(self.field.size());
            mixed.extend(part.scale(self.field, factor).terms());
        }
        let mixed = Flat::collect(self.field, mixed);
        let content = if mixed.is_zero() { return None } else { self.common(lead, &mixed)?.gcd };
        h.exact_div(self.field, self.packing, &content)
    }
}

/// The result for coprime polynomials: the gcd is one.
fn coprime(f: &Flat, g: &Flat) -> Common<Flat> {
    Common { gcd: Flat::constant(1), left: f.clone(), right: g.clone() }
}

/// The gcd of two polynomials in two variables with the leading coefficient `scale`, by dense interpolation. `degrees`
/// has the degrees in the main variable of `f`, `g` and the gcd.
fn gcd_rows<K: WordField>(field: &K, nodes: &Nodes, [f, g, scale]: [Rows; 3], degrees: [u32; 3]) -> Option<Rows> {
    let [f_length, g_length, length] = degrees.map(|degree| degree as usize + 1);
    let value = |&x: &u64| {
        let [a, b, c] = [&f, &g, &scale].map(|rows| value_at(field, rows, x));
        let gcd = dense::gcd(field, &a, &b);
        let lucky = (a.len() == f_length || b.len() == g_length) && gcd.len() == length;
        lucky.then(|| dense::scale(field, &gcd, c.first().copied().unwrap_or(0)))
    };
    Some(nodes.interpolate(field, nodes.points().iter().map(value).collect::<Option<_>>()?))
}
