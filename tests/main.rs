//! All integration tests, in one binary; the modules mirror `src/`.

mod architecture;
#[cfg(feature = "cli")]
mod cli;
mod codegen;
mod corpus;
mod derive;
mod document;
mod dynamics;
mod files;
mod gait;
mod groebner;
mod kinematics;
mod model;
mod motion;
mod number;
mod poly;
mod real;
mod robots;
mod roots;
mod solver;
mod spatial;
mod template;
mod watch;
mod witness;
