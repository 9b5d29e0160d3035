//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
mod files;
mod kinematics;
mod derive;
mod document;
mod number;
mod poly;
mod roots;
mod spatial;
