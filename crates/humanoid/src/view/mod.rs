//! Self-contained HTML pages of a robot and its motion, without network requests. Main type: [`Page`].
//!
//! The page's script and its frame are built from `viewer/` into `viewer/dist/`; this module writes the data.
//! `viewer/src/data.ts` describes them.

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
pub use run::RunRequest;
pub use sole::Sole;
pub use walk::WalkRecord;
