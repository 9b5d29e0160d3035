//! Methods of texts, lists and dicts, slices, and texts with `%`.

use super::value::{Value, bad};
use crate::model::xacro::budget::Budget;
use crate::{Error, ErrorKind, Result};

/// The methods of texts.
const TEXT: [&str; 17] = [
    "lower",
    "upper",
    "strip",
    "lstrip",
    "rstrip",
    "split",
    "replace",
    "startswith",
    "endswith",
    "join",
    "find",
    "count",
    "capitalize",
    "title",
    "isdigit",
    "index",
    "zfill",
];
/// The methods of dicts.
const DICT: [&str; 4] = ["get", "keys", "values", "items"];
/// The methods of lists.
const LIST: [&str; 2] = ["index", "count"];

/// Whether `owner` has the method `name`.
pub fn is_method(owner: &Value, name: &str) -> bool {
    match owner {
        Value::Text(_) => TEXT.contains(&name),
        Value::Dict(_) => DICT.contains(&name),
        Value::List(_) | Value::Tuple(_) => LIST.contains(&name),
        _ => false,
    }
}

/// Calls a method.
///
/// # Errors
/// [`ErrorKind::BadValue`] for wrong arguments and above the limits.
pub fn call(owner: &Value, name: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    match owner {
        Value::Text(text) => text_method(text, name, arguments, budget),
        Value::Dict(entries) => dict_method(entries, name, arguments, budget),
        Value::List(list) | Value::Tuple(list) => list_method(list, name, arguments, budget),
        _ => Err(bad(format!("a {} has no methods", owner.kind()))),
    }
}

fn text_method(text: &str, name: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    budget.spend_length(text.len())?;
    let given: Option<Vec<&str>> =
        arguments.iter().map(|value| if let Value::Text(text) = value { Some(&**text) } else { None }).collect();
    let cut = |part: &str| -> String { part.to_owned() };
    let set = |set: &str| -> Vec<char> { set.chars().collect() };
    let value = match (name, given.as_deref()) {
        ("lower", Some([])) => Value::text(text.to_lowercase()),
        ("upper", Some([])) => Value::text(text.to_uppercase()),
        ("capitalize", Some([])) => Value::text(capitalized(text)),
        ("title", Some([])) => {
            Value::text(text.split_inclusive(|c: char| !c.is_alphabetic()).map(capitalized).collect::<String>())
        }
        ("isdigit", Some([])) => Value::Bool(!text.is_empty() && text.chars().all(|c| c.is_ascii_digit())),
        ("strip", Some([])) => Value::text(cut(text.trim())),
        ("lstrip", Some([])) => Value::text(cut(text.trim_start())),
        ("rstrip", Some([])) => Value::text(cut(text.trim_end())),
        ("strip", Some([letters])) => Value::text(cut(text.trim_matches(&set(letters)[..]))),
        ("lstrip", Some([letters])) => Value::text(cut(text.trim_start_matches(&set(letters)[..]))),
        ("rstrip", Some([letters])) => Value::text(cut(text.trim_end_matches(&set(letters)[..]))),
        ("split", Some([])) => texts(text.split_whitespace()),
        ("split", Some([separator])) if !separator.is_empty() => texts(text.split(separator)),
        ("startswith", Some([start])) => Value::Bool(text.starts_with(start)),
        ("endswith", Some([end])) => Value::Bool(text.ends_with(end)),
        ("count", Some([part])) if !part.is_empty() => Value::Int(text.matches(part).count() as i128),
        ("find", Some([part])) => Value::Int(text.find(part).map_or(-1, |at| text[..at].chars().count() as i128)),
        ("index", Some([part])) if text.contains(part) => {
            Value::Int(text.find(part).map_or(-1, |at| text[..at].chars().count() as i128))
        }
        ("replace", Some([old, new])) if !old.is_empty() => {
            let length = text.len().saturating_add(text.matches(old).count().saturating_mul(new.len()));
            budget.spend_length(length)?;
            Value::text(text.replace(old, new))
        }
        ("join", _) => return join(text, arguments, budget),
        ("zfill", _) => return zero_filled(text, arguments, budget),
        _ => return Err(bad(format!("`{name}` of a text does not take these arguments"))),
    };
    Ok(value)
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or(String::new(), |first| first.to_uppercase().chain(letters.flat_map(char::to_lowercase)).collect())
}

fn texts<'t>(parts: impl Iterator<Item = &'t str>) -> Value {
    Value::list(parts.map(Value::text).collect())
}

