//! Tests of groebot-robot in one binary; the modules mirror `src/`.

mod control;
mod document;
mod dynamics;
mod errors;
mod files;
mod kinematics;
mod limits;
mod model;
mod motion;
mod robots;
mod spatial;

use proptest::test_runner::{Config, FileFailurePersistence};

/// So many cases of a property; inputs that fail are kept in `tests/regressions/` and come first from then on.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
