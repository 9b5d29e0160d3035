//! Tests of groebot-ik in one binary; the modules mirror `src/`.

mod codegen;
mod derive;
#[path = "../../robot/tests/dynamics/samples.rs"]
#[allow(dead_code)]
mod dynamics_samples;
mod eigenvalue;
#[path = "../../robot/tests/errors.rs"]
mod errors;
mod folder;
mod reach;
#[path = "../../algebra/tests/real/sixteen.rs"]
#[allow(dead_code)]
mod sixteen;
mod solver;
mod tolerances;
mod witness;

use proptest::test_runner::{Config, FileFailurePersistence};

/// So many cases of a property; inputs that fail are kept in `tests/regressions/` and come first from then on.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
