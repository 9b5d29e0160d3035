//! Linear independence modulo a prime.

use std::collections::BTreeMap;

use groebot_algebra::number::{Ring, Zp};

/// Independent rows with entries by key. The last key of a row does not occur in later rows.
#[derive(Clone, Debug)]
pub struct Echelon<K> {
    field: Zp,
    rows: Vec<BTreeMap<K, u64>>,
}

impl<K: Ord + Clone> Echelon<K> {
    pub fn new(field: Zp) -> Self {
        Echelon { field, rows: Vec::new() }
    }

    /// Adds `row` if it is independent of the earlier rows. Returns whether it is.
    pub fn insert(&mut self, row: impl IntoIterator<Item = (K, u64)>) -> bool {
        let mut row: BTreeMap<K, u64> = row.into_iter().filter(|(_, value)| *value != 0).collect();
        for own in &self.rows {
            cancel(self.field, &mut row, own);
        }
        let is_new = !row.is_empty();
        if is_new {
            self.rows.push(row);
        }
        is_new
    }
}

/// Subtracts a multiple of `own` from `row`, such that the last entry of `own` cancels.
fn cancel<K: Ord + Clone>(field: Zp, row: &mut BTreeMap<K, u64>, own: &BTreeMap<K, u64>) {
    let Some((lead, value)) = own.last_key_value() else { return };
    let factor = row.get(lead).and_then(|entry| field.checked_div(entry, value));
    let Some(factor) = factor else { return };
    for (key, value) in own {
        let entry = row.get(key).copied().unwrap_or(0);
        match field.sub(&entry, &field.mul(&factor, value)) {
            0 => drop(row.remove(key)),
            rest => drop(row.insert(key.clone(), rest)),
        }
    }
}
