//! Tests of groebot-algebra in one binary; the modules mirror `src/`.

mod corpus;
mod escape;
mod groebner;
mod number;
mod poly;
mod random;
mod real;
mod roots;
mod watch;

use proptest::test_runner::{Config, FileFailurePersistence};

/// The number of cases of a property test. Failing inputs are stored in `tests/regressions/` and run first afterwards.
fn cases(count: u32) -> Config {
    let kept = FileFailurePersistence::SourceParallel("tests/regressions");
    Config { cases: count, failure_persistence: Some(Box::new(kept)), ..Config::default() }
}
