//! Comparison of stored measurements with repeated ones: words must be equal, numbers may differ by the rounding of another mathematical library.

use crate::tolerances::WITNESS;

/// Allowed ratio of two larger residuals.
const FACTOR: f64 = 1e3;

/// The first line, from 1, in which a table of checks differs. `None` if all lines agree.
pub fn table_differs(stored: &str, measured: &str) -> Option<usize> {
    differs(stored, measured, |a, b| {
        let (a, b): (Vec<&str>, Vec<&str>) = (a.split(',').collect(), b.split(',').collect());
        // The last columns are the residual, the distance and the verdict.
        same_cells(&a, &b, |column| column + 3 == b.len())
    })
}

/// The first line, from 1, in which the measured part of a page differs. `None` if all lines agree.
pub fn page_differs(stored: &str, measured: &str) -> Option<usize> {
    differs(stored, measured, |a, b| {
        if b.starts_with('|') {
            // The last columns are four residuals and two distances; the line ends in a bar.
            let (a, b): (Vec<&str>, Vec<&str>) = (a.split('|').collect(), b.split('|').collect());
            return same_cells(&a, &b, |column| column + 3 < b.len());
        }
        // A weak spot with its target, or a summary that ends with a residual.
        let words = |line| -> Vec<&str> {
            str::split(line, [' ', ',', '(', ')']).map(|word| word.trim_end_matches('.')).collect()
        };
        let (a, b) = (words(a), words(b));
        same_cells(&a, &b, |_| !b.starts_with(&["*"]))
    })
}

/// Whether two lists of cells agree. `is_residual` says which columns are residuals.
fn same_cells(a: &[&str], b: &[&str], is_residual: impl Fn(usize) -> bool) -> bool {
    let space = |cell: &str| [cell.len() - cell.trim_start().len(), cell.len() - cell.trim_end().len()];
    let same = |(column, (a, b)): (usize, (&&str, &&str))| {
        let same = if is_residual(column) { same_residual } else { same_place };
        a == b || space(a) == space(b) && same(a.trim(), b.trim())
    };
    a.len() == b.len() && a.iter().zip(b).enumerate().all(same)
}

/// A table of checks with `*` in place of each number that depends on rounding. The kinds of targets, the counts and the verdicts remain.
pub fn without_numbers(table: &str) -> String {
    let cell = |cell: &str| if numbers(cell, cell).is_some() { "*".to_owned() } else { cell.to_owned() };
    table.split('\n').map(|line| line.split(',').map(cell).collect::<Vec<_>>().join(",")).collect::<Vec<_>>().join("\n")
}

fn differs(stored: &str, measured: &str, same: impl Fn(&str, &str) -> bool) -> Option<usize> {
    let (stored, measured): (Vec<&str>, Vec<&str>) = (stored.split('\n').collect(), measured.split('\n').collect());
    let common = stored.iter().zip(&measured).take_while(|(a, b)| a == b || same(a, b)).count();
    (common < stored.len().max(measured.len())).then_some(common + 1)
}

/// Two numbers with exponents. Counts and words must be equal.
fn numbers(a: &str, b: &str) -> Option<[f64; 2]> {
    let number = |text: &str| text.parse::<f64>().ok().filter(|number| number.is_finite());
    let pair = [number(a)?, number(b)?];
    [a, b].iter().any(|text| text.contains('e')).then_some(pair)
}

fn same_place(a: &str, b: &str) -> bool {
    a == b || numbers(a, b).is_some_and(|[x, y]| (x - y).abs() <= WITNESS.near * (1.0 + y.abs()))
}

fn same_residual(a: &str, b: &str) -> bool {
    let same = |[x, y]: [f64; 2]| x.min(y) >= 0.0 && (x.max(y) <= WITNESS.member || x.max(y) <= FACTOR * x.min(y));
    a == b || numbers(a, b).is_some_and(same)
}
