//! Identification of inertial parameters from a log of motions and torques. Main type: [`Identification`].
//!
//! Torques are the regressor times the inertial parameters, of which only the base parameters matter (M. Gautier and W.
//! Khalil, IEEE Trans. Robotics and Automation 6, 1990). These and the joint friction are estimated by weighted least
//! squares, with each joint weighted by the noise of its torques (M. Gautier, ICRA 1997). The same sum of squares is
//! then minimised over physically consistent bodies ([`Consistency`]), and the residuals are tested ([`Finding`]).

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

/// The largest absolute value of a number in a log.
const MOST: f64 = groebot_algebra::limits::LOG_LARGEST;
/// Minimum noise of a joint relative to its greatest torque. Smaller residuals count as exact.
const EXACT: f64 = 1e-7;

/// One row of a log: a motion and its torques, one entry for each degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Logged {
    /// Joint positions \[rad or m\].
    pub q: Vec<f64>,
    /// Joint velocities.
    pub velocity: Vec<f64>,
    /// Joint accelerations.
    pub acceleration: Vec<f64>,
    /// Measured torques \[N m\] or forces \[N\].
    pub torques: Vec<f64>,
}

/// An estimated parameter.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// Its name: a linear combination of [`Equations::parameter_names`], or a friction coefficient.
    pub name: String,
    /// The estimated value.
    pub value: f64,
    /// Half width of the 95 % confidence interval, by Student's t. It is valid for normal noise that is independent
    /// from row to row. `None` when the log has no more torques than unknowns.
    pub interval: Option<f64>,
    /// The value in the description.
    pub described: f64,
}

/// Physically consistent bodies that explain the torques as well as possible.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Consistency {
    /// Ten inertial parameters for each body, as in [`Equations::parameters`], near those of the description.
    pub bodies: Vec<f64>,
    /// Their base parameters.
    pub values: Vec<f64>,
    /// Squared distance of these from the estimated values, in units of their joint standard deviation.
    pub squares: f64,
    /// Lower bound of this distance over all consistent bodies. It uses parameters that cannot be negative, and the
    /// final decrease of the squares.
    pub least: f64,
    /// The 99.9 % quantile of the squared distance if noise is the only cause.
    pub bound: f64,
    /// Whether the minimum of the squares was reached, within 1e-4 of its value or a hundredth of the noise.
    pub is_converged: bool,
}

impl Consistency {
    /// Whether some consistent bodies agree with the estimated values within the noise.
    pub fn holds(&self) -> bool {
        self.squares <= self.bound
    }

    /// Whether no consistent bodies agree with them.
    pub fn is_refuted(&self) -> bool {
        self.least > self.bound
    }
}

/// Result of an identification.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Identification {
    /// The base parameters.
    pub base: Vec<Estimate>,
    /// Viscous and Coulomb friction for each degree of freedom, on request.
    pub friction: Vec<[Estimate; 2]>,
    /// Number of torques minus number of unknowns: the degrees of freedom of the noise.
    pub freedom: usize,
    /// The condition number of the least-squares matrix with its columns scaled to equal length.
    pub condition: f64,
    /// Root mean square of the residuals for each degree of freedom.
    pub misses: Vec<f64>,
    /// Root mean square of the residuals as a fraction of the torques' standard deviation.
    pub unexplained: Vec<f64>,
    /// Physical consistency of the base parameters.
    pub consistency: Consistency,
    /// Problems of the log; empty when the torques agree with rigid bodies and the noise is independent from row to
    /// row.
    pub findings: Vec<Finding>,
}

/// The least-squares system of a log. Rows: log row and degree of freedom. Columns: friction, then base parameters.
struct System {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    /// Number of friction columns.
    friction: usize,
    /// Number of degrees of freedom.
    count: usize,
}

