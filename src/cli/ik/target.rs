//! Targets of `groebot ik`: from an argument, from joint values, or from the columns of a table.

use nalgebra::{Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::cli::columns::{Columns, Field, of_joints};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_robot::kinematics::{Chain, JointKind, LengthUnit, Quantity, Target, TargetNumber, Task};
use groebot_robot::spatial::{Pose, rotation};

/// The numbers of `text`, with angles in the input unit.
fn numbers(text: &str) -> Result<Vec<f64>> {
    let number = |part: &str| limits::number(part).ok();
    text.split(',').map(number).collect::<Option<_>>().ok_or_else(|| {
        Error::new(ErrorKind::Syntax, "give finite numbers separated by commas, such as 0.3,-1.5,2e-3, of at most 1e15")
    })
}

/// A target, and the values of the given joints.
pub type Aim = (Target, Vec<f64>);

/// The target of `text`, in the form of the chain's task, then the values of the given joints.
///
/// # Errors
/// [`ErrorKind::Syntax`] for text that is not a number; as [`aim`].
pub fn target(chain: &Chain, text: &str, degrees: bool) -> Result<Aim> {
    aim(chain, &numbers(text)?, degrees)
}

/// The target of these numbers, then the values of the given joints.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a number of values that differs from that of the chain's task, for a matrix that is not a rotation, and for a quaternion without
/// the value of the given joint.
pub fn aim(chain: &Chain, values: &[f64], degrees: bool) -> Result<Aim> {
    let count = chain.given_inputs().len();
    let Some(own) = values.len().checked_sub(count) else {
        let names = chain.parts().given.join(", ");
        let text = format!("{} numbers are given; the values of {count} joints are last: {names}", values.len());
        return Err(Error::new(ErrorKind::BadValue, text));
    };
    if count == 1 && has_quaternion(chain.task(), values) {
        let text = format!(
            "{} numbers are given: the last four may be a quaternion without the value of the given joint, or three angles with it; give a quaternion or a matrix, \
             then the value of {}",
            values.len(),
            chain.parts().given.join(", ")
        );
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    let turns = chain.given_inputs().into_iter().map(|joint| chain.joints()[joint].kind == JointKind::Revolute);
    let inside = |(value, turns): (&f64, bool)| if degrees && turns { value.to_radians() } else { *value };
    let given = values[own..].iter().zip(turns).map(inside).collect();
    Ok((target_of(chain, &values[..own], degrees)?, given))
}

/// The largest deviation of a quaternion's length from one, that of `solve`'s targets.
const QUATERNION: f64 = 1e-6;

/// Whether `values` without those of given joints are a target with a quaternion.
fn has_quaternion(task: Task, values: &[f64]) -> bool {
    let is_target = matches!((task, values.len()), (Task::Pose, 7) | (Task::Rotation, 4));
    let length = values.iter().rev().take(4).map(|entry| entry * entry).sum::<f64>().sqrt();
    is_target && (length - 1.0).abs() < QUATERNION
}

/// The target of `values`.
fn target_of(chain: &Chain, values: &[f64], degrees: bool) -> Result<Target> {
    let radians = |value: f64| if degrees { value.to_radians() } else { value };
    let wanted = match chain.task() {
        Task::Pose => {
            "a pose has 6 numbers (x, y, z, roll, pitch, yaw), 7 (x, y, z, qx, qy, qz, qw) or 12 (x, y, z, the matrix by rows)"
        }
        Task::Position => "a position has 3 numbers (x, y, z)",
        Task::Ray => "a ray has 6 numbers (x, y, z and the direction's x, y, z)",
        Task::PositionPitchRoll => "a position with pitch and roll has 5 numbers (x, y, z, pitch, roll)",
        Task::PositionYaw { .. } => "a position with yaw has 4 numbers (x, y, z, yaw)",
        Task::Direction => "a direction has 3 numbers (x, y, z, of any length)",
        Task::Rotation => "a rotation has 3 numbers (roll, pitch, yaw), 4 (qx, qy, qz, qw) or 9 (the matrix by rows)",
        Task::PlanarPosition { .. } => "a planar position has 2 numbers",
        Task::PlanarPose { .. } => "a planar pose has 3 numbers, the last one the angle",
    };
    let euler = |[r, p, y]: [f64; 3]| UnitQuaternion::from_euler_angles(radians(r), radians(p), radians(y));
    let unit = |vector: Vector3<f64>| vector.try_normalize(0.0).unwrap_or(vector);
    Ok(match (chain.task(), values.len(), values) {
        (Task::Pose, 6, &[x, y, z, roll, pitch, yaw]) => {
            Target::Pose(Pose::from_parts(Translation3::new(x, y, z), euler([roll, pitch, yaw])))
        }
        (Task::Pose, 7, &[x, y, z, i, j, k, w]) => {
            let rotation = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
            Target::Pose(Pose::from_parts(Translation3::new(x, y, z), rotation))
        }
        (Task::Pose, 12, &[x, y, z, ..]) => {
            Target::Pose(Pose::from_parts(Translation3::new(x, y, z), by_rows(&values[3..])?))
        }
        (Task::Rotation, 9, _) => Target::Rotation(by_rows(values)?),
        (Task::Position, 3, &[x, y, z]) => Target::Position([x, y, z].into()),
        (Task::Ray, 6, &[x, y, z, i, j, k]) => {
            Target::Ray { point: [x, y, z].into(), direction: unit(Vector3::new(i, j, k)) }
        }
        (Task::PositionPitchRoll, 5, &[x, y, z, pitch, roll]) => {
            Target::PositionPitchRoll { point: [x, y, z].into(), pitch: radians(pitch), roll: radians(roll) }
        }
        (Task::PositionYaw { .. }, 4, &[x, y, z, yaw]) => {
            Target::PositionYaw { point: [x, y, z].into(), yaw: radians(yaw) }
        }
        (Task::Direction, 3, &[i, j, k]) => Target::Direction(unit(Vector3::new(i, j, k))),
        (Task::Rotation, 3, &[roll, pitch, yaw]) => Target::Rotation(euler([roll, pitch, yaw])),
        (Task::Rotation, 4, &[i, j, k, w]) => {
            Target::Rotation(UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)))
        }
        (Task::PlanarPosition { .. }, 2, &[x, y]) => Target::PlanarPosition([x, y]),
        (Task::PlanarPose { .. }, 3, &[x, y, phi]) => Target::PlanarPose([x, y, radians(phi)]),
        (_, count, _) => {
            return Err(Error::new(ErrorKind::BadValue, format!("{count} numbers are given; {wanted}")));
        }
    })
}

