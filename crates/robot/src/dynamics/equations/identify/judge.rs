//! Statistical tests of a log: whether it agrees with rigid bodies that move under the measured torques. Main type:
//! [`Finding`].

use std::fmt;

use super::Consistency;
use super::quantiles::chi_square_999;
use crate::document::shown;

/// Maximum fraction of the torques' standard deviation that may be unexplained. Wrong units, signs and delays leave
/// more; friction and noise of good logs leave less.
const UNEXPLAINED: f64 = 0.2;
/// Residuals below this fraction of a joint's torques are not tested, because rounding in files is not independent
/// noise.
const TINY: f64 = 1e-4;
/// Minimum number of rows for a test of the noise.
const FEWEST: usize = 30;
/// Number of lags of the test for independence, and the smallest correlation that is reported, however many rows show
/// it.
const LAGS: usize = 10;
const CORRELATED: f64 = 0.2;
/// An outlier exceeds this number of robust standard deviations and this fraction of the greatest torque.
const OUTLYING: f64 = 7.0;
const GROSS: f64 = 0.03;
/// Torques are clipped if at least this many rows, and this fraction of the rows, have the extreme value. Their mean
/// residual must also be this many standard deviations towards the inside.
const CLIPPED: (usize, f64, f64) = (5, 0.005, 4.0);
/// Correlation with the description's torques that indicates a wrong sign; and correlation and ratio that indicate a
/// wrong unit.
const OPPOSITE: f64 = -0.7;
const ALIKE: f64 = 0.9;
const UNIT: f64 = 50.0;

/// A problem of a log.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Finding {
    /// The kind of problem.
    pub kind: FindingKind,
    /// The joint, if the problem belongs to one.
    pub joint: Option<String>,
    /// The size: a fraction, a correlation, a number of rows, a factor, or a sum of squares.
    pub size: f64,
}

/// Kind of a problem of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FindingKind {
    /// A fraction of all torques is not explained by any parameters, physically consistent or not.
    Unexplained,
    /// The residuals of a joint are correlated from row to row.
    Correlated,
    /// The torques of a joint are clipped at an extreme value.
    Clipped,
    /// Some residuals are much larger than the others.
    Outliers,
    /// The torques of a joint have the opposite sign of those of the description.
    Sign,
    /// The torques of a joint are proportional to those of the description, but many times as large.
    Unit,
    /// No physically consistent bodies explain the torques.
    NoBodies,
}

impl FindingKind {
    /// Its name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            FindingKind::Unexplained => "unexplained",
            FindingKind::Correlated => "correlated",
            FindingKind::Clipped => "clipped",
            FindingKind::Outliers => "outliers",
            FindingKind::Sign => "sign",
            FindingKind::Unit => "unit",
            FindingKind::NoBodies => "no_bodies",
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(joint) = &self.joint {
            write!(f, "{}: ", shown(joint))?;
        }
        let size = self.size;
        match self.kind {
            FindingKind::Unexplained => {
                write!(
                    f,
                    "{:.0} % of the torques are unexplained; check that angles are in radians, torques in N m, and both are synchronous",
                    100.0 * size
                )
            }
            FindingKind::Correlated => {
                write!(
                    f,
                    "the torque residuals are correlated from row to row ({size:.2}), so that intervals are too narrow; check for friction (--friction), a delay, a filter"
                )
            }
            FindingKind::Clipped => write!(
                f,
                "{size:.0} rows have the extreme torque, although the bodies need a larger one; remove rows with a drive at its limit"
            ),
            FindingKind::Outliers => {
                write!(f, "{size:.0} rows have residuals above {OUTLYING} robust standard deviations; remove outliers")
            }
            FindingKind::Sign => write!(
                f,
                "torques are opposite to those of the description (correlation {size:.2}); change the sign of its torques or of its angles"
            ),
            FindingKind::Unit => write!(
                f,
                "torques are {size:.3e} times those of the description; check that they are in N m, or N for a prismatic joint"
            ),
            FindingKind::NoBodies => {
                write!(
                    f,
                    "no physically consistent bodies have the identified parameters: all are at least {size:.1} standard deviations away"
                )
            }
        }
    }
}

/// Problems of the measured torques, joint by joint. Inputs are the measured torques, the residuals and the
/// description's torques. `freedom` is the number of torques minus the number of unknowns.
pub(super) fn findings(
    joints: &[String],
    torques: &[Vec<f64>],
    misses: &[Vec<f64>],
    described: &[Vec<f64>],
    freedom: usize,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    let whole = |lists: &[Vec<f64>], of: fn(&[f64]) -> f64| lists.iter().map(|list| of(list)).sum::<f64>();
    let share = (whole(misses, squares) / whole(torques, variation)).sqrt();
    if freedom > 0 && share > UNEXPLAINED {
        findings.push(Finding { kind: FindingKind::Unexplained, joint: None, size: share });
    }
    for (at, joint) in joints.iter().enumerate() {
        let (torques, misses, described) = (&torques[at], &misses[at], &described[at]);
        let mut find = |kind: FindingKind, size: Option<f64>| {
            findings.extend(size.map(|size| Finding { kind, joint: Some(joint.clone()), size }));
        };
        find(FindingKind::Sign, opposite(torques, described));
        find(FindingKind::Unit, other_unit(torques, described));
        // Few rows, and rows without residuals, contain no information about noise.
        if torques.len() >= FEWEST && freedom >= FEWEST && unexplained(torques, misses) > TINY {
            find(FindingKind::Clipped, clipped(torques, misses));
            find(FindingKind::Outliers, outliers(torques, misses));
            find(FindingKind::Correlated, correlated(misses));
        }
    }
    findings
}

