//! General chains of six joints: all real solutions, at most sixteen, by one eigenvalue problem ([`Chain`]).
//!
//! Joints are counted from the hidden one, and the axes after the target are moved to its other side. The hidden joint maps `E2 E3 (line 4)` to `G E6^-1 E5^-1
//! (line 4)`. Fourteen functions of a line (M. Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508) are transformed by each joint with matrices that
//! are affine in the cosine and sine of its angle. In the frame of the hidden joint, four pairs of them rotate as plane vectors do, and six are invariant. Two
//! vectors `a`, `b` with `b` rotated from `a` fulfil Rodrigues' equation `b - a = x w x (a + b)`, where `x` is the tangent of half the angle. It is linear in
//! `x`, so that the eigenvalue problem has as many rows as the chain has solutions.

mod answers;
mod candidates;
mod chain;
mod cluster;
mod curve;
mod given;
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
pub use given::Given;
pub use hessenberg::Hessenberg;
pub use pencil::{Matrix, SIZE};
pub use rigid::Rigid;
pub use shifted_qr::Eigenvalue;
pub use vector::Vector;
