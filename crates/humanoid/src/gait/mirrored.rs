//! A leg that is the mirror image of another one. Main type: [`Mirrored`].

use std::sync::Arc;

use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};

use super::biped::Biped;
use super::legs::LegSolver;
use crate::Result;
use groebot_robot::kinematics::{InverseKinematics, Solution, Target};
use groebot_robot::spatial::{Axis, Pose};

/// The greatest distance \[m, rad\] between the axes of a leg and the mirror images of the other one's. The error of a
/// sole is of this size, which is a ten thousandth of the tolerance of the centre of mass.
const EQUAL: f64 = 1e-11;

/// The solver of a leg by that of its mirror image in the torso's plane y = 0.
#[derive(Clone, Debug)]
pub struct Mirrored {
    /// The solver of the image.
    image: LegSolver,
    /// The value of each joint for the value 1 of its image.
    senses: Vec<f64>,
    /// The tip of the image's solver in the frame of the image of the tip.
    image_from_tip: Pose,
}

impl Mirrored {
    /// The mirror image of `image`, whose joints turn in these senses, with frames of the tips that are mirror images.
    pub(crate) fn new(image: LegSolver, senses: Vec<f64>) -> Self {
        Mirrored { image, senses, image_from_tip: Pose::identity() }
    }

    /// The solver of the right leg of `biped` by that of the left one. `None` unless the axes are mirror images.
    pub fn right(biped: &Biped, left: &LegSolver) -> Option<Self> {
        let [own, other] = &biped.feet;
        let axis = |joint: &usize| biped.model.joints()[*joint].screw.axis();
        let pairs = own.joints.iter().zip(&other.joints);
        let senses: Option<Vec<f64>> = pairs.map(|(left, right)| sense(axis(left)?, axis(right)?)).collect();
        let [torso_from_left, torso_from_right] = [own, other].map(|foot| biped.model.link(foot.link).1);
        let image_from_tip = reflected(&torso_from_right).inv_mul(&torso_from_left);
        let solver = Mirrored { image: Arc::clone(left), senses: senses?, image_from_tip };
        (own.joints.len() == other.joints.len()).then_some(solver)
    }
}

impl InverseKinematics for Mirrored {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        let image = match target {
            Target::Pose(pose) => Target::Pose(reflected(pose) * self.image_from_tip),
            other => *other,
        };
        self.image.solve(&image, given, out)?;
        for answer in out {
            answer.q.iter_mut().zip(&self.senses).for_each(|(q, sense)| *q *= sense);
        }
        Ok(())
    }

    fn uses_eigenvalues(&self) -> bool {
        self.image.uses_eigenvalues()
    }
}

/// The rotation about the axis `right` for the rotation by 1 about the axis `left`, whose mirror image it is; `None`
/// where it is not.
fn sense(left: &Axis, right: &Axis) -> Option<f64> {
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
    // A reflection reverses the sense of rotations.
    let (direction, point) = (-(mirror * *left.direction()), Point3::from(mirror * left.point().coords));
    let sense = right.direction().dot(&direction).signum();
    let is_parallel = (*right.direction() - direction * sense).norm() <= EQUAL;
    (is_parallel && (right.foot(&point) - point).norm() <= EQUAL).then_some(sense)
}

/// The mirror image of a pose in y = 0.
fn reflected(pose: &Pose) -> Pose {
    let (at, turn) = (pose.translation.vector, pose.rotation.quaternion());
    let turn = Quaternion::new(turn.w, -turn.i, turn.j, -turn.k);
    Pose::from_parts(Vector3::new(at.x, -at.y, at.z).into(), UnitQuaternion::new_unchecked(turn))
}
