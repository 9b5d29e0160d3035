//! Hensel lifting of a factorization in the main variable to power series in the inner variable (von zur Gathen and
//! Gerhard, Modern Computer Algebra, chapter 15), and conversion to polynomials with a known leading coefficient.

use crate::poly::words::WordField;
use crate::poly::words::dense::{self, Dense};
use crate::poly::words::skeleton::Rows;

/// A polynomial in two variables as `lead` times monic power series in `y = inner - centre`, modulo `y^precision`.
///
/// The precision exceeds the degree of `lead f`, so it determines a product of two polynomials of matching degrees.
pub struct SeriesFactors<'a, K> {
    field: &'a K,
    centre: u64,
    degree: usize,
    lead_degree: usize,
    lead: Rows,
    factors: Vec<Rows>,
}

impl<'a, K: WordField> SeriesFactors<'a, K> {
    /// Lifts the coprime `factors` of `f` from `inner = centre`. `lead` is the leading coefficient of `f`. Returns
    /// `None` when `lead` vanishes there or the factors are not coprime.
    pub fn new(field: &'a K, f: &Rows, lead: &Rows, factors: &[Dense], centre: u64) -> Option<Self> {
        let precision = f.len() + lead.len() - 1;
        let (degree, lead_degree) = (f.len() - 1, lead.len() - 1);
        let [f, lead] = [f, lead].map(|rows| translate(field, rows.clone(), centre));
        let monic = divide_series(field, &f, &lead, precision)?;
        let factors: Vec<Dense> = factors.iter().map(|factor| dense::monic(field, factor)).collect();
        let product = factors.iter().fold(vec![1], |product, factor| dense::mul(field, &product, factor));
        if monic[0] != product {
            return None;
        }
        let factors = lift(field, &monic, factors)?;
        Some(SeriesFactors { field, centre, degree, lead_degree, lead, factors })
    }

    /// `lead` times the product of the series in `chosen`, truncated.
    fn product(&self, chosen: &[usize]) -> Rows {
        let precision = self.degree + self.lead_degree + 1;
        let product = chosen
            .iter()
            .fold(self.lead.clone(), |product, &i| multiply_series(self.field, &product, &self.factors[i], precision));
        trimmed(product)
    }

    /// Whether the product of the series in `chosen` is a factor: it is a polynomial, and so is its cofactor.
    pub fn is_factor(&self, chosen: &[usize]) -> bool {
        let rest: Vec<usize> = (0..self.factors.len()).filter(|i| !chosen.contains(i)).collect();
        let length = |chosen: &[usize]| self.product(chosen).len() - 1;
        length(chosen) + length(&rest) == self.degree + self.lead_degree
    }

    /// Each factor as a polynomial with the leading coefficient `lead`; `None` when they are not polynomials.
    pub fn polynomials(&self) -> Option<Vec<Rows>> {
        let products: Vec<Rows> = (0..self.factors.len()).map(|i| self.product(&[i])).collect();
        let degrees = products.iter().map(|rows| rows.len() - 1).sum::<usize>();
        let back = self.field.neg(self.centre);
        let expected = self.degree + (products.len() - 1) * self.lead_degree;
        (degrees == expected).then(|| products.into_iter().map(|rows| translate(self.field, rows, back)).collect())
    }
}

fn trimmed(mut rows: Rows) -> Rows {
    while rows.last().is_some_and(Vec::is_empty) {
        rows.pop();
    }
    rows
}

/// The rows of `f(x, y + shift)`.
fn translate<K: WordField>(field: &K, mut rows: Rows, shift: u64) -> Rows {
    for start in 0..rows.len() {
        for k in (start..rows.len() - 1).rev() {
            let upper = rows[k + 1].clone();
            dense::add_scaled(field, &mut rows[k], shift, &upper, 0);
        }
    }
    rows
}

/// Coefficient `k` of the product of two series, indices `range` of the first.
fn coefficient<K: WordField>(field: &K, f: &[Dense], g: &[Dense], k: usize, range: std::ops::Range<usize>) -> Dense {
    let mut sum = Dense::new();
    for i in range {
        if let (Some(a), Some(b)) = (f.get(i), g.get(k - i)) {
            dense::add_scaled(field, &mut sum, 1, &dense::mul(field, a, b), 0);
        }
    }
    sum
}

