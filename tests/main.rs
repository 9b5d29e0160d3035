//! All integration tests, in one binary; the modules mirror `src/`.

mod files;
mod number;
