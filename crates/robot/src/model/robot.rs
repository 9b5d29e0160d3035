//! A robot as a tree of links and joints, checked. Main type: [`Robot`].

use num_traits::{One, Zero};

use super::check;
use super::{Actuator, Fault, Joint, JointType, Link, Mimic, Part, RobotParts};
use crate::document::shown;
use crate::spatial::NEGLIGIBLE;
use crate::spatial::exact::Placement;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// A checked tree of links and joints, with masses and shapes. It never changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    parts: RobotParts,
    /// The joint above each link.
    above: Vec<Option<usize>>,
    /// The parent and child link of each joint.
    ends: Vec<(usize, usize)>,
    root: usize,
    /// The joints, each behind those above it.
    order: Vec<usize>,
}

impl Robot {
    /// Checks links and joints and makes them a tree.
    ///
    /// # Errors
    /// As [`Robot::with_faults`] and [`Robot::check`].
    pub fn new(parts: RobotParts) -> Result<Self> {
        let robot = Robot::with_faults(parts)?;
        robot.check()?;
        Ok(robot)
    }

    /// Makes links and joints a tree. What is wrong with a single joint or actuator is kept in [`Robot::faults`]: an axis of zero, missing, inverted or
    /// infinite limits, a joint that follows none or itself in the end, an actuator of a joint that the robot does not have. A chain elsewhere is sound.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`] for two links or joints of one name; [`ErrorKind::UnknownName`] for a joint between links that do not
    /// exist; [`ErrorKind::BadValue`] for no or several roots, a loop, an empty name. All with name and line.
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

    /// The robot whose rotations are what their numbers mean: quarter turns where 1.5708 is given.
    ///
    /// # Errors
    /// As [`Robot::with_faults`].
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

    /// The robot whose joints that follow others by a multiplier of zero are fixed at their constant value: right to rounding.
    ///
    /// # Errors
    /// As [`Robot::with_faults`].
    pub fn with_constants_fixed(&self) -> Result<Self> {
        let mut parts = self.parts.clone();
        for (joint, fixed) in self.parts.joints.iter().zip(&mut parts.joints) {
            let Some(value) = self.constant(joint).filter(|_| joint.kind.is_single()) else { continue };
            let held = match joint.kind {
                JointType::Prismatic => Placement::shifted_along(&joint.axis, &value),
                _ => Placement::turned_about(&joint.axis, &value),
            };
            fixed.origin = joint.origin.placement.then(&held).into();
            (fixed.kind, fixed.limits, fixed.mimic) = (JointType::Fixed, None, None);
        }
        Robot::with_faults(parts)
    }

    /// The same robot with more notes.
    #[must_use]
    pub fn with_notes(mut self, notes: Vec<String>) -> Self {
        self.parts.notes.extend(notes);
        self
    }

    /// The same robot, faults without a line at the line of their part.
    pub(super) fn with_lines(mut self, line_of: impl Fn(&Part) -> Option<usize>) -> Self {
        for fault in &mut self.parts.faults {
            if let Some(line) = line_of(&fault.part) {
                fault.error = fault.error.clone().at_line(line);
            }
        }
        self
    }

    /// What is wrong with single parts, in the order of the file.
    pub fn faults(&self) -> &[Fault] {
        &self.parts.faults
    }

    /// Fails for a fault of any part: for who uses the whole robot.
    ///
    /// # Errors
    /// That of the first of [`Robot::faults`].
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

    /// The link that hangs on none.
    pub fn root(&self) -> &str {
        &self.parts.links[self.root].name
    }

    /// The place of the link that hangs on none.
    pub fn root_place(&self) -> usize {
        self.root
    }

    /// The links that carry none, in the order of the file.
    pub fn leaves(&self) -> Vec<&str> {
        let children = self.children();
        let leaves = self.parts.links.iter().zip(&children).filter(|(_, joints)| joints.is_empty());
        leaves.map(|(link, _)| link.name.as_str()).collect()
    }

