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
