//! Polynomial systems in files: reading and printing plain text and the formats of Singular and msolve.
//!
//! A [`PolynomialSystem`] is a [`Heading`] (field, variables, order) and a list of [`Given`] polynomials with their
//! locations in the file.
//!
//! ```
//! use groebot_algebra::poly::system::{Format, PolynomialSystem};
//!
//! let text = "ring r = 32003,(x,y),lp; ideal i = x2 + y2 - 1, x - y;";
//! let system = PolynomialSystem::read(text, None)?;
//! assert_eq!(system.print(Format::Msolve)?, "x, y\n32003\nx^2 + y^2 + 32002,\nx + 32002*y\n");
//! # Ok::<(), groebot_algebra::Error>(())
//! ```

mod detect;
mod expand;
mod msolve;
mod order;
mod plain;
mod print;
mod reader;
mod singular;
mod words;

use std::fmt;

use super::{Expression, Order};
use crate::limits;
use crate::number::Zp;
use crate::{Error, ErrorKind, Result};
use words::At;

pub use order::parse_order;

/// Maximum size of a system in bytes.
pub const MAX_SYSTEM_LENGTH: usize = limits::SYSTEM_BYTES;
/// Maximum number of tokens (numbers, names, signs) of one polynomial.
pub(crate) const MAX_WORDS: usize = limits::POLYNOMIAL_WORDS;
/// Maximum number of variables and parameters together.
pub(crate) const MAX_NAMES: usize = limits::SYSTEM_NAMES;

/// File format of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// groebot's own format: lines `variables: x, y`, `order: lex`, then one polynomial or equation per line.
    Plain,
    /// A ring and an ideal in Singular's syntax.
    Singular,
    /// msolve's format: a line of variables, the characteristic, then polynomials with commas between them.
    Msolve,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Format::Plain => "plain",
            Format::Singular => "singular",
            Format::Msolve => "msolve",
        })
    }
}

/// The ring of a system's polynomials: field, names, order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heading {
    /// 0 for the rationals, else the prime p of GF(p).
    pub characteristic: u64,
    /// The parameters: coefficients are rational functions of them. Without parameters, coefficients are numbers.
    pub parameters: Vec<String>,
    /// The variables, greatest first.
    pub variables: Vec<String>,
    /// The monomial order.
    pub order: Order,
}

impl Heading {
    /// Same heading, but with another order.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when its blocks do not cover the variables.
    pub fn with_order(self, order: Order) -> Result<Self> {
        let order = order::fit(order, self.variables.len())?;
        Ok(Heading { order, ..self })
    }

    /// Same heading, but modulo the prime `p`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `p` is not a prime that [`Zp`] takes, or when the characteristic is another prime
    /// already.
    pub fn modulo(self, p: u64) -> Result<Self> {
        Zp::new(p)?;
        if ![0, p].contains(&self.characteristic) {
            let text =
                format!("the coefficients are already modulo {}; give this modulus or none", self.characteristic);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Heading { characteristic: p, ..self })
    }
}

/// One polynomial as written in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Given {
    /// The expression that is equal to zero.
    pub expression: Expression,
    /// The line where it starts, counted from 1.
    pub line: usize,
    /// The column where it starts, in characters, counted from 1.
    pub column: usize,
}

/// A polynomial system as read from a file. All names in its polynomials are declared in the heading.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PolynomialSystem {
    /// Field, names, order.
    pub heading: Heading,
    /// The polynomials, at least one.
    pub polynomials: Vec<Given>,
}

impl PolynomialSystem {
    /// Detects the format of `text` from its content. It is [`Format::Singular`] when it starts with `ring` or one of
    /// Singular's comments. It is [`Format::Msolve`] when its first line is a list of names and the second a number
    /// alone. Else it is [`Format::Plain`].
    pub fn format_of(text: &str) -> Format {
        detect::format_of(text.strip_prefix('\u{feff}').unwrap_or(text))
    }

    /// Reads a system in the given format, or in the format that [`PolynomialSystem::format_of`] detects.
    ///
    /// # Errors
    /// With line and column: [`ErrorKind::Syntax`]; [`ErrorKind::UnknownName`], [`ErrorKind::DuplicateName`];
    /// [`ErrorKind::BadValue`] for a characteristic that is not a prime and for an order that does not cover the
    /// variables; [`ErrorKind::Unsupported`] for a statement of Singular beyond one ring and its polynomials. Without
    /// them: a text of more than [`MAX_SYSTEM_LENGTH`] bytes.
    pub fn read(text: &str, format: Option<Format>) -> Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.len() > MAX_SYSTEM_LENGTH {
            let message = format!("the text is {} bytes long, at most {MAX_SYSTEM_LENGTH} are read", text.len());
            return Err(Error::new(ErrorKind::BadValue, message));
        }
        match format.unwrap_or_else(|| Self::format_of(text)) {
            Format::Plain => plain::read(text),
            Format::Singular => singular::read(text),
            Format::Msolve => msolve::read(text),
        }
    }

    /// Same as [`PolynomialSystem::read`], but from the bytes of a file.
    ///
    /// # Errors
    /// Those of [`PolynomialSystem::read`]; [`ErrorKind::Syntax`] for text that is not UTF-8.
    pub fn read_bytes(bytes: &[u8], format: Option<Format>) -> Result<Self> {
        match std::str::from_utf8(bytes) {
            Ok(text) => Self::read(text, format),
            Err(error) => {
                let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
                let last = good.rsplit('\n').next().unwrap_or_default();
                let at = At { line: 1 + good.matches('\n').count(), column: 1 + last.chars().count() };
                Err(at.error(ErrorKind::Syntax, "the text is not UTF-8; save the file as UTF-8"))
            }
        }
    }
}

/// Fails unless `p` is 0 or a prime that [`Zp`] takes.
fn check_characteristic(p: u64, at: At) -> Result<()> {
    if p == 0 { Ok(()) } else { Zp::new(p).map(drop).map_err(|error| at.place(&error)) }
}

/// Builds the system from at least one polynomial.
fn assemble(heading: Heading, polynomials: Vec<Given>, end: At) -> Result<PolynomialSystem> {
    if polynomials.is_empty() {
        return Err(end.error(ErrorKind::Syntax, "there is no polynomial; give at least one"));
    }
    let system = PolynomialSystem { heading, polynomials };
    system.check_divisors()?;
    Ok(system)
}
