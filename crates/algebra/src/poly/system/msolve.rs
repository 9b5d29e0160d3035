//! msolve's file format: variables, characteristic, polynomials with commas between them.

use super::reader::{Names, Reader};
use super::{Format, Heading, PolynomialSystem, assemble, check_characteristic};
use crate::Result;
use crate::poly::Order;
use crate::poly::token::Kind;

/// Reads msolve's format. The format does not contain the order, which is grevlex.
pub(super) fn read(text: &str) -> Result<PolynomialSystem> {
    let mut reader = Reader::new(text, Format::Msolve)?;
    let (mut names, mut variables) = (Names::default(), Vec::new());
    loop {
        let (name, at) = reader.name("a variable")?;
        names.declare(&name, at)?;
        variables.push(name);
        if !reader.take(',')? {
            break;
        }
    }
    let (characteristic, at) = reader.integer("the characteristic, 0 or a prime,")?;
    check_characteristic(characteristic, at)?;
    let mut polynomials = Vec::new();
    while *reader.peek() != Kind::End {
        polynomials.push(reader.polynomial(&[','], &mut |_, token, tokens| names.resolve(token, tokens))?);
        if !reader.take(',')? {
            break;
        }
    }
    let heading = Heading { characteristic, parameters: Vec::new(), variables, order: Order::GrevLex };
    assemble(heading, polynomials, reader.at())
}
