//! Validation of the parts of [`Chain::new`](super::Chain::new). Each fault has its part and key, so that a file reader
//! can report the line.

use num_traits::{One, Signed, Zero};

use super::parts::{ChainParts, Joint, JointKind, Tip, WIDEST};
use super::task::Plane;
use super::{ExactMatrix, ExactVector};
use crate::document::{one_among, shown};
use crate::model::is_plain;
use crate::spatial::exact::vector::{cosine, show, sine, unit};
use crate::{Error, ErrorKind};
use groebot_algebra::limits;
use groebot_algebra::number::{BigInt, BigRational};

const MAX_JOINTS: usize = limits::CHAIN_JOINTS;
const MAX_NAME: usize = limits::NAME_CHARACTERS;
const MAX_TEXT: usize = limits::TEXT_CHARACTERS;
const MAX_SYMBOL: usize = limits::SYMBOL_CHARACTERS;

/// The part of a chain that has a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Chain,
    Joint(usize),
    Tip,
    Choice,
    Task,
}

/// A fault with its part and key.
#[derive(Debug)]
pub struct Fault {
    pub part: Part,
    pub key: &'static str,
    pub error: Error,
}

type Checked = Result<(), Fault>;

/// Checks everything. Returns the first fault.
pub fn check(parts: &ChainParts) -> Checked {
    check_texts(parts)?;
    check_count(parts.joints.len())?;
    for (index, joint) in parts.joints.iter().enumerate() {
        check_joint(index, joint)?;
        check_unique(index, &parts.joints)?;
        if let Some(plane) = parts.task.plane() {
            check_plane(index, joint, plane, WIDEST)?;
        }
    }
    check_tip(&parts.tip)?;
    check_direction(parts)?;
    check_mimics(parts)?;
    check_given(parts)?;
    let unknowns: Vec<String> = parts.joints.iter().flat_map(Joint::unknowns).collect();
    let unknowns: Vec<&str> = unknowns.iter().map(String::as_str).collect();
    check_order(parts, &unknowns)?;
    check_choice(parts, &unknowns)
}

fn fault(part: Part, key: &'static str, kind: ErrorKind, message: String) -> Fault {
    Fault { part, key, error: Error::new(kind, message) }
}

/// A fault of a joint, with its name in the message.
fn joint_fault(index: usize, joint: &Joint, key: &'static str, kind: ErrorKind, message: &str) -> Fault {
    fault(Part::Joint(index), key, kind, joint_message(&joint.name, message))
}

/// A message about the joint `name`.
pub fn joint_message(name: &str, message: &str) -> String {
    format!("joint `{}`: {message}", shown(name))
}

fn check_texts(parts: &ChainParts) -> Checked {
    if !limits::is_name(&parts.name) {
        let message =
            format!("the chain's name is `{}`; give {MAX_NAME} visible characters at most", shown(&parts.name));
        return Err(fault(Part::Chain, "name", ErrorKind::BadValue, message));
    }
    for (key, text) in [("description", &parts.description), ("source", &parts.source)] {
        if text.as_ref().is_some_and(|text| !is_plain(text, MAX_TEXT)) {
            let message = format!("`{key}` is too long or has control characters; give {MAX_TEXT} characters at most");
            return Err(fault(Part::Chain, key, ErrorKind::BadValue, message));
        }
    }
    Ok(())
}

/// Refuses an empty chain and too many joints.
pub fn check_count(joints: usize) -> Checked {
    if (1..=MAX_JOINTS).contains(&joints) {
        return Ok(());
    }
    let message = format!("the chain has {joints} joints; give 1 to {MAX_JOINTS}");
    Err(fault(Part::Chain, "joint", ErrorKind::BadValue, message))
}

