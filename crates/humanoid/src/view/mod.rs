//! A page to see a robot and how it moves: one HTML file that asks nobody for anything. Main type: [`Page`].
//!
//! The page's program and its frame are built from `viewer/` and stand in `viewer/dist/`; here its data are written. What these hold, `viewer/src/data.ts` says.

mod bytes;
mod chain;
mod data;
mod motion;
mod page;
mod reach;
mod robot;
mod run;
mod sole;
mod walk;

pub use page::Page;
pub use run::Asked;
pub use sole::Sole;
pub use walk::WalkRecord;
