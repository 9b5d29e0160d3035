//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
mod files;
mod number;
