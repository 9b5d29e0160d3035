//! What bodies weigh, from a log of motions and torques. Main type: [`Identification`].
//!
//! Torques are the regressor times what bodies weigh, of which only base parameters matter (M. Gautier and W. Khalil, IEEE Trans. Robotics and Automation 6, 1990); these and the
//! joints' friction are found by weighted least squares, each joint by the noise of its torques (M. Gautier, ICRA 1997). The same squares are then made least over bodies that can exist
//! ([`Consistency`]), and what torques miss is tested ([`Finding`]).

mod base;
mod bodies;
mod fit;
mod judge;
mod quantiles;

use nalgebra::{DMatrix, DVector};

use self::base::Base;
use self::bodies::{Problem, is_never_negative};
use self::fit::Fit;
pub use self::judge::{Finding, FindingKind};
use self::quantiles::{chi_square_999, student_95, widening};
use super::{Equations, State, sign};
use crate::{Error, ErrorKind, Result};

/// The greatest size of a number of a log.
const MOST: f64 = groebot_algebra::limits::LOG_LARGEST;
/// The least noise of a joint, as a share of the greatest torque: what misses less counts as exact.
const EXACT: f64 = 1e-7;

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
    /// Half of the interval that has it with 95 %, by Student's t: right for noise that is independent from row to row and normal. None where the log has no more torques than unknowns.
    pub interval: Option<f64>,
    /// What the description tells.
    pub told: f64,
}

/// Bodies that can exist, and explain the torques as well as such bodies can.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Consistency {
    /// Ten numbers a body, as [`Equations::parameters`] has them, near to those of the description.
    pub bodies: Vec<f64>,
    /// Their base parameters.
    pub values: Vec<f64>,
    /// How far these are from those that were found: the square of that, in their common standard deviation.
    pub squares: f64,
    /// No bodies are nearer: by a parameter that no bodies have below zero, and by how the squares fell at last.
    pub least: f64,
    /// What 99.9 % of the squares are below if noise alone is the cause.
    pub bound: f64,
    /// Whether the least of the squares was reached, within 1e-4 of itself or a hundredth of the noise.
    pub is_converged: bool,
}

impl Consistency {
    /// Whether bodies can weigh what was found, within its noise.
    pub fn holds(&self) -> bool {
        self.squares <= self.bound
    }

    /// Whether no bodies can.
    pub fn is_refuted(&self) -> bool {
        self.least > self.bound
    }
}

/// What a log tells of a robot.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Identification {
    /// Base parameters.
    pub base: Vec<Estimate>,
    /// By freedom viscous and Coulomb friction, where it was asked for.
    pub friction: Vec<[Estimate; 2]>,
    /// How many torques the log has beyond the unknowns: the degrees of freedom of its noise.
    pub freedom: usize,
    /// The condition number of the matrix of the least squares, its columns brought to one length.
    pub condition: f64,
    /// By freedom the root of the mean square of what torques miss.
    pub misses: Vec<f64>,
    /// By freedom that as a share of the torques' standard deviation.
    pub unexplained: Vec<f64>,
    /// Of the base parameters.
    pub consistency: Consistency,
    /// What is wrong with the log; nothing where torques are those of bodies, and noise that is independent from row to row.
    pub findings: Vec<Finding>,
}

/// The least squares of a log: rows by row of the log and freedom, columns friction and then base parameters.
struct System {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    /// How many columns friction has.
    friction: usize,
    /// How many freedoms.
    count: usize,
}

