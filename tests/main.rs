//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "cli")]
mod codegen;
#[cfg(feature = "cli")]
mod fuzz;
mod polar;

use proptest::test_runner::{Config, FileFailurePersistence};

/// So many cases of a property; inputs that fail are kept in `tests/regressions/` and come first from then on.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
