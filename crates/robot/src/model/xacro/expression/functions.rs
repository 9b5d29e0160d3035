//! The built-in functions and constants: those of Python that xacro exposes, and those of `math`.

use std::cmp::Ordering;
use std::f64::consts::{E, PI, TAU};

use super::methods::{insert, items};
use super::operators::{binary, order};
use super::syntax::Operator;
use super::value::{Value, bad, parse_float, parse_int};
use crate::document::shown;
use crate::model::xacro::budget::Budget;
use crate::{Error, ErrorKind, Result};

/// A function of one number.
type OfOne = fn(f64) -> f64;

/// The functions of one number.
const OF_ONE: [(&str, OfOne); 27] = [
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("sinh", f64::sinh),
    ("cosh", f64::cosh),
    ("tanh", f64::tanh),
    ("asinh", f64::asinh),
    ("acosh", f64::acosh),
    ("atanh", f64::atanh),
    ("sqrt", f64::sqrt),
    ("cbrt", f64::cbrt),
    ("exp", f64::exp),
    ("exp2", f64::exp2),
    ("expm1", f64::exp_m1),
    ("log2", f64::log2),
    ("log10", f64::log10),
    ("log1p", f64::ln_1p),
    ("fabs", f64::abs),
    ("radians", |degrees| degrees * (PI / 180.0)),
    ("degrees", |radians| radians * (180.0 / PI)),
    ("ceil", f64::ceil),
    ("floor", f64::floor),
    ("trunc", f64::trunc),
    ("log", f64::ln),
];
/// The other functions of `math`.
const OF_MORE: [&str; 8] = ["atan2", "hypot", "pow", "fmod", "copysign", "isnan", "isinf", "isfinite"];
/// The functions of Python, which are in the module `python` too.
const PYTHON: [&str; 23] = [
    "abs",
    "all",
    "any",
    "bool",
    "dict",
    "divmod",
    "enumerate",
    "float",
    "int",
    "isinstance",
    "len",
    "list",
    "max",
    "min",
    "range",
    "repr",
    "reversed",
    "round",
    "sorted",
    "str",
    "sum",
    "tuple",
    "zip",
];
/// The functions of xacro that read files, arguments or packages, or write notes.
const XACRO: [&str; 9] =
    ["load_yaml", "abs_filename", "arg", "message", "warning", "error", "fatal", "print_location", "tokenize"];
/// The functions of `$(eval ...)`.
const EVAL: [&str; 4] = ["env", "optenv", "find", "dirname"];
/// The functions of Python that are only in its module: xacro does not expose them as plain names.
const ONLY_IN_MODULE: [&str; 9] = ["abs", "all", "any", "divmod", "enumerate", "isinstance", "repr", "reversed", "sum"];
/// The functions that tests of types accept.
const TYPES: [(&str, &str); 7] = [
    ("str", "str"),
    ("int", "int"),
    ("float", "float"),
    ("bool", "bool"),
    ("list", "list"),
    ("dict", "dict"),
    ("tuple", "tuple"),
];

/// The value of a built-in name: a function, a constant or a module.
pub fn global(name: &str) -> Option<Value> {
    let module = ["math", "xacro", "python"].into_iter().find(|module| *module == name).map(Value::Module);
    let plain = Some(name).filter(|name| !ONLY_IN_MODULE.contains(name) && *name != "arg" && *name != "dotify");
    module.or_else(|| plain.and_then(|name| ["math", "python", "xacro"].iter().find_map(|module| member(module, name))))
}

/// The value of a name in a module.
pub fn member(module: &str, name: &str) -> Option<Value> {
    let constant = match (module, name) {
        ("math", "pi") => Some(PI),
        ("math", "e") => Some(E),
        ("math", "tau") => Some(TAU),
        ("math", "inf") => Some(f64::INFINITY),
        ("math", "nan") => Some(f64::NAN),
        _ => None,
    };
    let names: &[&'static str] = match module {
        "math" => &OF_MORE,
        "python" => &PYTHON,
        "xacro" => &XACRO,
        _ => &[],
    };
    let listed = names.iter().find(|known| **known == name).copied();
    let of_one = || OF_ONE.iter().find(|(known, _)| *known == name && module == "math").map(|(known, _)| *known);
    let dotify = || (module == "xacro" && name == "dotify").then_some("dict");
    constant.map(Value::Float).or_else(|| listed.or_else(of_one).or_else(dotify).map(Value::Function))
}

