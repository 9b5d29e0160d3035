//! Sparse interpolation (Zippel 1979). The monomials of a polynomial are known from an image in fewer variables. Its
//! coefficients are found from as many further images as its largest coefficient has terms. The points are powers of
//! one point, as in Ben-Or and Tiwari 1988, so the linear systems are transposed Vandermonde systems.

use super::dense::{self, Dense};
use super::field::{WordField, inverses};
use super::flat::{Flat, Packing, powers};
use crate::random::SplitMix64;

/// A polynomial in two variables: `rows[k]` is the coefficient of the inner variable's `k`-th power, dense in the main.
pub type Rows = Vec<Dense>;

/// Powers of a random value for each variable in `free`; empty lists for the others.
pub fn base_point<K: WordField>(field: &K, random: &mut SplitMix64, free: &[usize], tops: &[u32]) -> Vec<Vec<u64>> {
    let table = |v: usize| {
        if free.contains(&v) { powers(field, random.unit(field.size()), tops[v]) } else { Vec::new() }
    };
    (0..tops.len()).map(table).collect()
}

/// The values of a polynomial at a point `b`, then at `b^2`, `b^3`, ...: one multiplication per term each time.
pub struct Orbit {
    places: Vec<Place>,
    rows: usize,
}

struct Place {
    row: usize,
    column: usize,
    ratio: u64,
    value: u64,
}

impl Orbit {
    /// Starts the evaluation of `f`. The variables in `tables` take powers; `main` and `inner` stay variables.
    pub fn new<K: WordField>(
        field: &K,
        packing: &Packing,
        f: &Flat,
        tables: &[Vec<u64>],
        [main, inner]: [usize; 2],
    ) -> Self {
        let place = |(key, value)| Place {
            row: packing.exponent(key, inner) as usize,
            column: packing.exponent(key, main) as usize,
            ratio: packing.value(field, tables, key),
            value,
        };
        Orbit { places: f.terms().map(place).collect(), rows: f.degree_in(packing, inner) as usize + 1 }
    }

    /// The value at the point whose powers are all one. Without further variables it is the polynomial itself.
    pub fn rows(&self) -> Rows {
        let mut rows = vec![Dense::new(); self.rows];
        for place in &self.places {
            store(&mut rows[place.row], place);
        }
        rows.iter_mut().for_each(dense::trim);
        rows
    }

    /// The value at the next power of the point.
    pub fn advance<K: WordField>(&mut self, field: &K) -> Rows {
        let mut rows = vec![Dense::new(); self.rows];
        for place in &mut self.places {
            place.value = field.mul(place.value, place.ratio);
            let row = &mut rows[place.row];
            if row.len() <= place.column {
                row.resize(place.column + 1, 0);
            }
            row[place.column] = field.add(row[place.column], place.value);
        }
        rows.iter_mut().for_each(dense::trim);
        rows
    }
}

fn store(row: &mut Dense, place: &Place) {
    if row.len() <= place.column {
        row.resize(place.column + 1, 0);
    }
    row[place.column] = place.value;
}

/// The monomials of a polynomial, grouped by the power of the main variable, prepared to solve for their coefficients.
pub struct Skeleton {
    groups: Vec<Group>,
}

/// The monomials multiplied by one power of the main variable. Row `m` of `solution` times the first values of the
/// coefficient is the coefficient of monomial `m`.
struct Group {
    column: usize,
    keys: Vec<u128>,
    solution: Vec<Dense>,
}

impl Skeleton {
    /// The skeleton of `known` for the point of `tables`; `None` when two monomials of a group have equal values at the
    /// point.
    pub fn new<K: WordField>(
        field: &K,
        packing: &Packing,
        known: &Flat,
        tables: &[Vec<u64>],
        main: usize,
    ) -> Option<Self> {
        let mut groups = Vec::new();
        for (column, part) in known.coefficients_in(packing, main).into_iter().enumerate() {
            let values: Vec<u64> = part.keys.iter().map(|&key| packing.value(field, tables, key)).collect();
            let solution = invert_vandermonde(field, &values)?;
            groups.push(Group { column, keys: part.keys, solution });
        }
        Some(Skeleton { groups })
    }

    /// The number of images that [`Skeleton::solve`] needs.
    pub fn points(&self) -> usize {
        self.groups.iter().map(|group| group.keys.len()).max().unwrap_or(0)
    }

