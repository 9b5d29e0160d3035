//! The default tip link of a chain: [`TipChoice`].

use std::fmt;

use crate::model::{JointType, Robot, listing};
use crate::{Error, ErrorKind, Result};

/// Names of tip frames, the preferred one first. `tool0` and `flange` are those of ROS-Industrial.
const FRAMES: [&str; 4] = ["tool0", "flange", "tcp", "ee_link"];
/// A name that is suggested after those, but never used by default, because most robots with feet have several.
const FOOT: &str = "foot";
/// Words in the names of links that belong to one of several limbs.
const SIDES: [&str; 4] = ["left", "right", "l", "r"];
/// Characters between the words of a name.
const SEPARATORS: [char; 5] = ['_', '-', '.', '/', ':'];

/// The rule by which the tip link of a chain was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TipChoice {
    /// By name.
    Given,
    /// It is the only leaf link.
    OnlyLeaf,
    /// It is the only link with this name of a tip frame, except for a prefix: `tool0`, `robot_tool0`.
    OnlyFrame(&'static str),
}

/// `given`, `the only leaf link`, `the only tool0 link`.
impl fmt::Display for TipChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TipChoice::Given => f.write_str("given"),
            TipChoice::OnlyLeaf => f.write_str("the only leaf link"),
            TipChoice::OnlyFrame(name) => write!(f, "the only {name} link"),
        }
    }
}

impl Robot {
    /// The default tip link of chains from the link `base`: the only leaf, else the only link named `tool0`, `flange`,
    /// `tcp` or `ee_link`, in that order, with or without a prefix. A name that occurs several times, or with `left` or
    /// `right` in its prefix, ends the search, because the robot has several tips.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] with [suggestions](Robot::suggested_tips) when the default is not unique.
    pub(super) fn default_tip(&self, base: usize) -> Result<(usize, TipChoice)> {
        if let [leaf] = self.leaves().as_slice() {
            return Ok((self.link(leaf)?, TipChoice::OnlyLeaf));
        }
        let moved: Vec<usize> = (0..self.links().len()).filter(|&link| self.is_moved(base, link)).collect();
        let called = |frame: &&'static str| {
            let found: Vec<usize> = moved.iter().copied().filter(|&link| self.is_called(link, frame)).collect();
            (!found.is_empty()).then_some((*frame, found))
        };
        match FRAMES.iter().find_map(called) {
            Some((frame, found)) if found.len() == 1 && !has_side(&self.links()[found[0]].name) => {
                Ok((found[0], TipChoice::OnlyFrame(frame)))
            }
            _ => {
                let tips = listing(self.suggested_tips(base).into_iter());
                let message = format!("the robot has several leaf links; choose a tip link, such as {tips}");
                Err(Error::new(ErrorKind::MissingKey, message))
            }
        }
    }

    /// The possible tip links of a chain from the link with the index `base`, the likeliest first: leaves that move. If
    /// a tip frame carries moving links, such as the fingers of a gripper, the chain ends at the frame. If no leaf
    /// moves, all leaves are returned.
    pub fn suggested_tips(&self, base: usize) -> Vec<&str> {
        let leaves = self.leaves();
        let moved: Vec<usize> = (0..self.links().len()).filter(|&link| self.is_moved(base, link)).collect();
        let carries = |link: &usize| self.is_frame(*link) && self.moves_below(*link);
        let frames: Vec<usize> = moved.iter().copied().filter(carries).collect();
        let is_of_tool =
            |link: usize| frames.iter().any(|&frame| self.is_below(link, frame) && self.is_moved(frame, link));
        let is_leaf = |link: usize| leaves.contains(&self.links()[link].name.as_str()) && !is_of_tool(link);
        let mut tips: Vec<usize> =
            moved.iter().copied().filter(|link| frames.contains(link) || is_leaf(*link)).collect();
        tips.sort_by_key(|&link| self.rank(link));
        if tips.is_empty() { leaves } else { tips.into_iter().map(|link| self.links()[link].name.as_str()).collect() }
    }

    /// The rank of a link's name among those of tip frames.
    fn rank(&self, link: usize) -> usize {
        let names = || FRAMES.iter().chain([&FOOT]);
        names().position(|name| self.is_called(link, name)).unwrap_or(names().count())
    }

    fn is_frame(&self, link: usize) -> bool {
        self.rank(link) < FRAMES.len()
    }

    /// Whether the name of a link is `word`, or a prefix followed by it.
    fn is_called(&self, link: usize, word: &str) -> bool {
        let name = self.links()[link].name.to_ascii_lowercase();
        name.strip_suffix(word).is_some_and(|prefix| prefix.is_empty() || prefix.ends_with(SEPARATORS))
    }

    /// Whether a joint between the two links moves.
    fn is_moved(&self, base: usize, link: usize) -> bool {
        self.between(base, link).iter().any(|(joint, _)| self.joints()[*joint].kind != JointType::Fixed)
    }

    /// Whether a joint below `link` moves.
    fn moves_below(&self, link: usize) -> bool {
        let moves = |joint: usize| self.joints()[joint].kind != JointType::Fixed;
        (0..self.joints().len()).any(|joint| moves(joint) && self.is_below(self.ends(joint).1, link))
    }

    /// Whether the link `above` carries `link`.
    fn is_below(&self, link: usize, above: usize) -> bool {
        self.ancestry(link).into_iter().any(|joint| self.ends(joint).0 == above)
    }
}

/// Whether a word of the name shows that the link belongs to one of several limbs.
fn has_side(name: &str) -> bool {
    name.split(SEPARATORS).any(|word| SIDES.iter().any(|side| word.eq_ignore_ascii_case(side)))
}