/// The function `name` of `$(eval ...)`.
pub fn eval_function(name: &str) -> Option<Value> {
    EVAL.iter().chain(&["arg"]).find(|known| **known == name).copied().map(Value::Function)
}

/// Whether the function `name` is called by [`super::Context::call`].
pub fn needs_context(name: &str) -> bool {
    name != "tokenize" && (XACRO.contains(&name) || EVAL.contains(&name))
}

/// Calls a built-in function with its arguments and its named arguments.
///
/// # Errors
/// [`ErrorKind::BadValue`] for wrong arguments, a value outside of the function's domain, and above the limits.
pub fn call(name: &str, arguments: &[Value], named: &[(&str, Value)], budget: &mut Budget) -> Result<Value> {
    let refuse_named = |allowed: &[&str]| match named.iter().find(|(given, _)| !allowed.contains(given)) {
        None => Ok(()),
        Some((given, _)) => Err(bad(format!("`{name}` has no argument `{}`", shown(given)))),
    };
    match name {
        "dict" => return dict(arguments, named, budget),
        "sorted" | "max" | "min" => refuse_named(&["reverse", "default"])?,
        "round" => refuse_named(&["ndigits"])?,
        _ => refuse_named(&[])?,
    }
    let option = |name: &str| named.iter().find(|(given, _)| *given == name).map(|(_, value)| value.clone());
    match (name, arguments) {
        ("min", _) => extreme(arguments, Ordering::Less, option("default"), budget),
        ("max", _) => extreme(arguments, Ordering::Greater, option("default"), budget),
        ("sorted", [list]) => sorted(list, option("reverse").is_some_and(|reverse| reverse.is_true()), budget),
        ("round", [value]) => rounded(value, option("ndigits").as_ref()),
        ("round", [value, digits]) => rounded(value, Some(digits)),
        ("abs" | "bool" | "float" | "int" | "len" | "repr" | "str", _) => simple(name, arguments, budget),
        _ if PYTHON.contains(&name) || name == "tokenize" => of_lists(name, arguments, budget),
        _ => math(name, arguments),
    }
}

fn wrong(name: &str) -> Error {
    bad(format!("`{name}` does not take these arguments"))
}

fn dict(arguments: &[Value], named: &[(&str, Value)], budget: &mut Budget) -> Result<Value> {
    let mut entries = Vec::new();
    match arguments {
        [] => {}
        [Value::Dict(given)] => entries.extend(given.iter().cloned()),
        [list] => {
            for pair in items(list, budget)? {
                let [key, value] = <[Value; 2]>::try_from(items(&pair, budget)?).map_err(|_| wrong("dict"))?;
                insert(&mut entries, key, value, budget)?;
            }
        }
        _ => return Err(wrong("dict")),
    }
    for (name, value) in named {
        insert(&mut entries, Value::text(*name), value.clone(), budget)?;
    }
    Ok(Value::Dict(entries.into()))
}

fn extreme(arguments: &[Value], wanted: Ordering, default: Option<Value>, budget: &mut Budget) -> Result<Value> {
    let values = match arguments {
        [list] => items(list, budget)?,
        values => values.to_vec(),
    };
    let mut values = values.into_iter();
    let Some(mut best) = values.next().or(default) else {
        return Err(bad("min and max take at least one value".to_owned()));
    };
    for value in values {
        if order(&value, &best, budget)? == Some(wanted) {
            best = value;
        }
    }
    Ok(best)
}

fn sorted(list: &Value, is_reverse: bool, budget: &mut Budget) -> Result<Value> {
    let mut values = items(list, budget)?;
    let mut failed = None;
    values.sort_by(|a, b| match order(a, b, budget) {
        Ok(order) => order.unwrap_or(Ordering::Equal),
        Err(error) => {
            failed = Some(error);
            Ordering::Equal
        }
    });
    if is_reverse {
        values.reverse();
    }
    failed.map_or(Ok(Value::list(values)), Err)
}

