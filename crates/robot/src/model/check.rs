//! Validation of the parts of [`Robot::new`](super::Robot::new).

use std::collections::{HashMap, HashSet};

use super::finite;
use super::{Actuator, Fault, Joint, JointType, Link, Part, RobotParts};
use crate::document::{did_you_mean, shown};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::escape::is_hidden;
use groebot_algebra::limits;
use groebot_algebra::number::BigRational;

/// Maximum length of a chain of mimic joints.
const MAX_FOLLOWERS: usize = limits::FOLLOWERS;
/// Maximum number of names in a message.
const LISTED: usize = 12;

/// Names for a message: all, or some with the number of the others.
pub(crate) fn listing<'n>(names: impl ExactSizeIterator<Item = &'n str>) -> String {
    let more = names.len().saturating_sub(LISTED);
    let names: Vec<String> = names.take(LISTED).map(|name| format!("`{}`", shown(name))).collect();
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{more}", names.join(", "))
}

/// The end of a message about an unknown `name`: the nearest of `allowed`, and some of them.
pub(crate) fn some_among<'n>(name: &str, allowed: impl Iterator<Item = &'n str>) -> String {
    let allowed: Vec<&str> = allowed.collect();
    format!("{}; allowed: {}", did_you_mean(name, &allowed), listing(allowed.into_iter()))
}

/// Whether `text` has at most `limit` characters and no control characters except line ends and tabs.
pub(crate) fn is_plain(text: &str, limit: usize) -> bool {
    text.chars().count() <= limit && !text.chars().any(|c| is_hidden(c) && c != '\n' && c != '\t')
}

/// Checks everything except the tree structure. Returns the indices of the parent and the child link of each joint.
/// Errors of a single joint or actuator are added to the faults. Such a joint loses its mimic law, and such an actuator
/// is removed.
pub fn parts(parts: &mut RobotParts) -> Result<Vec<(usize, usize)>> {
    check_name(&parts.name, None, "robot")?;
    let links = index_links(&parts.links)?;
    let joints = index_joints(&parts.joints)?;
    let ends = parts.joints.iter().map(|joint| ends_of(joint, &parts.links, &links)).collect::<Result<_>>()?;
    let known: HashSet<&Part> = parts.faults.iter().map(|fault| &fault.part).collect();
    let (mut faults, mut lost) = (Vec::new(), Vec::new());
    for (place, joint) in parts.joints.iter().enumerate() {
        let part = Part::Joint(joint.name.clone());
        let sound = || check_motion(joint).and_then(|()| finite::check_joint(joint));
        let motion = if known.contains(&part) { Ok(()) } else { sound() };
        let mimic = check_mimic(joint, &parts.joints, &joints);
        lost.extend(mimic.is_err().then_some(place));
        let found = [motion, mimic].into_iter().filter_map(Result::err);
        faults.extend(found.map(|error| Fault { part: part.clone(), error }));
    }
    for link in &parts.links {
        let part = Part::Link(link.name.clone());
        let found = if known.contains(&part) { None } else { finite::check_link(link).err() };
        faults.extend(found.map(|error| Fault { part, error }));
    }
    lost.into_iter().for_each(|place| parts.joints[place].mimic = None);
    let mut actuators = Vec::new();
    for actuator in std::mem::take(&mut parts.actuators) {
        match check_actuator(&actuator, &actuators, &parts.joints) {
            Ok(()) => actuators.push(actuator),
            Err(error) => faults.push(Fault { part: Part::Actuator(actuator.name), error }),
        }
    }
    parts.actuators = actuators;
    parts.faults.extend(faults);
    parts.faults.sort_by_key(|fault| fault.error.place().line);
    Ok(ends)
}

/// The index of `name` in `names`.
///
/// # Errors
/// [`ErrorKind::UnknownName`] with the nearest name.
pub fn place<'n>(what: &str, name: &str, names: impl Iterator<Item = &'n str> + Clone) -> Result<usize> {
    names.clone().position(|own| own == name).ok_or_else(|| {
        let text = format!("the robot has no {what} `{}`{}", shown(name), some_among(name, names));
        Error::new(ErrorKind::UnknownName, text)
    })
}

fn check_actuator(actuator: &Actuator, before: &[Actuator], joints: &[Joint]) -> Result<()> {
    check_name(&actuator.name, None, "actuator")?;
    let named =
        |kind, message: String| Err(Error::new(kind, format!("actuator `{}`: {message}", shown(&actuator.name))));
    if before.iter().any(|other| other.name == actuator.name) {
        return named(
            ErrorKind::DuplicateName,
            "another actuator has this name; give each a different name".to_owned(),
        );
    }
    if actuator.joints.is_empty() {
        return named(ErrorKind::BadValue, "it moves no joint; give a joint".to_owned());
    }
    for (name, _) in &actuator.joints {
        if let Err(error) = place("joint", name, joints.iter().map(|joint| joint.name.as_str())) {
            return named(error.kind(), error.message().to_owned());
        }
    }
    if let Some((name, ratio)) = actuator.joints.iter().find(|(_, ratio)| !(ratio.is_finite() && *ratio != 0.0)) {
        let message = format!("its ratio to `{}` is {ratio}; give one that is finite and not zero", shown(name));
        return named(ErrorKind::BadValue, message);
    }
    Ok(())
}

fn check_name(name: &str, line: Option<usize>, what: &str) -> Result<()> {
    limits::check_name(what, name).map_err(|error| if let Some(line) = line { error.at_line(line) } else { error })
}

