//! Chains between two links of a robot: from the base towards the leaves, and first towards the root if the tip is on
//! another branch.

use std::collections::{HashMap, HashSet};

use num_traits::ToPrimitive;

use super::frame::{Frame, Rationality, Reading};
use super::parts::{Meant, along_z};
use super::telescope::{Telescope, joined};
use super::tip::TipChoice;
use super::{Chain, ChainParts, ExactVector, Joint, JointKind, LengthUnit, Mimic, Placement, Task, Tip};
use crate::document::shown;
use crate::model::{self, Fault, JointType, Part, Robot, some_among};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// Maximum number of joints of a path, including fixed ones.
const MAX_PATH: usize = groebot_algebra::limits::PATH_JOINTS;
/// Maximum number of characters of a chain's name.
const MAX_NAME: usize = 64;

/// The path through a robot from one link to another.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LinkPath {
    /// The name of the first link.
    pub base: String,
    /// The name of the last link.
    pub tip: String,
    /// The joints of the path, as indices in [`Robot::joints`], each with whether it is passed from child to parent.
    pub joints: Vec<(usize, bool)>,
    /// How the tip link was chosen.
    pub choice: TipChoice,
}

impl Robot {
    /// Finds the path from the link `base` (by default the root) to the link `tip` (by default the only leaf, else the
    /// only link named `tool0`, `flange`, `tcp` or `ee_link`, in that order: [`TipChoice`]).
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for unknown links; [`ErrorKind::MissingKey`] without `tip` when the default is not
    /// unique; [`ErrorKind::BadValue`] for more than 64 joints on the path.
    pub fn path(&self, base: Option<&str>, tip: Option<&str>) -> Result<LinkPath> {
        let base = self.find("base", base.unwrap_or(self.root()))?;
        let (tip, choice) = match tip {
            Some(tip) => (self.find("tip", tip)?, TipChoice::Given),
            None => self.default_tip(base)?,
        };
        let joints = self.between(base, tip);
        let [base, tip] = [base, tip].map(|link| self.links()[link].name.clone());
        if joints.len() > MAX_PATH {
            let text = format!(
                "{} joints are between `{}` and `{}`; at most {MAX_PATH} are allowed, fixed ones included",
                joints.len(),
                shown(&base),
                shown(&tip)
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(LinkPath { base, tip, joints, choice })
    }

    /// The joints from the link with the index `base` to the one with the index `tip`, each with whether it is passed
    /// from child to parent.
    pub(super) fn between(&self, base: usize, tip: usize) -> Vec<(usize, bool)> {
        let (mut up, mut down) = (self.ancestry(base), self.ancestry(tip));
        while up.last().is_some() && up.last() == down.last() {
            up.pop();
            down.pop();
        }
        let up = up.into_iter().map(|joint| (joint, true));
        up.chain(down.into_iter().rev().map(|joint| (joint, false))).collect()
    }

    /// The name of the link on `path` that carries its first moving joint. A chain from this link is the shortest one
    /// with the same joints. Without moving joints it is the base.
    pub fn carrier<'p>(&'p self, path: &'p LinkPath) -> &'p str {
        let moving = path.joints.iter().find(|(joint, _)| self.joints()[*joint].kind != JointType::Fixed);
        let carrier = moving.map(|(joint, is_up)| (self.ends(*joint), is_up));
        carrier.map_or(&path.base, |((parent, child), is_up)| &self.links()[if *is_up { child } else { parent }].name)
    }

    /// Extracts the chain from the link `base` to the link `tip` (defaults as in [`Robot::path`]), in the frame of
    /// `base`, with the task `pose`, in metres. Fixed joints are merged into their neighbours. A joint that is passed
    /// from child to parent has its axis reversed, so that its values and limits are unchanged. Joints coupled by
    /// `mimic` are one unknown. Prismatic joints along one direction, as in a telescope, become one joint whose value
    /// is their sum. Any other mimic joint follows its leader or, if that is not on the path, the first joint coupled
    /// to it. The chain's numbers are those of the description; [`Chain::ideal`] is the ideal robot.
    ///
    /// # Errors
    /// Those of [`Robot::path`]; that of a [fault](Robot::faults) of a joint or link on the path;
    /// [`ErrorKind::Unsupported`] for a floating or planar joint on the path; [`ErrorKind::BadValue`] for a path
    /// without moving joints; those of [`Chain::new`].
    pub fn chain(&self, base: Option<&str>, tip: Option<&str>) -> Result<Chain> {
        self.chain_along(&self.path(base, tip)?)
    }

    fn chain_along(&self, path: &LinkPath) -> Result<Chain> {
        if let Some(fault) = self.faults().iter().find(|fault| self.is_on(path, fault)) {
            return Err(fault.error.clone());
        }
        let (joints, tip) = self.walk(path, Reading::AsDescribed)?;
        let telescopes = Telescope::among(&joints);
        let joints = joined(joints, &telescopes);
        if joints.is_empty() {
            let text = format!(
                "no joint moves between `{}` and `{}`; choose links with moving joints between them",
                shown(&path.base),
                shown(&path.tip)
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let name: String = format!("{}_{}", self.name(), path.tip).chars().take(MAX_NAME).collect();
        let (meant, tip_meant) = self.walk(path, Reading::AsMeant)?;
        let meant = joined(meant, &telescopes);
        Chain::new(ChainParts {
            name: name.trim().to_owned(),
            description: Some(format!("from link {} to link {}", path.base, path.tip)),
            source: None,
            length_unit: LengthUnit::Metre,
            meant: Meant::unless_described(meant, tip_meant, (&joints, &tip)),
            joints,
            tip,
            task: Task::Pose,
            direction: along_z(),
            given: Vec::new(),
            order: None,
            choice: None,
        })
    }

    /// Faults of the robot outside the path, and parts that the reader ignored. None of them affects the chain along
    /// `path`.
    pub fn ignored(&self, path: &LinkPath) -> Vec<String> {
        let beside = self.faults().iter().filter(|fault| !self.is_on(path, fault));
        let beside = beside.map(|fault| format!("ignored, because it is not in the chain: {}", fault.error));
        self.parts().notes.iter().cloned().chain(beside).collect()
    }

    /// Whether the part with the fault is on the path.
    fn is_on(&self, path: &LinkPath, fault: &Fault) -> bool {
        let is_end = |joint: usize, name: &str| {
            let (parent, child) = self.ends(joint);
            [parent, child].iter().any(|link| self.links()[*link].name == name)
        };
        match &fault.part {
            Part::Joint(name) => path.joints.iter().any(|(joint, _)| self.joints()[*joint].name == *name),
            Part::Link(name) => *name == path.base || path.joints.iter().any(|(joint, _)| is_end(*joint, name)),
            Part::Actuator(_) => false,
        }
    }

    /// Notes for a user of the chain along `path`: numbers that were replaced, mimic joints and their leaders, joints
    /// that are passed from child to parent, and [ignored](Robot::ignored) parts.
    pub fn notes(&self, path: &LinkPath) -> Vec<String> {
        let mut notes = Vec::new();
        let mimics = self.mimics(path);
        let alone =
            |joint: &model::Joint| mimics.iter().all(|(name, mimic)| *name != joint.name && mimic.leader != joint.name);
        for (index, _) in &path.joints {
            let joint = &self.joints()[*index];
            let name = shown(&joint.name);
            notes.extend(joint.notes.iter().map(|note| format!("{name}: {note}")));
            if let Some(value) = self.constant(joint) {
                let value = value.to_f64().unwrap_or(f64::NAN);
                notes.push(format!("{name}: its multiplier is zero, so that it is fixed at {value}"));
            } else if let Some(mimic) = joint.mimic.as_ref().filter(|_| alone(joint)) {
                notes.push(format!(
                    "{name}: in the robot it follows {mimic}, outside this chain; here it is independent"
                ));
            }
        }
        let walked = self.walk(path, Reading::AsDescribed).map(|(joints, _)| joints).unwrap_or_default();
        notes.extend(Telescope::among(&walked).iter().flat_map(|telescope| telescope.notes(&walked)));
        let up = path.joints.iter().filter(|(index, is_up)| *is_up && self.joints()[*index].kind != JointType::Fixed);
        let up: Vec<String> = up.map(|(index, _)| shown(&self.joints()[*index].name)).collect();
        if !up.is_empty() {
            notes.push(format!(
                "passed from child to parent, with reversed axes and unchanged values and limits: {}",
                up.join(", ")
            ));
        }
        notes.extend(self.ignored(path));
        notes
    }

    fn find(&self, what: &str, name: &str) -> Result<usize> {
        self.links().iter().position(|link| link.name == name).ok_or_else(|| {
            let names = some_among(name, self.links().iter().map(|link| link.name.as_str()));
            let text = format!("the {what} `{}` is not a link of the robot{names}", shown(name));
            Error::new(ErrorKind::UnknownName, text)
        })
    }

    /// The joints of the path that are coupled to others of it, with their laws. The leader is the common one or, if
    /// that is not on the path, the first of them.
    fn mimics(&self, path: &LinkPath) -> Vec<(&str, Mimic)> {
        let moving = path.joints.iter().map(|(index, _)| &self.joints()[*index]);
        let laws = moving.filter(|joint| self.moves(joint)).map(|joint| (joint, self.law(joint)));
        let mut heads: HashMap<String, (&str, Mimic)> = HashMap::new();
        let laws: Vec<(&model::Joint, Mimic)> = laws.collect();
        for (joint, law) in &laws {
            let leads = joint.mimic.is_none();
            if leads || !heads.contains_key(&law.leader) {
                heads.insert(law.leader.clone(), (&joint.name, law.clone()));
            }
        }
        let followers = laws.into_iter().filter_map(|(joint, law)| {
            let (head, first) = heads.get(&law.leader).filter(|(head, _)| *head != joint.name)?;
            // x = (head - b) / m is the leader's value.
            let back = Mimic {
                leader: (*head).to_owned(),
                multiplier: first.multiplier.recip(),
                offset: -&first.offset / &first.multiplier,
            };
            Some((joint.name.as_str(), back.then(&law)))
        });
        followers.collect()
    }

    /// The symbols of the moving joints on the path: those of the source if each has its own, else 1, 2, 3.
    fn symbols(&self, path: &LinkPath) -> Vec<String> {
        let moving: Vec<&model::Joint> =
            path.joints.iter().map(|(index, _)| &self.joints()[*index]).filter(|joint| self.moves(joint)).collect();
        let own_symbols: Vec<String> = moving.iter().filter_map(|joint| joint.symbol.clone()).collect();
        let distinct: HashSet<&String> = own_symbols.iter().collect();
        if distinct.len() == moving.len() {
            own_symbols
        } else {
            (1..=moving.len()).map(|place| place.to_string()).collect()
        }
    }

    /// Whether a joint moves in a chain: it is neither fixed nor a mimic joint with a multiplier of zero.
    fn moves(&self, joint: &model::Joint) -> bool {
        joint.kind != JointType::Fixed && self.constant(joint).is_none()
    }

    /// The moving joints in the base frame, and the tip.
    fn walk(&self, path: &LinkPath, reading: Reading) -> Result<(Vec<Joint>, Tip)> {
        Frame::walked(reading, |base| self.walk_from(base, path)).map(|(joints, frame)| (joints, frame.tip()))
    }

    /// Same as `walk`, but from a given base frame. Also returns whether the joints' axes are rational.
    fn walk_from(&self, base: Frame, path: &LinkPath) -> Result<((Vec<Joint>, Frame), Rationality)> {
        let (mut joints, mut frame, mut own_symbols) = (Vec::new(), base, Rationality::default());
        let (mimics, symbols) = (self.mimics(path), self.symbols(path));
        for (index, is_up) in &path.joints {
            let joint = &self.joints()[*index];
            if !is_up {
                frame = frame.then(&joint.origin.placement);
            }
            let kind = kind_of(joint)?;
            if let (Some(kind), Some(value)) = (kind, self.constant(joint)) {
                frame = frame.then(&held(kind, &joint.axis, &if *is_up { -value } else { value }));
            } else if let Some(kind) = kind {
                let axis = frame.direction(&joint.axis);
                own_symbols.add(frame.rationality(&joint.axis));
                joints.push(Joint {
                    name: joint.name.clone(),
                    symbol: symbols[joints.len()].clone(),
                    kind,
                    axis: if *is_up { axis.map(|x| -x) } else { axis },
                    point: frame.point(),
                    limits: joint.limits.filter(|_| joint.kind != JointType::Continuous),
                    mimic: mimics.iter().find(|(name, _)| *name == joint.name).map(|(_, mimic)| mimic.clone()),
                });
            }
            if *is_up {
                frame = frame.before(&joint.origin.placement);
            }
        }
        Ok(((joints, frame), own_symbols))
    }
}

/// The motion of a joint at a constant value, within rounding.
fn held(kind: JointKind, axis: &ExactVector, value: &BigRational) -> Placement {
    match kind {
        JointKind::Prismatic => Placement::shifted_along(axis, value),
        JointKind::Revolute => Placement::turned_about(axis, value),
    }
}

/// The type of a joint in a chain; `None` when it is fixed.
fn kind_of(joint: &model::Joint) -> Result<Option<JointKind>> {
    match joint.kind {
        JointType::Fixed => Ok(None),
        JointType::Revolute | JointType::Continuous => Ok(Some(JointKind::Revolute)),
        JointType::Prismatic => Ok(Some(JointKind::Prismatic)),
        JointType::Floating | JointType::Planar => {
            let message = format!(
                "the type `{}` is not supported in a chain; allowed between base and tip: `revolute`, `continuous`, `prismatic`, \
                 `fixed`",
                joint.kind.name()
            );
            Err(joint.error(ErrorKind::Unsupported, &message))
        }
    }
}