fn join(separator: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    let [list] = arguments else { return Err(bad("`join` takes one list of texts".to_owned())) };
    let mut out = String::new();
    for (index, item) in items(list, budget)?.iter().enumerate() {
        let Value::Text(text) = item else { return Err(bad("`join` takes one list of texts".to_owned())) };
        out += if index > 0 { separator } else { "" };
        out += text;
        budget.spend(text.len())?;
        crate::model::xacro::budget::check_length(out.len())?;
    }
    Ok(Value::text(out))
}

fn zero_filled(text: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    let width = arguments.first().and_then(Value::integer).and_then(|width| usize::try_from(width).ok()).unwrap_or(0);
    budget.spend_length(width)?;
    let sign = if text.starts_with(['+', '-']) { &text[..1] } else { "" };
    let zeros = "0".repeat(width.saturating_sub(text.chars().count()));
    Ok(Value::text(format!("{sign}{zeros}{}", &text[sign.len()..])))
}

fn dict_method(entries: &[(Value, Value)], name: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    budget.spend_length(entries.len())?;
    Ok(match (name, arguments) {
        ("keys", []) => Value::list(entries.iter().map(|(key, _)| key.clone()).collect()),
        ("values", []) => Value::list(entries.iter().map(|(_, value)| value.clone()).collect()),
        ("items", []) => Value::list(
            entries.iter().map(|(key, value)| Value::Tuple(vec![key.clone(), value.clone()].into())).collect(),
        ),
        ("get", [key]) => Value::entry(entries, key, budget)?.unwrap_or(Value::None),
        ("get", [key, other]) => Value::entry(entries, key, budget)?.unwrap_or_else(|| other.clone()),
        _ => return Err(bad(format!("`{name}` of a dict does not take these arguments"))),
    })
}

fn list_method(list: &[Value], name: &str, arguments: &[Value], budget: &mut Budget) -> Result<Value> {
    let [wanted] = arguments else { return Err(bad(format!("`{name}` of a list takes one argument"))) };
    let mut places = Vec::new();
    for (place, item) in list.iter().enumerate() {
        if item.equals(wanted, budget)? {
            places.push(place as i128);
        }
    }
    match (name, places.first()) {
        ("count", _) => Ok(Value::Int(places.len() as i128)),
        (_, Some(place)) => Ok(Value::Int(*place)),
        _ => Err(bad("`index` finds no such entry in the list".to_owned())),
    }
}

/// Adds an entry to a dict, or replaces it.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a list or dict as key.
pub fn insert(entries: &mut Vec<(Value, Value)>, key: Value, value: Value, budget: &mut Budget) -> Result<()> {
    if matches!(key, Value::List(_) | Value::Dict(_)) {
        return Err(bad(format!("a {} is not a key; give a text or a number", key.kind())));
    }
    for (known, old) in entries.iter_mut() {
        if known.equals(&key, budget)? {
            *old = value;
            return Ok(());
        }
    }
    budget.spend_length(entries.len())?;
    entries.push((key, value));
    Ok(())
}

/// The entries of a list, the letters of a text, or the keys of a dict.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another type.
pub fn items(value: &Value, budget: &mut Budget) -> Result<Vec<Value>> {
    let items: Vec<Value> = match value {
        Value::List(list) | Value::Tuple(list) => list.to_vec(),
        Value::Text(text) => text.chars().map(|c| Value::text(c.to_string())).collect(),
        Value::Dict(entries) => entries.iter().map(|(key, _)| key.clone()).collect(),
        _ => return Err(bad(format!("a {} has no entries; give a list", value.kind()))),
    };
    budget.spend_length(items.len())?;
    Ok(items)
}

/// The place of an index, which is negative from the end, in a list of `length`.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another type and outside of the list.
pub fn position(length: usize, index: &Value) -> Result<usize> {
    let Some(index) = index.integer() else {
        return Err(bad(format!("a {} is not an index; give an integer", index.kind())));
    };
    let place = if index < 0 { index.checked_add(length as i128) } else { Some(index) };
    let place = place.and_then(|place| usize::try_from(place).ok()).filter(|place| *place < length);
    place.ok_or_else(|| bad(format!("the index {index} is outside of a list of {length}")))
}

