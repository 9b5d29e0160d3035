//! The accuracy of solutions by distance of their target from singular ones: [`Accuracy`], a table for readers.

use std::fmt;

use super::report::{Kind, Report, Row, Verdict};

/// The targets at one distance from singular ones.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Class {
    /// The distance as text, such as `ordinary` or `1e-6 of singular`.
    pub name: String,
    /// The number of targets.
    pub rows: usize,
    /// The number of targets that failed.
    pub failed: usize,
    /// The number of solutions.
    pub answers: usize,
    /// The largest residual of each target's solutions, ascending.
    pub residuals: Vec<f64>,
    /// The distance between the joints that made each target and the nearest solution, ascending.
    pub distances: Vec<f64>,
}

/// The classes of a report that have rows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Accuracy {
    /// The classes from ordinary to singular, then the others.
    pub classes: Vec<Class>,
}

impl Report {
    /// Residuals and distances by class of target.
    pub fn accuracy(&self) -> Accuracy {
        let names =
            ["ordinary", "1e-3 of singular", "1e-6 of singular", "1e-9 of singular", "singular", "arcs", "other"];
        let class = |name: &&str| Class::of(name, self.rows.iter().filter(|row| class_of(&row.kind) == *name));
        Accuracy { classes: names.iter().map(class).filter(|class| class.rows > 0).collect() }
    }
}

fn class_of(kind: &Kind) -> &'static str {
    match kind {
        Kind::Random | Kind::Rational => "ordinary",
        Kind::Near(3) => "1e-3 of singular",
        Kind::Near(6) => "1e-6 of singular",
        Kind::Near(9) => "1e-9 of singular",
        Kind::Singular => "singular",
        Kind::Arcs => "arcs",
        _ => "other",
    }
}

impl Class {
    fn of<'a>(name: &str, rows: impl Iterator<Item = &'a Row>) -> Self {
        let rows: Vec<&Row> = rows.collect();
        let sorted = |value: fn(&Row) -> Option<f64>| {
            let mut values: Vec<f64> = rows.iter().filter_map(|row| value(row)).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        Class {
            name: name.to_owned(),
            rows: rows.len(),
            failed: rows.iter().filter(|row| matches!(row.verdict, Verdict::Fail(_))).count(),
            answers: rows.iter().map(|row| row.solutions).sum(),
            residuals: sorted(|row| row.worst_residual),
            distances: sorted(|row| row.nearest),
        }
    }

    /// The quantile `share` of the residuals; `None` without solutions.
    pub fn residual(&self, share: f64) -> Option<f64> {
        quantile(&self.residuals, share)
    }

    /// The quantile `share` of the distances; `None` if no joints are known.
    pub fn distance(&self, share: f64) -> Option<f64> {
        quantile(&self.distances, share)
    }
}

/// The least of the ascending values such that at least the fraction `share` of all values does not exceed it.
fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let rank = (share * values.len() as f64).ceil() as usize;
    values.get(rank.clamp(1, values.len().max(1)) - 1).copied()
}

/// A Markdown table. Residuals are fractions of the reach or rad, distances are in rad or fractions of the reach; each with two digits.
impl fmt::Display for Accuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| targets | number | failed | answers | residual p50 | p99 | p99.9 | worst | joints p50 | worst |"
        )?;
        writeln!(f, "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")?;
        for class in &self.classes {
            let residuals = [0.5, 0.99, 0.999, 1.0].map(|share| shown(class.residual(share)));
            let distances = [0.5, 1.0].map(|share| shown(class.distance(share)));
            let Class { name, rows, failed, answers, .. } = class;
            let (residuals, distances) = (residuals.join(" | "), distances.join(" | "));
            writeln!(f, "| {name} | {rows} | {failed} | {answers} | {residuals} | {distances} |")?;
        }
        Ok(())
    }
}

fn shown(value: Option<f64>) -> String {
    value.map(|value| if value == 0.0 { "0".to_owned() } else { format!("{value:.0e}") }).unwrap_or_default()
}
