//! A robot as a validated tree of links and joints. Main type: [`Robot`].

use num_traits::{One, Zero};

use super::check;
use super::{Actuator, Fault, Joint, JointType, Link, Mimic, Part, RobotParts};
use crate::document::shown;
use crate::spatial::NEGLIGIBLE;
use crate::spatial::exact::Placement;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// A validated tree of links and joints, with masses and shapes. It is immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    parts: RobotParts,
    /// The parent joint of each link.
    above: Vec<Option<usize>>,
    /// The parent and child link of each joint.
    ends: Vec<(usize, usize)>,
    root: usize,
    /// The joints, sorted topologically: each joint is after its parent.
    order: Vec<usize>,
}

impl Robot {
    /// Validates links and joints and builds the tree.
    ///
    /// # Errors
    /// Those of [`Robot::with_faults`] and [`Robot::check`].
    pub fn new(parts: RobotParts) -> Result<Self> {
        let robot = Robot::with_faults(parts)?;
        robot.check()?;
        Ok(robot)
    }

    /// Builds the tree of links and joints. Errors of a single joint or actuator are stored in [`Robot::faults`]: a
    /// zero axis; missing, inverted or infinite limits; a mimic joint without a leader or in a cycle; an actuator of an
    /// unknown joint. A chain elsewhere is usable.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`] for two links or joints of one name; [`ErrorKind::UnknownName`] for a joint between
    /// links that do not exist; [`ErrorKind::BadValue`] for no or several roots, a loop, an empty name. All with name
    /// and line.
    pub fn with_faults(mut parts: RobotParts) -> Result<Self> {
        let ends = check::parts(&mut parts)?;
        let above = check::parents(&parts, &ends)?;
        let root = check::root(&parts.links, &above)?;
        let mut robot = Robot { parts, above, ends, root, order: Vec::new() };
        robot.order = robot.descent();
        let mut reached = vec![false; robot.ends.len()];
        robot.order.iter().for_each(|joint| reached[*joint] = true);
        match reached.iter().position(|reached| !reached) {
            None => Ok(robot),
            Some(joint) => {
                let message = "it is part of a loop of links; a robot must be a tree";
                Err(robot.parts.joints[joint].error(ErrorKind::BadValue, message))
            }
        }
    }

    /// Replaces rounded rotations by the exact ones that they approximate: quarter turns for 1.5708.
    ///
    /// # Errors
    /// Those of [`Robot::with_faults`].
    pub fn as_meant(&self) -> Result<Self> {
        let mut parts = self.parts.clone();
        for joint in &mut parts.joints {
            let placement = &mut joint.origin.placement;
            if let Some(meant) = placement.meant.take() {
                placement.rotation = meant;
            }
        }
        Robot::with_faults(parts)
    }

    /// Fixes mimic joints with a multiplier of zero at their constant value, within rounding.
    ///
    /// # Errors
    /// Those of [`Robot::with_faults`].
    pub fn with_constants_fixed(&self) -> Result<Self> {
        let mut parts = self.parts.clone();
        for (joint, fixed) in self.parts.joints.iter().zip(&mut parts.joints) {
            let Some(value) = self.constant(joint).filter(|_| joint.kind.is_single()) else { continue };
            hold(joint, fixed, &value);
        }
        Robot::with_faults(parts)
    }

    /// Adds notes to the robot.
    #[must_use]
    pub fn with_notes(mut self, notes: Vec<String>) -> Self {
        self.parts.notes.extend(notes);
        self
    }

    /// Adds lines to faults without a line: those of their parts.
    pub(super) fn with_lines(mut self, line_of: impl Fn(&Part) -> Option<usize>) -> Self {
        for fault in &mut self.parts.faults {
            if let Some(line) = line_of(&fault.part) {
                fault.error = fault.error.clone().at_line(line);
            }
        }
        self
    }

    /// Replaces the errors of the faults.
    pub(super) fn with_fault_errors(mut self, changed: impl Fn(Error) -> Error) -> Self {
        for fault in &mut self.parts.faults {
            fault.error = changed(fault.error.clone());
        }
        self
    }

