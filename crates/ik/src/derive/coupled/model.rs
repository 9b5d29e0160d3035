//! The validated description of chains that share actuators: [`CoupledChains`].

use crate::solver::MAX_JOINTS;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{Chain, Joint};

/// One of the chains, with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct CoupledChain {
    /// Its name.
    pub name: String,
    /// The prefix for the names of its inputs and joints.
    pub prefix: String,
    /// The chain, with its task. All chains have a common base frame and length unit.
    pub chain: Chain,
    /// The name of the file that defines the chain, in the description's folder. `None` if the description itself contains the chain.
    pub file: Option<String>,
}

/// A joint of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointPlace {
    /// Index of the chain.
    pub member: usize,
    /// Index of the joint in its chain.
    pub joint: usize,
}

/// An actuator that moves one joint, or several joints together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Actuator {
    /// The name. For a single joint: its name with the chain's prefix. For several joints: their common name, or else the first one's with its chain's prefix.
    pub name: String,
    /// Its joints.
    pub joints: Vec<JointPlace>,
}

/// The plain data of [`CoupledChains`], not yet checked.
#[derive(Clone, Debug, PartialEq)]
pub struct CoupledParts {
    /// The name of the mechanism: letters, digits and `_`.
    pub name: String,
    /// A description of the mechanism.
    pub description: Option<String>,
    /// The source of its numbers.
    pub source: Option<String>,
    /// The chains.
    pub chains: Vec<CoupledChain>,
    /// Groups of joints with a common actuator. Each list has two or more joints of different chains, and each joint is in at most one list.
    pub shared: Vec<Vec<JointPlace>>,
}

/// Validated, immutable chains that share actuators.
#[derive(Clone, Debug, PartialEq)]
pub struct CoupledChains {
    parts: CoupledParts,
    actuators: Vec<Actuator>,
}

/// The part of the description that an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Whole,
    Chain(usize),
    Shared(usize),
}

/// An error, and the part that it is about.
pub(super) struct Fault {
    pub part: Part,
    pub error: Error,
}

impl CoupledChains {
    /// Checks `parts` and makes them coupled chains.
    ///
    /// # Errors
    /// * [`ErrorKind::BadValue`] for no chain, an invalid name or prefix, or different length units.
    /// * [`ErrorKind::BadValue`] for an actuator with joints of one chain or of different kinds, and for more than 16 actuators.
    /// * [`ErrorKind::DuplicateName`] for chains or actuators with one name, and joints that are shared twice.
    /// * [`ErrorKind::UnknownName`] for shared joints that do not exist.
    pub fn new(parts: CoupledParts) -> Result<Self> {
        CoupledChains::assemble(parts).map_err(|fault| fault.error)
    }

    pub(super) fn assemble(parts: CoupledParts) -> std::result::Result<Self, Fault> {
        check_coupled(&parts)?;
        check_shared(&parts)?;
        let actuators = actuators(&parts);
        check_actuators(&actuators)?;
        Ok(CoupledChains { parts, actuators })
    }

    /// The plain data.
    pub fn parts(&self) -> &CoupledParts {
        &self.parts
    }

    /// The chains.
    pub fn chains(&self) -> &[CoupledChain] {
        &self.parts.chains
    }

    /// The actuators, chain by chain. A shared one is at the position of its first joint.
    pub fn actuators(&self) -> &[Actuator] {
        &self.actuators
    }

    /// Index of the actuator of a joint.
    pub(crate) fn actuator_of(&self, place: JointPlace) -> Option<usize> {
        self.actuators.iter().position(|actuator| actuator.joints.contains(&place))
    }

    /// The joints that an actuator moves, each as text such as `left.HipRoll`.
    pub fn moved(&self, actuator: &Actuator) -> Vec<String> {
        actuator.joints.iter().map(|place| self.parts.shown(*place)).collect()
    }

    /// The least and greatest value of an actuator that all its joints allow. `None` if no joint has limits.
    pub(crate) fn limits(&self, actuator: &Actuator) -> Option<(f64, f64)> {
        let own = actuator.joints.iter().filter_map(|place| self.parts.joint(*place)?.limits);
        own.reduce(|(low, high), (least, greatest)| (f64::max(low, least), f64::min(high, greatest)))
    }
}

impl CoupledParts {
    fn joint(&self, place: JointPlace) -> Option<&Joint> {
        self.chains.get(place.member)?.chain.joints().get(place.joint)
    }

    /// A joint as text, such as `left.HipRoll`.
    fn shown(&self, place: JointPlace) -> String {
        let member = self.chains.get(place.member).map_or("?", |member| &member.name);
        format!("{member}.{}", self.joint(place).map_or("?", |joint| &joint.name))
    }
}

type Checked = std::result::Result<(), Fault>;

