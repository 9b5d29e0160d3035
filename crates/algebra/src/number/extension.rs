//! Algebraic extension fields `F[t]/(m)`.

use super::{BigInt, Field, Ring, Style};
use crate::{Error, ErrorKind, Result};

/// The field `F[t]/(m)` for an irreducible polynomial `m`. An element is the list of its coefficients, constant term
/// first.
#[derive(Clone, Debug, PartialEq)]
pub struct Extension<F: Field> {
    base: F,
    name: String,
    /// The relation: `t^d` is minus the sum of `low[i] t^i`.
    low: Vec<F::Element>,
}

impl<F: Field> Extension<F> {
    /// Extends `base` by a root `name` of the monic polynomial `t^d + low[d-1] t^(d-1) + ... + low[0]`. The caller
    /// ensures that it is irreducible. Otherwise some inverses do not exist.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `low` is empty: the degree is at least one.
    pub fn new(base: F, name: impl Into<String>, low: Vec<F::Element>) -> Result<Self> {
        if low.is_empty() {
            return Err(Error::new(
                ErrorKind::BadValue,
                "an extension has degree at least 1; give that many coefficients",
            ));
        }
        Ok(Extension { base, name: name.into(), low })
    }

    /// The base field.
    pub fn base(&self) -> &F {
        &self.base
    }

    /// The degree of the extension over its base.
    pub fn degree(&self) -> usize {
        self.low.len()
    }

    /// Embeds an element of the base field.
    pub fn embed(&self, a: &F::Element) -> Vec<F::Element> {
        let mut element = vec![self.base.zero(); self.degree()];
        element[0] = a.clone();
        element
    }

    /// `t a`: shifts the coefficients up and reduces the last one by the relation.
    fn shifted(&self, a: &[F::Element]) -> Vec<F::Element> {
        let top = &a[a.len() - 1];
        let below = std::iter::once(self.base.zero()).chain(a[..a.len() - 1].iter().cloned());
        below.zip(&self.low).map(|(c, m)| self.base.sub(&c, &self.base.mul(top, m))).collect()
    }

    fn scaled(&self, a: &[F::Element], by: &F::Element) -> Vec<F::Element> {
        a.iter().map(|c| self.base.mul(c, by)).collect()
    }

    /// Solves `b x = a` by Gauss-Jordan elimination on the matrix of the multiplication by `b`.
    fn quotient(&self, a: &[F::Element], b: &[F::Element]) -> Option<Vec<F::Element>> {
        let degree = self.degree();
        let columns: Vec<_> = std::iter::successors(Some(b.to_vec()), |c| Some(self.shifted(c))).take(degree).collect();
        let row = |i: usize| columns.iter().map(|column| column[i].clone()).chain([a[i].clone()]).collect::<Vec<_>>();
        let mut rows: Vec<_> = (0..degree).map(row).collect();
        for k in 0..degree {
            let pivot = (k..degree).find(|&i| !self.base.is_zero(&rows[i][k]))?;
            rows.swap(k, pivot);
            rows[k] = self.scaled(&rows[k], &self.base.inverse(&rows[k][k])?);
            for i in (0..degree).filter(|&i| i != k) {
                let factor = rows[i][k].clone();
                let reduced = rows[i].iter().zip(&rows[k]).map(|(x, y)| self.base.sub(x, &self.base.mul(&factor, y)));
                rows[i] = reduced.collect();
            }
        }
        Some(rows.iter().map(|row| row[degree].clone()).collect())
    }
}

impl<F: Field> Ring for Extension<F> {
    type Element = Vec<F::Element>;

    fn zero(&self) -> Self::Element {
        self.embed(&self.base.zero())
    }
    fn one(&self) -> Self::Element {
        self.embed(&self.base.one())
    }
    fn from_integer(&self, n: &BigInt) -> Self::Element {
        self.embed(&self.base.from_integer(n))
    }
    fn add(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        a.iter().zip(b).map(|(x, y)| self.base.add(x, y)).collect()
    }
    fn neg(&self, a: &Self::Element) -> Self::Element {
        a.iter().map(|x| self.base.neg(x)).collect()
    }
    /// Horner's rule in `t`.
    fn mul(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        let horner = |sum: Vec<_>, c| self.add(&self.shifted(&sum), &self.scaled(a, c));
        b.iter().rev().fold(self.zero(), horner)
    }
    fn is_zero(&self, a: &Self::Element) -> bool {
        a.iter().all(|x| self.base.is_zero(x))
    }
    fn checked_div(&self, a: &Self::Element, b: &Self::Element) -> Option<Self::Element> {
        self.quotient(a, b)
    }
    fn format(&self, a: &Self::Element, style: Style) -> String {
        let term = |(power, c): (usize, &F::Element)| {
            let number = self.base.format(c, style);
            match (power, style) {
                (0, _) => number,
                (_, Style::Latex) => format!("({number}){}^{{{power}}}", self.name),
                _ => format!("({number})*{}^{power}", self.name),
            }
        };
        let nonzero = a.iter().enumerate().filter(|(_, c)| !self.base.is_zero(c));
        let terms: Vec<String> = nonzero.map(term).collect();
        if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") }
    }
    /// The root by its name, else a generator of the base field.
    fn generator(&self, name: &str) -> Option<Self::Element> {
        if name == self.name {
            return Some(self.shifted(&self.one()));
        }
        self.base.generator(name).map(|a| self.embed(&a))
    }
}

impl<F: Field> Field for Extension<F> {
    fn characteristic(&self) -> u64 {
        self.base.characteristic()
    }
}
