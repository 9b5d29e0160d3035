//! Dense linear equations of fixed size by Gauss elimination with partial pivoting (Golub and Van Loan, Algorithm 3.4.1).

/// Solves `L X = R` in place: `R` becomes `X`, `L` is used up. The smallest pivot as a share of the largest entry of `L`; zero when `L`
/// is singular or not finite, and `R` means nothing then.
pub(super) fn solve<const N: usize, const M: usize>(left: &mut [[f64; N]; N], right: &mut [[f64; M]; N]) -> f64 {
    let largest = left.iter().flatten().fold(0.0_f64, |most, entry| most.max(entry.abs()));
    let mut least = largest;
    for k in 0..N {
        let mut best = k;
        for row in k + 1..N {
            best = if left[row][k].abs() > left[best][k].abs() { row } else { best };
        }
        let size = left[best][k].abs();
        if size <= 0.0 || !size.is_finite() {
            return 0.0;
        }
        least = least.min(size);
        left.swap(k, best);
        right.swap(k, best);
        let inverse = 1.0 / left[k][k];
        let (pivot, target) = (left[k], right[k]);
        for row in k + 1..N {
            let factor = left[row][k] * inverse;
            (k + 1..N).for_each(|column| left[row][column] -= factor * pivot[column]);
            right[row].iter_mut().zip(&target).for_each(|(entry, over)| *entry -= factor * over);
        }
    }
    for k in (0..N).rev() {
        let inverse = 1.0 / left[k][k];
        right[k].iter_mut().for_each(|entry| *entry *= inverse);
        let target = right[k];
        for row in 0..k {
            let factor = left[row][k];
            right[row].iter_mut().zip(&target).for_each(|(entry, over)| *entry -= factor * over);
        }
    }
    least / largest
}
