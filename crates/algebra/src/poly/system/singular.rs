//! Singular's file format: one ring, then one ideal or polynomials.
//!
//! ```text
//! ring r = 32003,(x,y,z(1..3)),(dp(2),lp(3));     // also 0 or QQ; (0,a,b) with parameters
//! poly f = 3x2y - 1;                              // as 3*x^2*y - 1
//! ideal i = f, x^2 + z(1)*z(3);
//! ```
//!
//! `z(1)` becomes `z1`. A word of one-letter names and digits is a monomial and counts as one factor: `2x^2` is
//! `(2*x)^2`, as in Singular.

use std::collections::{HashMap, HashSet};

use super::order::fitted;
use super::reader::{Names, Reader, place, shown};
use super::words::At;
use super::{Format, Given, Heading, MAX_NAMES, PolynomialSystem, assemble, check_characteristic};
use crate::poly::token::{Kind, Token};
use crate::poly::{Block, Order};
use crate::{Error, ErrorKind, Result};

/// Reads Singular's format.
pub(super) fn read(text: &str) -> Result<PolynomialSystem> {
    let mut reader = Reader::new(text, Format::Singular)?;
    let mut file = File::default();
    while *reader.peek() != Kind::End {
        file.statement(&mut reader)?;
    }
    let end = reader.at();
    let Some(heading) = file.heading else {
        return Err(end.error(ErrorKind::Syntax, "there is no ring; give one, as in `ring r = 0,(x,y),dp;`"));
    };
    let polynomials = file.ideal.unwrap_or_else(|| file.polynomials.into_iter().map(|(_, given)| given).collect());
    assemble(heading, polynomials, end)
}

/// State of the reader.
#[derive(Default)]
struct File {
    heading: Option<Heading>,
    names: Names,
    /// Names that are used with an index: `z` of `z(1)`.
    indexed: HashSet<String>,
    polynomials: Vec<(String, Given)>,
    positions: HashMap<String, usize>,
    ideal: Option<Vec<Given>>,
}

impl File {
    fn statement(&mut self, reader: &mut Reader<'_>) -> Result<()> {
        let (word, at) = reader.name("`ring`, `poly` or `ideal`")?;
        match word.as_str() {
            "ring" if self.heading.is_some() => Err(at.error(ErrorKind::Unsupported, "a second ring; give one")),
            "ring" => self.ring(reader),
            "poly" | "ideal" if self.heading.is_none() => {
                Err(at.error(ErrorKind::Syntax, format!("a ring is required before this `{word}`; give one")))
            }
            "poly" => self.polynomial(reader),
            "ideal" if self.ideal.is_some() => Err(at.error(ErrorKind::Unsupported, "a second ideal; give one")),
            "ideal" => self.ideal(reader),
            _ => {
                let word = shown(&word);
                let text =
                    format!("`{word}` is not supported; allowed are `ring`, `poly` and `ideal` with their values");
                Err(at.error(ErrorKind::Unsupported, text))
            }
        }
    }

    /// `NAME = CHARACTERISTIC,(VARIABLES),(ORDER);`
    fn ring(&mut self, reader: &mut Reader<'_>) -> Result<()> {
        reader.name("the ring's name")?;
        reader.expect('=')?;
        let (characteristic, parameters) = self.field(reader)?;
        reader.expect(',')?;
        let mut variables = Vec::new();
        if reader.take('(')? {
            self.list(reader, &mut variables)?;
            reader.expect(')')?;
        } else {
            self.item(reader, &mut variables)?;
        }
        reader.expect(',')?;
        let at = reader.at();
        let order = fitted(order(reader, variables.len())?, variables.len(), at)?;
        reader.expect(';')?;
        self.heading = Some(Heading { characteristic, parameters, variables, order });
        Ok(())
    }