fn index_links(links: &[Link]) -> Result<HashMap<&str, usize>> {
    let mut index = HashMap::new();
    for (place, link) in links.iter().enumerate() {
        check_name(&link.name, link.line, "link")?;
        if index.insert(link.name.as_str(), place).is_some() {
            let message =
                format!("link `{}`: another link has this name; give each a different name", shown(&link.name));
            let error = Error::new(ErrorKind::DuplicateName, message);
            return Err(if let Some(line) = link.line { error.at_line(line) } else { error });
        }
    }
    Ok(index)
}

fn index_joints(joints: &[Joint]) -> Result<HashMap<&str, usize>> {
    let mut index = HashMap::new();
    for (place, joint) in joints.iter().enumerate() {
        check_name(&joint.name, joint.line, "joint")?;
        if index.insert(joint.name.as_str(), place).is_some() {
            return Err(
                joint.error(ErrorKind::DuplicateName, "another joint has this name; give each a different name")
            );
        }
    }
    Ok(index)
}

fn check_motion(joint: &Joint) -> Result<()> {
    let bad = |message: &str| Err(joint.error(ErrorKind::BadValue, message));
    let is_zero = |x: &BigRational| *x == BigRational::default();
    if joint.kind.has_axis() && joint.axis.iter().all(is_zero) {
        return bad("axis [0, 0, 0] has no direction; give a non-zero vector");
    }
    let turns = matches!(joint.kind, JointType::Revolute | JointType::Continuous);
    let remedy = if turns { ", or the type `continuous` for a revolute joint without limits" } else { "" };
    match joint.limits {
        None if joint.kind == JointType::Revolute => {
            bad("a revolute joint needs limits; give <limit lower upper>, or the type `continuous`")
        }
        None if joint.kind == JointType::Prismatic => bad("a prismatic joint needs limits; give <limit lower upper>"),
        Some((low, high)) if !(low.is_finite() && high.is_finite()) => {
            bad(&format!("the limits {low}..{high} are not finite; give finite ones{remedy}"))
        }
        Some((low, high)) if low > high => {
            bad(&format!("the limits {low}..{high} are inverted; give the lower limit first{remedy}"))
        }
        _ => Ok(()),
    }
}

/// Checks that the joint's leader exists and that the chain of leaders ends. It may end at a joint whose own leader
/// does not exist.
fn check_mimic(joint: &Joint, joints: &[Joint], index: &HashMap<&str, usize>) -> Result<()> {
    let (mut follower, mut steps) = (joint, 0);
    while let Some(mimic) = &follower.mimic {
        let Some(leader) = index.get(mimic.leader.as_str()) else {
            if steps > 0 {
                return Ok(());
            }
            let names = some_among(&mimic.leader, joints.iter().map(|joint| joint.name.as_str()));
            let message = format!("it mimics `{}`, which is not a joint{names}", shown(&mimic.leader));
            return Err(joint.error(ErrorKind::UnknownName, &message));
        };
        (follower, steps) = (&joints[*leader], steps + 1);
        if steps > MAX_FOLLOWERS || follower.name == joint.name {
            let message = format!(
                "the chain of joints that it mimics is a cycle, or has more than {MAX_FOLLOWERS} joints; remove the mimic law of one"
            );
            return Err(joint.error(ErrorKind::BadValue, &message));
        }
    }
    Ok(())
}

fn ends_of(joint: &Joint, links: &[Link], index: &HashMap<&str, usize>) -> Result<(usize, usize)> {
    let find = |what: &str, name: &str| {
        index.get(name).copied().ok_or_else(|| {
            let names = some_among(name, links.iter().map(|link| link.name.as_str()));
            let message = format!("its {what} `{}` is not a link{names}", shown(name));
            joint.error(ErrorKind::UnknownName, &message)
        })
    };
    Ok((find("parent", &joint.parent)?, find("child", &joint.child)?))
}

/// The parent joint of each link. A link with two is in a loop.
pub fn parents(parts: &RobotParts, ends: &[(usize, usize)]) -> Result<Vec<Option<usize>>> {
    let joints = &parts.joints;
    let mut above: Vec<Option<usize>> = vec![None; parts.links.len()];
    for (place, joint) in joints.iter().enumerate() {
        if let Some(other) = above[ends[place].1].replace(place) {
            let (child, other) = (shown(&joint.child), shown(&joints[other].name));
            let message = format!(
                "its child `{child}` is already the child of joint `{other}`; a robot must be a tree, without loops"
            );
            return Err(joint.error(ErrorKind::BadValue, &message));
        }
    }
    Ok(above)
}

/// The link without a parent joint.
pub fn root(links: &[Link], above: &[Option<usize>]) -> Result<usize> {
    let roots: Vec<usize> = (0..links.len()).filter(|link| above[*link].is_none()).collect();
    match roots.as_slice() {
        [root] => Ok(*root),
        [] if links.is_empty() => Err(Error::new(ErrorKind::MissingKey, "the robot has no <link>; give at least one")),
        [] => Err(Error::new(ErrorKind::BadValue, "every link has a parent: a loop; a robot must be a tree")),
        _ => {
            let names = listing(roots.iter().map(|root| links[*root].name.as_str()));
            let message = format!("{} links have no parent joint: {names}; only the root may have none", roots.len());
            Err(Error::new(ErrorKind::BadValue, message))
        }
    }
}
