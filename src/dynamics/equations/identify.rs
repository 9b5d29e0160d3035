//! What bodies weigh, from a log of motions and torques. Main type: [`Identification`].
//!
//! Torques are the regressor times what bodies weigh, of which only base parameters matter (M. Gautier and W. Khalil, IEEE Trans. Robotics and Automation 6, 1990); these and the
//! joints' friction are found by least squares, each joint weighed by what it misses (M. Gautier, ICRA 1997). Whether bodies can have them is told by their
//! pseudo-inertia (P. M. Wensing, S. Kim and J.-J. E. Slotine, IEEE Robotics and Automation Letters 3, 2018).

use nalgebra::{DMatrix, DVector, Matrix4, SymmetricEigen};

use super::{Equations, State, sign};
use crate::{Error, ErrorKind, Result};

/// Columns whose part across others is less than this share of themselves depend on these.
const DEPENDENT: f64 = 1e-8;
/// The log tells no parameter whose least singular value is below this share of the greatest.
const BLIND: f64 = 1e-10;
/// How often consistent bodies are sought, and how near in deviations they count as found.
const SEARCHES: usize = 5000;
const FOUND: f64 = 1e-2;
/// The standard normal distribution has 95 % of itself within so many deviations.
pub const CONFIDENT: f64 = 1.959_963_984_540_054;

/// A motion and its torques, by freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Logged {
    /// Where joints are.
    pub q: Vec<f64>,
    /// Their rates.
    pub velocity: Vec<f64>,
    /// What these change by.
    pub acceleration: Vec<f64>,
    /// What was measured.
    pub torques: Vec<f64>,
}

/// A number that was found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// What it is: a sum of the numbers of [`Equations::parameter_names`], or friction.
    pub name: String,
    /// What was found.
    pub value: f64,
    /// Its standard deviation; 95 % lie within [`CONFIDENT`] of them.
    pub deviation: f64,
    /// What the description tells.
    pub told: f64,
}

/// Whether bodies can weigh what was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Consistency {
    /// They can: these are ten numbers a body, as [`Equations::parameters`] has them, near to those of the description.
    Consistent(Vec<f64>),
    /// No bodies were found whose base parameters are nearer than this to those that were found, and the one that is farthest.
    Off {
        /// In its deviations.
        deviations: f64,
        /// Its name.
        name: String,
    },
}

/// What a log tells of a robot.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Identification {
    /// Base parameters.
    pub base: Vec<Estimate>,
    /// By freedom viscous and Coulomb friction, where it was asked for.
    pub friction: Vec<[Estimate; 2]>,
    /// The condition number of the matrix of the least squares, its columns brought to one length.
    pub condition: f64,
    /// By freedom the root of the mean square of what torques miss.
    pub misses: Vec<f64>,
    /// Of the base parameters.
    pub consistency: Consistency,
}

/// Which parameters stand for all: `B pi` are the base parameters.
struct Base {
    pivots: Vec<usize>,
    combinations: DMatrix<f64>,
}