    /// `0`, `QQ`, `p`, or one of these in parentheses followed by parameters.
    fn field(&mut self, reader: &mut Reader<'_>) -> Result<(u64, Vec<String>)> {
        let mut parameters = Vec::new();
        let open = reader.take('(')?;
        let characteristic = if *reader.peek() == Kind::Word("QQ") {
            reader.advance()?;
            0
        } else {
            let (p, at) = reader.integer("the characteristic: 0, `QQ` or a prime,")?;
            check_characteristic(p, at)?;
            p
        };
        if open {
            if reader.take(',')? {
                self.list(reader, &mut parameters)?;
            }
            reader.expect(')')?;
        }
        Ok((characteristic, parameters))
    }

    fn list(&mut self, reader: &mut Reader<'_>, names: &mut Vec<String>) -> Result<()> {
        self.item(reader, names)?;
        while reader.take(',')? {
            self.item(reader, names)?;
        }
        Ok(())
    }

    /// `x`, `x(3)` or `x(1..3)`.
    fn item(&mut self, reader: &mut Reader<'_>, names: &mut Vec<String>) -> Result<()> {
        let (name, at) = reader.name("a name")?;
        if !reader.take('(')? {
            self.names.declare(&name, at)?;
            names.push(name);
            return Ok(());
        }
        let (first, _) = reader.integer("an index")?;
        let mut last = first;
        if reader.take('.')? {
            reader.expect('.')?;
            last = reader.integer("an index")?.0;
        }
        reader.expect(')')?;
        if last < first || last - first >= MAX_NAMES as u64 {
            let text = format!("indices must increase, with at most {MAX_NAMES} names");
            return Err(at.error(ErrorKind::BadValue, text));
        }
        for index in first..=last {
            self.names.declare(&format!("{name}{index}"), at)?;
            names.push(format!("{name}{index}"));
        }
        self.indexed.insert(name);
        Ok(())
    }

    /// `NAME = POLYNOMIAL;`
    fn polynomial(&mut self, reader: &mut Reader<'_>) -> Result<()> {
        let (name, at) = reader.name("the polynomial's name")?;
        reader.expect('=')?;
        let given = self.given(reader)?;
        reader.expect(';')?;
        let taken = self.names.contains(&name);
        if self.positions.insert(name.clone(), self.polynomials.len()).is_some() || taken {
            let text = format!("`{}` is already defined; give each polynomial its own name", shown(&name));
            return Err(at.error(ErrorKind::DuplicateName, text));
        }
        self.polynomials.push((name, given));
        Ok(())
    }

    /// `NAME = POLYNOMIAL, ...;`, where a polynomial may be the name of an earlier one.
    fn ideal(&mut self, reader: &mut Reader<'_>) -> Result<()> {
        reader.name("the ideal's name")?;
        reader.expect('=')?;
        let mut ideal = Vec::new();
        loop {
            ideal.push(match self.known(reader)? {
                Some(given) => given,
                None => self.given(reader)?,
            });
            if !reader.take(',')? {
                break;
            }
        }
        reader.expect(';')?;
        self.ideal = Some(ideal);
        Ok(())
    }

    /// The polynomial whose name is used alone.
    fn known(&self, reader: &mut Reader<'_>) -> Result<Option<Given>> {
        let Kind::Word(word) = *reader.peek() else { return Ok(None) };
        let alone = matches!(reader.second()?, Kind::Symbol(',' | ';'));
        match self.positions.get(word) {
            Some(&index) if alone => {
                reader.advance()?;
                Ok(Some(self.polynomials[index].1.clone()))
            }
            _ => Ok(None),
        }
    }

    fn given(&self, reader: &mut Reader<'_>) -> Result<Given> {
        reader.polynomial(&[',', ';'], &mut |reader, token, tokens| self.resolve(reader, token, tokens))
    }

