//! All integration tests, in one binary; the modules mirror `src/`.

mod derive;
mod document;
mod number;
mod poly;
