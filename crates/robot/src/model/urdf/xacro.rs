//! Remains of xacro in a URDF, and unexpanded xacro.

use super::xml::{EXPAND, Element};
use crate::document::shown;
use crate::model::listing;
use crate::{Error, ErrorKind, Result};

/// The elements with xacro definitions.
const DEFINITIONS: [&str; 2] = ["xacro:property", "xacro:arg"];

/// Returns a note about unused xacro definitions.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for other xacro elements, and for `${...}` in a link or joint.
pub fn unused(root: &Element) -> Result<Vec<String>> {
    let own = || root.children.iter().filter(|child| child.name.starts_with("xacro:"));
    if let Some(other) = own().find(|child| !DEFINITIONS.contains(&child.name.as_str())) {
        return Err(is_xacro(other));
    }
    let mut described = root.children.iter().filter(|child| ["link", "joint"].contains(&child.name.as_str()));
    if let Some(error) = described.find_map(used) {
        return Err(error);
    }
    let names: Vec<&str> = own().map(|child| child.attribute("name").unwrap_or("")).collect();
    let line = own().next().map(|first| first.line);
    let note = |line| format!("line {line}: unused definitions of xacro are ignored: {}", listing(names.into_iter()));
    Ok(line.map(note).into_iter().collect())
}

/// The error for unexpanded xacro in `element`.
fn used(element: &Element) -> Option<Error> {
    if element.name.starts_with("xacro:") {
        return Some(is_xacro(element));
    }
    let found = element.attributes().find(|(_, value)| value.contains("${"));
    let error = |(name, value): (&str, &str)| {
        let text = format!("has `{name}` = \"{}\": `${{...}}` is xacro, {EXPAND}", shown(value));
        element.error(ErrorKind::Unsupported, &text)
    };
    found.map(error).or_else(|| element.children.iter().find_map(used))
}

fn is_xacro(element: &Element) -> Error {
    element.error(ErrorKind::Unsupported, &format!("is xacro, {EXPAND}"))
}
