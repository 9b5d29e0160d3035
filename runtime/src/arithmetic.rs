//! Functions that `core` lacks: square root and rounding. With the feature `std` they are those of `std`; without it the square root is the C library's.

/// Functions of a number.
pub(crate) trait Arithmetic {
    /// The square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// The nearest integer, halves away from zero.
    fn round(self) -> Self;
    /// The greatest integer that is not greater than the number.
    fn floor(self) -> Self;
    /// The least integer that is not less than the number.
    fn ceil(self) -> Self;
}

#[cfg(feature = "std")]
impl Arithmetic for f64 {
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn round(self) -> f64 {
        to_nearest(self)
    }

    #[inline(always)]
    fn floor(self) -> f64 {
        f64::floor(self)
    }

    #[inline(always)]
    fn ceil(self) -> f64 {
        f64::ceil(self)
    }
}

#[cfg(not(feature = "std"))]
#[allow(unsafe_code)]
mod library {
    unsafe extern "C" {
        pub safe fn sqrt(x: f64) -> f64;
    }
}

#[cfg(not(feature = "std"))]
impl Arithmetic for f64 {
    #[inline(always)]
    fn sqrt(self) -> f64 {
        library::sqrt(self)
    }

    fn round(self) -> f64 {
        to_nearest(self)
    }

    fn floor(self) -> f64 {
        let whole = whole(self);
        if whole > self { whole - 1.0 } else { whole }
    }

    fn ceil(self) -> f64 {
        -Arithmetic::floor(-self)
    }
}

/// The nearest integer, halves away from zero. That of `std` calls the C library on targets without SSE4.1.
#[inline(always)]
fn to_nearest(x: f64) -> f64 {
    // Just below one half, because adding one half to it must not round up to one.
    whole(x + 0.499_999_999_999_999_94_f64.copysign(x))
}

/// The integer part of the number.
#[inline(always)]
fn whole(x: f64) -> f64 {
    const ALL_WHOLE: f64 = (1_u64 << 52) as f64;
    if x.abs() < ALL_WHOLE { ((x as i64) as f64).copysign(x) } else { x }
}
