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

/// The number of cases of a property test. Failing inputs are stored in `tests/regressions/` and run first afterwards.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