    /// Faults of single parts, in the order of the file.
    pub fn faults(&self) -> &[Fault] {
        &self.parts.faults
    }

    /// Checks that no part has a fault, for callers that use the whole robot.
    ///
    /// # Errors
    /// The error of the first of [`Robot::faults`].
    pub fn check(&self) -> Result<()> {
        self.faults().first().map_or(Ok(()), |fault| Err(fault.error.clone()))
    }

    /// The plain data of this robot.
    pub fn parts(&self) -> &RobotParts {
        &self.parts
    }

    /// The name of the robot.
    pub fn name(&self) -> &str {
        &self.parts.name
    }

    /// All links, in the order of the file.
    pub fn links(&self) -> &[Link] {
        &self.parts.links
    }

    /// All joints, in the order of the file.
    pub fn joints(&self) -> &[Joint] {
        &self.parts.joints
    }

    /// The name of the root link.
    pub fn root(&self) -> &str {
        &self.parts.links[self.root].name
    }

    /// The index of the root link.
    pub fn root_place(&self) -> usize {
        self.root
    }

    /// The names of the leaf links, in the order of the file.
    pub fn leaves(&self) -> Vec<&str> {
        let children = self.children();
        let leaves = self.parts.links.iter().zip(&children).filter(|(_, joints)| joints.is_empty());
        leaves.map(|(link, _)| link.name.as_str()).collect()
    }

    /// The names of the links that end a limb: their parent joint moves, and no joint below moves.
    pub fn tips(&self) -> Vec<&str> {
        let mut moves_below = vec![false; self.parts.links.len()];
        for (index, joint) in self.parts.joints.iter().enumerate() {
            let mut link = (joint.kind != JointType::Fixed).then_some(self.ends[index].0);
            while let Some(place) = link.filter(|place| !moves_below[*place]) {
                moves_below[place] = true;
                link = self.above[place].map(|joint| self.ends[joint].0);
            }
        }
        let is_tip = |link: usize| {
            let moved = self.above[link].is_some_and(|joint| self.parts.joints[joint].kind != JointType::Fixed);
            moved && !moves_below[link]
        };
        (0..self.parts.links.len())
            .filter(|link| is_tip(*link))
            .map(|link| self.parts.links[link].name.as_str())
            .collect()
    }

