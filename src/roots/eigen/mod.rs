//! Eigenvalues of small real matrices with no allocation and no library: [`Hessenberg`] form, shifted QR steps, inverse iteration.
//!
//! Sources: G. H. Golub and C. F. Van Loan, Matrix Computations, 4th edition (2013), sections 5.1, 7.4, 7.5 and 7.6.1;
//! J. G. F. Francis, The QR transformation, Computer Journal 4 (1961/62) 265-271 and 332-345.

mod hessenberg;
mod inverse_iteration;
mod shifted_qr;

pub use hessenberg::Hessenberg;

/// An eigenvalue of a real matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Eigenvalue {
    /// Its real part.
    pub re: f64,
    /// Its imaginary part; exactly zero when it is real.
    pub im: f64,
}
