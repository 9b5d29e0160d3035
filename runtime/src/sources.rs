//! The run time's own text, for whoever puts it and a robot's file together.

/// The Rust modules in the order of [`crate`], each with its name.
pub const RUST: [(&str, &str); 23] = [
    ("answers", include_str!("answers.rs")),
    ("approach", include_str!("approach.rs")),
    ("arithmetic", include_str!("arithmetic.rs")),
    ("batch", include_str!("batch.rs")),
    ("conditions", include_str!("conditions.rs")),
    ("derivatives", include_str!("derivatives.rs")),
    ("joints", include_str!("joints.rs")),
    ("limits", include_str!("limits.rs")),
    ("measure", include_str!("measure.rs")),
    ("mechanism", include_str!("mechanism.rs")),
    ("newton", include_str!("newton.rs")),
    ("number", include_str!("number.rs")),
    ("problem", include_str!("problem.rs")),
    ("quartic", include_str!("quartic.rs")),
    ("refine", include_str!("refine.rs")),
    ("registers", include_str!("registers.rs")),
    ("roots", include_str!("roots.rs")),
    ("self_motion", include_str!("self_motion.rs")),
    ("solution", include_str!("solution.rs")),
    ("solve", include_str!("solve.rs")),
    ("storage", include_str!("storage.rs")),
    ("tolerances", include_str!("tolerances.rs")),
    ("trigonometry", include_str!("trigonometry.rs")),
];

/// The root of the crate.
pub const ROOT: &str = include_str!("lib.rs");

/// The modules of [`crate::six_axes`], each with its name, its root first.
pub const SIX_AXES: [(&str, &str); 19] = [
    ("mod", include_str!("six_axes/mod.rs")),
    ("answers", include_str!("six_axes/answers.rs")),
    ("candidates", include_str!("six_axes/candidates.rs")),
    ("chain", include_str!("six_axes/chain.rs")),
    ("curve", include_str!("six_axes/curve.rs")),
    ("hessenberg", include_str!("six_axes/hessenberg.rs")),
    ("inverse_iteration", include_str!("six_axes/inverse_iteration.rs")),
    ("linear", include_str!("six_axes/linear.rs")),
    ("pencil", include_str!("six_axes/pencil.rs")),
    ("polish", include_str!("six_axes/polish.rs")),
    ("profile", include_str!("six_axes/profile.rs")),
    ("reduce", include_str!("six_axes/reduce.rs")),
    ("rigid", include_str!("six_axes/rigid.rs")),
    ("rows", include_str!("six_axes/rows.rs")),
    ("screw", include_str!("six_axes/screw.rs")),
    ("section", include_str!("six_axes/section.rs")),
    ("shifted_qr", include_str!("six_axes/shifted_qr.rs")),
    ("solve", include_str!("six_axes/solve.rs")),
    ("vector", include_str!("six_axes/vector.rs")),
];

/// The header of the run time in C, and its source.
pub const C_HEADER: &str = include_str!("../c/groebot.h");
/// As [`C_HEADER`] tells.
pub const C: &str = include_str!("../c/groebot.c");
/// The same of six joints in any place.
pub const C_SIX_AXES_HEADER: &str = include_str!("../c/groebot_six_axes.h");
/// As [`C_SIX_AXES_HEADER`] tells.
pub const C_SIX_AXES: &str = include_str!("../c/groebot_six_axes.c");
