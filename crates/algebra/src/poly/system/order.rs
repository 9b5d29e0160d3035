//! Monomial orders as text: `lex`, `grevlex`, `block:2,3`, `grevlex(2), lex(3)`.

use super::Format;
use super::reader::Reader;
use super::words::At;
use crate::poly::token::Kind;
use crate::poly::{Block, Order};
use crate::{Error, ErrorKind, Result};

const ALLOWED: &str = "`lex`, `grevlex`, `block:2,3` or blocks such as `grevlex(2), lex(3)`";

/// Parses a monomial order: `lex`, `grevlex`, `block:2,3` (graded blocks of these sizes) or blocks such as `grevlex(2),
/// lex(3)`. It reads the [`Display`] text of an [`Order`] back.
///
/// [`Display`]: std::fmt::Display
///
/// # Errors
/// [`ErrorKind::Syntax`] with the column.
pub fn parse_order(text: &str) -> Result<Order> {
    let mut reader = Reader::new(text, Format::Plain)?;
    let order = order(&mut reader)?;
    match reader.peek() {
        Kind::End => Ok(order),
        _ => Err(reader.unexpected("the end of the order")),
    }
}

/// Parses the order at the next token.
pub(super) fn order(reader: &mut Reader<'_>) -> Result<Order> {
    let (name, at) = reader.name(ALLOWED)?;
    let graded = match name.as_str() {
        "lex" => false,
        "grevlex" => true,
        "block" => return sizes(reader),
        _ => return Err(at.error(ErrorKind::Syntax, format!("an order is {ALLOWED}"))),
    };
    if *reader.peek() != Kind::Symbol('(') {
        return Ok(if graded { Order::GrevLex } else { Order::Lex });
    }
    let mut blocks = vec![block(reader, graded)?];
    while reader.take(',')? || reader.take('>')? {
        let (name, at) = reader.name("`lex` or `grevlex`")?;
        match name.as_str() {
            "lex" => blocks.push(block(reader, false)?),
            "grevlex" => blocks.push(block(reader, true)?),
            _ => return Err(at.error(ErrorKind::Syntax, "a block is `lex(SIZE)` or `grevlex(SIZE)`")),
        }
    }
    Ok(Order::Block(blocks))
}

fn block(reader: &mut Reader<'_>, graded: bool) -> Result<Block> {
    reader.expect('(')?;
    let size = reader.size()?;
    reader.expect(')')?;
    Ok(Block { size, graded })
}

fn sizes(reader: &mut Reader<'_>) -> Result<Order> {
    reader.expect(':')?;
    let mut blocks = vec![Block { size: reader.size()?, graded: true }];
    while reader.take(',')? {
        blocks.push(Block { size: reader.size()?, graded: true });
    }
    Ok(Order::Block(blocks))
}

/// Same as [`fit`], but the error has the location `at`.
pub(super) fn fitted(order: Order, variables: usize, at: At) -> Result<Order> {
    fit(order, variables).map_err(|error| at.place(&error))
}

/// Fits `order` to a number of variables. A single block becomes a plain order.
///
/// # Errors
/// [`ErrorKind::BadValue`] when the blocks do not cover the variables.
pub(super) fn fit(order: Order, variables: usize) -> Result<Order> {
    let Order::Block(blocks) = &order else { return Ok(order) };
    let covered = blocks.iter().fold(0, |sum: usize, block| sum.saturating_add(block.size));
    if covered != variables {
        let shown = super::reader::shown(&order.to_string());
        let text =
            format!("the blocks of the order {shown} must cover the {variables} variables, no more and no fewer");
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(match blocks.as_slice() {
        [Block { graded: true, .. }] => Order::GrevLex,
        [Block { graded: false, .. }] => Order::Lex,
        _ => order,
    })
}
