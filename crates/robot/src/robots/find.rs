//! Search of a robot by its name. Main function: [`find`].

use super::{LISTED, Listed};
use crate::document::{did_you_mean, shown};
use crate::{Error, ErrorKind, Result};

/// The listed robot `name`.
///
/// # Errors
/// [`ErrorKind::UnknownName`] with similar names.
pub fn find(name: &str) -> Result<&'static Listed> {
    let unknown = || {
        let text = format!("no robot is called `{}`{}; `groebot robots` lists the names", shown(name), similar(name));
        Error::new(ErrorKind::UnknownName, text)
    };
    LISTED.iter().find(|listed| listed.name() == name).ok_or_else(unknown)
}

/// Maximum number of similar names in a message.
const SIMILAR: usize = 6;

/// ` (did you mean ...?)` with the names that contain `name`, else with the nearest name; empty when none is near.
fn similar(name: &str) -> String {
    let plain = |text: &str| text.replace(['_', '-', ' '], "").to_lowercase();
    let own = plain(name);
    let names: Vec<&str> = LISTED.iter().map(Listed::name).collect();
    let longer = |other: &&&str| own.len() > 1 && plain(other).contains(&own);
    let mut longer: Vec<&str> = names.iter().filter(longer).copied().collect();
    longer.sort_by_key(|other| !plain(other).starts_with(&own));
    let near: Vec<String> = longer.iter().take(SIMILAR).map(|other| format!("`{other}`")).collect();
    if near.is_empty() { did_you_mean(name, &names) } else { format!(" (did you mean {}?)", near.join(", ")) }
}
