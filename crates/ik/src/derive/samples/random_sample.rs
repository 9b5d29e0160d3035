//! Random reachable targets modulo a prime. The joints are at rational points of their circles; forward kinematics gives the target.

use crate::derive::closure::{
    Arithmetic, Assignment, Coupling, Evaluation, Image, JointValue, Letter, Measure, Mechanism, Modular, Multilinear,
    Object, Relation, Target, TargetRotation, Word, evaluate,
};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Field, Ring, Zp};
use groebot_algebra::random::SplitMix64;
use groebot_robot::kinematics::{ExactVector, Task};

/// Joint values and the target that they reach, modulo a prime.
#[derive(Clone, Debug)]
pub struct RandomSample {
    joints: Vec<JointValue<u64>>,
    target: Target<u64>,
}

impl RandomSample {
    /// Random values of all joints, and their target.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a denominator that the prime divides.
    pub fn draw(mechanism: &Mechanism, arithmetic: &mut Modular, random: &mut SplitMix64) -> Result<Self> {
        let mut joints: Vec<JointValue<u64>> =
            (0..mechanism.joints().len()).map(|joint| value(mechanism, joint, arithmetic, random)).collect();
        for (follower, coupling) in mechanism.followers() {
            joints[follower] = followed(coupling, &joints[coupling.leader], arithmetic);
        }
        let nowhere = Target { position: [0; 3], rotation: TargetRotation::Unspecified };
        let assignment = Assignment { joints, target: nowhere };
        let parameters = parameters(mechanism, &assignment, arithmetic)?;
        let target = Target::new(mechanism, &parameters, arithmetic)?;
        Ok(RandomSample { joints: assignment.joints, target })
    }

    /// `relation` at these joint values and this target, as a polynomial in the joints of the set `unknown`.
    ///
    /// # Errors
    /// As [`evaluate`].
    pub fn evaluate(
        &self,
        mechanism: &Mechanism,
        relation: &Relation,
        unknown: u32,
        arithmetic: &mut Modular,
    ) -> Result<Multilinear<u64>> {
        let pick = |(joint, value): (usize, &JointValue<u64>)| match unknown >> joint & 1 {
            0 => value.clone(),
            _ => JointValue::Unknown,
        };
        let joints = self.joints.iter().enumerate().map(pick).collect();
        evaluate(mechanism, relation, &Assignment { joints, target: self.target.clone() }, arithmetic)
    }
}

/// A random point of the circle c^2 + n s'^2 = 1, or a random length.
fn value(mechanism: &Mechanism, joint: usize, arithmetic: &mut Modular, random: &mut SplitMix64) -> JointValue<u64> {
    let (screw, field) = (&mechanism.joints()[joint], arithmetic.field());
    let p = field.modulus();
    if !screw.is_revolute() {
        return JointValue::Length(random.unit(p));
    }
    let n = arithmetic.rational(&screw.square);
    loop {
        let t = random.unit(p);
        let square = field.mul(&n, &field.mul(&t, &t));
        if let Some(inverse) = field.inverse(&field.add(&1, &square)) {
            let cosine = field.mul(&field.sub(&1, &square), &inverse);
            let sine = field.mul(&field.add(&t, &t), &inverse);
            return JointValue::Angle { cosine, sine };
        }
    }
}

/// The value of a joint that follows another one.
fn followed(coupling: &Coupling, leader: &JointValue<u64>, arithmetic: &mut Modular) -> JointValue<u64> {
    let values = match leader {
        JointValue::Angle { cosine, sine } => coupling.follow(&[*cosine, *sine], arithmetic),
        JointValue::Length(length) => coupling.follow(&[*length], arithmetic),
        JointValue::Unknown => Vec::new(),
    };
    match values[..] {
        [cosine, sine] => JointValue::Angle { cosine, sine },
        [length] => JointValue::Length(length),
        _ => JointValue::Unknown,
    }
}

/// The numbers of the target by forward kinematics, in the order of [`Mechanism::parameters`].
fn parameters(mechanism: &Mechanism, at: &Assignment<u64>, arithmetic: &mut Modular) -> Result<Vec<u64>> {
    let word = Word((0..mechanism.joints().len()).map(Letter::Joint).collect());
    let mut image = |object: Object| -> Result<[u64; 3]> {
        match Evaluation::new(mechanism, at, arithmetic).carry(&word, &object, Measure::Offset)? {
            Image::Point(x) | Image::Direction(x) => Ok(x.map(|entry| entry.constant_term().copied().unwrap_or(0))),
            _ => Err(Error::new(ErrorKind::BadValue, "forward kinematics carries points and directions")),
        }
    };
    let position = image(Object::Point(mechanism.tip_point().clone()))?;
    let aim = image(Object::Direction(mechanism.aim().clone()))?;
    let mut columns = Vec::new();
    for k in 0..3 {
        let column: ExactVector = mechanism.tip_rotation().each_ref().map(|row| row[k].clone());
        columns.push(image(Object::Direction(column))?);
    }
    let rotation = (0..9).map(|entry| columns[entry % 3][entry / 3]);
    Ok(match mechanism.seen() {
        Task::Pose | Task::Ray | Task::PositionPitchRoll => position.into_iter().chain(rotation).collect(),
        Task::Position => position.to_vec(),
        Task::Direction => aim.to_vec(),
        Task::Rotation => rotation.collect(),
        Task::PlanarPosition { plane } => plane.coordinates().map(|k| position[k]).to_vec(),
        Task::PositionYaw { axis } => {
            let [a, b] = axis.across();
            position.into_iter().chain([columns[a][a], columns[a][b]]).collect()
        }
        Task::PlanarPose { plane } => {
            let (a, b) = ((plane.normal() + 1) % 3, (plane.normal() + 2) % 3);
            let turned = [columns[a][a], columns[a][b]];
            plane.coordinates().map(|k| position[k]).into_iter().chain(turned).collect()
        }
    })
}

/// The prime field of `p` if no constant of the mechanism has a denominator that `p` divides, otherwise `None`.
///
/// # Errors
/// [`ErrorKind::BadValue`] if `p` is not prime.
pub fn lucky_field(mechanism: &Mechanism, p: u64) -> Result<Option<Modular>> {
    let mut arithmetic = Modular::new(Zp::new(p)?);
    let mut constants: Vec<&BigRational> = mechanism.tip_point().iter().chain(mechanism.aim()).collect();
    constants.extend(mechanism.tip_rotation().iter().flatten());
    let mut has_lengths = true;
    for joint in mechanism.joints() {
        constants.extend(joint.axis.iter().chain(&joint.point));
        constants.extend(joint.coupling.iter().flat_map(Coupling::numbers));
        has_lengths &= arithmetic.rational(&joint.square) != 0;
    }
    for constant in constants {
        arithmetic.rational(constant);
    }
    Ok((has_lengths && !arithmetic.is_unlucky()).then_some(arithmetic))
}
