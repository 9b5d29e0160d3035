//! The exact closure of a serial chain's loop.
//!
//! * [`Mechanism`]: its screws.
//! * [`Relation`], [`Mechanism::relations`]: the invariants of rigid motions that hold around the loop.
//! * [`evaluate()`]: their values as polynomials in the unknown joints.
//! * [`prove()`]: the proof that each is in the ideal of the inverse kinematics.
//!
//! J. M. Selig, *Geometric Fundamentals of Robotics*, 2nd ed. (2005), chapters 4-6: motions as group elements and their invariants. D. L. Pieper, *The
//! kinematics of manipulators under computer control* (1968): distances and components in which joints cancel.

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
pub use assignment::{Assignment, JointValue, Target, TargetRotation};
pub use coupling::{Coupling, Law};
pub(crate) use evaluate::Evaluation;
pub use evaluate::{Image, Vector, evaluate};
pub(crate) use explain::show;
pub(super) use feature::common_point_of as common_point;
pub use mechanism::{Mechanism, ScrewJoint, UprightLoop};
pub use prove::prove;
pub use relation::{Letter, Measure, Object, Relation, Word};
pub(super) use vector::parallel;