fn multiply_series<K: WordField>(field: &K, f: &[Dense], g: &[Dense], precision: usize) -> Rows {
    (0..precision).map(|k| coefficient(field, f, g, k, 0..k + 1)).collect()
}

/// `f / lead` modulo `y^precision`; `lead` has constants as coefficients.
fn divide_series<K: WordField>(field: &K, f: &[Dense], lead: &[Dense], precision: usize) -> Option<Rows> {
    let inverse = field.inverse(*lead.first()?.first()?)?;
    let mut quotient = Rows::new();
    for k in 0..precision {
        let known = coefficient(field, &quotient, lead, k, 0..k);
        let rest = dense::sub(field, f.get(k).map_or(&[], Vec::as_slice), &known);
        quotient.push(dense::scale(field, &rest, inverse));
    }
    Some(quotient)
}

/// The monic series whose product is `f` and whose constant terms are `factors`, computed order by order.
fn lift<K: WordField>(field: &K, f: &[Dense], factors: Vec<Dense>) -> Option<Vec<Rows>> {
    let inverses = (0..factors.len()).map(|i| cofactor_inverse(field, &factors, i)).collect::<Option<Vec<_>>>()?;
    let mut prefixes = prefix_products(field, &factors);
    let nothing = vec![Dense::new(); factors.len()];
    let mut series: Vec<Rows> = factors.into_iter().map(|factor| vec![factor]).collect();
    for (k, target) in f.iter().enumerate().skip(1) {
        let middle = middles(field, &prefixes, &series, k);
        let product = prefix_coefficients(field, &prefixes, &series, &middle, &nothing).pop()?;
        let error = dense::sub(field, target, &product);
        let step = |(rows, inverse): (&Rows, &Dense)| {
            let error = dense::rem(field, &error, &rows[0]);
            dense::rem(field, &dense::mul(field, &error, inverse), &rows[0])
        };
        let steps: Vec<Dense> = series.iter().zip(&inverses).map(step).collect();
        let coefficients = prefix_coefficients(field, &prefixes, &series, &middle, &steps);
        prefixes.iter_mut().zip(coefficients).for_each(|(prefix, coefficient)| prefix.push(coefficient));
        series.iter_mut().zip(steps).for_each(|(rows, step)| rows.push(step));
    }
    Some(series)
}

/// The inverse of the product of all other factors modulo factor `i`.
fn cofactor_inverse<K: WordField>(field: &K, factors: &[Dense], i: usize) -> Option<Dense> {
    let others = factors.iter().enumerate().filter(|(j, _)| *j != i);
    let times = |product: Dense, other: &Dense| dense::rem(field, &dense::mul(field, &product, other), &factors[i]);
    let product = others.fold(vec![1], |product, (_, other)| times(product, other));
    dense::inverse_modulo(field, &product, &factors[i])
}

/// The products of the first factors, of the first two, and so on: series of which only the constant term is known.
fn prefix_products<K: WordField>(field: &K, factors: &[Dense]) -> Vec<Rows> {
    let mut product = vec![1];
    let mut next = |factor: &Dense| {
        product = dense::mul(field, &product, factor);
        vec![product.clone()]
    };
    factors.iter().map(&mut next).collect()
}

/// The part of coefficient `k` of each prefix product that depends on lower orders alone.
fn middles<K: WordField>(field: &K, prefixes: &[Rows], series: &[Rows], k: usize) -> Vec<Dense> {
    let pairs = (0..series.len()).map(|i| i.checked_sub(1).map(|before| (&prefixes[before], &series[i])));
    pairs.map(|pair| pair.map_or_else(Dense::new, |(prefix, rows)| coefficient(field, prefix, rows, k, 1..k))).collect()
}

/// The next coefficient of each prefix product, given the next coefficients `steps` of the series.
fn prefix_coefficients<K: WordField>(
    field: &K,
    prefixes: &[Rows],
    series: &[Rows],
    middle: &[Dense],
    steps: &[Dense],
) -> Vec<Dense> {
    let mut result = vec![steps[0].clone()];
    for i in 1..series.len() {
        let mut sum = middle[i].clone();
        dense::add_scaled(field, &mut sum, 1, &dense::mul(field, &result[i - 1], &series[i][0]), 0);
        dense::add_scaled(field, &mut sum, 1, &dense::mul(field, &prefixes[i - 1][0], &steps[i]), 0);
        result.push(sum);
    }
    result
}
