//! The validated description of limbs that share motors: [`Limbs`].

use crate::kinematics::{Chain, Joint};
use crate::solver::MAX_JOINTS;
use crate::{Error, ErrorKind, Result};

/// One limb.
#[derive(Clone, Debug, PartialEq)]
pub struct Limb {
    /// Its name.
    pub name: String,
    /// What stands before the names of its inputs and joints.
    pub prefix: String,
    /// Its chain, with its task. Base frame and length unit are those of all limbs.
    pub chain: Chain,
    /// The name of the file that states the chain, in the description's folder; none when the chain stands in place.
    pub file: Option<String>,
}

/// A joint of a limb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointPlace {
    /// Index of the limb.
    pub limb: usize,
    /// Index of the joint in its chain.
    pub joint: usize,
}

/// A motor, which moves one joint or several alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motor {
    /// Its name: of a single joint the joint's with the limb's prefix, of several their common name, or else the first one's with
    /// its limb's prefix.
    pub name: String,
    /// Its joints.
    pub joints: Vec<JointPlace>,
}

/// The plain data of [`Limbs`], not yet checked.
#[derive(Clone, Debug, PartialEq)]
pub struct LimbsParts {
    /// The name of the mechanism: letters, digits and `_`.
    pub name: String,
    /// What it is.
    pub description: Option<String>,
    /// Where its figures come from.
    pub source: Option<String>,
    /// The limbs.
    pub limbs: Vec<Limb>,
    /// Joints that are one motor: each list has joints of different limbs, two or more, and each joint stands in one list at most.
    pub shared: Vec<Vec<JointPlace>>,
}

/// Validated limbs that share motors. They never change.
#[derive(Clone, Debug, PartialEq)]
pub struct Limbs {
    parts: LimbsParts,
    motors: Vec<Motor>,
}

/// What an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Whole,
    Limb(usize),
    Shared(usize),
}

/// An error, and what it is about.
pub(super) struct Fault {
    pub part: Part,
    pub error: Error,
}

impl Limbs {
    /// Checks `parts` and makes them limbs.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no limb, a name or prefix that is no word, another length unit, joints of one limb as one motor, of
    /// another kind, or more than 16 motors; [`ErrorKind::DuplicateName`] for limbs or motors of one name, and joints that are shared
    /// twice; [`ErrorKind::UnknownName`] for shared joints that are not there.
    pub fn new(parts: LimbsParts) -> Result<Self> {
        Limbs::assemble(parts).map_err(|fault| fault.error)
    }

    pub(super) fn assemble(parts: LimbsParts) -> std::result::Result<Self, Fault> {
        check_limbs(&parts)?;
        check_shared(&parts)?;
        let motors = motors(&parts);
        check_motors(&motors)?;
        Ok(Limbs { parts, motors })
    }

    /// The plain data.
    pub fn parts(&self) -> &LimbsParts {
        &self.parts
    }

    /// The limbs.
    pub fn limbs(&self) -> &[Limb] {
        &self.parts.limbs
    }

    /// The motors: limb by limb, shared ones where their first joint stands.
    pub fn motors(&self) -> &[Motor] {
        &self.motors
    }

    /// Index of the motor of a joint.
    pub fn motor_of(&self, place: JointPlace) -> Option<usize> {
        self.motors.iter().position(|motor| motor.joints.contains(&place))
    }

    /// The least and greatest value of a motor, which all its joints allow; none where no joint says any.
    pub fn limits(&self, motor: &Motor) -> Option<(f64, f64)> {
        let own = motor.joints.iter().filter_map(|place| self.parts.joint(*place)?.limits);
        own.reduce(|(low, high), (least, greatest)| (f64::max(low, least), f64::min(high, greatest)))
    }
}

impl LimbsParts {
    fn joint(&self, place: JointPlace) -> Option<&Joint> {
        self.limbs.get(place.limb)?.chain.joints().get(place.joint)
    }

    /// `left.HipRoll`.
    fn shown(&self, place: JointPlace) -> String {
        let limb = self.limbs.get(place.limb).map_or("?", |limb| &limb.name);
        format!("{limb}.{}", self.joint(place).map_or("?", |joint| &joint.name))
    }
}

type Checked = std::result::Result<(), Fault>;

fn fault(part: Part, kind: ErrorKind, text: String) -> Checked {
    Err(Fault { part, error: Error::new(kind, text) })
}

