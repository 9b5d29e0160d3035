//! Plain-text format: header lines, then one polynomial or equation per line.
//!
//! ```text
//! # comment
//! variables: x, y          greatest first; by default the names in the order of their appearance
//! parameters: a, b         by default none
//! characteristic: 32003    by default 0
//! order: grevlex           or lex, block:2,3, grevlex(2), lex(3)
//! x^2 + y^2 - a
//! x*y = 1/2*b
//! ```

use super::order::{fitted, order};
use super::reader::{Names, Reader};
use super::words::At;
use super::{Format, Given, Heading, PolynomialSystem, assemble, check_characteristic};
use crate::poly::Order;
use crate::poly::token::Kind;
use crate::{ErrorKind, Result};

const KEYS: &str = "`variables`, `parameters`, `characteristic` and `order`";

/// Contents of the header lines.
#[derive(Default)]
struct Header {
    keys: Vec<String>,
    names: Names,
    variables: Option<Vec<String>>,
    parameters: Vec<String>,
    characteristic: u64,
    order: Option<(Order, At)>,
}

/// Reads plain text.
pub(super) fn read(text: &str) -> Result<PolynomialSystem> {
    let mut reader = Reader::new(text, Format::Plain)?;
    let (mut header, mut polynomials) = (Header::default(), Vec::new());
    loop {
        match reader.peek() {
            Kind::End => break,
            Kind::Delimiter(_) => drop(reader.advance()?),
            Kind::Name(_) if reader.second()? == Kind::Symbol(':') => {
                if !polynomials.is_empty() {
                    return Err(reader.error("header lines must be before the first polynomial; move it up"));
                }
                header.line(&mut reader)?;
            }
            _ => polynomials.push(header.polynomial(&mut reader)?),
        }
    }
    let heading = header.finish(&polynomials, reader.at())?;
    assemble(heading, polynomials, reader.at())
}

impl Header {
    /// Reads a header line `key: value`.
    fn line(&mut self, reader: &mut Reader<'_>) -> Result<()> {
        let (key, at) = reader.name(KEYS)?;
        reader.expect(':')?;
        if self.keys.contains(&key) {
            return Err(at.error(ErrorKind::DuplicateName, format!("the header line `{key}` is given twice")));
        }
        match key.as_str() {
            "variables" => self.variables = Some(self.list(reader)?),
            "parameters" => self.parameters = self.list(reader)?,
            "characteristic" => {
                let (p, at) = reader.integer("0 or a prime")?;
                check_characteristic(p, at)?;
                self.characteristic = p;
            }
            "order" => {
                let at = reader.at();
                self.order = Some((order(reader)?, at));
            }
            _ => return Err(at.error(ErrorKind::UnknownKey, format!("unknown header line; allowed are {KEYS}"))),
        }
        self.keys.push(key);
        match reader.peek() {
            Kind::End | Kind::Delimiter(_) => Ok(()),
            _ => Err(reader.unexpected("the end of the line")),
        }
    }

    /// Reads names with commas between them.
    fn list(&mut self, reader: &mut Reader<'_>) -> Result<Vec<String>> {
        let mut list = Vec::new();
        loop {
            let (name, at) = reader.name("a name")?;
            self.names.declare(&name, at)?;
            list.push(name);
            if !reader.take(',')? {
                return Ok(list);
            }
        }
    }

    fn polynomial(&self, reader: &mut Reader<'_>) -> Result<Given> {
        reader.equation(&mut |_, token, tokens| match self.variables {
            Some(_) => self.names.resolve(token, tokens),
            None => {
                tokens.push(token);
                Ok(())
            }
        })
    }

    fn finish(mut self, polynomials: &[Given], end: At) -> Result<Heading> {
        let variables = match self.variables.take() {
            Some(variables) => variables,
            None => self.appearing(polynomials, end)?,
        };
        let order = match self.order {
            Some((order, at)) => fitted(order, variables.len(), at)?,
            None => Order::GrevLex,
        };
        Ok(Heading { characteristic: self.characteristic, parameters: self.parameters, variables, order })
    }

    /// The names in `polynomials` that are not parameters, in the order of appearance.
    fn appearing(&mut self, polynomials: &[Given], end: At) -> Result<Vec<String>> {
        let mut variables = Vec::new();
        for given in polynomials {
            for name in given.expression.names() {
                if !self.names.contains(name) {
                    self.names.declare(name, At { line: given.line, column: given.column })?;
                    variables.push(name.to_owned());
                }
            }
        }
        if variables.is_empty() && !polynomials.is_empty() {
            return Err(end.error(ErrorKind::MissingKey, "there is no variable; declare some, as in `variables: x, y`"));
        }
        Ok(variables)
    }
}
