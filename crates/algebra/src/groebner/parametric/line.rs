//! Rational functions of one variable modulo a prime, from their values.
//!
//! Interpolation, then the extended Euclidean algorithm. The step with the largest quotient gives unknown degrees (M.
//! Monagan, "Maximal quotient rational reconstruction", ISSAC 2004).

use super::prime::Prime;

/// Numerator and denominator, constant terms first, coprime; the zero function is `0 / 1`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quotient {
    pub numerator: Vec<u64>,
    pub denominator: Vec<u64>,
}

impl Quotient {
    /// The degrees of numerator and denominator.
    pub fn degrees(&self) -> (usize, usize) {
        (self.numerator.len().max(1) - 1, self.denominator.len() - 1)
    }
}

/// Distinct points of the line with the constants of interpolation.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    field: Prime,
    pub nodes: Vec<u64>,
    /// The product of all `t - node`, monic.
    master: Vec<u64>,
    /// `basis[i]`: the polynomial that is 1 at node `i` and 0 at the others.
    basis: Vec<Vec<u64>>,
}

impl Nodes {
    /// Builds the tables for distinct `nodes`.
    pub fn new(field: Prime, nodes: Vec<u64>) -> Self {
        let master = product_of_roots(field, &nodes);
        let cofactors: Vec<Vec<u64>> = nodes.iter().map(|&node| divide_by_root(field, &master, node)).collect();
        let values: Vec<u64> = cofactors.iter().zip(&nodes).map(|(f, &node)| field.horner(f, node)).collect();
        let inverses = field.inverses(&values).expect("the nodes are distinct");
        let scale = |(f, inverse): (Vec<u64>, u64)| f.into_iter().map(|c| field.mul(c, inverse)).collect();
        let basis = cofactors.into_iter().zip(inverses).map(scale).collect();
        Nodes { field, nodes, master, basis }
    }

    pub fn count(&self) -> usize {
        self.nodes.len()
    }

    /// The polynomial with these values.
    fn interpolate(&self, values: &[u64]) -> Vec<u64> {
        let mut sum = vec![0; values.len()];
        for (&value, basis) in values.iter().zip(&self.basis) {
            self.field.sub_multiple(&mut sum, self.field.neg(value), basis);
        }
        trimmed(sum)
    }

    /// The function of least degrees with these values; `None` when they do not determine it with one value left for a
    /// check.
    pub fn quotient(&self, values: &[u64]) -> Option<Quotient> {
        let mut best = None;
        let mut largest = 1;
        self.walk(values, |jump, numerator, denominator| {
            if jump > largest {
                largest = jump;
                best = Some(Quotient { numerator: numerator.to_vec(), denominator: denominator.to_vec() });
            }
            true
        });
        best
    }

    /// The function with these values and degrees; `None` when there is none.
    pub fn quotient_of(&self, values: &[u64], degrees: (usize, usize)) -> Option<Quotient> {
        let mut found = None;
        self.walk(values, |_, numerator, denominator| {
            if numerator.len() > degrees.0 + 1 {
                return true;
            }
            let quotient = Quotient { numerator: numerator.to_vec(), denominator: denominator.to_vec() };
            found = (quotient.degrees() == degrees).then_some(quotient);
            false
        });
        found
    }

    /// Enumerates the remainders and cofactors of the Euclidean algorithm for `master` and the interpolating
    /// polynomial, each with the degree of the next quotient. These degrees add up to the number of nodes. It ends when
    /// `visit` returns false.
    fn walk(&self, values: &[u64], mut visit: impl FnMut(usize, &[u64], &[u64]) -> bool) {
        let (mut before, mut remainder) = (self.master.clone(), self.interpolate(values));
        let (mut cofactor_before, mut cofactor) = (Vec::new(), vec![1]);
        while visit(before.len() - remainder.len(), &remainder, &cofactor) && !remainder.is_empty() {
            let quotient = divide(self.field, &mut before, &remainder);
            let next = sub_product(self.field, cofactor_before, &quotient, &cofactor);
            (cofactor_before, cofactor) = (cofactor, next);
            (before, remainder) = (remainder, before);
        }
    }
}

fn trimmed(mut f: Vec<u64>) -> Vec<u64> {
    while f.last() == Some(&0) {
        f.pop();
    }
    f
}

/// The monic polynomial with these roots.
pub(super) fn product_of_roots(field: Prime, roots: &[u64]) -> Vec<u64> {
    let mut product = Vec::with_capacity(roots.len() + 1);
    product.push(1);
    for &root in roots {
        let negated = field.neg(root);
        product.push(1);
        for k in (1..product.len() - 1).rev() {
            product[k] = field.reduce(product[k - 1] + negated * product[k]);
        }
        product[0] = field.mul(product[0], negated);
    }
    product
}

/// `f / (x - root)` for a monic `f` with this root.
pub(super) fn divide_by_root(field: Prime, f: &[u64], root: u64) -> Vec<u64> {
    let mut quotient = vec![0; f.len() - 1];
    let mut carry = 0;
    for (slot, &c) in quotient.iter_mut().zip(&f[1..]).rev() {
        carry = field.reduce(c + root * carry);
        *slot = carry;
    }
    quotient
}

/// The quotient of `rest` by `divisor`; `rest` becomes the remainder.
pub(super) fn divide(field: Prime, rest: &mut Vec<u64>, divisor: &[u64]) -> Vec<u64> {
    let Some(shift) = (rest.len() + 1).checked_sub(divisor.len()).filter(|&n| n > 0) else { return Vec::new() };
    let mut quotient = vec![0; shift];
    let low = &divisor[..divisor.len() - 1];
    let lead = divisor[low.len()];
    let inverse = if lead == 1 { 1 } else { field.inverse(lead) };
    for k in (0..shift).rev() {
        let factor = field.mul(rest[k + low.len()], inverse);
        quotient[k] = factor;
        rest.truncate(k + low.len());
        field.sub_multiple(&mut rest[k..], factor, low);
    }
    *rest = trimmed(std::mem::take(rest));
    quotient
}

/// `s - quotient * t`.
fn sub_product(field: Prime, mut s: Vec<u64>, quotient: &[u64], t: &[u64]) -> Vec<u64> {
    s.resize(s.len().max(quotient.len() + t.len() - 1), 0);
    for (k, &factor) in quotient.iter().enumerate() {
        field.sub_multiple(&mut s[k..k + t.len()], factor, t);
    }
    trimmed(s)
}
