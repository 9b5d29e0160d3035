//! [`Expression`]: an exact algebraic expression as a tree, and its text.

use std::collections::HashSet;
use std::fmt::{self, Display, Formatter};

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, Pow, Signed};
use serde::{Deserialize, Serialize, Serializer};

/// An exact algebraic expression, as written: neither expanded nor simplified.
///
/// `a - b` is `Sum[a, Negation(b)]` and `a / b` is `Product[a, Inverse(b)]`, so that long sums and products stay flat.
/// Its [`Display`] is plain text that [`parse`] reads back. A tree from [`parse`] is read back as the same tree, others
/// as an equal expression. The text must be within [`MAX_LENGTH`](super::MAX_LENGTH), [`MAX_DEPTH`](super::MAX_DEPTH)
/// and [`EXPRESSION_EXPONENT`](crate::limits::EXPRESSION_EXPONENT). Serde writes and reads this text. All functions recurse to the height of
/// the tree, so a tree built by hand should not be higher than `MAX_DEPTH`.
///
/// [`parse`]: super::parse()
#[derive(Clone, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(try_from = "String")]
pub enum Expression {
    /// An exact number.
    Number(BigRational),
    /// An identifier `[A-Za-z_][A-Za-z0-9_]*`: an unknown, a parameter, a constant.
    Name(String),
    /// `-a`.
    Negation(Box<Expression>),
    /// `1/a`.
    Inverse(Box<Expression>),
    /// `a + b + ...`; zero when empty.
    Sum(Vec<Expression>),
    /// `a * b * ...`, from left to right; one when empty.
    Product(Vec<Expression>),
    /// `a^n`; `a^0` is one.
    Power(Box<Expression>, u32),
}

impl Expression {
    /// The integer `n`.
    pub fn integer(n: i64) -> Self {
        Expression::Number(BigRational::from_integer(BigInt::from(n)))
    }

    /// The identifier `name`. The caller ensures that it is valid ([`is_identifier`](super::is_identifier)).
    pub fn name(name: impl Into<String>) -> Self {
        Expression::Name(name.into())
    }

    /// `-self`.
    #[must_use]
    pub fn negated(self) -> Self {
        Expression::Negation(Box::new(self))
    }

    /// `self^n`.
    #[must_use]
    pub fn power(self, n: u32) -> Self {
        Expression::Power(Box::new(self), n)
    }

    /// The sum of `terms`. A single term is returned unchanged.
    pub fn sum(terms: Vec<Expression>) -> Self {
        single(terms).unwrap_or_else(Expression::Sum)
    }

    /// The product of `factors`. A single factor is returned unchanged.
    pub fn product(factors: Vec<Expression>) -> Self {
        single(factors).unwrap_or_else(Expression::Product)
    }

    /// The operands of this expression, from left to right.
    pub(crate) fn children(&self) -> &[Expression] {
        match self {
            Expression::Number(_) | Expression::Name(_) => &[],
            Expression::Negation(a) | Expression::Inverse(a) | Expression::Power(a, _) => std::slice::from_ref(a),
            Expression::Sum(parts) | Expression::Product(parts) => parts,
        }
    }

    /// The identifiers, each once, in the order of first appearance.
    pub fn names(&self) -> Vec<&str> {
        let (mut seen, mut names) = (HashSet::new(), Vec::new());
        self.visit(&mut |node| {
            if let Expression::Name(name) = node
                && seen.insert(name.as_str())
            {
                names.push(name.as_str());
            }
        });
        names
    }

    /// Calls `see` with this expression, then with all its subexpressions, from left to right.
    pub fn visit<'a>(&'a self, see: &mut dyn FnMut(&'a Expression)) {
        see(self);
        for child in self.children() {
            child.visit(see);
        }
    }

    /// Replaces each name for which `replacement` has an expression.
    #[must_use]
    pub fn substitute(&self, replacement: &dyn Fn(&str) -> Option<Expression>) -> Self {
        let each = |parts: &[Expression]| parts.iter().map(|part| part.substitute(replacement)).collect();
        match self {
            Expression::Number(_) => self.clone(),
            Expression::Name(name) => replacement(name).unwrap_or_else(|| self.clone()),
            Expression::Negation(a) => a.substitute(replacement).negated(),
            Expression::Inverse(a) => Expression::Inverse(Box::new(a.substitute(replacement))),
            Expression::Sum(parts) => Expression::Sum(each(parts)),
            Expression::Product(parts) => Expression::Product(each(parts)),
            Expression::Power(a, n) => a.substitute(replacement).power(*n),
        }
    }

    fn level(&self) -> Level {
        match self {
            Expression::Number(q) if q.is_negative() => Level::Sum,
            Expression::Number(q) if decimal_places(q).is_none() => Level::Product,
            Expression::Sum(parts) | Expression::Product(parts) if parts.len() == 1 => parts[0].level(),
            Expression::Sum(parts) | Expression::Product(parts) if parts.is_empty() => Level::Atom,
            Expression::Number(_) | Expression::Name(_) => Level::Atom,
            Expression::Sum(_) | Expression::Negation(_) => Level::Sum,
            Expression::Product(_) | Expression::Inverse(_) => Level::Product,
            Expression::Power(..) => Level::Power,
        }
    }

