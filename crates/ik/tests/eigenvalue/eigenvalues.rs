//! Hessenberg form and eigenvalues, compared with nalgebra's real Schur form and with known spectra.

use groebot_runtime::six_axes::{Eigenvalue, Hessenberg, Matrix, SIZE};
use nalgebra::{DMatrix, Schur};

use super::Random;

fn spectrum(rows: Matrix) -> Vec<(f64, f64)> {
    Hessenberg::reduce(rows).eigenvalues().unwrap().map(|v: Eigenvalue| (v.re, v.im)).to_vec()
}

/// The largest distance between a value and the nearest one of the other list, in both directions.
fn gap(a: &[(f64, f64)], b: &[(f64, f64)]) -> f64 {
    let one = |a: &[(f64, f64)], b: &[(f64, f64)]| {
        let nearest = |x: &(f64, f64)| b.iter().map(|y| (x.0 - y.0).hypot(x.1 - y.1)).fold(f64::INFINITY, f64::min);
        a.iter().map(nearest).fold(0.0, f64::max)
    };
    one(a, b).max(one(b, a))
}

fn random_matrix(random: &mut Random) -> Matrix {
    std::array::from_fn(|_| std::array::from_fn(|_| random.number()))
}

/// The companion matrix of the monic polynomial with these coefficients, constant term first, padded with zeros.
fn companion<const N: usize>(coefficients: [f64; N]) -> Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i, j) {
            (i, j) if i < N && j + 1 == N => -coefficients[i],
            (i, j) if i < N && i == j + 1 => 1.0,
            _ => 0.0,
        })
    })
}

fn product(rows: &Matrix, v: &[f64; SIZE]) -> [f64; SIZE] {
    rows.each_ref().map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
}

#[test]
fn eigenvalues_agree_with_a_trusted_library() {
    let mut random = Random::new(1);
    for _ in 0..500 {
        let rows = random_matrix(&mut random);
        let matrix = DMatrix::from_fn(16, 16, |i, j| rows[i][j]);
        let schur = Schur::try_new(matrix, 1e-15, 10_000).expect("a Schur form");
        let known: Vec<_> = schur.complex_eigenvalues().iter().map(|v| (v.re, v.im)).collect();
        assert!(gap(&spectrum(rows), &known) < 1e-11);
    }
}

/// `Q y`, by the reflectors.
fn turned_back(form: &Hessenberg, y: [f64; SIZE]) -> [f64; SIZE] {
    form.reflectors.iter().rev().fold(y, |y, v| {
        let share: f64 = v.iter().zip(&y).map(|(a, b)| a * b).sum();
        std::array::from_fn(|k| y[k] - share * v[k])
    })
}

#[test]
fn hessenberg_form_is_similar() {
    let mut random = Random::new(2);
    let rows = random_matrix(&mut random);
    let form = Hessenberg::reduce(rows);
    for k in 0..SIZE {
        let unit = std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
        // A Q e = Q H e.
        let left = product(&rows, &turned_back(&form, unit));
        let right = turned_back(&form, form.matrix.map(|row| row[k]));
        assert!(left.iter().zip(&right).all(|(a, b)| (a - b).abs() < 1e-13));
        assert!((k + 2..SIZE).all(|row| form.matrix[row][k] == 0.0));
    }
}

#[test]
fn even_polynomials_and_multiple_roots_end() {
    // The zero padding of a companion matrix adds zero eigenvalues.
    let beside = |mut roots: Vec<(f64, f64)>| {
        roots.push((0.0, 0.0));
        roots
    };
    let unit = |angle: f64| (angle.cos(), angle.sin());
    let sixth: Vec<_> = (0..6).map(|k| unit(std::f64::consts::TAU * f64::from(k) / 6.0)).collect();
    assert!(gap(&spectrum(companion([-1.0, 0.0, 0.0, 0.0, 0.0, 0.0])), &beside(sixth)) < 1e-13);
    let eighth: Vec<_> = (0..8).map(|k| unit(std::f64::consts::PI * f64::from(2 * k + 1) / 8.0)).collect();
    assert!(gap(&spectrum(companion([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])), &beside(eighth)) < 1e-13);
    // (x^2 - 1)^2 (x^2 - 4)^2
    let double = spectrum(companion([16.0, 0.0, -40.0, 0.0, 33.0, 0.0, -10.0, 0.0]));
    let roots = vec![(-2.0, 0.0), (-1.0, 0.0), (1.0, 0.0), (2.0, 0.0)];
    assert!(gap(&double, &beside(roots)) < 1e-6);
    let nilpotent = companion([0.0; 16]);
    assert!(gap(&spectrum(nilpotent), &[(0.0, 0.0)]) < 1e-15);
}

#[test]
fn eigenvectors_have_small_residuals() {
    let mut random = Random::new(3);
    let mut seen = 0;
    for _ in 0..200 {
        let rows = random_matrix(&mut random);
        let form = Hessenberg::reduce(rows);
        let values = form.eigenvalues().unwrap();
        let real: Vec<f64> = values.iter().filter(|value| value.im == 0.0).map(|value| value.re).collect();
        for (value, v) in real.iter().zip(form.eigenvectors(&real)) {
            let length = v.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
            let is_one = product(&rows, &v).iter().zip(&v).all(|(a, b)| (a - value * b).abs() < 1e-12 * length);
            assert!(is_one, "{value}");
            seen += 1;
        }
    }
    assert!(seen > 200);
}

#[test]
fn what_is_not_finite_has_no_eigenvalues() {
    let mut rows = [[1.0; SIZE]; SIZE];
    rows[2][3] = f64::NAN;
    assert!(Hessenberg::reduce(rows).eigenvalues().is_none());
}
