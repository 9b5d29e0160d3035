//! Expansion of expressions to polynomials of a ring.

use super::words::At;
use super::{Given, Heading, PolynomialSystem};
use crate::limits;
use crate::number::Field;
use crate::poly::{Expression, Polynomial, PolynomialRing};
use crate::{ErrorKind, Result, Watch};

/// Maximum number of terms of one expanded polynomial.
pub const MAX_TERMS: f64 = limits::EXPANSION_TERMS;
/// Maximum number of bits of a coefficient in an expanded summand.
pub const MAX_BITS: f64 = limits::EXPANSION_BITS;
/// Maximum total degree of an expanded summand.
pub const MAX_DEGREE: u64 = limits::EXPANSION_DEGREE;
/// Maximum degree of a summand in the parameters: numerator and denominator together.
pub const MAX_PARAMETER_DEGREE: u64 = limits::EXPANSION_PARAMETER_DEGREE;
/// Maximum sum of the degrees of all denominators of one polynomial.
pub const MAX_DENOMINATOR_DEGREE: u64 = limits::EXPANSION_DENOMINATOR_DEGREE;

impl Heading {
    /// Builds the ring of these variables over `field`. The parameters are generators of the field.
    ///
    /// # Errors
    /// Those of [`PolynomialRing::new`].
    pub fn ring<F: Field>(&self, field: F) -> Result<PolynomialRing<F>> {
        PolynomialRing::new(field, &self.variables, self.order.clone())
    }
}

impl PolynomialSystem {
    /// Expands the polynomials in `ring`: a ring over [`Rationals`](crate::number::Rationals) or
    /// [`Zp`](crate::number::Zp), or over the [`Fractions`](crate::poly::Fractions) of the parameters, with the
    /// system's variables in any order.
    ///
    /// # Errors
    /// With line and column: [`ErrorKind::BadValue`] for a division by zero (modulo p) and for an expansion beyond the
    /// limits of size; [`ErrorKind::UnknownName`] for a name that `ring` lacks. The error with which `watch` stops the
    /// work; it is checked before each polynomial.
    pub fn expand<F: Field>(&self, ring: &PolynomialRing<F>, watch: &Watch) -> Result<Vec<Polynomial<F::Element>>> {
        let expand = |given: &Given| {
            watch.check()?;
            self.check_size(given)?;
            given.expression.evaluate(ring).map_err(|error| given.at().place(&error))
        };
        self.polynomials.iter().map(expand).collect()
    }

    /// Checks that no polynomial divides by a variable.
    pub(super) fn check_divisors(&self) -> Result<()> {
        let variables: std::collections::HashSet<&str> = self.heading.variables.iter().map(String::as_str).collect();
        for given in &self.polynomials {
            let mut divides = false;
            given.expression.visit(&mut |part| {
                if let Expression::Inverse(divisor) = part {
                    divides |= divisor.names().iter().any(|name| variables.contains(name));
                }
            });
            if divides {
                let text = "the polynomial that starts here divides by a variable; multiply it out";
                return Err(given.at().error(ErrorKind::BadValue, text));
            }
        }
        Ok(())
    }

    fn check_size(&self, given: &Given) -> Result<()> {
        let summands = match &given.expression {
            Expression::Sum(terms) => terms.as_slice(),
            single => std::slice::from_ref(single),
        };
        let is_parameter = |name: &str| self.heading.parameters.iter().any(|parameter| parameter == name);
        let (mut terms, mut denominators) = (0.0, 0u64);
        for summand in summands {
            let bound = summand.expansion_bound();
            let degree = degrees(summand, &is_parameter);
            terms += bound.terms;
            denominators = denominators.saturating_add(degree.bottom);
            let small = bound.bits <= MAX_BITS
                && summand.degree_bound() <= MAX_DEGREE
                && degree.top.saturating_add(degree.bottom) <= MAX_PARAMETER_DEGREE;
            if !small || terms > MAX_TERMS || denominators > MAX_DENOMINATOR_DEGREE {
                return Err(given.at().error(ErrorKind::BadValue, too_large()));
            }
        }
        Ok(())
    }
}

impl Given {
    fn at(&self) -> At {
        At { line: self.line, column: self.column }
    }
}

fn too_large() -> String {
    format!(
        "the expansion of the polynomial that starts here may take more than {MAX_TERMS:.0} terms, {MAX_BITS:.0} bits in a coefficient, \
         degree {MAX_DEGREE}, or degree {MAX_PARAMETER_DEGREE} in the parameters; write it shorter"
    )
}

/// Bounds on the degrees in the parameters.
#[derive(Clone, Copy, Default)]
struct Degrees {
    top: u64,
    bottom: u64,
}

impl Degrees {
    fn product(self, other: Degrees) -> Degrees {
        Degrees { top: self.top.saturating_add(other.top), bottom: self.bottom.saturating_add(other.bottom) }
    }
}

fn degrees(expression: &Expression, is_parameter: &dyn Fn(&str) -> bool) -> Degrees {
    let parts = expression.children().iter().map(|part| degrees(part, is_parameter));
    match expression {
        Expression::Number(_) => Degrees::default(),
        Expression::Name(name) => Degrees { top: u64::from(is_parameter(name)), bottom: 0 },
        Expression::Negation(_) | Expression::Product(_) => parts.fold(Degrees::default(), Degrees::product),
        Expression::Inverse(a) => {
            let Degrees { top, bottom } = degrees(a, is_parameter);
            Degrees { top: bottom, bottom: top }
        }
        Expression::Sum(_) => {
            let parts: Vec<Degrees> = parts.collect();
            let bottom = parts.iter().fold(0u64, |sum, part| sum.saturating_add(part.bottom));
            let lifted = parts.iter().map(|part| part.top.saturating_add(bottom - part.bottom.min(bottom)));
            Degrees { top: lifted.max().unwrap_or(0), bottom }
        }
        Expression::Power(a, n) => {
            let Degrees { top, bottom } = degrees(a, is_parameter);
            let n = u64::from(*n);
            Degrees { top: top.saturating_mul(n), bottom: bottom.saturating_mul(n) }
        }
    }
}