    /// The links that end a limb: moved by the joint above them, with no moving joint below.
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

    /// The joints that hang on each link.
    pub(super) fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.parts.links.len()];
        for (joint, (parent, _)) in self.ends.iter().enumerate() {
            children[*parent].push(joint);
        }
        children
    }

    /// The joints below the root, each behind those above it, in the order of the file where that leaves a choice.
    fn descent(&self) -> Vec<usize> {
        let children = self.children();
        let (mut order, mut open) = (Vec::new(), vec![self.root]);
        while let Some(link) = open.pop() {
            order.extend(&children[link]);
            open.extend(children[link].iter().rev().map(|joint| self.ends[*joint].1));
        }
        order
    }

    /// The actuators that move several joints, or that are named.
    pub fn actuators(&self) -> &[Actuator] {
        &self.parts.actuators
    }

    /// The places of the joints that one number moves, which turn or slide, in the order of the file: those of a configuration `q`. A joint
    /// that follows another has its own place; [`Robot::follow`] fills it.
    pub fn moving(&self) -> Vec<usize> {
        (0..self.joints().len()).filter(|joint| self.joints()[*joint].kind.is_single()).collect()
    }

    /// The places of all joints, each behind those above it.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The places of all joints, each behind those above it, and a limb's joints together.
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

    /// The places of the parent and the child link of a joint.
    ///
    /// # Panics
    /// When there is no such joint.
    pub fn ends(&self, joint: usize) -> (usize, usize) {
        self.ends[joint]
    }

    /// The places of the joints from a link up to the root.
    ///
    /// # Panics
    /// When there is no such link.
    pub fn ancestry(&self, link: usize) -> Vec<usize> {
        std::iter::successors(self.above[link], |joint| self.above[self.ends[*joint].0]).collect()
    }

    /// The error for a robot of which nothing is to be seen; `notes` say which meshes could not be read.
    pub fn unseen(&self, notes: &[String]) -> Error {
        let why: String = notes.iter().map(|note| format!("; {note}")).collect();
        let text = format!(
            "the robot `{}` has no shape, and no joint away from its parent: there is nothing to see; give a link a visual or a collision{why}",
            shown(self.name())
        );
        Error::new(ErrorKind::BadValue, text)
    }

    /// The place of the link `name`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn link(&self, name: &str) -> Result<usize> {
        check::place("link", name, self.links().iter().map(|link| link.name.as_str()))
    }

    /// The place of the joint `name`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn joint(&self, name: &str) -> Result<usize> {
        check::place("joint", name, self.joints().iter().map(|joint| joint.name.as_str()))
    }

    /// How `joint` follows the one that leads it in the end; itself when it follows none.
    pub fn law(&self, joint: &Joint) -> Mimic {
        let own = Mimic { leader: joint.name.clone(), multiplier: BigRational::one(), offset: BigRational::zero() };
        let leader = |mimic: &Mimic| self.joints().iter().find(|joint| joint.name == mimic.leader);
        match joint.mimic.as_ref().and_then(|mimic| Some((mimic, leader(mimic)?))) {
            Some((mimic, leader)) => self.law(leader).then(mimic),
            None => own,
        }
    }

    /// The value that `joint` always has: that of one that follows another one by a multiplier of zero \[rad or m\].
    pub fn constant(&self, joint: &Joint) -> Option<BigRational> {
        let law = self.law(joint);
        law.multiplier.is_zero().then_some(law.offset)
    }

    /// Puts the joints of a configuration that follow others where these bring them.
    ///
    /// # Panics
    /// When `q` has fewer values than joints turn or slide.
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

    /// What is to be said about links: masses that no body has, and shapes that the reader left out.
    pub fn doubts(&self) -> Vec<String> {
        let fault = |link: &Link| {
            let inertia = link.mass.as_ref()?.inertia();
            // A frame may say that it weighs nothing.
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
