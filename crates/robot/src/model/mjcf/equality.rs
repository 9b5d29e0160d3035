//! Constraints of an MJCF: joints that follow others, and what a tree of links cannot express.

use num_traits::Zero;

use super::body::{Reader, absolute};
use super::compiler::flag;
use super::defaults::{MAIN, Styled};
use crate::Result;
use crate::document::shown;
use crate::model::Mimic;
use crate::model::urdf::xml::Element;

impl<'e> Reader<'_, 'e> {
    /// Reads `<equality>`: linear laws of two joints become mimic joints; the others are notes.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for wrong numbers, [`crate::ErrorKind::UnknownName`] for an unknown class.
    pub fn read_equalities(&mut self) -> Result<()> {
        let sections = self.root.children.iter().filter(|child| child.name == "equality");
        for element in sections.flat_map(|section| &section.children) {
            let styled = self.classes.styled(element, MAIN, &["equality"])?;
            if styled.holder("active").map_or(Ok(None), |holder| flag(holder, "active"))? == Some(false) {
                continue;
            }
            if element.name != "joint" {
                let text = format!(
                    "line {}: the constraint <{}> is ignored: links form a tree without it",
                    element.line,
                    shown(&element.name)
                );
                self.note(text);
            } else if let Some(note) = self.follow(element, &styled)? {
                self.note(format!("line {}: {note}", element.line));
            }
        }
        Ok(())
    }

    /// Adds the mimic law of a constraint between two joints. Returns a note if it is ignored.
    fn follow(&mut self, element: &Element, styled: &Styled<'e>) -> Result<Option<String>> {
        let follower = element.required("joint1")?;
        let ignored = |why: &str| Ok(Some(format!("the law of joint `{}` is ignored: {why}", shown(follower))));
        let Some(leader) = element.attribute("joint2") else {
            return ignored("it holds the joint at a constant");
        };
        let mut law = styled.list("polycoef", 1..=5)?.unwrap_or_default();
        if law.iter().skip(2).any(|coefficient| !coefficient.is_zero()) {
            return ignored("its polynomial is not linear");
        }
        law.resize(2, num_traits::Zero::zero());
        if styled.holder("polycoef").is_none() {
            law[1] = num_traits::One::one();
        }
        let own = self.parts.joints.iter().position(|joint| joint.name == follower);
        let reference = |name: &str| self.references.get(name);
        let (Some(own), Some(start), Some(other)) = (own, reference(follower), reference(leader)) else {
            return ignored("one of its joints is not a hinge or slide of the robot");
        };
        if self.parts.joints[own].mimic.is_some() {
            return ignored("the joint already follows another one");
        }
        let offset = absolute(&law[0], &law[1], start, other);
        let mimic = Mimic { leader: leader.to_owned(), multiplier: law[1].clone(), offset };
        self.parts.joints[own].mimic = Some(mimic);
        Ok(None)
    }

    /// Notes the tendons, which are no parts of a robot.
    pub fn read_tendons(&mut self) {
        let sections = self.root.children.iter().filter(|child| child.name == "tendon" || child.name == "deformable");
        let sections: Vec<&Element> = sections.filter(|section| !section.children.is_empty()).collect();
        for section in sections {
            let count = section.children.len();
            let text = format!("line {}: <{}> with {count} elements is ignored", section.line, shown(&section.name));
            self.note(text);
        }
    }
}
