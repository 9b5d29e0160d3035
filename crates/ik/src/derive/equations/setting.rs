//! [`Setting`]: the equations of a system after replacement of some parameters, and their ring.

use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Rationals, Ring, Style};
use groebot_algebra::poly::{Expression, Fraction, Fractions, Order, Polynomial, PolynomialRing, parse, square_root};

use crate::derive::System;

/// The field of coefficients: rational functions of the parameters over Q, modulo their square-root relations.
pub type Coefficients = Fractions<Rationals>;
/// A polynomial in the unknowns over [`Coefficients`].
pub type Poly = Polynomial<Fraction<BigRational>>;
/// A polynomial in the parameters over Q.
pub type ParameterPoly = Polynomial<BigRational>;
/// The ring of the unknowns over [`Coefficients`].
pub type Unknowns = PolynomialRing<Coefficients>;

/// A remaining parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Symbol {
    /// The name.
    pub name: String,
    /// The square, if the parameter is algebraic over the parameters before it.
    pub square: Option<Expression>,
    /// Whether it is assumed greater than zero.
    pub positive: bool,
}

/// The replacement of `name` by `value`, an expression in remaining parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Substitution {
    /// The parameter that is replaced.
    pub name: String,
    /// The new value.
    pub value: Expression,
}

/// The equations at one stratum of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The remaining parameters. Squares mention only earlier ones.
    pub symbols: Vec<Symbol>,
    /// All unknowns, greatest first.
    pub unknowns: Vec<String>,
    /// The expressions that are zero.
    pub equations: Vec<Expression>,
    /// The substitutions so far, in order.
    pub substitutions: Vec<Substitution>,
}

impl Setting {
    /// The setting of `system` itself, without substitutions.
    pub fn new(system: &System) -> Self {
        let positive = |parameter: &crate::derive::Parameter| match parameter.source {
            crate::derive::ParameterSource::Input(index) => system.inputs[index].positive,
            crate::derive::ParameterSource::SquareRoot => true,
            _ => false,
        };
        let symbols = system.parameters.iter().map(|parameter| Symbol {
            name: parameter.name.clone(),
            square: parameter.square.clone(),
            positive: positive(parameter),
        });
        Setting {
            symbols: symbols.collect(),
            unknowns: system.order.clone(),
            equations: system.equations.iter().map(|equation| equation.expression.clone()).collect(),
            substitutions: Vec::new(),
        }
    }

    /// The field of rational functions of the remaining parameters.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if a relation is malformed.
    pub fn field(&self) -> Result<Coefficients> {
        let names: Vec<&str> = self.symbols.iter().map(|symbol| symbol.name.as_str()).collect();
        let mut field = Fractions::new(Rationals, &names)?;
        for (index, symbol) in self.symbols.iter().enumerate() {
            if let Some(square) = &symbol.square {
                let square = square.evaluate(field.ring())?;
                field = field.with_square(index, &square)?;
            }
        }
        Ok(field)
    }

    /// The ring of the unknowns in `order`, with variables `names`, greatest first.
    ///
    /// # Errors
    /// As [`Setting::field`].
    pub fn ring<S: AsRef<str>>(&self, names: &[S], order: Order) -> Result<Unknowns> {
        PolynomialRing::new(self.field()?, names, order)
    }

    /// The equations as polynomials of `ring`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if an equation divides by an expression that is zero in this setting.
    pub(crate) fn generators(&self, ring: &Unknowns) -> Result<Vec<Poly>> {
        self.equations.iter().map(|equation| equation.evaluate(ring)).collect()
    }