/// The slice `[start:end:step]` of a list or text.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another type, and for a step of zero.
pub fn slice(owner: &Value, bounds: &[Option<Value>; 3], budget: &mut Budget) -> Result<Value> {
    let whole = items(owner, budget)?;
    let integer = |bound: &Option<Value>| match bound {
        None => Ok(None),
        Some(bound) => bound.integer().map(Some).ok_or_else(|| bad("a slice takes integers".to_owned())),
    };
    let step = integer(&bounds[2])?.unwrap_or(1);
    if step == 0 {
        return Err(bad("a slice has a step of zero; give another step".to_owned()));
    }
    let length = whole.len() as i128;
    let (low, high) = if step > 0 { (0, length) } else { (-1, length - 1) };
    let at = |bound: Option<i128>, absent| match bound {
        None => absent,
        Some(place) if place < 0 => place.saturating_add(length).clamp(low, high),
        Some(place) => place.clamp(low, high),
    };
    let (start, end) = if step > 0 { (low, high) } else { (high, low) };
    let (mut place, end) = (at(integer(&bounds[0])?, start), at(integer(&bounds[1])?, end));
    let mut part = Vec::new();
    while if step > 0 { place < end } else { place > end } {
        part.extend(usize::try_from(place).ok().and_then(|place| whole.get(place).cloned()));
        place = place.saturating_add(step);
    }
    match owner {
        Value::List(_) => Ok(Value::list(part)),
        Value::Tuple(_) => Ok(Value::Tuple(part.into())),
        Value::Text(_) => join("", &[Value::list(part)], budget),
        _ => Err(bad(format!("a {} has no slice; give a list or a text", owner.kind()))),
    }
}

/// The text of `format % value`, with the conversions `%s`, `%d`, `%i`, `%f`, `%e`, `%g` with width and precision, and
/// `%%`.
///
/// # Errors
/// [`ErrorKind::BadValue`] for other conversions, and for missing or additional values.
pub fn formatted(format: &str, value: &Value, budget: &mut Budget) -> Result<String> {
    let values = match value {
        Value::Tuple(values) => values.to_vec(),
        value => vec![value.clone()],
    };
    let mut values = values.iter();
    let mut out = String::new();
    let mut parts = format.split('%');
    out += parts.next().unwrap_or("");
    while let Some(part) = parts.next() {
        if part.is_empty() {
            out.push('%');
            out += parts.next().unwrap_or("");
            continue;
        }
        let at = part.find(|c: char| c.is_ascii_alphabetic());
        let at = at.ok_or_else(|| conversion(part))?;
        let value = values.next().ok_or_else(|| bad("a value is missing for `%`".to_owned()))?;
        out += &converted(&part[..at], part.as_bytes()[at], value, budget)?;
        out += &part[at + 1..];
        budget.spend_length(out.len())?;
    }
    if values.next().is_some() {
        return Err(bad("more values than `%` are given".to_owned()));
    }
    Ok(out)
}

fn conversion(part: &str) -> Error {
    let text = format!("`%{}` is not supported; give %s, %d, %f or %e", crate::document::shown(part));
    Error::new(ErrorKind::Unsupported, text)
}

/// The text of one value. `options` are the zero, the width and the precision.
fn converted(options: &str, letter: u8, value: &Value, budget: &mut Budget) -> Result<String> {
    let bad_options = || conversion(options);
    let (width, precision) = options.split_once('.').unwrap_or((options, ""));
    let is_zero = width.starts_with('0');
    let width: usize = if width.is_empty() { 0 } else { width.parse().map_err(|_| bad_options())? };
    let precision = if precision.is_empty() { None } else { Some(precision.parse().map_err(|_| bad_options())?) };
    if width > 1000 || precision.is_some_and(|precision: usize| precision > 1000) {
        return Err(bad_options());
    }
    let number = || value.number().ok_or_else(|| bad(format!("a {} is not a number", value.kind())));
    let text = match letter {
        b's' => {
            let text = value.shown(budget)?;
            text.chars().take(precision.unwrap_or(usize::MAX)).collect()
        }
        b'd' | b'i' if value.integer().is_some() => value.integer().unwrap_or(0).to_string(),
        b'd' | b'i' => format!("{:.0}", number()?.trunc()),
        b'f' | b'F' => format!("{:.*}", precision.unwrap_or(6), number()?),
        b'e' => {
            let text = format!("{:.*e}", precision.unwrap_or(6), number()?);
            let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let (sign, exponent) = exponent.strip_prefix('-').map_or(('+', exponent), |exponent| ('-', exponent));
            format!("{digits}e{sign}{exponent:0>2}")
        }
        _ => return Err(conversion(&format!("{options}{}", letter as char))),
    };
    let sign = if is_zero && letter != b's' && text.starts_with('-') { "-" } else { "" };
    let digits = &text[sign.len()..];
    let width = width.saturating_sub(sign.len());
    Ok(if is_zero && letter != b's' { format!("{sign}{digits:0>width$}") } else { format!("{text:>width$}") })
}
