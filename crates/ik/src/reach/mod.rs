//! Reachability maps. Targets are the places of a grid with evenly spread orientations. For each place, a map has the number of solutions, those within joint
//! limits, and the manipulability. Main type: [`ReachMap`].
//!
//! A pose is computed from its index and not stored (F. Zacharias, C. Borst and G. Hirzinger, Capturing robot workspace structure: representing robot
//! capabilities, IROS 2007).

mod drawing;
mod grid;
mod map;
mod orientations;
mod poses;
mod redundant;
mod request;
mod stored;
mod survey;

pub use grid::{Axis, Grid};
pub use map::{Entry, ReachMap};
pub use request::{Measure, Request};
pub use survey::{Solves, Survey};