impl Equations {
    /// Identifies the inertial parameters, and on request the joint friction, from a log. Rotor inertias are taken from
    /// the description, and so is friction without this request.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`], with the row; [`ErrorKind::BadValue`] for a number above 1e12, and for a log
    /// that does not determine all base parameters, with the name of an undetermined one; [`ErrorKind::Unsupported`]
    /// for a floating base and a robot without joints.
    pub fn identify(&self, log: &[Logged], with_friction: bool) -> Result<Identification> {
        self.check_identified()?;
        let base = self.base_parameters()?;
        let system = self.system(log, &base, with_friction)?;
        let names = self.base_names(&base);
        let name = |column: usize| self.unknown_name(&names, column, system.friction);
        let (fit, weights) = system.solve(name)?;
        let freedom = system.right.len() - fit.values.len();
        // The scale of the noise relative to the weights.
        let scale = (system.weighted(&weights, &fit).norm_squared() / freedom.max(1) as f64).sqrt();
        let described = &base.combinations * DVector::from_vec(self.parameters());
        let estimate = |column: usize, described: f64| Estimate {
            name: name(column),
            value: fit.values[column],
            interval: (freedom > 0).then(|| student_95(freedom) * fit.spread[column] * scale),
            described,
        };
        let friction = |row: usize| {
            let described = self.described_friction(row);
            [0, 1].map(|which| estimate(2 * row + which, described[which]))
        };
        let rows_of_friction = 0..system.friction / 2;
        let consistency = self.consistency(&base, &fit, system.friction, scale, freedom);
        let residual = &system.right - &system.matrix * &fit.values;
        let torques = system.by_joint(log.iter().flat_map(|row| row.torques.iter().copied()));
        let misses = system.by_joint(residual.iter().copied());
        let own = system.by_joint(self.described_torques(log)?);
        let mut findings = judge::findings(&self.names, &torques, &misses, &own, freedom);
        findings.extend(judge::of_bodies(&consistency, freedom));
        Ok(Identification {
            base: described
                .iter()
                .enumerate()
                .map(|(at, described)| estimate(system.friction + at, *described))
                .collect(),
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
            return refused("a robot with a floating base is not supported");
        }
        if self.names.is_empty() {
            return refused("the robot has no moving joint; there is nothing to identify");
        }
        let negative = |drive: &super::Drive| drive.damping < 0.0 || drive.friction < 0.0 || drive.armature < 0.0;
        match self.drives.iter().position(negative) {
            Some(joint) => {
                let text = format!(
                    "the joint of link `{}` has a negative damping, friction or rotor inertia; give nonnegative numbers",
                    self.parameter_link_names[joint + 1]
                );
                Err(Error::new(ErrorKind::BadValue, text))
            }
            None => Ok(()),
        }
    }

    /// Builds the least-squares system of a log.
    fn system(&self, log: &[Logged], base: &Base, with_friction: bool) -> Result<System> {
        let (count, parameters) = (self.freedoms(), base.pivots.len());
        let friction = if with_friction { 2 * count } else { 0 };
        let (rows, unknowns) = (log.len() * count, friction + parameters);
        if rows < unknowns || unknowns == 0 {
            let text =
                format!("{} rows of {count} torques are given for {unknowns} parameters; give more rows", log.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let (mut matrix, mut right) = (DMatrix::zeros(rows, unknowns), DVector::zeros(rows));
        let mut workspace = self.workspace();
        for (number, logged) in log.iter().enumerate() {
            let at = |error: Error| error.with_context(format!("row {}", number + 1));
            let state = State::new(&logged.q, &logged.velocity);
            self.check(state, Some(("torques", &logged.torques))).and_then(|()| check_range(logged)).map_err(at)?;
            let own = self.of_drives(&logged.velocity, &logged.acceleration, !with_friction);
            let regressor = self.regressor(&mut workspace, state, &logged.acceleration).map_err(at)?;
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

    /// The torques of the description, for each row and degree of freedom.
    fn described_torques(&self, log: &[Logged]) -> Result<Vec<f64>> {
        let mut workspace = self.workspace();
        let mut all = Vec::with_capacity(log.len() * self.freedoms());
        for logged in log {
            let state = State::new(&logged.q, &logged.velocity);
            all.extend(self.inverse(&mut workspace, state, &logged.acceleration)?.iter());
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

    /// Viscous and Coulomb friction of a degree of freedom in the description, summed over all joints that it moves.
    fn described_friction(&self, freedom: usize) -> [f64; 2] {
        let own = self.drives.iter().filter(|drive| drive.freedom == freedom);
        own.fold([0.0; 2], |[viscous, coulomb], drive| {
            [viscous + drive.factor * drive.factor * drive.damping, coulomb + drive.factor.abs() * drive.friction]
        })
    }

    /// The torques of rotors, and of friction on request.
    fn of_drives(&self, velocity: &[f64], acceleration: &[f64], with_friction: bool) -> Vec<f64> {
        let mut torques = vec![0.0; self.freedoms()];
        for drive in &self.drives {
            let rotor = drive.armature * drive.factor * acceleration[drive.freedom];
            let friction = if with_friction { drive.friction(drive.factor * velocity[drive.freedom]) } else { 0.0 };
            torques[drive.freedom] += drive.factor * (rotor + friction);
        }
        torques
    }

    /// Minimises the squares over consistent bodies. Friction is unconstrained, so the last columns of the triangular
    /// factor belong to the base parameters alone.
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
    /// Solves the least squares with each joint weighted by the noise of its torques. Returns the fit and the noise.
    fn solve(&self, name: impl Fn(usize) -> String + Copy) -> Result<(Fit, Vec<f64>)> {
        let plain = Fit::of(&self.matrix, &self.right, name)?;
        let least = EXACT * self.right.amax().max(f64::MIN_POSITIVE);
        let residual = &self.right - &self.matrix * &plain.values;
        let noise = |joint: usize| {
            let own = || (joint..residual.len()).step_by(self.count);
            let squares: f64 = own().map(|row| residual[row].powi(2)).sum();
            let free: f64 = own().map(|row| 1.0 - plain.leverage[row]).sum();
            // If a joint has no more rows than unknowns, its noise cannot be estimated.
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

    /// The residuals in units of the joints' noise.
    fn weighted(&self, noise: &[f64], fit: &Fit) -> DVector<f64> {
        let mut residual = &self.right - &self.matrix * &fit.values;
        residual.iter_mut().enumerate().for_each(|(row, value)| *value /= noise[row % self.count]);
        residual
    }

    /// Splits a list by row and degree of freedom into one list for each degree of freedom.
    fn by_joint(&self, all: impl IntoIterator<Item = f64>) -> Vec<Vec<f64>> {
        let mut lists = vec![Vec::with_capacity(self.right.len() / self.count); self.count];
        all.into_iter().enumerate().for_each(|(row, value)| lists[row % self.count].push(value));
        lists
    }
}

/// The largest squared distance below zero, in standard deviations, of a base parameter that cannot be negative for
/// consistent bodies.
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
