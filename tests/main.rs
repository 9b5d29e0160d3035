//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
#[cfg(feature = "cli")]
mod cli;
mod codegen;
mod control;
mod corpus;
mod derive;
mod document;
mod dynamics;
mod eigenvalue;
mod escape;
mod files;
mod folder;
#[cfg(feature = "cli")]
mod fuzz;
mod gait;
mod groebner;
mod kinematics;
mod limits;
mod model;
mod motion;
mod nav;
mod number;
mod poly;
mod reach;
mod real;
mod robots;
mod roots;
mod sim;
mod solver;
mod spatial;
mod task;
mod view;
mod watch;
mod witness;

use proptest::test_runner::{Config, FileFailurePersistence};

/// So many cases of a property; inputs that fail are kept in `tests/regressions/` and come first from then on.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