    /// Writes this expression, in parentheses when its precedence is below `least`.
    fn write(&self, f: &mut Formatter<'_>, least: Level) -> fmt::Result {
        if self.level() >= least {
            return self.write_bare(f);
        }
        f.write_str("(")?;
        self.write_bare(f)?;
        f.write_str(")")
    }

    fn write_bare(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Expression::Number(q) => write_number(f, q),
            Expression::Name(name) => f.write_str(name),
            Expression::Negation(a) => {
                f.write_str("-")?;
                a.write(f, Level::Product)
            }
            Expression::Inverse(a) => {
                f.write_str("1/")?;
                a.write(f, Level::Power)
            }
            Expression::Sum(parts) if parts.is_empty() => f.write_str("0"),
            Expression::Product(parts) if parts.is_empty() => f.write_str("1"),
            Expression::Sum(parts) | Expression::Product(parts) if parts.len() == 1 => parts[0].write_bare(f),
            Expression::Sum(terms) => write_sum(f, terms),
            Expression::Product(factors) => write_product(f, factors),
            Expression::Power(a, n) => {
                a.write(f, Level::Atom)?;
                write!(f, "^{n}")
            }
        }
    }
}

/// Precedence of the outermost operation of a text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Sum,
    Product,
    Power,
    Atom,
}

fn single(mut parts: Vec<Expression>) -> Result<Expression, Vec<Expression>> {
    if parts.len() == 1 { Ok(parts.remove(0)) } else { Err(parts) }
}

fn write_sum(f: &mut Formatter<'_>, terms: &[Expression]) -> fmt::Result {
    for (i, term) in terms.iter().enumerate() {
        match term {
            Expression::Negation(a) => {
                f.write_str(if i == 0 { "-" } else { " - " })?;
                a.write(f, Level::Product)?;
            }
            Expression::Number(q) if q.is_negative() => {
                f.write_str(if i == 0 { "-" } else { " - " })?;
                write_number(f, &-q)?;
            }
            _ => {
                f.write_str(if i == 0 { "" } else { " + " })?;
                term.write(f, Level::Product)?;
            }
        }
    }
    Ok(())
}

fn write_product(f: &mut Formatter<'_>, factors: &[Expression]) -> fmt::Result {
    for (i, factor) in factors.iter().enumerate() {
        match factor {
            Expression::Inverse(a) => {
                f.write_str(if i == 0 { "1/" } else { "/" })?;
                a.write(f, Level::Power)?;
            }
            _ => {
                f.write_str(if i == 0 { "" } else { "*" })?;
                factor.write(f, Level::Power)?;
            }
        }
    }
    Ok(())
}

/// Maximum number of digits of a number that is written without an exponent.
const PLAIN_DIGITS: usize = 40;

/// The number of decimals that writes `q` exactly, if there is one.
fn decimal_places(q: &BigRational) -> Option<u32> {
    let twos = q.denom().trailing_zeros()?;
    let mut odd: BigUint = q.denom().magnitude() >> twos;
    let (five, mut fives) = (BigUint::from(5u8), 0u64);
    while (&odd % &five) == BigUint::ZERO {
        odd /= &five;
        fives += 1;
    }
    odd.is_one().then(|| twos.max(fives)).and_then(|places| u32::try_from(places).ok())
}

/// Writes `q` as an integer or a decimal number when that is exact, else as a fraction.
fn write_number(f: &mut Formatter<'_>, q: &BigRational) -> fmt::Result {
    let Some(places) = decimal_places(q) else { return write!(f, "{q}") };
    let scaled = (q * BigRational::from_integer(BigInt::from(10).pow(places))).to_integer();
    let sign = if q.is_negative() { "-" } else { "" };
    let digits = scaled.magnitude().to_string();
    let places = places as usize;
    if digits.len().max(places) > PLAIN_DIGITS {
        return write_scientific(f, sign, &digits, places);
    }
    if places == 0 {
        return write!(f, "{sign}{digits}");
    }
    let padded = format!("{digits:0>width$}", width = places + 1);
    let (whole, fraction) = padded.split_at(padded.len() - places);
    write!(f, "{sign}{whole}.{fraction}")
}

fn write_scientific(f: &mut Formatter<'_>, sign: &str, digits: &str, places: usize) -> fmt::Result {
    let zeros = digits.len() - digits.trim_end_matches('0').len();
    match zeros.min(4096) {
        _ if places > 0 => write!(f, "{sign}{digits}e-{places}"),
        0 => write!(f, "{sign}{digits}"),
        zeros => write!(f, "{sign}{}e{zeros}", &digits[..digits.len() - zeros]),
    }
}

impl Display for Expression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.write(f, Level::Sum)
    }
}

impl Serialize for Expression {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
