//! Quantiles of Student's t and the chi-square distribution, against tables such as those of the NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.

#[path = "../../src/dynamics/equations/identify/quantiles.rs"]
mod source;

use source::{chi_square_999, student_95, widening};

#[test]
fn quantiles_are_those_of_tables() {
    let table = [
        (1, 12.706),
        (2, 4.303),
        (3, 3.182),
        (4, 2.776),
        (5, 2.571),
        (10, 2.228),
        (30, 2.042),
        (100, 1.984),
        (1000, 1.962),
        (100_000, 1.960),
    ];
    for (freedom, expected) in table {
        assert!((student_95(freedom) - expected).abs() < 6e-4, "{freedom}: {}", student_95(freedom));
        assert!((widening(freedom) - expected / 1.96).abs() < 6e-4, "{freedom}: {}", widening(freedom));
    }
    for (freedom, expected) in [(3, 16.266), (10, 29.588), (30, 59.703), (100, 149.449)] {
        assert!((chi_square_999(freedom) / expected - 1.0).abs() < 2e-2, "{freedom}: {}", chi_square_999(freedom));
    }
}

/// From 1000 degrees of freedom on, the asymptotic expansion is used.
#[test]
fn quantiles_are_continuous() {
    assert!((student_95(1000) - student_95(1001)).abs() < 1e-5);
}
