//! Six joints in any place, found together: all real solutions, sixteen at most, by one eigenvalue problem ([`Chain`]).
//!
//! The joint that is hidden moves `E2 E3 (line 4)` to `G E6^-1 E5^-1 (line 4)`, joints counted from it and the axes behind the target moved to its other
//! side. Of a line, fourteen functions (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508) turn with each joint by matrices that are affine
//! in the cosine and sine of its angle. Seen from the hidden joint, four pairs of them turn as plane vectors do, and six stay as they are. Two vectors
//! `a`, `b` with `b` turned from `a` fulfil Rodrigues' equation `b - a = x w x (a + b)`, `x` the tangent of half the angle: linear in `x`, so that the
//! eigenvalue problem has as many rows as the chain has solutions.

mod answers;
mod candidates;
mod chain;
mod cluster;
mod curve;
mod hessenberg;
mod inverse_iteration;
mod linear;
mod pencil;
mod polish;
mod profile;
mod reduce;
mod rigid;
mod rows;
mod screw;
mod section;
mod shifted_qr;
mod solve;
pub(crate) mod vector;

pub use answers::{Answer, Answers, ROOM};
pub use chain::{Chain, Formulation, Formulations};
pub use hessenberg::Hessenberg;
pub use pencil::{Matrix, SIZE};
pub use rigid::Rigid;
pub use shifted_qr::Eigenvalue;
pub use vector::Vector;
