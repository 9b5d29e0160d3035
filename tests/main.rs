//! All integration tests, in one binary; the modules mirror `src/`.

mod document;
mod kinematics;
mod number;
