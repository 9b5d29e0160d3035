//! Valid names for X3D and VRML97. Main type: [`Names`].

use std::collections::HashMap;

use groebot_robot::document::word;

/// Words of VRML97 that cannot be names.
const RESERVED: &str = " DEF USE PROTO EXTERNPROTO ROUTE TO IS NULL TRUE FALSE eventIn eventOut exposedField field ";

/// Unique names, with the last number that was appended to each.
#[derive(Default)]
pub struct Names(HashMap<String, usize>);

impl Names {
    /// The unused name of letters, digits and underscores that is nearest to `name`.
    pub fn legal(&mut self, name: &str) -> String {
        let mut legal = word(name);
        if RESERVED.contains(&format!(" {legal} ")) {
            legal.push('_');
        }
        let (mut free, mut number) = (legal.clone(), self.0.get(&legal).copied().unwrap_or(1));
        while self.0.contains_key(&free) {
            number += 1;
            free = format!("{legal}_{number}");
        }
        self.0.insert(legal, number);
        self.0.entry(free.clone()).or_insert(1);
        free
    }
}