    /// The setting after replacement of a parameter. A parameter whose square becomes zero becomes zero too.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] if there is no such parameter.
    pub(crate) fn substitute(&self, substitution: &Substitution) -> Result<Setting> {
        let Some(index) = self.symbols.iter().position(|symbol| symbol.name == substitution.name) else {
            let text = format!("no parameter `{}` is left to be replaced", substitution.name);
            return Err(Error::new(ErrorKind::UnknownName, text));
        };
        let replace = |expression: &Expression| {
            expression.substitute(&|name| (name == substitution.name).then(|| substitution.value.clone()))
        };
        let mut setting = self.clone();
        setting.symbols.remove(index);
        for symbol in &mut setting.symbols {
            symbol.square = symbol.square.as_ref().map(replace);
        }
        setting.equations = setting.equations.iter().map(replace).collect();
        setting.substitutions.push(substitution.clone());
        match setting.vanished_root()? {
            Some(name) => setting.substitute(&Substitution { name, value: Expression::integer(0) }),
            None => Ok(setting),
        }
    }

    /// The settings for both signs of each root whose square has become a square of the parameters. Otherwise the relation of the root would not be prime.
    ///
    /// # Errors
    /// As [`Setting::field`].
    pub(crate) fn split_roots(&self) -> Result<Vec<Setting>> {
        for (index, symbol) in self.symbols.iter().enumerate() {
            let Some(square) = &symbol.square else { continue };
            let Some(root) = self.root_among_earlier(index, square)? else { continue };
            let mut settings = Vec::new();
            for value in [root.clone(), root.negated()] {
                let substitution = Substitution { name: symbol.name.clone(), value };
                settings.extend(self.substitute(&substitution)?.split_roots()?);
            }
            return Ok(settings);
        }
        Ok(vec![self.clone()])
    }

    /// An expression in the parameters before symbol `index` whose square is `square`: a polynomial, or a polynomial times an earlier root.
    fn root_among_earlier(&self, index: usize, square: &Expression) -> Result<Option<Expression>> {
        let field = Setting { symbols: self.symbols[..index].to_vec(), ..self.clone() }.field()?;
        let ring = field.ring();
        let square = field.reduce(&square.evaluate(ring)?);
        if let Some(root) = square_root(ring, &square) {
            return Ok(Some(expression_of(ring, &root)));
        }
        for earlier in &self.symbols[..index] {
            let Some(other) = &earlier.square else { continue };
            let other = other.evaluate(ring)?;
            if let Some(root) = square_root(ring, &ring.mul(&square, &other)) {
                let name = Expression::name(earlier.name.clone());
                let parts = match ring.exact_div(&root, &other) {
                    Some(factor) => vec![expression_of(ring, &factor), name],
                    None => {
                        let inverse = Expression::Inverse(Box::new(expression_of(ring, &other)));
                        vec![expression_of(ring, &root), name, inverse]
                    }
                };
                return Ok(Some(Expression::product(parts)));
            }
        }
        Ok(None)
    }

    /// A parameter whose square is zero.
    fn vanished_root(&self) -> Result<Option<String>> {
        for (index, symbol) in self.symbols.iter().enumerate() {
            if let Some(square) = &symbol.square {
                let before = Setting { symbols: self.symbols[..index].to_vec(), ..self.clone() };
                if square.evaluate(before.field()?.ring())?.is_zero() {
                    return Ok(Some(symbol.name.clone()));
                }
            }
        }
        Ok(None)
    }

    /// Whether both settings have equal parameters and equations. Their substitutions may differ.
    pub(crate) fn same_equations(&self, other: &Setting) -> bool {
        self.symbols == other.symbols && self.unknowns == other.unknowns && self.equations == other.equations
    }

    /// Adds an algebraic parameter after the others.
    #[must_use]
    pub(crate) fn with_symbol(&self, symbol: Symbol) -> Setting {
        let mut setting = self.clone();
        setting.symbols.push(symbol);
        setting
    }
}

/// A polynomial as the expression of its text.
pub(crate) fn expression_of<R: Ring>(ring: &R, element: &R::Element) -> Expression {
    parse(&ring.format(element, Style::Text)).expect("printed text parses back")
}
