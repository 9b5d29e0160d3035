//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "cli")]
mod codegen;
#[cfg(feature = "cli")]
mod fuzz;
mod polar;
mod release;

use proptest::test_runner::{Config, FileFailurePersistence};

/// Settings for a property test with this number of cases. Failing inputs are stored in `tests/regressions/` and tested
/// first in later runs.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