fn fault(part: Part, kind: ErrorKind, text: String) -> Checked {
    Err(Fault { part, error: Error::new(kind, text) })
}

/// Whether `text` consists of letters, digits and `_` and does not start with a digit.
fn is_word(text: &str) -> bool {
    let first = text.bytes().next().is_some_and(|byte| !byte.is_ascii_digit());
    first && text.len() <= 64 && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

fn check_coupled(parts: &CoupledParts) -> Checked {
    let bad = |part, text: String| fault(part, ErrorKind::BadValue, text);
    if !is_word(&parts.name) {
        return bad(Part::Whole, "`name` is not a word; give letters, digits and `_`, no digit first".to_owned());
    }
    let Some(first) = parts.chains.first() else {
        return bad(Part::Whole, "there are no chains; give at least one".to_owned());
    };
    for (index, member) in parts.chains.iter().enumerate() {
        let part = Part::Chain(index);
        if !is_word(&member.name) || !is_word(&member.prefix) {
            return bad(part, "the chain's name and prefix must be letters, digits and `_`, no digit first".to_owned());
        }
        if member.chain.length_unit() != first.chain.length_unit() {
            let (own, other) = (member.chain.length_unit().symbol(), first.chain.length_unit().symbol());
            return bad(part, format!("lengths are in {own} here and in {other} in `{}`; give one unit", first.name));
        }
        let twin = |other: &&CoupledChain| other.name == member.name || other.prefix == member.prefix;
        if let Some(other) = parts.chains[..index].iter().find(twin) {
            let text =
                format!("`{}` and `{}` have equal names or prefixes; change one of them", member.name, other.name);
            return fault(part, ErrorKind::DuplicateName, text);
        }
    }
    Ok(())
}

fn check_shared(parts: &CoupledParts) -> Checked {
    for (index, group) in parts.shared.iter().enumerate() {
        let part = Part::Shared(index);
        let names = || group.iter().map(|&place| format!("`{}`", parts.shown(place))).collect::<Vec<_>>().join(", ");
        if group.iter().any(|&place| parts.joint(place).is_none()) {
            return fault(part, ErrorKind::UnknownName, format!("{}: there is no such joint", names()));
        }
        let again = |place: &&JointPlace| parts.shared[..index].iter().any(|other| other.contains(place));
        if let Some(&place) = group.iter().find(again) {
            let text = format!("`{}` is shared twice; name all joints of an actuator in one list", parts.shown(place));
            return fault(part, ErrorKind::DuplicateName, text);
        }
        let is_repeated = |place: &JointPlace| group.iter().filter(|other| other.member == place.member).count() > 1;
        if group.len() < 2 || group.iter().any(is_repeated) {
            let text =
                format!("an actuator is shared by joints of two or more chains, one of each, but this is {}", names());
            return fault(part, ErrorKind::BadValue, text);
        }
        let kind = |place: JointPlace| parts.joint(place).map(|joint| joint.kind);
        if group.iter().any(|&place| kind(place) != kind(group[0])) {
            return fault(part, ErrorKind::BadValue, format!("{}: all must be revolute, or all prismatic", names()));
        }
    }
    Ok(())
}

fn actuators(parts: &CoupledParts) -> Vec<Actuator> {
    let mut actuators: Vec<Actuator> = Vec::new();
    for (member, CoupledChain { prefix, chain, .. }) in parts.chains.iter().enumerate() {
        for (joint, own) in chain.joints().iter().enumerate() {
            let place = JointPlace { member, joint };
            if actuators.iter().any(|actuator| actuator.joints.contains(&place)) {
                continue;
            }
            let group = parts.shared.iter().find(|group| group.contains(&place));
            let joints = group.cloned().unwrap_or_else(|| vec![place]);
            let is_own = |place: &JointPlace| parts.joint(*place).is_some_and(|other| other.name == own.name);
            let is_common = joints.len() > 1 && joints.iter().all(is_own);
            let name = if is_common { own.name.clone() } else { format!("{prefix}{}", own.name) };
            actuators.push(Actuator { name, joints });
        }
    }
    actuators
}

fn check_actuators(actuators: &[Actuator]) -> Checked {
    if actuators.len() > MAX_JOINTS {
        let text = format!("the chains have {} actuators; {MAX_JOINTS} are allowed", actuators.len());
        return fault(Part::Whole, ErrorKind::BadValue, text);
    }
    for (index, actuator) in actuators.iter().enumerate() {
        if actuators[..index].iter().any(|other| other.name == actuator.name) {
            let text = format!("two actuators are called `{}`; give the chains other prefixes", actuator.name);
            return fault(Part::Chain(actuator.joints[0].member), ErrorKind::DuplicateName, text);
        }
    }
    Ok(())
}