impl Equations {
    /// What bodies weigh and how joints rub by a log; rotors are taken as they are told, and so is friction unless it is asked for.
    ///
    /// # Errors
    /// As [`Equations::inverse`], with the row; [`ErrorKind::BadValue`] for a number beyond 1e12, and a log that does not tell all base parameters apart, with one that it leaves open;
    /// [`ErrorKind::Unsupported`] for a base that moves freely and a robot without joints.
    pub fn identify(&self, log: &[Logged], with_friction: bool) -> Result<Identification> {
        self.check_identified()?;
        let base = self.base_parameters()?;
        let system = self.system(log, &base, with_friction)?;
        let names = self.base_names(&base);
        let name = |column: usize| self.unknown_name(&names, column, system.friction);
        let (fit, weights) = system.solve(name)?;
        let freedom = system.right.len() - fit.values.len();
        // The noise beside that of the weights.
        let scale = (system.weighted(&weights, &fit).norm_squared() / freedom.max(1) as f64).sqrt();
        let told = &base.combinations * DVector::from_vec(self.parameters());
        let estimate = |column: usize, told: f64| Estimate {
            name: name(column),
            value: fit.values[column],
            interval: (freedom > 0).then(|| student_95(freedom) * fit.spread[column] * scale),
            told,
        };
        let friction = |row: usize| {
            let told = self.told_friction(row);
            [0, 1].map(|which| estimate(2 * row + which, told[which]))
        };
        let rows_of_friction = 0..system.friction / 2;
        let consistency = self.consistency(&base, &fit, system.friction, scale, freedom);
        let residual = &system.right - &system.matrix * &fit.values;
        let torques = system.by_joint(log.iter().flat_map(|row| row.torques.iter().copied()));
        let misses = system.by_joint(residual.iter().copied());
        let own = system.by_joint(self.told_torques(log)?);
        let mut findings = judge::findings(&self.names, &torques, &misses, &own, freedom);
        findings.extend(judge::of_bodies(&consistency, freedom));
        Ok(Identification {
            base: told.iter().enumerate().map(|(at, told)| estimate(system.friction + at, *told)).collect(),
            friction: rows_of_friction.map(friction).collect(),
            freedom,
            condition: fit.condition,
            misses: misses.iter().map(|list| judge::root_mean_square(list)).collect(),
            unexplained: torques.iter().zip(&misses).map(|(all, missed)| judge::unexplained(all, missed)).collect(),
            consistency,
            findings,
        })
    }

    fn check_identified(&self) -> Result<()> {
        let refused = |text: &str| Err(Error::new(ErrorKind::Unsupported, text));
        if self.is_floating() {
            return refused("a robot whose root moves freely is not identified");
        }
        if self.names.is_empty() {
            return refused("the robot has no joint that moves; there is nothing to identify");
        }
        let negative = |drive: &super::Drive| drive.damping < 0.0 || drive.friction < 0.0 || drive.armature < 0.0;
        match self.drives.iter().position(negative) {
            Some(joint) => {
                let text = format!(
                    "the joint of link `{}` has a damping, friction or rotor inertia below zero; give numbers that are not",
                    self.told_names[joint + 1]
                );
                Err(Error::new(ErrorKind::BadValue, text))
            }
            None => Ok(()),
        }
    }

