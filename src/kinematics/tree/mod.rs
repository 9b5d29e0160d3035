//! A robot as a tree of links and joints, checked, as a URDF describes it. Main type: [`Tree`]; [`Tree::chain`] cuts chains out.

mod outline;
mod path;
mod telescope;

use std::collections::HashMap;

pub use path::TreePath;

use super::validate::{is_plain, joint_message};
use super::{ExactVector, Mimic, Placement};
use crate::document::{did_you_mean, shown};
use crate::number::BigRational;
use crate::{Error, ErrorKind, Result};

const MAX_NAME: usize = 200;
/// How many joints may follow in turn.
const MAX_FOLLOWERS: usize = 100;
/// How many names a message lists.
const LISTED: usize = 12;

/// One rigid body. Its frame is the frame of the joint above it.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeLink {
    /// Its name, unique in the tree.
    pub name: String,
    /// The line of the file where it stands.
    pub line: Option<usize>,
}

/// How a joint of a tree moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeJointKind {
    /// Not at all.
    Fixed,
    /// It turns about its axis, between limits.
    Revolute,
    /// It turns about its axis without limits.
    Continuous,
    /// It slides along its axis.
    Prismatic,
    /// In all six directions; no chain can have one.
    Floating,
    /// In a plane; no chain can have one.
    Planar,
}

impl TreeJointKind {
    /// Its name in a URDF: `fixed`, `revolute`, `continuous`, `prismatic`, `floating` or `planar`.
    pub fn name(self) -> &'static str {
        match self {
            TreeJointKind::Fixed => "fixed",
            TreeJointKind::Revolute => "revolute",
            TreeJointKind::Continuous => "continuous",
            TreeJointKind::Prismatic => "prismatic",
            TreeJointKind::Floating => "floating",
            TreeJointKind::Planar => "planar",
        }
    }

    /// Whether it has an axis.
    pub fn has_axis(self) -> bool {
        !matches!(self, TreeJointKind::Fixed | TreeJointKind::Floating)
    }
}

/// A joint between two links. Metres and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeJoint {
    /// Its name, unique in the tree.
    pub name: String,
    /// How it moves.
    pub kind: TreeJointKind,
    /// The link that it hangs on.
    pub parent: String,
    /// The link that it moves.
    pub child: String,
    /// Its frame in the parent's frame, at the value zero.
    pub origin: Placement,
    /// The direction of its axis in its own frame, of any length; not looked at when it has none.
    pub axis: ExactVector,
    /// Least and greatest value.
    pub limits: Option<(f64, f64)>,
    /// The joint that it follows.
    pub mimic: Option<Mimic>,
    /// What the reader made of its numbers.
    pub notes: Vec<String>,
    /// The line of the file where it stands.
    pub line: Option<usize>,
}

impl TreeJoint {
    /// An error about this joint, with its name and line.
    pub(super) fn error(&self, kind: ErrorKind, message: &str) -> Error {
        let error = Error::new(kind, joint_message(&self.name, message));
        if let Some(line) = self.line { error.at_line(line) } else { error }
    }
}

/// A checked tree of links. It never changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    name: String,
    links: Vec<TreeLink>,
    joints: Vec<TreeJoint>,
    /// The joint above each link.
    above: Vec<Option<usize>>,
    /// The parent and child link of each joint.
    ends: Vec<(usize, usize)>,
    root: usize,
}

impl Tree {
    /// Checks links and joints and makes them a tree.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`] for two links or two joints of one name; [`ErrorKind::UnknownName`] for a joint between links
    /// that do not exist, or that follows no joint; [`ErrorKind::BadValue`] for no or several roots, a loop, an axis of zero,
    /// missing, inverted or infinite limits, a joint that follows itself in the end, an empty name. All with name and line.
    pub fn new(name: String, links: Vec<TreeLink>, joints: Vec<TreeJoint>) -> Result<Self> {
        check_name(&name, None, "robot")?;
        let link_index = index_links(&links)?;
        let joint_index = index_joints(&joints)?;
        for joint in &joints {
            check_motion(joint)?;
            check_mimic(joint, &joints, &joint_index)?;
        }
        let ends = joints.iter().map(|joint| ends_of(joint, &links, &link_index)).collect::<Result<Vec<_>>>()?;
        let above = parents(&links, &joints, &ends)?;
        let root = root_of(&links, &above)?;
        let tree = Tree { name, links, joints, above, ends, root };
        tree.check_connected()?;
        Ok(tree)
    }