/// The rotation with this matrix by rows.
fn by_rows(entries: &[f64]) -> Result<UnitQuaternion<f64>> {
    rotation::from_matrix(&Matrix3::from_row_slice(entries))
}

/// The columns of a table of targets of `chain`: those of its task, a rotation as a quaternion, a matrix or angles, then its given joints.
pub fn columns(chain: &Chain, degrees: bool) -> Columns {
    let (layout, joints) = (chain.task().layout(), of_joints(chain.joints()));
    let given: Vec<Field> = chain.given_inputs().into_iter().map(|joint| joints[joint].clone()).collect();
    let is_entry = |number: &TargetNumber| matches!(number, TargetNumber::Rotation { .. });
    let (entries, others): (Vec<TargetNumber>, Vec<TargetNumber>) = layout.numbers().iter().partition(|n| is_entry(n));
    let [entries, others] = [entries, others].map(|list| list.into_iter().map(Field::of_target).collect::<Vec<_>>());
    let rotations = if entries.is_empty() {
        vec![Vec::new()]
    } else {
        let quaternion = ["qx", "qy", "qz", "qw"].map(|name| Field::new(name, Quantity::Number));
        let angles = ["roll", "pitch", "yaw"].map(|name| Field::new(name, Quantity::Angle));
        vec![quaternion.to_vec(), entries, angles.to_vec()]
    };
    let form = |rotation: &Vec<Field>| [&others[..], rotation, &given].concat();
    let forms = rotations.iter().map(form).collect();
    Columns {
        forms,
        joints: joints.into_iter().map(|joint| joint.name).collect(),
        millimetres: chain.length_unit() == LengthUnit::Millimetre,
        degrees,
        skips_unsolved: false,
    }
}

/// The target that the joint values of `text` reach.
///
/// # Errors
/// [`ErrorKind::Syntax`] for text that is not a number; as [`Target::reached`].
pub fn reached(chain: &Chain, text: &str, degrees: bool) -> Result<Aim> {
    let turns = |i: usize| chain.joints().get(i).is_some_and(|joint| joint.kind == JointKind::Revolute);
    let inside = |(i, value): (usize, f64)| if degrees && turns(i) { value.to_radians() } else { value };
    let q: Vec<f64> = numbers(text)?.into_iter().enumerate().map(inside).collect();
    let target = Target::reached(chain, &q)?;
    Ok((target, chain.given_inputs().into_iter().map(|joint| q[joint]).collect()))
}
