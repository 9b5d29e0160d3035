//! Names that X3D and VRML97 take. Main type: [`Names`].

use std::collections::HashSet;

use crate::document::word;

/// Words of VRML97 that cannot be names.
const RESERVED: &str = " DEF USE PROTO EXTERNPROTO ROUTE TO IS NULL TRUE FALSE eventIn eventOut exposedField field ";

/// Names that are given once each.
#[derive(Default)]
pub struct Names(HashSet<String>);

impl Names {
    /// The name of letters, digits and lines that is nearest to `name` and not yet given.
    pub fn legal(&mut self, name: &str) -> String {
        let mut legal = word(name);
        if RESERVED.contains(&format!(" {legal} ")) {
            legal.push('_');
        }
        let numbered = (2..).map(|number| format!("{legal}_{number}"));
        let free = std::iter::once(legal.clone()).chain(numbered).find(|name| !self.0.contains(name));
        let free = free.expect("numbers do not end");
        self.0.insert(free.clone());
        free
    }
}