/// The problem that no physically consistent bodies have the identified parameters.
pub(super) fn of_bodies(consistency: &Consistency, freedom: usize) -> Option<Finding> {
    let is_off = freedom > 0 && consistency.is_refuted();
    is_off.then(|| Finding { kind: FindingKind::NoBodies, joint: None, size: consistency.least.sqrt() })
}

fn squares(list: &[f64]) -> f64 {
    list.iter().map(|x| x * x).sum()
}

fn mean(list: &[f64]) -> f64 {
    list.iter().sum::<f64>() / list.len().max(1) as f64
}

/// The sum of squared deviations from the mean.
fn variation(list: &[f64]) -> f64 {
    let mean = mean(list);
    list.iter().map(|x| (x - mean).powi(2)).sum()
}

pub(super) fn root_mean_square(list: &[f64]) -> f64 {
    (squares(list) / list.len().max(1) as f64).sqrt()
}

/// The residual as a fraction of the torques' standard deviation; zero for constant torques without residual.
pub(super) fn unexplained(torques: &[f64], misses: &[f64]) -> f64 {
    let missed = squares(misses);
    if missed == 0.0 { 0.0 } else { (missed / variation(torques)).sqrt() }
}

/// The correlation of two lists, and the ratio of the first to the second.
fn compared(list: &[f64], with: &[f64]) -> Option<[f64; 2]> {
    let [a, b] = [mean(list), mean(with)];
    let product: f64 = list.iter().zip(with).map(|(x, y)| (x - a) * (y - b)).sum();
    let (own, other) = (variation(list), variation(with));
    let correlation = product / (own * other).sqrt();
    correlation.is_finite().then(|| [correlation, product / other])
}

fn opposite(torques: &[f64], described: &[f64]) -> Option<f64> {
    compared(torques, described).map(|[correlation, _]| correlation).filter(|correlation| *correlation < OPPOSITE)
}

fn other_unit(torques: &[f64], described: &[f64]) -> Option<f64> {
    let [correlation, ratio] = compared(torques, described)?;
    let is_alike = correlation > ALIKE && torques.len() > 2;
    (is_alike && !(1.0 / UNIT..UNIT).contains(&ratio)).then_some(ratio)
}

/// The number of rows with an extreme torque where the bodies need a larger one.
fn clipped(torques: &[f64], misses: &[f64]) -> Option<f64> {
    let (fewest, share, deviations) = CLIPPED;
    let deviation = root_mean_square(misses);
    let extremes = [(f64::max as fn(f64, f64) -> f64, -1.0), (f64::min as fn(f64, f64) -> f64, 1.0)];
    let count = |(farther, inside): (fn(f64, f64) -> f64, f64)| {
        let extreme = torques.iter().copied().reduce(farther)?;
        let there: Vec<f64> =
            torques.iter().zip(misses).filter(|(x, _)| **x == extreme).map(|(_, miss)| *miss).collect();
        let is_often = there.len() >= fewest && there.len() as f64 >= share * torques.len() as f64;
        let is_inside = inside * mean(&there) > deviations * deviation / (there.len() as f64).sqrt();
        (is_often && is_inside && there.len() < torques.len()).then_some(there.len() as f64)
    };
    extremes.into_iter().filter_map(count).reduce(|a, b| a + b)
}

/// The number of rows whose residuals are much larger than the median.
fn outliers(torques: &[f64], misses: &[f64]) -> Option<f64> {
    let mut sizes: Vec<f64> = misses.iter().map(|miss| miss.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    // For a normal distribution, the standard deviation is 1.4826 times the median of the absolute values.
    let deviation = 1.4826 * sizes[sizes.len() / 2];
    let greatest = torques.iter().fold(0.0, |most: f64, torque| most.max(torque.abs()));
    let least = (OUTLYING * deviation).max(GROSS * greatest);
    let count = sizes.iter().filter(|size| **size > least).count();
    (count > 0 && deviation > 0.0).then_some(count as f64)
}

/// The greatest autocorrelation of the residuals, if they are not independent (G. M. Ljung and G. E. P. Box, Biometrika
/// 65, 1978).
fn correlated(misses: &[f64]) -> Option<f64> {
    let (count, middle, all) = (misses.len(), mean(misses), variation(misses));
    let correlation = |lag: usize| {
        let pairs = misses.iter().zip(&misses[lag..]);
        pairs.map(|(a, b)| (a - middle) * (b - middle)).sum::<f64>() / all
    };
    let lags: Vec<f64> = (1..=LAGS).map(correlation).collect();
    let weigh = |(lag, value): (usize, &f64)| value * value / (count - lag) as f64;
    let statistic = count as f64 * (count + 2) as f64 * (1..).zip(&lags).map(weigh).sum::<f64>();
    let greatest = lags.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    (statistic > 1.5 * chi_square_999(LAGS) && greatest.abs() > CORRELATED).then_some(greatest)
}