fn check_joint(index: usize, joint: &Joint) -> Checked {
    let bad = |key, message: String| Err(joint_fault(index, joint, key, ErrorKind::BadValue, &message));
    let is_symbol =
        (1..=MAX_SYMBOL).contains(&joint.symbol.len()) && joint.symbol.bytes().all(|b| b.is_ascii_alphanumeric());
    if !limits::is_name(&joint.name) {
        return bad("name", format!("not a name; give 1 to {MAX_NAME} visible characters"));
    }
    if !is_symbol {
        let symbol = shown(&joint.symbol);
        return bad("symbol", format!("symbol `{symbol}`: give 1 to {MAX_SYMBOL} ASCII letters and digits"));
    }
    if joint.axis.iter().all(Zero::is_zero) {
        return bad("axis", "axis [0, 0, 0] has no direction; give a non-zero vector".into());
    }
    if !is_near(&joint.point) {
        return bad("point", "a coordinate of the axis' point is beyond 10^12; give smaller ones".into());
    }
    match joint.limits {
        Some((low, high)) if !(low.is_finite() && high.is_finite()) => {
            bad("limits", format!("limits [{low}, {high}] are not finite; give finite ones or none"))
        }
        Some((low, high)) if low > high => bad("limits", "the limits are inverted; give the lower limit first".into()),
        _ => Ok(()),
    }
}

/// Whether every sum of the coordinates is in the range of doubles.
fn is_near(point: &ExactVector) -> bool {
    let bound = BigRational::from_integer(BigInt::from(limits::COORDINATE));
    point.iter().all(|x| x.abs() <= bound)
}

fn check_unique(index: usize, joints: &[Joint]) -> Checked {
    let joint = &joints[index];
    for earlier in &joints[..index] {
        let duplicate = if earlier.name == joint.name {
            Some(("name", "an earlier joint has this name; give each joint a different name".to_owned()))
        } else if earlier.symbol == joint.symbol {
            let other = shown(&earlier.name);
            Some((
                "symbol",
                format!("joint `{other}` has the symbol `{}`; give each joint a different symbol", joint.symbol),
            ))
        } else {
            None
        };
        if let Some((key, message)) = duplicate {
            return Err(joint_fault(index, joint, key, ErrorKind::DuplicateName, &message));
        }
    }
    Ok(())
}

/// Checks that, in a planar task, revolute axes are normal to the plane and prismatic axes are in it, within the
/// tolerance `within` \[rad\].
pub(super) fn check_plane(index: usize, joint: &Joint, plane: Plane, within: f64) -> Checked {
    let normal = ["x", "y", "z"][plane.normal()];
    let off = match joint.kind {
        JointKind::Revolute => sine(&joint.axis, &normal_of(plane)),
        JointKind::Prismatic => cosine(&joint.axis, &normal_of(plane)),
    };
    if off <= within {
        return Ok(());
    }
    let allowed = match joint.kind {
        JointKind::Revolute => format!("a revolute axis must be parallel to {normal}, the plane's normal"),
        JointKind::Prismatic => format!("a prismatic axis must have {normal} = 0"),
    };
    let message = format!(
        "axis {} moves the tip out of the {} plane of the task; {allowed}{}",
        shown(&show(&joint.axis)),
        plane.name(),
        if off <= WIDEST {
            format!("; the deviation is {off:.1e} rad: a larger tolerance, `--snap`, idealises it")
        } else {
            String::new()
        }
    );
    Err(joint_fault(index, joint, "axis", ErrorKind::BadValue, &message))
}

fn normal_of(plane: Plane) -> ExactVector {
    unit(plane.normal())
}

fn check_tip(tip: &Tip) -> Checked {
    if !is_near(&tip.point) {
        let message = "a coordinate of the tip is beyond 10^12; give smaller ones".into();
        return Err(fault(Part::Tip, "point", ErrorKind::BadValue, message));
    }
    if !is_rotation(&tip.rotation) {
        let message = "the tip's matrix is not a rotation; give an exact one: R R^T = 1 and det R = 1".into();
        return Err(fault(Part::Tip, "rotation", ErrorKind::BadValue, message));
    }
    Ok(())
}

fn is_rotation(r: &ExactMatrix) -> bool {
    let dot = |a: &ExactVector, b: &ExactVector| -> BigRational { a.iter().zip(b).map(|(x, y)| x * y).sum() };
    let unit = |i: usize, j: usize| if i == j { BigRational::one() } else { BigRational::zero() };
    let orthonormal = (0..3).all(|i| (0..3).all(|j| dot(&r[i], &r[j]) == unit(i, j)));
    let cross = |i: usize| &r[0][(i + 1) % 3] * &r[1][(i + 2) % 3] - &r[0][(i + 2) % 3] * &r[1][(i + 1) % 3];
    orthonormal && (0..3).all(|i| cross(i) == r[2][i])
}