    /// The rows of a log.
    fn system(&self, log: &[Logged], base: &Base, with_friction: bool) -> Result<System> {
        let (count, parameters) = (self.freedoms(), base.pivots.len());
        let friction = if with_friction { 2 * count } else { 0 };
        let (rows, unknowns) = (log.len() * count, friction + parameters);
        if rows < unknowns || unknowns == 0 {
            let text = format!("{} rows of {count} torques are given; {unknowns} numbers are asked for", log.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let (mut matrix, mut right) = (DMatrix::zeros(rows, unknowns), DVector::zeros(rows));
        let mut room = self.workspace();
        for (number, logged) in log.iter().enumerate() {
            let at = |error: Error| error.with_context(format!("row {}", number + 1));
            let state = State::new(&logged.q, &logged.velocity);
            self.check(state, Some(("torques", &logged.torques))).and_then(|()| check_range(logged)).map_err(at)?;
            let own = self.of_drives(&logged.velocity, &logged.acceleration, !with_friction);
            let regressor = self.regressor(&mut room, state, &logged.acceleration).map_err(at)?;
            for row in 0..count {
                let into = number * count + row;
                right[into] = logged.torques[row] - own[row];
                for (column, pivot) in base.pivots.iter().enumerate() {
                    matrix[(into, friction + column)] = regressor[(row, *pivot)];
                }
                if with_friction {
                    matrix[(into, 2 * row)] = logged.velocity[row];
                    matrix[(into, 2 * row + 1)] = sign(logged.velocity[row]);
                }
            }
        }
        Ok(System { matrix, right, friction, count })
    }

    /// The torques of the description, by row and freedom.
    fn told_torques(&self, log: &[Logged]) -> Result<Vec<f64>> {
        let mut room = self.workspace();
        let mut all = Vec::with_capacity(log.len() * self.freedoms());
        for logged in log {
            let state = State::new(&logged.q, &logged.velocity);
            all.extend(self.inverse(&mut room, state, &logged.acceleration)?.iter());
        }
        Ok(all)
    }

    fn unknown_name(&self, base: &[String], column: usize, friction: usize) -> String {
        match column.checked_sub(friction) {
            Some(at) => base[at].clone(),
            None => {
                let kind = if column.is_multiple_of(2) { "viscous" } else { "Coulomb" };
                format!("{}: {kind} friction", self.names[column / 2])
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

    /// The least of the squares over bodies that can exist. Friction is free, so that the last columns of the triangular factor are those of base parameters alone.
    fn consistency(&self, base: &Base, fit: &Fit, friction: usize, scale: f64, freedom: usize) -> Consistency {
        let count = base.pivots.len();
        let root = fit.root.view((friction, friction), (count, count)) / scale.max(1.0);
        let found: DVector<f64> = fit.values.rows(friction, count).into_owned();
        let problem = Problem { matrix: &root * &base.combinations, right: &root * &found };
        let nearest = problem.solve(&self.parameters());
        let values = &base.combinations * DVector::from_column_slice(&nearest.parameters);
        Consistency {
            values: values.as_slice().to_vec(),
            bodies: nearest.parameters,
            squares: nearest.squares,
            least: nearest.least.max(below_nothing(base, &root, found.as_slice())),
            bound: chi_square_999(count) * widening(freedom.max(1)).powi(2),
            is_converged: nearest.is_converged,
        }
    }
}

impl System {
    /// Least squares, each joint by the noise that its torques show, and that noise.
    fn solve(&self, name: impl Fn(usize) -> String + Copy) -> Result<(Fit, Vec<f64>)> {
        let plain = Fit::of(&self.matrix, &self.right, name)?;
        let least = EXACT * self.right.amax().max(f64::MIN_POSITIVE);
        let residual = &self.right - &self.matrix * &plain.values;
        let noise = |joint: usize| {
            let own = || (joint..residual.len()).step_by(self.count);
            let squares: f64 = own().map(|row| residual[row].powi(2)).sum();
            let free: f64 = own().map(|row| 1.0 - plain.leverage[row]).sum();
            // Where a joint's rows are all used up nothing tells its noise.
            (squares / free.max(1.0)).sqrt().max(least)
        };
        let noise: Vec<f64> = (0..self.count).map(noise).collect();
        let (mut matrix, mut right) = (self.matrix.clone(), self.right.clone());
        for row in 0..right.len() {
            let weight = 1.0 / noise[row % self.count];
            matrix.row_mut(row).scale_mut(weight);
            right[row] *= weight;
        }
        Ok((Fit::of(&matrix, &right, name)?, noise))
    }

    /// What is missed, in units of the joints' noise.
    fn weighted(&self, noise: &[f64], fit: &Fit) -> DVector<f64> {
        let mut residual = &self.right - &self.matrix * &fit.values;
        residual.iter_mut().enumerate().for_each(|(row, value)| *value /= noise[row % self.count]);
        residual
    }

    /// A list by row and freedom as one list for each freedom.
    fn by_joint(&self, all: impl IntoIterator<Item = f64>) -> Vec<Vec<f64>> {
        let mut lists = vec![Vec::with_capacity(self.right.len() / self.count); self.count];
        all.into_iter().enumerate().for_each(|(row, value)| lists[row % self.count].push(value));
        lists
    }
}

/// The square of the greatest distance below zero, in deviations, of a base parameter that is so of no bodies.
fn below_nothing(base: &Base, root: &DMatrix<f64>, found: &[f64]) -> f64 {
    let Some(inverse) = root.clone().try_inverse() else { return 0.0 };
    let distance = |at: usize| {
        let row: Vec<f64> = base.combinations.row(at).iter().copied().collect();
        let is_wrong = found[at] < 0.0 && is_never_negative(&row);
        if is_wrong { (found[at] / inverse.row(at).norm()).powi(2) } else { 0.0 }
    };
    (0..found.len()).map(distance).fold(0.0, f64::max)
}

fn check_range(logged: &Logged) -> Result<()> {
    let lists = [("q", &logged.q), ("v", &logged.velocity), ("a", &logged.acceleration), ("tau", &logged.torques)];
    for (name, list) in lists {
        if let Some(at) = list.iter().position(|value| value.abs() > MOST) {
            let text = format!("{name}{at} is {:e}; give a number of at most {MOST:e} in size", list[at]);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
    }
    Ok(())
}