    /// The polynomial with the given images at the powers of the point.
    pub fn solve<K: WordField>(
        &self,
        field: &K,
        packing: &Packing,
        images: &[Rows],
        [main, inner]: [usize; 2],
    ) -> Flat {
        let height = images.iter().map(Vec::len).max().unwrap_or(0);
        let mut terms = Vec::new();
        for group in &self.groups {
            for row in 0..height {
                let at = |image: &Rows| image.get(row).and_then(|row| row.get(group.column)).copied().unwrap_or(0);
                let values: Vec<u64> = images.iter().take(group.keys.len()).map(at).collect();
                if values.iter().all(|&value| value == 0) {
                    continue;
                }
                let place = packing.power(main, group.column as u32) + packing.power(inner, row as u32);
                for (key, weights) in group.keys.iter().zip(&group.solution) {
                    terms.push((key + place, dot(field, weights, &values)));
                }
            }
        }
        Flat::collect(field, terms.into_iter().filter(|term| term.1 != 0).collect())
    }
}

fn dot<K: WordField>(field: &K, a: &[u64], b: &[u64]) -> u64 {
    a.iter().zip(b).fold(0, |sum, (&x, &y)| field.add(sum, field.mul(x, y)))
}

/// The inverse of the matrix `v_m^j`, `j = 1..`, by the quotients of the product of all `z - v_m`.
fn invert_vandermonde<K: WordField>(field: &K, values: &[u64]) -> Option<Vec<Dense>> {
    let master = values.iter().fold(vec![1], |product, &v| dense::mul(field, &product, &[field.neg(v), 1]));
    let quotients: Vec<Dense> = values.iter().map(|&v| dense::div_rem(field, &master, &[field.neg(v), 1]).0).collect();
    let weights: Vec<u64> =
        values.iter().zip(&quotients).map(|(&v, q)| field.mul(v, dense::evaluate(field, q, v))).collect();
    let inverses = inverses(field, &weights)?;
    Some(quotients.iter().zip(inverses).map(|(q, inverse)| dense::scale(field, q, inverse)).collect())
}

/// Distinct points of the inner variable with the inverses of their differences, for dense interpolation.
pub struct Nodes {
    points: Vec<u64>,
    inverses: Vec<Vec<u64>>,
}

impl Nodes {
    /// Chooses `count` distinct random points; `None` when the field has fewer points.
    pub fn new<K: WordField>(field: &K, random: &mut SplitMix64, count: usize) -> Option<Self> {
        if field.size() / 2 <= count as u64 {
            return None;
        }
        let mut points = Vec::with_capacity(count);
        while points.len() < count {
            let point = random.below(field.size());
            if !points.contains(&point) {
                points.push(point);
            }
        }
        let differences = |i: usize| points[..i].iter().map(|&p| field.sub(points[i], p)).collect::<Vec<_>>();
        let inverses = (0..count).map(|i| inverses(field, &differences(i))).collect::<Option<_>>()?;
        Some(Nodes { points, inverses })
    }

    /// The points.
    pub fn points(&self) -> &[u64] {
        &self.points
    }

    /// The rows with the given value at each point, by Newton's divided differences.
    pub fn interpolate<K: WordField>(&self, field: &K, mut values: Rows) -> Rows {
        let count = values.len();
        for i in 1..count {
            for j in 0..i {
                let difference = dense::sub(field, &values[i], &values[j]);
                values[i] = dense::scale(field, &difference, self.inverses[i][j]);
            }
        }
        let mut rows: Rows = vec![Dense::new(); count];
        for (i, value) in values.iter().enumerate().rev() {
            let minus = field.neg(self.points[i]);
            for k in (0..count - i).rev() {
                let lower = if k > 0 { rows[k - 1].clone() } else { value.clone() };
                let mut row = dense::scale(field, &rows[k], minus);
                dense::add_scaled(field, &mut row, 1, &lower, 0);
                rows[k] = row;
            }
        }
        while rows.last().is_some_and(Vec::is_empty) {
            rows.pop();
        }
        rows
    }
}

/// The value of `rows` at the inner point `x`: dense in the main variable.
pub fn value_at<K: WordField>(field: &K, rows: &[Dense], x: u64) -> Dense {
    rows.iter().rev().fold(Dense::new(), |value, row| {
        let mut value = dense::scale(field, &value, x);
        dense::add_scaled(field, &mut value, 1, row, 0);
        value
    })
}