    /// The name of the robot.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All links, in the order of the file.
    pub fn links(&self) -> &[TreeLink] {
        &self.links
    }

    /// All joints, in the order of the file.
    pub fn joints(&self) -> &[TreeJoint] {
        &self.joints
    }

    /// The link that hangs on none.
    pub fn root(&self) -> &str {
        &self.links[self.root].name
    }

    /// The links that carry none, in the order of the file.
    pub fn leaves(&self) -> Vec<&str> {
        let children = self.children();
        let leaves = self.links.iter().zip(&children).filter(|(_, joints)| joints.is_empty());
        leaves.map(|(link, _)| link.name.as_str()).collect()
    }

    /// The links that end a limb: moved by the joint above them, with no moving joint below.
    pub fn tips(&self) -> Vec<&str> {
        let mut moves_below = vec![false; self.links.len()];
        for (index, joint) in self.joints.iter().enumerate() {
            let mut link = (joint.kind != TreeJointKind::Fixed).then_some(self.ends[index].0);
            while let Some(place) = link.filter(|place| !moves_below[*place]) {
                moves_below[place] = true;
                link = self.above[place].map(|joint| self.ends[joint].0);
            }
        }
        let is_tip = |link: usize| {
            let moved = self.above[link].is_some_and(|joint| self.joints[joint].kind != TreeJointKind::Fixed);
            moved && !moves_below[link]
        };
        (0..self.links.len()).filter(|link| is_tip(*link)).map(|link| self.links[link].name.as_str()).collect()
    }

    /// The joints that hang on each link.
    fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.links.len()];
        for (joint, (parent, _)) in self.ends.iter().enumerate() {
            children[*parent].push(joint);
        }
        children
    }

    /// Every link must be below the root: the others form loops.
    fn check_connected(&self) -> Result<()> {
        let children = self.children();
        let mut reached = vec![false; self.links.len()];
        let mut open = vec![self.root];
        while let Some(link) = open.pop() {
            reached[link] = true;
            open.extend(children[link].iter().map(|joint| self.ends[*joint].1));
        }
        match self.ends.iter().position(|(_, child)| !reached[*child]) {
            None => Ok(()),
            Some(joint) => {
                let message = "it is part of a loop of links; a robot must be a tree";
                Err(self.joints[joint].error(ErrorKind::BadValue, message))
            }
        }
    }
}

/// Names for a message: all of them, or some and how many more.
fn listing<'n>(names: impl ExactSizeIterator<Item = &'n str>) -> String {
    let more = names.len().saturating_sub(LISTED);
    let names: Vec<String> = names.take(LISTED).map(|name| format!("`{}`", shown(name))).collect();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{more}", names.join(", "))
}

/// The end of a message about an unknown `name`: the nearest of `allowed`, and some of them.
fn some_among<'n>(name: &str, allowed: impl Iterator<Item = &'n str>) -> String {
    let allowed: Vec<&str> = allowed.collect();
    format!("{}; allowed: {}", did_you_mean(name, &allowed), listing(allowed.into_iter()))
}

fn check_name(name: &str, line: Option<usize>, what: &str) -> Result<()> {
    if is_plain(name, MAX_NAME) && !name.trim().is_empty() && !name.contains(['\n', '\t']) {
        return Ok(());
    }
    let message = format!("the {what}'s name is `{}`; give 1 to {MAX_NAME} visible characters", shown(name));
    let error = Error::new(ErrorKind::BadValue, message);
    Err(if let Some(line) = line { error.at_line(line) } else { error })
}

fn index_links(links: &[TreeLink]) -> Result<HashMap<&str, usize>> {
    let mut index = HashMap::new();
    for (place, link) in links.iter().enumerate() {
        check_name(&link.name, link.line, "link")?;
        if index.insert(link.name.as_str(), place).is_some() {
            let message = format!("link `{}`: its name is taken; give each link its own", shown(&link.name));
            let error = Error::new(ErrorKind::DuplicateName, message);
            return Err(if let Some(line) = link.line { error.at_line(line) } else { error });
        }
    }
    Ok(index)
}