    /// The child joints of each link.
    pub(super) fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.parts.links.len()];
        for (joint, (parent, _)) in self.ends.iter().enumerate() {
            children[*parent].push(joint);
        }
        children
    }

    /// The joints below the root, sorted topologically: each joint is after its parent. Otherwise they are in the order
    /// of the file.
    fn descent(&self) -> Vec<usize> {
        let children = self.children();
        let (mut order, mut open) = (Vec::new(), vec![self.root]);
        while let Some(link) = open.pop() {
            order.extend(&children[link]);
            open.extend(children[link].iter().rev().map(|joint| self.ends[*joint].1));
        }
        order
    }

    /// The actuators that are named or move several joints.
    pub fn actuators(&self) -> &[Actuator] {
        &self.parts.actuators
    }

    /// The indices of the joints with one degree of freedom (revolute or prismatic), in the order of the file: those of
    /// a configuration `q`. A mimic joint has its own entry, which [`Robot::follow`] sets.
    pub fn moving(&self) -> Vec<usize> {
        (0..self.joints().len()).filter(|joint| self.joints()[*joint].kind.is_single()).collect()
    }

    /// The indices of all joints, sorted topologically: each joint is after its parent.
    #[doc(hidden)]
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The indices of all joints, sorted topologically: each joint is after its parent, and a limb's joints are
    /// together.
    #[doc(hidden)]
    pub fn limb_by_limb(&self) -> Vec<usize> {
        let children = self.children();
        let below = |link: usize| children[link].iter().rev();
        let (mut order, mut open) = (Vec::new(), below(self.root).copied().collect::<Vec<_>>());
        while let Some(joint) = open.pop() {
            order.push(joint);
            open.extend(below(self.ends[joint].1));
        }
        order
    }

    /// The indices of the parent and the child link of a joint.
    ///
    /// # Panics
    /// When there is no such joint.
    pub fn ends(&self, joint: usize) -> (usize, usize) {
        self.ends[joint]
    }

    /// The indices of the joints from a link up to the root.
    ///
    /// # Panics
    /// When there is no such link.
    pub fn ancestry(&self, link: usize) -> Vec<usize> {
        std::iter::successors(self.above[link], |joint| self.above[self.ends[*joint].0]).collect()
    }

    /// The error for a robot without a visible shape. `notes` are the meshes that could not be read.
    #[doc(hidden)]
    pub fn unseen(&self, notes: &[String]) -> Error {
        let why: String = notes.iter().map(|note| format!("; {note}")).collect();
        let text = format!(
            "the robot `{}` has no shape, and no joint at a distance from its parent, so there is nothing to draw; give a link a visual or a collision{why}",
            shown(self.name())
        );
        Error::new(ErrorKind::BadValue, text)
    }

    /// The index of the link `name`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn link(&self, name: &str) -> Result<usize> {
        check::place("link", name, self.links().iter().map(|link| link.name.as_str()))
    }

    /// The index of the joint `name`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn joint(&self, name: &str) -> Result<usize> {
        check::place("joint", name, self.joints().iter().map(|joint| joint.name.as_str()))
    }

    /// The mimic law of `joint` relative to its independent leader; the identity for an independent joint.
    pub fn law(&self, joint: &Joint) -> Mimic {
        let own = Mimic { leader: joint.name.clone(), multiplier: BigRational::one(), offset: BigRational::zero() };
        let leader = |mimic: &Mimic| self.joints().iter().find(|joint| joint.name == mimic.leader);
        match joint.mimic.as_ref().and_then(|mimic| Some((mimic, leader(mimic)?))) {
            Some((mimic, leader)) => self.law(leader).then(mimic),
            None => own,
        }
    }

    /// The constant value of a mimic joint with a multiplier of zero \[rad or m\].
    pub(crate) fn constant(&self, joint: &Joint) -> Option<BigRational> {
        let law = self.law(joint);
        law.multiplier.is_zero().then_some(law.offset)
    }

    /// Sets the mimic joints of a configuration from their leaders.
    ///
    /// # Panics
    /// When `q` has fewer values than there are revolute and prismatic joints.
    #[doc(hidden)]
    pub fn follow(&self, q: &mut [f64]) {
        let moving = self.moving();
        for (place, joint) in moving.iter().enumerate() {
            let law = self.law(&self.joints()[*joint]);
            let leader = moving.iter().position(|other| self.joints()[*other].name == law.leader);
            if let Some(leader) = leader.filter(|leader| *leader != place) {
                q[place] = law.value(q[leader]);
            }
        }
    }

    /// The mass of all links \[kg\].
    pub fn mass(&self) -> f64 {
        self.links().iter().map(|link| link.inertia().mass()).sum()
    }

    /// Notes about links: physically impossible masses, and shapes that the reader ignored.
    pub fn doubts(&self) -> Vec<String> {
        let fault = |link: &Link| {
            let inertia = link.mass.as_ref()?.inertia();
            // A frame may have an explicit mass of zero.
            let weighs = inertia.generalised().iter().any(|entry| *entry != 0.0);
            inertia.check(NEGLIGIBLE * inertia.mass().abs()).err().filter(|_| weighs)
        };
        let of = |link: &Link| {
            let faults = fault(link).map(|fault| fault.message().to_owned()).into_iter();
            let named = |text: String| format!("link `{}`: {text}", shown(&link.name));
            faults.chain(link.notes.iter().cloned()).map(named).collect::<Vec<_>>()
        };
        self.links().iter().flat_map(of).collect()
    }
}

/// Makes `fixed` the joint `joint`, fixed at the constant `value` \[rad or m\].
pub(super) fn hold(joint: &Joint, fixed: &mut Joint, value: &BigRational) {
    let held = match joint.kind {
        JointType::Prismatic => Placement::shifted_along(&joint.axis, value),
        _ => Placement::turned_about(&joint.axis, value),
    };
    fixed.origin = joint.origin.placement.then(&held).into();
    (fixed.kind, fixed.limits, fixed.mimic) = (JointType::Fixed, None, None);
}