/// Rounds half to even: to an integer without `digits`.
fn rounded(value: &Value, digits: Option<&Value>) -> Result<Value> {
    let digits = match digits {
        None | Some(Value::None) => None,
        Some(digits) => Some(digits.integer().ok_or_else(|| wrong("round"))?),
    };
    match (value, digits) {
        (Value::Float(value), None) => as_integer(value.round_ties_even()),
        (Value::Float(value), Some(digits)) if (0..=300).contains(&digits) => {
            let text = format!("{value:.*}", digits as usize);
            text.parse().map(Value::Float).map_err(|_| wrong("round"))
        }
        (Value::Float(value), Some(digits)) if (-300..0).contains(&digits) => {
            let unit = 10f64.powi(-digits as i32);
            Ok(Value::Float((value / unit).round_ties_even() * unit))
        }
        (value, None | Some(0..=300)) => value.integer().map(Value::Int).ok_or_else(|| wrong("round")),
        _ => Err(wrong("round")),
    }
}

fn as_integer(value: f64) -> Result<Value> {
    if value.abs() < 1e38 {
        return Ok(Value::Int(value as i128));
    }
    Err(bad(format!("{value:e} is not an integer of at most 38 digits")))
}

/// A conversion of one value.
fn simple(name: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    let [value] = arguments else {
        return match (name, arguments) {
            ("str", []) => Ok(Value::text("")),
            ("int", []) => Ok(Value::Int(0)),
            ("float", []) => Ok(Value::Float(0.0)),
            ("bool", []) => Ok(Value::Bool(false)),
            ("int", [Value::Text(text), base]) => based(text, base),
            _ => Err(wrong(name)),
        };
    };
    match (name, value) {
        ("abs", Value::Float(value)) => Ok(Value::Float(value.abs())),
        ("abs", value) => value.integer().and_then(i128::checked_abs).map(Value::Int).ok_or_else(|| wrong(name)),
        ("bool", value) => Ok(Value::Bool(value.is_true())),
        ("float", Value::Text(text)) => parse_float(text).map(Value::Float).ok_or_else(|| not_number(text)),
        ("float", value) => value.number().map(Value::Float).ok_or_else(|| wrong(name)),
        ("int", Value::Text(text)) => parse_int(text).map(Value::Int).ok_or_else(|| not_number(text)),
        ("int", Value::Float(value)) => as_integer(value.trunc()),
        ("int", value) => value.integer().map(Value::Int).ok_or_else(|| wrong(name)),
        ("len", Value::Text(text)) => Ok(Value::Int(text.chars().count() as i128)),
        ("len", value) => Ok(Value::Int(items(value, budget)?.len() as i128)),
        ("repr", value) => {
            let mut out = String::new();
            value.write(&mut out, budget)?;
            Ok(Value::text(out))
        }
        (_, value) => value.shown(budget).map(Value::Text),
    }
}

fn not_number(text: &str) -> Error {
    bad(format!("`{}` is not a number", shown(text)))
}

fn based(text: &str, base: &Value) -> Result<Value> {
    let base = base.integer().and_then(|base| u32::try_from(base).ok()).filter(|base| (2..=36).contains(base));
    let text = text.trim().to_lowercase();
    let digits = match base {
        Some(16) => text.trim_start_matches("0x"),
        Some(2) => text.trim_start_matches("0b"),
        Some(8) => text.trim_start_matches("0o"),
        _ => &text,
    };
    let value = base.and_then(|base| i128::from_str_radix(digits, base).ok());
    value.map(Value::Int).ok_or_else(|| not_number(&text))
}

