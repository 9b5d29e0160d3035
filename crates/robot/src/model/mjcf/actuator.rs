//! Actuators of an MJCF: the largest torques and forces of joints, and their position servos.

use std::collections::BTreeMap;

use super::body::{Reader, magnitude};
use super::compiler::double;
use super::defaults::{MAIN, Styled};
use super::joint::is_limited;
use crate::Result;
use crate::model::Servo;
use crate::model::urdf::xml::Element;

/// The elements of `<actuator>` that act on a joint.
const KINDS: [&str; 8] = ["general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder", "dcmotor"];

impl<'e> Reader<'_, 'e> {
    /// Reads `<actuator>`: the effort of a joint without `actuatorfrcrange` is the sum of the limits of its actuators.
    /// The servo of a joint is the sum of its actuators with a position gain. Actuators of tendons and sites are noted.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for wrong numbers, [`crate::ErrorKind::UnknownName`] for an unknown class.
    pub fn read_actuators(&mut self) -> Result<()> {
        let mut efforts: BTreeMap<&'e str, Option<f64>> = BTreeMap::new();
        let mut servos: BTreeMap<&'e str, Servo> = BTreeMap::new();
        let mut others = 0_usize;
        let sections = self.root.children.iter().filter(|child| child.name == "actuator");
        for element in sections.flat_map(|section| &section.children) {
            let joint = element.attribute("joint").or(element.attribute("jointinparent"));
            let Some(joint) = joint.filter(|_| KINDS.contains(&element.name.as_str())) else {
                others += 1;
                continue;
            };
            let styled = self.classes.styled(element, MAIN, &[element.name.as_str(), "general"])?;
            let effort = self.effort(element, &styled)?;
            let gear = gear(&styled)?;
            let gains = if has_gains(element) { gains(element, &styled)? } else { [0.0; 2] };
            let [stiffness, damping] = gains.map(|gain| gain * gear * gear);
            let servo = servos.entry(joint).or_insert(Servo { stiffness: 0.0, damping: 0.0 });
            (servo.stiffness, servo.damping) = (servo.stiffness + stiffness, servo.damping + damping);
            let sum = efforts.entry(joint).or_insert(Some(0.0));
            *sum = sum.zip(effort).map(|(sum, effort)| sum + effort);
        }
        for joint in self.parts.joints.iter_mut().filter(|joint| joint.effort.is_none()) {
            joint.effort = efforts.get(joint.name.as_str()).copied().flatten().filter(|effort| effort.is_finite());
        }
        for joint in &mut self.parts.joints {
            joint.servo = servos.get(joint.name.as_str()).copied().filter(|servo| servo.stiffness > 0.0);
        }
        if others > 0 {
            self.note(format!("{others} actuators of tendons, sites or bodies are ignored"));
        }
        Ok(())
    }

    /// The largest torque or force of an actuator at its joint; `None` without a limit.
    fn effort(&self, element: &'e Element, styled: &Styled<'e>) -> Result<Option<f64>> {
        let gear = gear(styled)?.abs();
        if let Some(force) = self.limit(styled, "forcerange", "forcelimited")? {
            return Ok(Some(force * gear));
        }
        // The force of a motor is its control times its gain.
        let gain = match element.name.as_str() {
            "motor" => Some(1.0),
            "general" if is_plain(styled) => {
                Some(styled.list("gainprm", 1..=10)?.and_then(|gain| gain.first().map(double)).unwrap_or(1.0).abs())
            }
            _ => None,
        };
        let Some(gain) = gain else { return Ok(None) };
        Ok(self.limit(styled, "ctrlrange", "ctrllimited")?.map(|control| control * gain * gear))
    }

    /// The magnitude of a range, if it limits.
    fn limit(&self, styled: &Styled<'e>, range: &str, switch: &str) -> Result<Option<f64>> {
        let Some(given) = styled.numbers::<2>(range)? else { return Ok(None) };
        let bounds = [double(&given[0]), double(&given[1])];
        Ok(is_limited(styled, switch, bounds, self.compiler.auto_limits)?.then(|| magnitude(&given)))
    }
}

/// The ratio of an actuator's motion to that of its joint.
fn gear(styled: &Styled<'_>) -> Result<f64> {
    Ok(styled.list("gear", 1..=6)?.and_then(|gear| gear.first().map(double)).unwrap_or(1.0))
}

/// Whether the gains of an actuator are those of a motor. The second number of `user` is 0 in models by [`Robot::to_mjcf`](crate::model::Robot::to_mjcf) of robots
/// without gains.
fn has_gains(element: &Element) -> bool {
    element.attribute("user").and_then(|numbers| numbers.split_whitespace().nth(1)) != Some("0")
}

/// The position gain and the velocity gain of an actuator, in its own motion; zero where it has none. `dampratio` and `timeconst`, which depend on the masses of
/// the compiled model, are not read.
fn gains(element: &Element, styled: &Styled<'_>) -> Result<[f64; 2]> {
    let number = |key: &str, default: f64| Ok(styled.float(key)?.unwrap_or(default));
    match element.name.as_str() {
        "position" => Ok([number("kp", 1.0)?, number("kv", 0.0)?]),
        "velocity" => Ok([0.0, number("kv", 1.0)?]),
        "general" if styled.attribute("biastype") == Some("affine") => {
            let bias: Vec<f64> = styled.list("biasprm", 1..=10)?.unwrap_or_default().iter().map(double).collect();
            Ok([1, 2].map(|at| (-bias.get(at).copied().unwrap_or(0.0)).max(0.0)))
        }
        _ => Ok([0.0; 2]),
    }
}

/// Whether a general actuator has a fixed gain and no bias.
fn is_plain(styled: &Styled<'_>) -> bool {
    styled.attribute("biastype").is_none_or(|word| word == "none")
        && styled.attribute("gaintype").is_none_or(|word| word == "fixed")
}