fn index_joints(joints: &[TreeJoint]) -> Result<HashMap<&str, usize>> {
    let mut index = HashMap::new();
    for (place, joint) in joints.iter().enumerate() {
        check_name(&joint.name, joint.line, "joint")?;
        if index.insert(joint.name.as_str(), place).is_some() {
            return Err(joint.error(ErrorKind::DuplicateName, "its name is taken; give each joint its own"));
        }
    }
    Ok(index)
}

fn check_motion(joint: &TreeJoint) -> Result<()> {
    let bad = |message: &str| Err(joint.error(ErrorKind::BadValue, message));
    let is_zero = |x: &BigRational| *x == BigRational::default();
    if joint.kind.has_axis() && joint.axis.iter().all(is_zero) {
        return bad("axis [0, 0, 0] has no direction; give a non-zero vector");
    }
    match joint.limits {
        None if joint.kind == TreeJointKind::Revolute => {
            bad("a revolute joint needs limits; give <limit lower upper>, or the type `continuous`")
        }
        None if joint.kind == TreeJointKind::Prismatic => {
            bad("a prismatic joint needs limits; give <limit lower upper>")
        }
        Some((low, high)) if !(low.is_finite() && high.is_finite()) => {
            bad("the limits are not finite; give finite ones")
        }
        Some((low, high)) if low > high => {
            bad(&format!("the limits {low}..{high} are inverted; give the lower limit first"))
        }
        _ => Ok(()),
    }
}

/// The leader must exist, and following leaders must come to an end.
fn check_mimic(joint: &TreeJoint, joints: &[TreeJoint], index: &HashMap<&str, usize>) -> Result<()> {
    let (mut follower, mut steps) = (joint, 0);
    while let Some(mimic) = &follower.mimic {
        let Some(leader) = index.get(mimic.leader.as_str()) else {
            let names = some_among(&mimic.leader, joints.iter().map(|joint| joint.name.as_str()));
            let message = format!("it mimics `{}`, which is no joint{names}", shown(&mimic.leader));
            return Err(follower.error(ErrorKind::UnknownName, &message));
        };
        (follower, steps) = (&joints[*leader], steps + 1);
        if steps > MAX_FOLLOWERS || follower.name == joint.name {
            let message = format!(
                "the joints that it mimics mimic one another, or are more than {MAX_FOLLOWERS}; let one of them lead"
            );
            return Err(joint.error(ErrorKind::BadValue, &message));
        }
    }
    Ok(())
}

fn ends_of(joint: &TreeJoint, links: &[TreeLink], index: &HashMap<&str, usize>) -> Result<(usize, usize)> {
    let find = |what: &str, name: &str| {
        index.get(name).copied().ok_or_else(|| {
            let names = some_among(name, links.iter().map(|link| link.name.as_str()));
            let message = format!("its {what} `{}` is no link{names}", shown(name));
            joint.error(ErrorKind::UnknownName, &message)
        })
    };
    Ok((find("parent", &joint.parent)?, find("child", &joint.child)?))
}

/// The joint above each link; a link with two is in a loop.
fn parents(links: &[TreeLink], joints: &[TreeJoint], ends: &[(usize, usize)]) -> Result<Vec<Option<usize>>> {
    let mut above: Vec<Option<usize>> = vec![None; links.len()];
    for (place, joint) in joints.iter().enumerate() {
        if let Some(other) = above[ends[place].1].replace(place) {
            let (child, other) = (shown(&joint.child), shown(&joints[other].name));
            let message =
                format!("its child `{child}` hangs on joint `{other}` already; a robot must be a tree, without loops");
            return Err(joint.error(ErrorKind::BadValue, &message));
        }
    }
    Ok(above)
}

fn root_of(links: &[TreeLink], above: &[Option<usize>]) -> Result<usize> {
    let roots: Vec<usize> = (0..links.len()).filter(|link| above[*link].is_none()).collect();
    match roots.as_slice() {
        [root] => Ok(*root),
        [] if links.is_empty() => Err(Error::new(ErrorKind::MissingKey, "the robot has no <link>; give at least one")),
        [] => Err(Error::new(ErrorKind::BadValue, "every link hangs on another one: a loop; a robot must be a tree")),
        _ => {
            let names = listing(roots.iter().map(|root| links[*root].name.as_str()));
            let message = format!("{} links hang on no joint: {names}; connect all but one of them", roots.len());
            Err(Error::new(ErrorKind::BadValue, message))
        }
    }
}