/// A function of lists.
fn of_lists(name: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    let lists = |budget: &mut Budget| arguments.iter().map(|list| items(list, budget)).collect::<Result<Vec<_>>>();
    let pair = |values: Vec<Value>| Value::Tuple(values.into());
    match (name, arguments) {
        ("list" | "tuple", []) => Ok(if name == "list" { Value::list(Vec::new()) } else { pair(Vec::new()) }),
        ("list", [list]) => items(list, budget).map(Value::list),
        ("tuple", [list]) => items(list, budget).map(pair),
        ("reversed", [list]) => Ok(Value::list(items(list, budget)?.into_iter().rev().collect())),
        ("all", [list]) => Ok(Value::Bool(items(list, budget)?.iter().all(Value::is_true))),
        ("any", [list]) => Ok(Value::Bool(items(list, budget)?.iter().any(Value::is_true))),
        ("sum", [list]) => {
            items(list, budget)?.iter().try_fold(Value::Int(0), |sum, value| binary(Operator::Add, &sum, value, budget))
        }
        ("enumerate", [list]) => {
            let numbered = items(list, budget)?.into_iter().enumerate();
            Ok(Value::list(numbered.map(|(at, value)| pair(vec![Value::Int(at as i128), value])).collect()))
        }
        ("zip", _) => {
            let lists = lists(budget)?;
            let length = lists.iter().map(Vec::len).min().unwrap_or(0);
            let row = |at: usize| pair(lists.iter().map(|list| list[at].clone()).collect());
            Ok(Value::list((0..length).map(row).collect()))
        }
        ("divmod", [a, b]) => {
            let quotient = binary(Operator::FloorDivide, a, b, budget)?;
            Ok(pair(vec![quotient, binary(Operator::Remainder, a, b, budget)?]))
        }
        ("isinstance", [value, Value::Function(kind)]) => {
            let kind = TYPES.iter().find(|(function, _)| function == kind).map(|(_, kind)| *kind);
            Ok(Value::Bool(kind == Some(value.kind()) || kind == Some("int") && value.kind() == "bool"))
        }
        ("range", _) => range(arguments, budget),
        ("tokenize", [Value::Text(text)]) => tokenized(text, ",; ", budget),
        ("tokenize", [Value::Text(text), Value::Text(separators)]) => tokenized(text, separators, budget),
        _ => Err(wrong(name)),
    }
}

fn tokenized(text: &str, separators: &str, budget: &mut Budget) -> Result<Value> {
    budget.spend_length(text.len())?;
    let parts = text.split(|c: char| separators.contains(c)).filter(|part| !part.is_empty());
    Ok(Value::list(parts.map(Value::text).collect()))
}

fn range(arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    let bounds: Option<Vec<i128>> = arguments.iter().map(Value::integer).collect();
    let (start, end, step) = match bounds.as_deref() {
        Some([end]) => (0, *end, 1),
        Some([start, end]) => (*start, *end, 1),
        Some([start, end, step]) if *step != 0 => (*start, *end, *step),
        _ => return Err(wrong("range")),
    };
    let span = if step > 0 { end.saturating_sub(start) } else { start.saturating_sub(end) };
    let length = usize::try_from((span.max(0) as u128).div_ceil(step.unsigned_abs())).unwrap_or(usize::MAX);
    budget.spend_length(length)?;
    Ok(Value::list((0..length as i128).map(|at| Value::Int(start + at * step)).collect()))
}

/// A function of `math`.
fn math(name: &str, arguments: &[Value]) -> Result<Value> {
    let numbers: Vec<f64> =
        arguments.iter().map(|value| value.number().ok_or_else(|| wrong(name))).collect::<Result<_>>()?;
    let value = match (name, numbers.as_slice()) {
        ("ceil" | "floor" | "trunc", [value]) => {
            return match arguments[0].integer() {
                Some(integer) => Ok(Value::Int(integer)),
                None => as_integer(of_one(name, *value)),
            };
        }
        ("isnan", [value]) => return Ok(Value::Bool(value.is_nan())),
        ("isinf", [value]) => return Ok(Value::Bool(value.is_infinite())),
        ("isfinite", [value]) => return Ok(Value::Bool(value.is_finite())),
        ("atan2", [y, x]) => y.atan2(*x),
        ("pow", [base, exponent]) => base.powf(*exponent),
        ("fmod", [a, b]) => a % b,
        ("copysign", [value, sign]) => value.copysign(*sign),
        ("hypot", [x, y]) => x.hypot(*y),
        ("log", [value, base]) => value.ln() / base.ln(),
        (_, [value]) => of_one(name, *value),
        _ => return Err(wrong(name)),
    };
    let is_finite = numbers.iter().all(|number| number.is_finite());
    if is_finite && !value.is_finite() {
        let text = format!("`{name}` is not defined for {numbers:?}, or its value is too large");
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(Value::Float(value))
}

/// The value of a function of one number; nan for an unknown function.
fn of_one(name: &str, value: f64) -> f64 {
    OF_ONE.iter().find(|(known, _)| *known == name).map_or(f64::NAN, |(_, function)| function(value))
}
