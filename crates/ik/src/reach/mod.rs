//! What a solver reaches: over a grid of places and orientations spread evenly over all, how many answers there are, how many within limits, and how well the arm moves there. Main type: [`ReachMap`].
//!
//! A pose is made from its number and forgotten when its answers are counted (F. Zacharias, C. Borst and G. Hirzinger, Capturing robot workspace
//! structure: representing robot capabilities, IROS 2007).

mod ask;
mod drawing;
mod grid;
mod map;
mod orientations;
mod poses;
mod stored;
mod survey;

pub use ask::{Ask, Measure};
pub use grid::{Axis, Grid};
pub use map::{Entry, ReachMap};
pub use survey::{Solves, Survey};
