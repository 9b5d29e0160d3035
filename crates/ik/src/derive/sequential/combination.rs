//! Linear combinations of rows over Q: [`combination`].

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use groebot_algebra::number::BigRational;

/// The coefficients of the linear combination of the independent `rows` that equals `target`.
pub(super) fn combination<K: Ord + Clone>(
    target: &BTreeMap<K, BigRational>,
    rows: &[BTreeMap<K, BigRational>],
) -> Option<Vec<BigRational>> {
    // Each row is reduced by the earlier rows, and its combination is recorded. Then the target is reduced.
    let unit =
        |index: usize| (0..rows.len()).map(|k| BigRational::from_integer(i32::from(k == index).into())).collect();
    let mut echelon: Vec<(K, BTreeMap<K, BigRational>, Vec<BigRational>)> = Vec::new();
    let reduce = |row: &mut BTreeMap<K, BigRational>, made: &mut Vec<BigRational>, echelon: &[(K, _, Vec<_>)]| {
        for (pivot, own, parts) in echelon {
            let Some(factor) = row
                .get(pivot)
                .map(|value| value / &BTreeMap::get(own, pivot).cloned().unwrap_or_else(BigRational::one))
            else {
                continue;
            };
            subtract(row, own, &factor);
            made.iter_mut().zip(parts).for_each(|(sum, part)| *sum -= &factor * part);
        }
    };
    for (index, row) in rows.iter().enumerate() {
        let (mut row, mut made): (_, Vec<BigRational>) = (row.clone(), unit(index));
        reduce(&mut row, &mut made, &echelon);
        let pivot = row.keys().next()?.clone();
        echelon.push((pivot, row, made));
    }
    let (mut rest, mut made) = (target.clone(), vec![BigRational::zero(); rows.len()]);
    reduce(&mut rest, &mut made, &echelon);
    rest.is_empty().then(|| made.into_iter().map(|number| -number).collect())
}

/// `row - factor own`, without zeros.
fn subtract<K: Ord + Clone>(row: &mut BTreeMap<K, BigRational>, own: &BTreeMap<K, BigRational>, factor: &BigRational) {
    for (key, value) in own {
        let entry = row.entry(key.clone()).or_insert_with(BigRational::zero);
        *entry -= factor * value;
    }
    row.retain(|_, value| !value.is_zero());
}
