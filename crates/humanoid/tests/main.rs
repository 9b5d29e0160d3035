//! Tests of groebot-humanoid in one binary; the modules mirror `src/`.

#[path = "../../robot/tests/dynamics/parts.rs"]
mod dynamics_parts;
mod gait;
mod nav;
mod sim;
mod stabilizer;
mod task;
mod view;
mod walkers;

use proptest::test_runner::{Config, FileFailurePersistence};

/// Configuration of a property with `count` cases. Failing inputs are stored in `tests/regressions/` and are run first from then on.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
