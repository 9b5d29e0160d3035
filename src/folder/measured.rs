//! What was measured, compared with what is measured again: words to the letter, numbers up to the rounding of another mathematical library.

/// Coordinates are the same up to this share of their size, or of one.
const NEAR: f64 = 1e-6;
/// Residuals up to this are rounding.
const ROUNDING: f64 = 1e-12;
/// Greater residuals are the same up to this factor.
const FACTOR: f64 = 1e3;

/// The first line, from 1, in which a table of checks differs; none where it says the same.
pub fn table_differs(stored: &str, measured: &str) -> Option<usize> {
    differs(stored, measured, |a, b| {
        let (a, b): (Vec<&str>, Vec<&str>) = (a.split(',').collect(), b.split(',').collect());
        // The last columns are the residual, the distance and the verdict.
        let is_size = |column: usize| (2..4).contains(&(b.len() - column));
        a.len() == b.len()
            && a.iter().zip(&b).enumerate().all(|(column, (a, b))| match is_size(column) {
                true => same_size(a, b),
                false => same_place(a, b),
            })
    })
}

/// The first line, from 1, in which the measured part of a page differs; none where it says the same.
pub fn page_differs(stored: &str, measured: &str) -> Option<usize> {
    let words = |line: &str| -> Vec<String> {
        let parts = line.split([' ', '|', ',', '(', ')', ':', ';']);
        parts.map(|word| word.trim_end_matches('.').to_owned()).collect()
    };
    differs(stored, measured, |a, b| {
        // Weak spots tell their targets; all other numbers are residuals and distances.
        let same = if b.starts_with('*') { same_place } else { same_size };
        let (a, b) = (words(a), words(b));
        a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| same(a, b))
    })
}

fn differs(stored: &str, measured: &str, same: impl Fn(&str, &str) -> bool) -> Option<usize> {
    let (stored, measured): (Vec<&str>, Vec<&str>) = (stored.split('\n').collect(), measured.split('\n').collect());
    let common = stored.iter().zip(&measured).take_while(|(a, b)| a == b || same(a, b)).count();
    (common < stored.len().max(measured.len())).then_some(common + 1)
}

/// Two numbers with exponents; counts and words have to be equal.
fn numbers(a: &str, b: &str) -> Option<[f64; 2]> {
    let number = |text: &str| text.parse::<f64>().ok().filter(|number| number.is_finite());
    let pair = [number(a)?, number(b)?];
    [a, b].iter().any(|text| text.contains('e')).then_some(pair)
}

fn same_place(a: &str, b: &str) -> bool {
    a == b || numbers(a, b).is_some_and(|[x, y]| (x - y).abs() <= NEAR * (1.0 + y.abs()))
}

fn same_size(a: &str, b: &str) -> bool {
    let same = |[x, y]: [f64; 2]| x.min(y) >= 0.0 && (x.max(y) <= ROUNDING || x.max(y) <= FACTOR * x.min(y));
    a == b || numbers(a, b).is_some_and(same)
}
