//! Any six joints, with axes in any place: all real solutions, sixteen at most, by one eigenvalue problem ([`EigenvalueSolver`]).
//!
//! The fourteen functions of Raghavan and Roth of the line of one axis turn with each joint by matrices that are affine in the cosine and
//! sine of its angle. Seen from the joint whose angle is hidden, four pairs of them turn as plane vectors do, and six stay as they are.
//! Two vectors `a`, `b` with `b` turned from `a` fulfil Rodrigues' equation `b - a = x w x (a + b)`, `x` the tangent of half the angle:
//! it is linear in `x`, so that the eigenvalue problem has exactly as many rows as the chain has solutions.

mod answers;
mod candidates;
mod curve;
mod formulation;
mod linear;
mod pencil;
mod polish;
mod profile;
mod reduce;
mod rows;
mod scalar;
mod screw;
mod six_axes;
mod solve;

pub use answers::{Answer, Answers, ROOM};
pub use formulation::{Equations, Formulation};
pub use pencil::SIZE;
pub use polish::{Links, Rigid};
pub use profile::{FUNCTIONS, Frame, PRODUCTS, Profile, STILL, TURNING};
pub use rows::{COLUMNS, Doubled, FAR, MOVING, Row, Rows};
pub use scalar::{Scalar, Vector};
pub use screw::{Axis, Figure, Line};
pub use six_axes::{SixAxes, SixAxesParts};
pub use solve::{EigenvalueSolver, Layout};
