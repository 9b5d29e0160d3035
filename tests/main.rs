//! All integration tests, in one binary; the modules mirror `src/`.

mod kinematics;
mod architecture;
mod files;
mod number;
mod poly;
mod roots;
mod spatial;