/// A word of letters, digits and `_` that starts with no digit.
fn is_word(text: &str) -> bool {
    let first = text.bytes().next().is_some_and(|byte| !byte.is_ascii_digit());
    first && text.len() <= 64 && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

fn check_limbs(parts: &LimbsParts) -> Checked {
    let bad = |part, text: String| fault(part, ErrorKind::BadValue, text);
    if !is_word(&parts.name) {
        return bad(Part::Whole, "`name` is no word; give letters, digits and `_`, no digit first".to_owned());
    }
    let Some(first) = parts.limbs.first() else {
        return bad(Part::Whole, "there is no limb; give one or more".to_owned());
    };
    for (index, limb) in parts.limbs.iter().enumerate() {
        let part = Part::Limb(index);
        if !is_word(&limb.name) || !is_word(&limb.prefix) {
            return bad(part, "the limb's name and prefix must be letters, digits and `_`, no digit first".to_owned());
        }
        if limb.chain.length_unit() != first.chain.length_unit() {
            let (own, other) = (limb.chain.length_unit().symbol(), first.chain.length_unit().symbol());
            return bad(part, format!("lengths are in {own} here and in {other} in `{}`; give one unit", first.name));
        }
        let twin = |other: &&Limb| other.name == limb.name || other.prefix == limb.prefix;
        if let Some(other) = parts.limbs[..index].iter().find(twin) {
            let text = format!("`{}` has the name or the prefix of `{}`; give it its own", limb.name, other.name);
            return fault(part, ErrorKind::DuplicateName, text);
        }
    }
    Ok(())
}

fn check_shared(parts: &LimbsParts) -> Checked {
    for (index, group) in parts.shared.iter().enumerate() {
        let part = Part::Shared(index);
        let names = || group.iter().map(|&place| format!("`{}`", parts.shown(place))).collect::<Vec<_>>().join(", ");
        if group.iter().any(|&place| parts.joint(place).is_none()) {
            return fault(part, ErrorKind::UnknownName, format!("{}: there is no such joint", names()));
        }
        let again = |place: &&JointPlace| parts.shared[..index].iter().any(|other| other.contains(place));
        if let Some(&place) = group.iter().find(again) {
            let text = format!("`{}` is shared twice; name all joints of a motor in one list", parts.shown(place));
            return fault(part, ErrorKind::DuplicateName, text);
        }
        let is_repeated = |place: &JointPlace| group.iter().filter(|other| other.limb == place.limb).count() > 1;
        if group.len() < 2 || group.iter().any(is_repeated) {
            let text =
                format!("a motor is shared by joints of two or more limbs, one of each, but this is {}", names());
            return fault(part, ErrorKind::BadValue, text);
        }
        let kind = |place: JointPlace| parts.joint(place).map(|joint| joint.kind);
        if group.iter().any(|&place| kind(place) != kind(group[0])) {
            return fault(part, ErrorKind::BadValue, format!("{}: all must turn, or all slide", names()));
        }
    }
    Ok(())
}

fn motors(parts: &LimbsParts) -> Vec<Motor> {
    let mut motors: Vec<Motor> = Vec::new();
    for (limb, Limb { prefix, chain, .. }) in parts.limbs.iter().enumerate() {
        for (joint, own) in chain.joints().iter().enumerate() {
            let place = JointPlace { limb, joint };
            if motors.iter().any(|motor| motor.joints.contains(&place)) {
                continue;
            }
            let group = parts.shared.iter().find(|group| group.contains(&place));
            let joints = group.cloned().unwrap_or_else(|| vec![place]);
            let is_own = |place: &JointPlace| parts.joint(*place).is_some_and(|other| other.name == own.name);
            let is_common = joints.len() > 1 && joints.iter().all(is_own);
            let name = if is_common { own.name.clone() } else { format!("{prefix}{}", own.name) };
            motors.push(Motor { name, joints });
        }
    }
    motors
}

fn check_motors(motors: &[Motor]) -> Checked {
    if motors.len() > MAX_JOINTS {
        let text = format!("the limbs have {} motors; {MAX_JOINTS} are allowed", motors.len());
        return fault(Part::Whole, ErrorKind::BadValue, text);
    }
    for (index, motor) in motors.iter().enumerate() {
        if motors[..index].iter().any(|other| other.name == motor.name) {
            let text = format!("two motors are called `{}`; give the limbs other prefixes", motor.name);
            return fault(Part::Limb(motor.joints[0].limb), ErrorKind::DuplicateName, text);
        }
    }
    Ok(())
}
