//! The operators of expressions on numbers, texts and lists.

use std::cmp::Ordering;

use super::methods::{formatted, position};
use super::syntax::{Comparison, Operator, Unary};
use super::value::{Value, bad};
use crate::document::shown;
use crate::model::xacro::budget::Budget;
use crate::{Error, ErrorKind, Result};

/// The value of an operator on one value.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a value that is not a number, and for a result that is too large.
pub fn unary(operator: Unary, value: &Value) -> Result<Value> {
    match (operator, value) {
        (Unary::Not, _) => return Ok(Value::Bool(!value.is_true())),
        (Unary::Minus, Value::Float(value)) => return Ok(Value::Float(-value)),
        (Unary::Plus, Value::Float(value)) => return Ok(Value::Float(*value)),
        _ => {}
    }
    let integer = value.integer().ok_or_else(|| bad(format!("a {} has no sign; give a number", value.kind())))?;
    let result = match operator {
        Unary::Minus => integer.checked_neg(),
        Unary::Invert => Some(!integer),
        _ => Some(integer),
    };
    result.map(Value::Int).ok_or_else(too_large)
}

fn too_large() -> Error {
    bad("an integer is too large; give at most 38 digits".to_owned())
}

/// The value of an operator on two values.
///
/// # Errors
/// [`ErrorKind::BadValue`] for types that the operator does not have, a division by zero, and above the limits.
pub fn binary(operator: Operator, a: &Value, b: &Value, budget: &mut Budget) -> Result<Value> {
    if let Some(joined) = joined(operator, a, b, budget)? {
        return Ok(joined);
    }
    match (a.integer(), b.integer(), a.number(), b.number()) {
        (Some(a), Some(b), ..) => integers(operator, a, b),
        (_, _, Some(a), Some(b)) => floats(operator, a, b),
        _ => {
            let text = format!("{operator:?} is not defined for {} and {}; give numbers", a.kind(), b.kind());
            Err(bad(text))
        }
    }
}

/// The value for texts and lists; `None` for other types.
fn joined(operator: Operator, a: &Value, b: &Value, budget: &mut Budget) -> Result<Option<Value>> {
    Ok(Some(match (operator, a, b) {
        (Operator::Add, Value::Text(a), Value::Text(b)) => {
            budget.spend_length(a.len() + b.len())?;
            Value::text(format!("{a}{b}"))
        }
        (Operator::Add, Value::List(a), Value::List(b)) => {
            budget.spend_length(a.len() + b.len())?;
            Value::list(a.iter().chain(b.iter()).cloned().collect())
        }
        (Operator::Add, Value::Tuple(a), Value::Tuple(b)) => {
            budget.spend_length(a.len() + b.len())?;
            Value::Tuple(a.iter().chain(b.iter()).cloned().collect::<Vec<_>>().into())
        }
        (Operator::Multiply, Value::Text(text), times) | (Operator::Multiply, times, Value::Text(text)) => {
            let Some(times) = times.integer() else { return Ok(None) };
            let times = usize::try_from(times.max(0)).unwrap_or(usize::MAX);
            budget.spend_length(text.len().saturating_mul(times))?;
            // An empty text has no length, however often it is repeated.
            Value::text(if text.is_empty() { String::new() } else { text.repeat(times) })
        }
        (Operator::Multiply, Value::List(list), times) | (Operator::Multiply, times, Value::List(list)) => {
            let Some(times) = times.integer() else { return Ok(None) };
            let times = usize::try_from(times.max(0)).unwrap_or(usize::MAX);
            budget.spend_length(list.len().saturating_mul(times))?;
            Value::list(if list.is_empty() {
                Vec::new()
            } else {
                std::iter::repeat_n(&**list, times).flatten().cloned().collect()
            })
        }
        (Operator::Remainder, Value::Text(format), value) => Value::text(formatted(format, value, budget)?),
        _ => return Ok(None),
    }))
}

fn integers(operator: Operator, a: i128, b: i128) -> Result<Value> {
    let divisor = |text: &str| bad(format!("{text} by zero; give another divisor"));
    let shift = || u32::try_from(b).ok().filter(|shift| *shift < 127);
    let result = match operator {
        Operator::Add => a.checked_add(b),
        Operator::Subtract => a.checked_sub(b),
        Operator::Multiply => a.checked_mul(b),
        Operator::Divide | Operator::FloorDivide | Operator::Remainder if b == 0 => return Err(divisor("a division")),
        Operator::Divide => return Ok(Value::Float(a as f64 / b as f64)),
        Operator::FloorDivide => a.checked_div_euclid(b).map(|q| if b < 0 && a.rem_euclid(b) != 0 { q - 1 } else { q }),
        Operator::Remainder => a.checked_rem_euclid(b).map(|rest| if b < 0 && rest != 0 { rest + b } else { rest }),
        Operator::Power if b < 0 => return floats(operator, a as f64, b as f64),
        Operator::Power => u32::try_from(b).ok().and_then(|b| a.checked_pow(b)),
        Operator::BitAnd => Some(a & b),
        Operator::BitOr => Some(a | b),
        Operator::BitXor => Some(a ^ b),
        Operator::ShiftRight => shift().map(|shift| a >> shift),
        Operator::ShiftLeft => shift().and_then(|shift| a.checked_mul(1 << shift)),
    };
    result.map(Value::Int).ok_or_else(too_large)
}

