//! Input checks of the equations of motion: joints with several degrees of freedom, negative friction or rotor inertia,
//! lists of the wrong length.

use super::{Base, Equations, State};
use crate::document::shown;
use crate::model::{JointType, Robot};
use crate::{Error, ErrorKind, Result};

/// Tolerance of the length of a unit quaternion.
const ROUNDED: f64 = 1e-3;

/// Refuses planar and floating joints below the root, since their degrees of freedom would be missing. Those at the
/// root are held at zero, each with a note.
pub(super) fn check_freedoms(robot: &Robot) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    for (place, joint) in robot.joints().iter().enumerate() {
        let kind = match joint.kind {
            JointType::Planar | JointType::Floating => joint.kind.name(),
            _ => continue,
        };
        let (parent, child) = robot.ends(place);
        if parent != robot.root_place() {
            let text = format!(
                "the type `{kind}` has several degrees of freedom, which equations of motion do not support; choose links with revolute and prismatic joints between them (--base, --tip), or give it the type `fixed`"
            );
            return Err(joint.error(ErrorKind::Unsupported, &text));
        }
        let [name, child] = [&joint.name, &robot.links()[child].name].map(|name| shown(name));
        notes.push(format!(
            "joint `{name}` of the type `{kind}` is held at zero: `{child}` is fixed to the root; --floating makes the root free"
        ));
    }
    Ok(notes)
}

/// Refuses negative damping, friction and rotor inertia, since such a joint would gain energy.
pub(super) fn check_drives(robot: &Robot) -> Result<()> {
    for joint in robot.joints() {
        let values = [("damping", joint.damping), ("friction", joint.friction), ("rotor inertia", joint.armature)];
        if let Some((name, value)) = values.into_iter().find(|(_, value)| *value < 0.0) {
            let text = format!("its {name} is {value}; give a nonnegative one");
            return Err(joint.error(ErrorKind::BadValue, &text));
        }
    }
    Ok(())
}

impl Equations {
    pub(super) fn check(&self, state: State<'_>, third: Option<(&str, &[f64])>) -> Result<()> {
        self.check_place(state.q)?;
        for (name, list) in std::iter::once(("velocity", state.velocity)).chain(third) {
            check_list(name, list, self.freedoms())?;
        }
        for (link, wrench) in state.outside {
            self.check_link(*link)?;
            if !wrench.to_vector().iter().all(|x| x.is_finite()) {
                let text = format!(
                    "the external wrench on link {link} is {:?}; give finite numbers",
                    wrench.to_vector().as_slice()
                );
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        Ok(())
    }

    pub(super) fn check_place(&self, q: &[f64]) -> Result<()> {
        check_list("q", q, self.coordinates())?;
        if self.base == Base::Floating {
            let length = q[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
            if (length - 1.0).abs() > ROUNDED {
                let text = format!("the quaternion q3..q6 has length {length}; give one of length 1");
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        Ok(())
    }

    pub(super) fn check_link(&self, link: usize) -> Result<()> {
        let most = self.frames.len() - 1;
        let text = || format!("there is no link {link}; links are counted from 0 to {most}");
        if link <= most { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
    }
}

fn check_list(name: &str, list: &[f64], count: usize) -> Result<()> {
    let text = if list.len() != count {
        format!("{name}: {} numbers are given, the robot has {count}", list.len())
    } else if let Some(at) = list.iter().position(|value| !value.is_finite()) {
        format!("{name}{at} is {}; give a finite number", list[at])
    } else {
        return Ok(());
    };
    Err(Error::new(ErrorKind::BadValue, text))
}
