//! Navigation: maps of the floor, and how long it takes from each place to a goal. Main types: [`Map`], [`Field`].
//!
//! RH0 chapter 4. Metres, radians and seconds; nothing here knows a robot.

mod exact;
mod field;
mod grid;
mod grow;
mod map;
mod marching;
mod octile;
mod read;
mod shape;
mod sight;
mod smooth;
mod taut;
mod waves;
mod weighted;
mod way;

pub use exact::{Distances, Guide, Shortest};
pub use field::{Field, Method};
pub use map::{Cell, Map};
pub use read::Meaning;
pub use shape::Shape;
pub use smooth::{Part, Smooth};
pub use way::{Enclosure, Way};
pub use weighted::Quickest;
