//! Inertia matrix and potential energy by a second method: body Jacobians from products of exponentials, RH0 (2-24),
//! (2-39), in the base frame at the zero configuration, and the heights of the centres of mass. It verifies the
//! recursions.

use super::model::{ExactJoint, ExactModel};
use super::number::Exact;
use crate::dynamics::recursions::{Frame, Mass, Matrix, Scalar, Six};
use crate::kinematics::JointKind;

/// The motion of a joint in the base frame: the rotation `R = 1 + s K + (1 - c) K K` by Rodrigues' formula about the
/// joint's point, or a translation.
fn exponential(model: &ExactModel, joint: &ExactJoint) -> Frame<Exact> {
    let unit = |i: usize, j: usize| if i == j { Exact::one() } else { Exact::zero() };
    let variable = |at: usize| model.setting.variable(&joint.value[at]);
    if joint.kind == JointKind::Prismatic {
        let rotation: Matrix<Exact> = std::array::from_fn(|i| std::array::from_fn(|j| unit(i, j)));
        return Frame { rotation, position: joint.axis.clone().map(|x| x * variable(0)) };
    }
    let [x, y, z] = joint.axis.clone();
    let skew = [[Exact::zero(), -z.clone(), y.clone()], [z, Exact::zero(), -x.clone()], [-y, x, Exact::zero()]];
    let square =
        |i: usize, j: usize| (0..3).fold(Exact::zero(), |sum, k| sum + skew[i][k].clone() * skew[k][j].clone());
    let (cosine, sine) = (variable(0), variable(1));
    let rotation: Matrix<Exact> = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            unit(i, j) + sine.clone() * skew[i][j].clone() + (Exact::one() - cosine.clone()) * square(i, j)
        })
    });
    let turned: [Exact; 3] = std::array::from_fn(|i| {
        (0..3).fold(Exact::zero(), |sum, k| sum + rotation[i][k].clone() * joint.point[k].clone())
    });
    let position = std::array::from_fn(|i| joint.point[i].clone() - turned[i].clone());
    Frame { rotation, position }
}

/// The twist of a joint at the zero configuration, in the base frame.
fn twist(joint: &ExactJoint) -> Six<Exact> {
    let zeros = || std::array::from_fn(|_| Exact::zero());
    if joint.kind == JointKind::Prismatic {
        return Six { linear: joint.axis.clone(), angular: zeros() };
    }
    let linear = std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        joint.point[j].clone() * joint.axis[k].clone() - joint.point[k].clone() * joint.axis[j].clone()
    });
    Six { linear, angular: joint.axis.clone() }
}

/// The inertia matrix, row by row, and the potential energy.
pub(super) fn inertia_and_potential(model: &ExactModel) -> (Vec<Vec<Exact>>, Exact) {
    let count = model.joints.len();
    let mut inertia = vec![vec![Exact::zero(); count]; count];
    let mut potential = Exact::zero();
    let motions: Vec<Frame<Exact>> = model.joints.iter().map(|joint| exponential(model, joint)).collect();
    // Columns of the body Jacobian: the unit twist of each joint that moves the body, in the body's frame of the zero
    // configuration.
    let mut columns: Vec<Six<Exact>> = Vec::new();
    let mut moved = motions[0].clone();
    for (body, joint) in model.joints.iter().enumerate() {
        columns.iter_mut().for_each(|column| *column = motions[body].motion_inward(column));
        columns.push(twist(joint));
        if body > 0 {
            moved = moved.then(&motions[body]);
        }
        let mass = in_base(joint);
        for (j, column) in columns.iter().enumerate() {
            let momentum = mass.times(column);
            for (i, other) in columns.iter().enumerate() {
                let entry = &mut inertia[i][j];
                *entry = entry.clone() + other.dot(&momentum);
            }
        }
        for (i, down) in model.gravity().into_iter().enumerate() {
            let turned =
                (0..3).fold(Exact::zero(), |sum, k| sum + moved.rotation[i][k].clone() * mass.moment[k].clone());
            potential = potential - down * (turned + mass.mass.clone() * moved.position[i].clone());
        }
    }
    (inertia, potential)
}

/// The ten inertial parameters of a body at the zero configuration, about the origin of the base.
fn in_base(joint: &ExactJoint) -> Mass<Exact> {
    let unit = |i: usize, j: usize| if i == j { Exact::one() } else { Exact::zero() };
    let rotation: Matrix<Exact> = std::array::from_fn(|i| std::array::from_fn(|j| unit(i, j)));
    joint.mass.outward(&Frame { rotation, position: joint.point.clone() })
}