fn check_direction(parts: &ChainParts) -> Checked {
    if !parts.direction.iter().all(Zero::is_zero) {
        return Ok(());
    }
    let message = "the task's direction is [0, 0, 0]; give a non-zero vector of the tip frame".into();
    Err(fault(Part::Task, "direction", ErrorKind::BadValue, message))
}

/// Checks that a leader is another joint of the chain, is not a mimic joint, and that the factor is not zero.
fn check_mimics(parts: &ChainParts) -> Checked {
    for (index, joint) in parts.joints.iter().enumerate() {
        let Some(mimic) = &joint.mimic else { continue };
        let bad = |kind, message: String| Err(joint_fault(index, joint, "mimic", kind, &message));
        let leader = parts.joints.iter().find(|other| other.name == mimic.leader);
        match leader {
            None => {
                let names: Vec<&str> = parts.joints.iter().map(|joint| joint.name.as_str()).collect();
                let among = one_among(&mimic.leader, &names);
                return bad(
                    ErrorKind::UnknownName,
                    format!("it mimics `{}`, which is not a joint{among}", shown(&mimic.leader)),
                );
            }
            Some(leader) if leader.mimic.is_some() => {
                let text = format!("it mimics `{}`, which is a mimic joint; name its leader", shown(&mimic.leader));
                return bad(ErrorKind::BadValue, text);
            }
            Some(_) if mimic.multiplier.is_zero() => {
                return bad(ErrorKind::BadValue, "its multiplier is zero; omit the joint".into());
            }
            Some(_) => {}
        }
    }
    Ok(())
}

/// Checks that given joints exist, are listed once, and leave at least one joint to solve for.
fn check_given(parts: &ChainParts) -> Checked {
    let bad = |kind, message| Err(fault(Part::Chain, "given", kind, format!("`given`: {message}")));
    let names: Vec<&str> = parts.joints.iter().map(|joint| joint.name.as_str()).collect();
    for (index, name) in parts.given.iter().enumerate() {
        if !names.contains(&name.as_str()) {
            let message = format!("no joint has the name `{}`{}", shown(name), one_among(name, &names));
            return bad(ErrorKind::UnknownName, message);
        }
        if parts.given[..index].contains(name) {
            return bad(ErrorKind::DuplicateName, format!("`{}` is given twice; name each joint once", shown(name)));
        }
    }
    for joint in parts.joints.iter().filter(|joint| parts.given.contains(&joint.name)) {
        if let Some(mimic) = &joint.mimic {
            let text = format!("joint `{}` follows `{}`; name that one", shown(&joint.name), shown(&mimic.leader));
            return bad(ErrorKind::BadValue, text);
        }
    }
    let is_given =
        |joint: &Joint| parts.given.contains(joint.mimic.as_ref().map_or(&joint.name, |mimic| &mimic.leader));
    if parts.joints.iter().all(is_given) {
        return bad(ErrorKind::BadValue, "every joint is given; leave at least one unknown".into());
    }
    Ok(())
}

fn check_order(parts: &ChainParts, unknowns: &[&str]) -> Checked {
    let Some(order) = &parts.order else { return Ok(()) };
    let bad = |kind, message| Err(fault(Part::Chain, "order", kind, format!("`order`: {message}")));
    for (index, name) in order.iter().enumerate() {
        if !unknowns.contains(&name.as_str()) {
            return bad(ErrorKind::UnknownName, no_unknown(name, unknowns));
        }
        if order[..index].contains(name) {
            return bad(ErrorKind::DuplicateName, format!("`{name}` is given twice; name each unknown once"));
        }
    }
    match unknowns.iter().find(|unknown| !order.iter().any(|name| name == *unknown)) {
        Some(missing) => bad(ErrorKind::BadValue, format!("`{missing}` is missing; name each unknown once")),
        None => Ok(()),
    }
}

fn check_choice(parts: &ChainParts, unknowns: &[&str]) -> Checked {
    match &parts.choice {
        Some(choice) if !unknowns.contains(&choice.unknown.as_str()) => {
            let message = format!("`choice`: {}", no_unknown(&choice.unknown, unknowns));
            Err(fault(Part::Choice, "unknown", ErrorKind::UnknownName, message))
        }
        _ => Ok(()),
    }
}

fn no_unknown(name: &str, unknowns: &[&str]) -> String {
    format!("no joint has the unknown `{}`{}", shown(name), one_among(name, unknowns))
}
