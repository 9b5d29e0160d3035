//! `--base`, `--tip` and `--gravity`: the part of a robot whose equations of motion are requested. Main type:
//! [`PartArguments`].

use nalgebra::Vector3;
use num_traits::ToPrimitive;

use super::description::DescriptionArguments;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::parse_rational;
use groebot_robot::model::{JointType, ReadOptions, Robot};
use groebot_robot::spatial::exact::ExactVector;

/// The links between which joints move, and gravity.
#[derive(clap::Args)]
pub struct PartArguments {
    /// The first link of the moving part; joints that are not between it and the tip are held at zero (default: the
    /// root)
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// The last link of the moving part (default: all links)
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
    /// Gravity in the frame of the root, or of `--base` [m/s^2]
    #[arg(long, value_name = "X,Y,Z", value_parser = gravity, allow_hyphen_values = true, default_value = "0,0,-9.81")]
    pub gravity: Gravity,
    #[command(flatten)]
    described: DescriptionArguments,
}

impl PartArguments {
    /// The options for the reader of the description.
    pub fn options(&self) -> ReadOptions {
        self.described.options()
    }

    /// The robot with only the joints between the two links, and gravity \[m/s^2\] in its root's frame. Joints that
    /// follow others by a multiplier of zero are fixed.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for unknown links, [`ErrorKind::BadValue`] where the base is not above the tip.
    pub fn of(&self, robot: &Robot) -> Result<(Robot, Vector3<f64>)> {
        let robot = &robot.with_constants_fixed()?;
        let ends = [self.base.as_deref(), self.tip.as_deref()];
        let place = |name: Option<&str>| name.map(|name| robot.link(name)).transpose();
        let (base, tip) = (place(ends[0])?, place(ends[1])?);
        let above = |link: Option<usize>| link.map_or_else(Vec::new, |link| robot.ancestry(link));
        let (carrying, path) = (above(base), above(tip));
        if tip.is_some() && !carrying.iter().all(|joint| path.contains(joint)) {
            let [base, tip] = ends.map(Option::unwrap_or_default);
            return Err(Error::new(ErrorKind::BadValue, format!("link `{base}` is not above link `{tip}`")));
        }
        let mut parts = robot.parts().clone();
        let below = |joint: usize| {
            base.is_none_or(|base| robot.ancestry(robot.ends(joint).1).iter().any(|&up| robot.ends(up).0 == base))
        };
        for (joint, other) in parts.joints.iter_mut().enumerate() {
            let moves = if tip.is_some() { path.contains(&joint) && !carrying.contains(&joint) } else { below(joint) };
            let is_part = ends.iter().any(Option::is_some);
            if !moves && (other.kind.is_single() || is_part) {
                (other.kind, other.limits, other.mimic) = (JointType::Fixed, None, None);
            }
        }
        let still: Vec<String> =
            parts.joints.iter().filter(|joint| !joint.kind.is_single()).map(|joint| joint.name.clone()).collect();
        for actuator in &mut parts.actuators {
            actuator.joints.retain(|(joint, _)| !still.contains(joint));
        }
        parts.actuators.retain(|actuator| !actuator.joints.is_empty());
        let robot = Robot::new(parts)?;
        let model = groebot_robot::dynamics::Model::new(&robot)?;
        let turn = base.map_or_else(nalgebra::UnitQuaternion::identity, |base| model.link(base).1.rotation);
        Ok((robot, turn * self.gravity.in_doubles()))
    }
}

/// Three exact numbers.
#[derive(Clone, Debug)]
pub struct Gravity(pub ExactVector);

impl Gravity {
    fn in_doubles(&self) -> Vector3<f64> {
        Vector3::from(self.0.each_ref().map(|entry| entry.to_f64().unwrap_or(f64::NAN)))
    }
}

/// Reads three numbers separated by commas.
fn gravity(text: &str) -> std::result::Result<Gravity, String> {
    let numbers: Option<Vec<_>> = text.split(',').map(|word| parse_rational(word.trim()).ok()).collect();
    let exact = numbers.and_then(|numbers| ExactVector::try_from(numbers).ok()).map(Gravity);
    let finite = exact.filter(|gravity| gravity.in_doubles().iter().all(|entry| entry.is_finite()));
    finite.ok_or_else(|| "give three finite numbers separated by commas, such as 0,0,-9.81".to_owned())
}
