//! Vectors in echelon form with their combinations of the inserted vectors.

use std::collections::BTreeMap;

use crate::Result;
use crate::groebner::division::inverse;
use crate::number::Field;
use crate::poly::PolynomialRing;

/// An independent vector: its pivot, its entries (one at the pivot), and its combination of the inserted independent
/// vectors.
struct Row<E> {
    pivot: usize,
    entries: Vec<E>,
    combination: BTreeMap<usize, E>,
}

/// The independent vectors inserted so far.
pub(super) struct Echelon<'r, F: Field> {
    ring: &'r PolynomialRing<F>,
    rows: Vec<Row<F::Element>>,
}

impl<'r, F: Field> Echelon<'r, F> {
    /// An empty echelon form. `ring` has the field, and names it in errors.
    pub fn new(ring: &'r PolynomialRing<F>) -> Self {
        Echelon { ring, rows: Vec::new() }
    }

    /// The number of independent vectors.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Inserts `vector` when it is independent. Otherwise returns the factors `c` with `vector + sum of c[k] * (k-th
    /// independent vector) = 0`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when a nonzero coefficient has no inverse.
    pub fn insert(&mut self, vector: &[F::Element]) -> Result<Option<BTreeMap<usize, F::Element>>> {
        let field = self.ring.field();
        let (mut entries, mut combination) = self.reduce(vector);
        let Some(pivot) = entries.iter().position(|entry| !field.is_zero(entry)) else { return Ok(Some(combination)) };
        let inverse = inverse(self.ring, &entries[pivot])?;
        combination.insert(self.rows.len(), field.one());
        combination.values_mut().chain(&mut entries).for_each(|value| *value = field.mul(value, &inverse));
        self.rows.push(Row { pivot, entries, combination });
        Ok(None)
    }

    /// `vector` with zeros at all pivots, and the combination that was added.
    fn reduce(&self, vector: &[F::Element]) -> (Vec<F::Element>, BTreeMap<usize, F::Element>) {
        let field = self.ring.field();
        let mut entries = vector.to_vec();
        let mut combination: BTreeMap<usize, F::Element> = BTreeMap::new();
        for row in &self.rows {
            let factor = field.neg(&entries[row.pivot]);
            if field.is_zero(&factor) {
                continue;
            }
            super::add_scaled(field, &mut entries, &factor, &row.entries);
            for (index, other) in &row.combination {
                let sum = combination.entry(*index).or_insert_with(|| field.zero());
                *sum = field.add(sum, &field.mul(&factor, other));
            }
        }
        (entries, combination)
    }
}
