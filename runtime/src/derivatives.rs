//! Jacobian of equations by the joints.

use crate::lanes::Lanes;
use crate::mechanism::{Equations, Joint, Joints, Mechanism, Parameters, Places};
use crate::number::Number;
use crate::storage::Array;

/// The derivative of each equation by each joint, where the equations are affine in the numbers of each joint. It is their values at the numbers' derivatives
/// minus their values at zeros; both are evaluated at once.
pub fn of_affine<M: Mechanism>(mechanism: &M, p: &Parameters<M>, at: &Places<M>) -> Equations<M, Joints<M>> {
    let (facts, p, at) = (mechanism.facts(), p.as_ref(), at.as_ref());
    let p: Parameters<M, Lanes<2>> = Array::by(p.len(), |i| Lanes::of(p[i]));
    let columns: Joints<M, Equations<M, Lanes<2>>> = Array::by(facts.joints.len(), |joint| {
        let mut moved: Places<M, Lanes<2>> = Array::by(at.len(), |i| Lanes::of(at[i]));
        match facts.joints[joint] {
            Joint::Angle([c, s]) => {
                moved.as_mut()[c] = Lanes([-at[s], 0.0]);
                moved.as_mut()[s] = Lanes([at[c], 0.0]);
            }
            Joint::Length(place) => moved.as_mut()[place] = Lanes([1.0, 0.0]),
        }
        mechanism.values(&p, &moved)
    });
    let derivative = |i: usize, joint: usize| {
        let [along, without] = columns.as_ref()[joint].as_ref()[i].0;
        along - without
    };
    Array::by(facts.size_of.len(), |i| Array::by(facts.joints.len(), |joint| derivative(i, joint)))
}

/// Number of joints whose derivatives an interpreter computes at once.
const JOINTS: usize = 7;

/// Same as [`of_affine`], for an interpreter: derivatives by all joints, and the equations' values, are evaluated at once. They are bitwise equal.
pub(crate) fn of_affine_at_once<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    at: &Places<M>,
) -> (Equations<M, Joints<M>>, Equations<M>) {
    let (facts, p, at) = (mechanism.facts(), p.as_ref(), at.as_ref());
    let (joints, count) = (facts.joints, facts.size_of.len());
    let p: Parameters<M, Lanes<{ 2 * JOINTS + 2 }>> = Array::by(p.len(), |i| Lanes::of(p[i]));
    let mut slopes: Equations<M, Joints<M>> = Array::by(count, |_| Array::by(joints.len(), |_| 0.0));
    let mut values: Equations<M> = Array::by(count, |_| 0.0);
    for first in (0..joints.len()).step_by(JOINTS) {
        let mut moved: Places<M, Lanes<{ 2 * JOINTS + 2 }>> = Array::by(at.len(), |i| Lanes::of(at[i]));
        for (lane, joint) in joints[first..].iter().take(JOINTS).enumerate() {
            let mut set =
                |place: usize, along: f64| moved.as_mut()[place].0[2 * lane..][..2].copy_from_slice(&[along, 0.0]);
            match *joint {
                Joint::Angle([c, s]) => {
                    set(c, -at[s]);
                    set(s, at[c]);
                }
                Joint::Length(place) => set(place, 1.0),
            }
        }
        let rows = mechanism.values(&p, &moved);
        for ((row, slopes), value) in rows.as_ref().iter().zip(slopes.as_mut()).zip(values.as_mut()) {
            let pairs = row.0.as_chunks().0;
            for (slope, [along, without]) in slopes.as_mut()[first..].iter_mut().zip(&pairs[..JOINTS]) {
                *slope = along - without;
            }
            *value = row.0[2 * JOINTS];
        }
    }
    (slopes, values)
}
