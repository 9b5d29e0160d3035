//! The tree of a robot as text: one line for each link, indented below its parent.

use std::fmt;

use super::{Joint, JointType, Robot};
use crate::document::shown;

impl Robot {
    /// The lines of the tree: the branch with the link's name, and the motion of its joint.
    pub fn outline(&self) -> Vec<(String, String)> {
        let children = self.children();
        let mut lines = vec![(shown(self.root()), String::new())];
        let mut open: Vec<(usize, String, bool)> = Vec::new();
        let push = |open: &mut Vec<(usize, String, bool)>, link: usize, stem: &str| {
            let last = children[link].len();
            let joints = children[link].iter().enumerate().rev();
            open.extend(joints.map(|(place, joint)| (*joint, stem.to_owned(), place + 1 == last)));
        };
        push(&mut open, self.root_place(), "");
        while let Some((joint, stem, is_last)) = open.pop() {
            let link = self.ends(joint).1;
            let (branch, below) =
                if is_last { ("\u{2514}\u{2500} ", "   ") } else { ("\u{251c}\u{2500} ", "\u{2502}  ") };
            lines.push((format!("{stem}{branch}{}", shown(&self.links()[link].name)), motion(&self.joints()[joint])));
            // Beyond this depth the indentation is constant, so that the text of a very deep tree has linear size.
            let deeper = if stem.chars().count() < 120 { stem + below } else { stem };
            push(&mut open, link, &deeper);
        }
        lines
    }
}

/// `LKneePitch, revolute, follows LHipPitch`; empty for a fixed joint.
fn motion(joint: &Joint) -> String {
    if joint.kind == JointType::Fixed {
        return String::new();
    }
    let follows = joint.mimic.as_ref().map(|mimic| format!(", follows {}", shown(&mimic.leader))).unwrap_or_default();
    format!("{}, {}{follows}", shown(&joint.name), joint.kind.name())
}

/// The tree, with the joints' names next to the links that they move.
impl fmt::Display for Robot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = self.outline();
        let width = lines.iter().map(|(branch, _)| branch.chars().count()).max().unwrap_or(0);
        let text: Vec<String> =
            lines.iter().map(|(branch, motion)| format!("{branch:<width$}  {motion}").trim_end().to_owned()).collect();
        f.write_str(&text.join("\n"))
    }
}
