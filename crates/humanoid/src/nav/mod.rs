//! Navigation: occupancy grids of the floor, arrival times to a goal, and shortest paths. Main types: [`Map`],
//! [`Field`].
//!
//! RH0 chapter 4. Metres, radians and seconds. This module does not depend on a robot.

mod exact;
mod field;
mod front;
mod grid;
mod grow;
mod map;
mod marching;
mod meaning;
mod octile;
mod path;
mod png;
mod potential;
mod read;
mod room;
mod shape;
mod smooth;
mod sweep;
mod taut;
mod traversal;
mod update;
mod waves;
mod weighted;
mod yaml;

pub use exact::{Distances, Guide, Shortest};
pub use field::{Field, Method};
pub use grid::Window;
pub use map::{Cell, Map};
pub use meaning::{Meaning, Mode};
pub use path::{Enclosure, Path};
pub use potential::{Forces, Potential, Stuck};
pub use room::{Piece, Room};
pub use shape::Shape;
pub(crate) use shape::signed_area;
pub use smooth::{Part, Smooth};
pub use update::UpdatedField;
pub use weighted::Quickest;
