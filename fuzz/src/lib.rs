//! What the targets check beyond "it does not panic".

use groebot::poly::Expression;
use groebot::poly::system::{Format, PolynomialSystem};

/// Expansions of more terms are not waited for.
const TERMS: f64 = 200.0;
/// Nor are those of more bits in a coefficient.
const BITS: f64 = 10_000.0;

/// A refused text says where; what is read and small prints as a system that prints the same again.
///
/// # Panics
/// When it does not.
pub fn system(bytes: &[u8], format: Format) {
    let system = match PolynomialSystem::read_bytes(bytes, Some(format)) {
        Ok(system) => system,
        Err(error) => {
            assert!(error.place().line.is_some() && error.message().starts_with("column "), "{error}");
            return;
        }
    };
    let small = |expression: &Expression| {
        let bound = expression.expansion_bound();
        bound.terms <= TERMS && bound.bits <= BITS
    };
    if !system.polynomials.iter().all(|given| small(&given.expression)) {
        return;
    }
    let Ok(text) = system.print(format) else { return };
    if let Ok(again) = PolynomialSystem::read(&text, Some(format)) {
        assert_eq!(again.print(format).as_ref(), Ok(&text));
    }
}

/// What is read prints as text that reads as the same tree.
///
/// # Panics
/// When it does not.
pub fn expression(read: groebot::Result<Expression>) {
    if let Ok(tree) = read {
        assert_eq!(groebot::poly::parse(&tree.to_string()), Ok(tree));
    }
}
