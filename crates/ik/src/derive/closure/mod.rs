//! The closure of a serial chain's loop, exactly: its screws ([`Mechanism`]), the rigid-motion invariants that hold around it
//! ([`Relation`], [`Mechanism::relations`]), their values as polynomials in the unknown joints ([`evaluate()`]) and the proof that each
//! lies in the ideal of the inverse kinematics ([`prove()`]).
//!
//! J. M. Selig, *Geometric Fundamentals of Robotics*, 2nd ed. (2005), chapters 4-6: motions as group elements and their invariants;
//! D. L. Pieper, *The kinematics of manipulators under computer control* (1968): distances and components in which joints cancel.

mod arithmetic;
mod assignment;
mod coordinates;
mod coupling;
mod evaluate;
mod explain;
mod feature;
mod following;
mod mechanism;
mod pool;
mod prove;
mod relation;
mod vector;

pub use arithmetic::{Arithmetic, Exact, Factor, Factors, Modular, Multilinear, Polynomials};
pub use assignment::{Assignment, JointValue, Target, Turn};
pub use coupling::{Coupling, Law};
pub use evaluate::{Image, Vector, carry, evaluate, evaluate_side};
pub(crate) use explain::show;
pub(super) use feature::common_point_of as common_point;
pub use mechanism::{Mechanism, ScrewJoint, Standing};
pub use prove::prove;
pub use relation::{Letter, Measure, Object, Relation, Word};
pub(super) use vector::parallel;
