//! Base parameters, numerically. Main type: [`Base`].

use nalgebra::{DMatrix, DVector};

use super::super::{Equations, State};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::random::SplitMix64;

/// Threshold for dependent columns: the part orthogonal to the other columns, relative to the column's length.
const DEPENDENT: f64 = 1e-8;

/// The minimal set of parameters: `B pi` are the base parameters.
pub(super) struct Base {
    pub(super) pivots: Vec<usize>,
    /// The matrix `B`: base parameters x ten inertial parameters for each body.
    pub(super) combinations: DMatrix<f64>,
}

impl Equations {
    /// Computes base parameters numerically: the first independent columns of the regressors of many states, and the
    /// other columns as combinations of these.
    pub(super) fn base_parameters(&self) -> Result<Base> {
        let (count, columns) = (self.freedoms(), self.parameters().len());
        let states = (3 * columns).div_ceil(count);
        let mut all = DMatrix::zeros(states * count, columns);
        let mut workspace = self.workspace();
        let mut random = SplitMix64::new(1);
        for state in 0..states {
            let mut list = |most: f64| (0..count).map(|_| random.between(-most, most)).collect::<Vec<f64>>();
            let [q, velocity, acceleration] = [3.0, 2.0, 5.0].map(&mut list);
            let regressor = self.regressor(&mut workspace, State::new(&q, &velocity), &acceleration)?;
            all.rows_mut(state * count, count).copy_from(regressor);
        }
        let size = all.amax();
        let (mut pivots, mut across): (Vec<usize>, Vec<DVector<f64>>) = (Vec::new(), Vec::new());
        for column in 0..columns {
            let own = all.column(column).into_owned();
            let mut rest = own.clone();
            // Two passes are enough (W. Kahan and B. N. Parlett).
            for _ in 0..2 {
                across.iter().for_each(|unit| rest -= unit * unit.dot(&rest));
            }
            if rest.norm() > DEPENDENT * own.norm() && own.amax() > DEPENDENT * size {
                pivots.push(column);
                across.push(rest.normalize());
            }
        }
        let chosen = all.select_columns(&pivots);
        let factors = chosen.svd(true, true);
        let mut combinations = factors.solve(&all, 0.0).map_err(|text| Error::new(ErrorKind::BadValue, text))?;
        combinations.iter_mut().filter(|entry| entry.abs() < DEPENDENT).for_each(|entry| *entry = 0.0);
        for (row, pivot) in pivots.iter().enumerate() {
            combinations.column_mut(*pivot).fill(0.0);
            combinations[(row, *pivot)] = 1.0;
        }
        Ok(Base { pivots, combinations })
    }

    pub(super) fn base_names(&self, base: &Base) -> Vec<String> {
        let names = self.parameter_names();
        let sum = |row: usize| {
            let mut text = names[base.pivots[row]].clone();
            for (column, factor) in base.combinations.row(row).iter().enumerate() {
                if *factor != 0.0 && column != base.pivots[row] {
                    let sign = if *factor < 0.0 { '-' } else { '+' };
                    let size = factor.abs();
                    let times = if (size - 1.0).abs() < 5e-7 { String::new() } else { format!("{} ", short(size)) };
                    text += &format!(" {sign} {times}{}", names[column]);
                }
            }
            text
        };
        (0..base.pivots.len()).map(sum).collect()
    }
}

fn short(number: f64) -> String {
    let text = format!("{number:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