impl Equations {
    /// What bodies weigh and how joints rub by a log; rotors are taken as they are told, and so is friction unless it is asked for.
    ///
    /// # Errors
    /// As [`Equations::inverse`], with the row; [`ErrorKind::BadValue`] for a log that does not tell all base parameters apart, with one that it leaves open; [`ErrorKind::Unsupported`] for a base that moves
    /// freely.
    pub fn identify(&self, log: &[Logged], with_friction: bool) -> Result<Identification> {
        if self.is_floating() {
            return Err(Error::new(ErrorKind::Unsupported, "a robot whose root moves freely is not identified"));
        }
        let base = self.base_parameters()?;
        let (count, parameters) = (self.freedoms(), base.pivots.len());
        let unknowns = parameters + if with_friction { 2 * count } else { 0 };
        let rows = log.len() * count;
        if rows < unknowns {
            let text = format!("{} rows of {count} torques are given; {unknowns} numbers are asked for", log.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let (mut matrix, mut right) = (DMatrix::zeros(rows, unknowns), DVector::zeros(rows));
        let mut room = self.workspace();
        for (number, logged) in log.iter().enumerate() {
            let at = |error: Error| error.with_context(format!("row {}", number + 1));
            let state = State::new(&logged.q, &logged.velocity);
            self.check(state, Some(("torques", &logged.torques))).map_err(at)?;
            let own = self.of_drives(&logged.velocity, &logged.acceleration, !with_friction);
            let regressor = self.regressor(&mut room, state, &logged.acceleration).map_err(at)?;
            for row in 0..count {
                let into = number * count + row;
                right[into] = logged.torques[row] - own[row];
                for (column, pivot) in base.pivots.iter().enumerate() {
                    matrix[(into, column)] = regressor[(row, *pivot)];
                }
                if with_friction {
                    matrix[(into, parameters + 2 * row)] = logged.velocity[row];
                    matrix[(into, parameters + 2 * row + 1)] = sign(logged.velocity[row]);
                }
            }
        }
        let names = self.base_names(&base);
        let name = |unknown: usize| self.unknown_name(&names, unknown);
        let plain = solve(&matrix, &right, name)?;
        // Each joint by what it misses: what is exact counts no more than what misses by a billionth of the torques.
        let least = 1e-9 * right.amax();
        let deviations = misses(&matrix, &right, &plain.0, count).map(|miss| miss.max(least));
        for row in 0..rows {
            let weight = 1.0 / deviations[row % count];
            matrix.row_mut(row).scale_mut(weight);
            right[row] *= weight;
        }
        let (found, spread, condition) = solve(&matrix, &right, name)?;
        let spare = (rows - unknowns).max(1) as f64;
        let scale = ((&right - &matrix * &found).norm_squared() / spare).sqrt();
        for row in 0..rows {
            let weight = deviations[row % count];
            matrix.row_mut(row).scale_mut(weight);
            right[row] *= weight;
        }
        let told = &base.combinations * DVector::from_vec(self.parameters());
        let estimate = |unknown: usize, told: f64| Estimate {
            name: name(unknown),
            value: found[unknown],
            deviation: spread[unknown] * scale,
            told,
        };
        let estimates: Vec<Estimate> = (0..parameters).map(|at| estimate(at, told[at])).collect();
        let friction = |row: usize| {
            let told = self.told_friction(row);
            [0, 1].map(|which| estimate(parameters + 2 * row + which, told[which]))
        };
        let friction = if with_friction { (0..count).map(friction).collect() } else { Vec::new() };
        Ok(Identification {
            consistency: self.consistency(&base, &estimates),
            base: estimates,
            friction,
            condition,
            misses: misses(&matrix, &right, &found, count).iter().copied().collect(),
        })
    }

    /// The base parameters by numbers: from the regressors of many states the first columns that are independent, and what the others are of these.
    fn base_parameters(&self) -> Result<Base> {
        let (count, columns) = (self.freedoms(), self.parameters().len());
        let states = (3 * columns).div_ceil(count);
        let mut all = DMatrix::zeros(states * count, columns);
        let mut room = self.workspace();
        let mut random = 1_u64;
        let mut number = || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for state in 0..states {
            let mut list = |most: f64| (0..count).map(|_| most * number()).collect::<Vec<f64>>();
            let [q, velocity, acceleration] = [3.0, 2.0, 5.0].map(&mut list);
            let regressor = self.regressor(&mut room, State::new(&q, &velocity), &acceleration)?;
            all.rows_mut(state * count, count).copy_from(regressor);
        }
        let size = all.amax();
        let (mut pivots, mut across): (Vec<usize>, Vec<DVector<f64>>) = (Vec::new(), Vec::new());
        for column in 0..columns {
            let own = all.column(column).into_owned();
            let mut rest = own.clone();
            // Twice is enough (W. Kahan and B. N. Parlett).
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

    fn base_names(&self, base: &Base) -> Vec<String> {
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

    fn unknown_name(&self, base: &[String], unknown: usize) -> String {
        match unknown.checked_sub(base.len()) {
            None => base[unknown].clone(),
            Some(at) => {
                let kind = if at % 2 == 0 { "viscous" } else { "Coulomb" };
                format!("{}: {kind} friction", self.names[at / 2])
            }
        }
    }

    /// Viscous and Coulomb friction of a freedom as they are told, of all joints that it moves.
    fn told_friction(&self, freedom: usize) -> [f64; 2] {
        let own = self.drives.iter().filter(|drive| drive.freedom == freedom);
        own.fold([0.0; 2], |[viscous, coulomb], drive| {
            [viscous + drive.factor * drive.factor * drive.damping, coulomb + drive.factor.abs() * drive.friction]
        })
    }

    /// What rotors, and friction if it is asked for, add to the torques.
    fn of_drives(&self, velocity: &[f64], acceleration: &[f64], with_friction: bool) -> Vec<f64> {
        let mut torques = vec![0.0; self.freedoms()];
        for drive in &self.drives {
            let rotor = drive.armature * drive.factor * acceleration[drive.freedom];
            let friction = if with_friction { drive.friction(drive.factor * velocity[drive.freedom]) } else { 0.0 };
            torques[drive.freedom] += drive.factor * (rotor + friction);
        }
        torques
    }

    /// Bodies that weigh what was found, sought between those of which each can be and those whose base parameters are right, in turn (J. P. Boyle and R. L.
    /// Dykstra, 1986), from those of the description.
    fn consistency(&self, base: &Base, found: &[Estimate]) -> Consistency {
        let wanted = DVector::from_iterator(found.len(), found.iter().map(|estimate| estimate.value));
        let combinations = &base.combinations;
        let plain = combinations * metric_inverse(combinations.ncols()) * combinations.transpose();
        let Some(solver) = plain.cholesky() else { return off(found, &wanted, &wanted) };
        let mut numbers = DVector::from_vec(self.parameters());
        let mut carried = DVector::zeros(numbers.len());
        let mut bodies = numbers.clone();
        for _ in 0..SEARCHES {
            let missing = &wanted - combinations * &numbers;
            let way = combinations.transpose() * solver.solve(&missing);
            numbers += metric_inverse(numbers.len()) * way;
            let before = &numbers + &carried;
            bodies = before.clone();
            bodies.as_mut_slice().chunks_exact_mut(10).for_each(to_body);
            carried = before - &bodies;
            numbers = bodies.clone();
            if let Consistency::Off { deviations, .. } = off(found, &wanted, &(combinations * &bodies))
                && deviations < FOUND
            {
                return Consistency::Consistent(bodies.as_slice().to_vec());
            }
        }
        off(found, &wanted, &(combinations * bodies))
    }
}

fn short(number: f64) -> String {
    let text = format!("{number:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// How far the farthest base parameter is from what was found.
fn off(found: &[Estimate], wanted: &DVector<f64>, reached: &DVector<f64>) -> Consistency {
    let size = wanted.amax();
    let miss = |at: usize| (wanted[at] - reached[at]).abs() / found[at].deviation.max(1e-9 * size);
    let farthest = (0..found.len()).max_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap_or(0);
    let name = found.get(farthest).map(|estimate| estimate.name.clone()).unwrap_or_default();
    Consistency::Off { deviations: if found.is_empty() { 0.0 } else { miss(farthest) }, name }
}

/// The inverse of the metric of ten numbers a body that the sum of squares of pseudo-inertias is: `m` and each product of inertia off the diagonal of these as they are.
fn metric_inverse(count: usize) -> DMatrix<f64> {
    // Second moments are (trace/2 - I): of xx, yy, zz the sum of squares is 3/4 of theirs less half of their products.
    let mut inverse = DMatrix::identity(count, count);
    for body in 0..count / 10 {
        for i in 1..10 {
            inverse[(10 * body + i, 10 * body + i)] = 0.5;
        }
        let diagonal = [4, 6, 9].map(|i| 10 * body + i);
        for (a, i) in diagonal.into_iter().enumerate() {
            for (b, j) in diagonal.into_iter().enumerate() {
                inverse[(i, j)] = if a == b { 2.0 } else { 1.0 };
            }
        }
    }
    inverse
}

/// Ten numbers that a body can have, near to these: the pseudo-inertia without its negative parts.
fn to_body(numbers: &mut [f64]) {
    let [m, x, y, z, xx, xy, yy, xz, yz, zz] = std::array::from_fn(|i| numbers[i]);
    let half = 0.5 * (xx + yy + zz);
    #[rustfmt::skip]
    let pseudo = Matrix4::new(
        half - xx, -xy, -xz, x,
        -xy, half - yy, -yz, y,
        -xz, -yz, half - zz, z,
        x, y, z, m,
    );
    let mut factors = SymmetricEigen::new(pseudo);
    factors.eigenvalues.iter_mut().for_each(|value| *value = value.max(0.0));
    let p = factors.recompose();
    let trace = p[(0, 0)] + p[(1, 1)] + p[(2, 2)];
    let tensor = [trace - p[(0, 0)], -p[(0, 1)], trace - p[(1, 1)], -p[(0, 2)], -p[(1, 2)], trace - p[(2, 2)]];
    numbers[..4].copy_from_slice(&[p[(3, 3)], p[(0, 3)], p[(1, 3)], p[(2, 3)]]);
    numbers[4..].copy_from_slice(&tensor);
}

/// By freedom the root of the mean square of what is missed.
fn misses(matrix: &DMatrix<f64>, right: &DVector<f64>, found: &DVector<f64>, count: usize) -> DVector<f64> {
    let left = right - matrix * found;
    let rows = (left.len() / count) as f64;
    DVector::from_fn(count, |at, _| {
        let squares: f64 = left.iter().skip(at).step_by(count).map(|x| x * x).sum();
        (squares / rows).sqrt()
    })
}

/// Least squares: what is found, its standard deviations for a miss of one, and the condition number.
fn solve(
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
    name: impl Fn(usize) -> String,
) -> Result<(DVector<f64>, DVector<f64>, f64)> {
    // Columns of one length are told apart best.
    let sizes = DVector::from_iterator(matrix.ncols(), matrix.column_iter().map(|column| column.norm()));
    let blind = |unknown: usize| {
        let text = format!("the log does not tell `{}`; move more joints, and faster", name(unknown));
        Error::new(ErrorKind::BadValue, text)
    };
    if let Some(unknown) = sizes.iter().position(|size| *size <= 1e-12 * sizes.amax()) {
        return Err(blind(unknown));
    }
    let mut scaled = matrix.clone();
    scaled.column_iter_mut().zip(sizes.iter()).for_each(|(mut column, size)| column /= *size);
    // An orthogonal factor makes a small matrix of it, with the same singular values.
    let triangle = scaled.clone().qr();
    let reduced = triangle.q().transpose() * right;
    let factors = triangle.r().svd(true, true);
    let (values, turn) = (&factors.singular_values, factors.v_t.as_ref());
    let (Some(turn), Some(greatest)) = (turn, values.iter().copied().reduce(f64::max)) else {
        return Err(Error::new(ErrorKind::BadValue, "the log is empty"));
    };
    let least = values.imin();
    if values[least] <= BLIND * greatest {
        return Err(blind(turn.row(least).iamax_full().1));
    }
    let found = factors.solve(&reduced, 0.0).map_err(|text| Error::new(ErrorKind::BadValue, text))?;
    let spread = |unknown: usize| {
        let parts = values.iter().enumerate().map(|(at, value)| (turn[(at, unknown)] / value).powi(2));
        parts.sum::<f64>().sqrt() / sizes[unknown]
    };
    let found = found.component_div(&sizes);
    let spread = DVector::from_fn(matrix.ncols(), |unknown, _| spread(unknown));
    Ok((found, spread, greatest / values[least]))
}