fn floats(operator: Operator, a: f64, b: f64) -> Result<Value> {
    let is_division = matches!(operator, Operator::Divide | Operator::FloorDivide | Operator::Remainder);
    if b == 0.0 && is_division || operator == Operator::Power && a == 0.0 && b < 0.0 {
        return Err(bad("a division by zero; give another divisor".to_owned()));
    }
    let value = match operator {
        Operator::Add => a + b,
        Operator::Subtract => a - b,
        Operator::Multiply => a * b,
        Operator::Divide => a / b,
        Operator::FloorDivide => floor_divided(a, b),
        Operator::Remainder => remainder(a, b),
        Operator::Power => a.powf(b),
        _ => return Err(bad(format!("{operator:?} is not defined for floats; give integers"))),
    };
    if operator == Operator::Power && a.is_finite() && b.is_finite() && !value.is_finite() {
        return Err(bad("a power is too large or not real; give other numbers".to_owned()));
    }
    Ok(Value::Float(value))
}

/// The remainder with the sign of `b`.
fn remainder(a: f64, b: f64) -> f64 {
    let rest = a % b;
    if rest != 0.0 && (rest < 0.0) != (b < 0.0) { rest + b } else { rest }
}

/// The quotient that belongs to [`remainder`], rounded to an integer.
fn floor_divided(a: f64, b: f64) -> f64 {
    let quotient = (a - remainder(a, b)) / b;
    let floor = quotient.floor();
    if quotient - floor > 0.5 { floor + 1.0 } else { floor }
}

/// Whether a comparison holds.
///
/// # Errors
/// [`ErrorKind::BadValue`] for types without an order.
pub fn compare(comparison: Comparison, a: &Value, b: &Value, budget: &mut Budget) -> Result<bool> {
    match comparison {
        Comparison::Equal => a.equals(b, budget),
        Comparison::Unequal => Ok(!a.equals(b, budget)?),
        Comparison::Is => Ok(a.kind() == b.kind() && a.equals(b, budget)?),
        Comparison::IsNot => Ok(a.kind() != b.kind() || !a.equals(b, budget)?),
        Comparison::In => contains(b, a, budget),
        Comparison::NotIn => Ok(!contains(b, a, budget)?),
        Comparison::Less => Ok(order(a, b, budget)? == Some(Ordering::Less)),
        Comparison::Greater => Ok(order(a, b, budget)? == Some(Ordering::Greater)),
        Comparison::AtMost => Ok(order(a, b, budget)?.is_some_and(Ordering::is_le)),
        Comparison::AtLeast => Ok(order(a, b, budget)?.is_some_and(Ordering::is_ge)),
    }
}

/// The order of two values; `None` for nan.
///
/// # Errors
/// [`ErrorKind::BadValue`] for types without an order.
pub fn order(a: &Value, b: &Value, budget: &mut Budget) -> Result<Option<Ordering>> {
    budget.spend(0)?;
    match (a, b) {
        (Value::Text(a), Value::Text(b)) => {
            budget.spend(a.len().min(b.len()))?;
            Ok(Some(a.cmp(b)))
        }
        (Value::List(a), Value::List(b)) | (Value::Tuple(a), Value::Tuple(b)) => {
            budget.enter()?;
            for (a, b) in a.iter().zip(b.iter()) {
                if !a.equals(b, budget)? {
                    let order = order(a, b, budget);
                    budget.leave();
                    return order;
                }
            }
            budget.leave();
            Ok(Some(a.len().cmp(&b.len())))
        }
        _ => match (a.integer(), b.integer(), a.number(), b.number()) {
            (Some(a), Some(b), ..) => Ok(Some(a.cmp(&b))),
            (_, _, Some(a), Some(b)) => Ok(a.partial_cmp(&b)),
            _ => Err(bad(format!("a {} and a {} have no order; give two numbers or two texts", a.kind(), b.kind()))),
        },
    }
}

fn contains(container: &Value, value: &Value, budget: &mut Budget) -> Result<bool> {
    match (container, value) {
        (Value::Text(text), Value::Text(part)) => {
            budget.spend(text.len())?;
            Ok(text.contains(&**part))
        }
        (Value::List(list) | Value::Tuple(list), _) => {
            for item in list.iter() {
                if item.equals(value, budget)? {
                    return Ok(true);
                }
            }
            Ok(false)
        }
        (Value::Dict(entries), _) => Ok(Value::entry(entries, value, budget)?.is_some()),
        _ => Err(bad(format!("a {} contains no {}; give a list, a dict or a text", container.kind(), value.kind()))),
    }
}

/// The value at an index or a key.
///
/// # Errors
/// [`ErrorKind::UnknownName`] for an absent key; [`ErrorKind::BadValue`] for an index outside of a list.
pub fn index_of(owner: &Value, index: &Value, budget: &mut Budget) -> Result<Value> {
    match owner {
        Value::List(list) | Value::Tuple(list) => Ok(list[position(list.len(), index)?].clone()),
        Value::Text(text) => {
            budget.spend(text.len())?;
            let letters: Vec<char> = text.chars().collect();
            Ok(Value::text(letters[position(letters.len(), index)?].to_string()))
        }
        Value::Dict(entries) => {
            let found = Value::entry(entries, index, budget)?;
            let key = index.shown(budget)?;
            let missing = || format!("the dict has no key `{}`; give one of its keys", shown(&key));
            found.ok_or_else(|| Error::new(ErrorKind::UnknownName, missing()))
        }
        _ => Err(bad(format!("a {} has no index; give a list, a dict or a text", owner.kind()))),
    }
}
