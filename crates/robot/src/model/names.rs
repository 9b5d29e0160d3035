//! Names of links and joints that have none in the file. Main type: [`Names`].

use std::collections::{HashMap, HashSet};

use super::urdf::xml::Element;

/// The names in use.
#[derive(Default)]
pub struct Names {
    links: HashSet<String>,
    joints: HashSet<String>,
    /// The number after the last one that was tried for a name.
    next: HashMap<String, u64>,
}

impl Names {
    /// The names of all bodies and joints of an MJCF.
    pub fn of_mjcf(root: &Element) -> Names {
        let mut names = Names::default();
        names.collect(root);
        names
    }

    fn collect(&mut self, element: &Element) {
        for child in &element.children {
            if let Some(name) = child.attribute("name") {
                match child.name.as_str() {
                    "body" => _ = self.links.insert(name.to_owned()),
                    "joint" | "freejoint" => _ = self.joints.insert(name.to_owned()),
                    _ => {}
                }
            }
            if child.name != "default" {
                self.collect(child);
            }
        }
    }

    /// An unused name for a link: `wanted`, or `wanted` and a number.
    pub fn link(&mut self, wanted: &str) -> String {
        unused(&mut self.links, &mut self.next, wanted)
    }

    /// An unused name for a joint: `wanted`, or `wanted` and a number.
    pub fn joint(&mut self, wanted: &str) -> String {
        unused(&mut self.joints, &mut self.next, wanted)
    }

    /// Records a name of the file for a link.
    pub fn take_link(&mut self, name: &str) {
        self.links.insert(name.to_owned());
    }

    /// Records a name of the file for a joint.
    pub fn take_joint(&mut self, name: &str) {
        self.joints.insert(name.to_owned());
    }

    /// Whether a link has this name.
    pub fn has_link(&self, name: &str) -> bool {
        self.links.contains(name)
    }
}

fn unused(taken: &mut HashSet<String>, next: &mut HashMap<String, u64>, wanted: &str) -> String {
    if taken.insert(wanted.to_owned()) {
        return wanted.to_owned();
    }
    let number = next.entry(wanted.to_owned()).or_insert(1);
    loop {
        *number += 1;
        let name = format!("{wanted}_{number}");
        if taken.insert(name.clone()) {
            return name;
        }
    }
}
