//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
#[cfg(feature = "cli")]
mod cli;
mod derive;
mod document;
mod files;
mod kinematics;
mod number;
mod poly;
mod roots;
mod spatial;