    /// A declared name, a name with its index, or the factors of a monomial.
    fn resolve<'a>(&self, reader: &mut Reader<'a>, token: Token<'a>, tokens: &mut Vec<Token<'a>>) -> Result<()> {
        let Kind::Word(word) = token.kind else { return self.names.resolve(token, tokens) };
        let at = place(&token);
        let mut push = |kind| tokens.push(Token { line: token.line, column: token.column, kind });
        if self.indexed.contains(word) && reader.take('(')? {
            let (index, _) = reader.integer("an index")?;
            reader.expect(')')?;
            let name = format!("{word}{index}");
            if !self.names.contains(&name) {
                return Err(self.names.unknown(&name, at));
            }
            push(Kind::Name(name));
        } else if self.names.contains(word) {
            push(Kind::Name(word.to_owned()));
        } else {
            monomial(word)
                .filter(|factors| self.knows_letters(factors))
                .ok_or_else(|| self.unknown(word, at))?
                .into_iter()
                .for_each(push);
        }
        Ok(())
    }

    fn knows_letters(&self, factors: &[Kind<'_>]) -> bool {
        factors.iter().all(|kind| if let Kind::Name(name) = kind { self.names.contains(name) } else { true })
    }

    fn unknown(&self, word: &str, at: At) -> Error {
        if self.positions.contains_key(word) {
            let text = format!(
                "the polynomial `{}` may be an element of the ideal, but not a part of an expression",
                shown(word)
            );
            return at.error(ErrorKind::Unsupported, text);
        }
        self.names.unknown(word, at)
    }
}

/// `1/3x2y` as `(1/3*x^2*y)`; `None` when the word has another form.
fn monomial(word: &str) -> Option<Vec<Kind<'_>>> {
    let letters = word.find(|c: char| c.is_ascii_alphabetic())?;
    let (coefficient, mut rest) = word.split_at(letters);
    let mut factors = vec![Kind::Symbol('(')];
    match coefficient.split_once('/') {
        Some((top, bottom)) => {
            factors.extend([Kind::Number(top), Kind::Symbol('/'), Kind::Number(bottom), Kind::Symbol('*')])
        }
        None if coefficient.is_empty() => {}
        None => factors.extend([Kind::Number(coefficient), Kind::Symbol('*')]),
    }
    while let Some(letter) = rest.get(..1) {
        if !letter.bytes().all(|b| b.is_ascii_alphabetic()) {
            return None;
        }
        let digits = rest[1..].find(|c: char| !c.is_ascii_digit()).map_or(rest.len(), |end| end + 1);
        factors.push(Kind::Name(letter.to_owned()));
        if digits > 1 {
            factors.extend([Kind::Symbol('^'), Kind::Number(&rest[1..digits])]);
        }
        rest = &rest[digits..];
        factors.push(Kind::Symbol(if rest.is_empty() { ')' } else { '*' }));
    }
    Some(factors)
}

/// `dp`, `lp`, or blocks of them in parentheses. The orders `c` and `C` of module components are ignored.
fn order(reader: &mut Reader<'_>, variables: usize) -> Result<Order> {
    let mut blocks = Vec::new();
    if !reader.take('(')? {
        return Ok(Order::Block(block(reader, variables)?.into_iter().collect()));
    }
    let mut left = variables;
    loop {
        if let Some(block) = block(reader, left)? {
            left = left.saturating_sub(block.size);
            blocks.push(block);
        }
        if !reader.take(',')? {
            break;
        }
    }
    reader.expect(')')?;
    Ok(Order::Block(blocks))
}

/// One block. Without a size it has all variables that are `left`. `None` for `c` and `C`.
fn block(reader: &mut Reader<'_>, left: usize) -> Result<Option<Block>> {
    let (name, at) = reader.name("an order such as `dp` or `lp`")?;
    let graded = match name.as_str() {
        "dp" => true,
        "lp" => false,
        "c" | "C" => return Ok(None),
        _ => {
            let text = format!(
                "the order `{}` is not supported; allowed are `dp`, `lp` and blocks of them such as `(dp(2),lp(3))`",
                shown(&name)
            );
            return Err(at.error(ErrorKind::Unsupported, text));
        }
    };
    let sized = reader.take('(')?;
    let size = if sized { reader.size()? } else { left };
    if sized {
        reader.expect(')')?;
    }
    if size == 0 {
        return Err(at.error(ErrorKind::BadValue, "the blocks before this one cover all variables; omit it"));
    }
    Ok(Some(Block { size, graded }))
}
