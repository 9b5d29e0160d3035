//! Source text of the run time, from which single-file solvers are assembled.

/// The Rust modules in the order of [`crate`], each with its name.
pub const RUST: [(&str, &str); 36] = [
    ("angles", include_str!("angles.rs")),
    ("answers", include_str!("answers.rs")),
    ("approach", include_str!("approach.rs")),
    ("arithmetic", include_str!("arithmetic.rs")),
    ("batch", include_str!("batch.rs")),
    ("conditions", include_str!("conditions.rs")),
    ("counters", include_str!("counters.rs")),
    ("curve", include_str!("curve.rs")),
    ("derivatives", include_str!("derivatives.rs")),
    ("described", include_str!("described.rs")),
    ("double", include_str!("double.rs")),
    ("exactly", include_str!("exactly.rs")),
    ("freedom", include_str!("freedom.rs")),
    ("joints", include_str!("joints.rs")),
    ("lanes", include_str!("lanes.rs")),
    ("limits", include_str!("limits.rs")),
    ("measure", include_str!("measure.rs")),
    ("mechanism", include_str!("mechanism.rs")),
    ("members", include_str!("members.rs")),
    ("newton", include_str!("newton.rs")),
    ("number", include_str!("number.rs")),
    ("problem", include_str!("problem.rs")),
    ("quartic", include_str!("quartic.rs")),
    ("refine", include_str!("refine.rs")),
    ("registers", include_str!("registers.rs")),
    ("roots", include_str!("roots.rs")),
    ("self_motion", include_str!("self_motion.rs")),
    ("singly", include_str!("singly.rs")),
    ("solution", include_str!("solution.rs")),
    ("solve", include_str!("solve.rs")),
    ("starts", include_str!("starts.rs")),
    ("steps", include_str!("steps.rs")),
    ("storage", include_str!("storage.rs")),
    ("strays", include_str!("strays.rs")),
    ("tolerances", include_str!("tolerances.rs")),
    ("trigonometry", include_str!("trigonometry.rs")),
];

/// The root of the crate.
pub const ROOT: &str = include_str!("lib.rs");

/// The modules of [`crate::six_axes`], each with its name, its root first.
pub const SIX_AXES: [(&str, &str); 20] = [
    ("mod", include_str!("six_axes/mod.rs")),
    ("answers", include_str!("six_axes/answers.rs")),
    ("candidates", include_str!("six_axes/candidates.rs")),
    ("chain", include_str!("six_axes/chain.rs")),
    ("cluster", include_str!("six_axes/cluster.rs")),
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

/// The header of the run time in C.
pub const C_HEADER: &str = include_str!("../c/groebot.h");
/// The source that belongs to [`C_HEADER`].
pub const C: &str = include_str!("../c/groebot.c");
/// The header of the run time in C for six joints in any place.
pub const C_SIX_AXES_HEADER: &str = include_str!("../c/groebot_six_axes.h");
/// The source that belongs to [`C_SIX_AXES_HEADER`].
pub const C_SIX_AXES: &str = include_str!("../c/groebot_six_axes.c");

/// The files that the C sources include, each by its path.
pub const C_PARTS: [(&str, &str); 48] = [
    ("groebot/angles.h", include_str!("../c/groebot/angles.h")),
    ("groebot/answers.h", include_str!("../c/groebot/answers.h")),
    ("groebot/approach.h", include_str!("../c/groebot/approach.h")),
    ("groebot/batch.h", include_str!("../c/groebot/batch.h")),
    ("groebot/candidates.h", include_str!("../c/groebot/candidates.h")),
    ("groebot/conditions.h", include_str!("../c/groebot/conditions.h")),
    ("groebot/curve.c", include_str!("../c/groebot/curve.c")),
    ("groebot/described.h", include_str!("../c/groebot/described.h")),
    ("groebot/freedom.c", include_str!("../c/groebot/freedom.c")),
    ("groebot/joints.c", include_str!("../c/groebot/joints.c")),
    ("groebot/limits.c", include_str!("../c/groebot/limits.c")),
    ("groebot/measure.h", include_str!("../c/groebot/measure.h")),
    ("groebot/mechanism.h", include_str!("../c/groebot/mechanism.h")),
    ("groebot/members.c", include_str!("../c/groebot/members.c")),
    ("groebot/newton.c", include_str!("../c/groebot/newton.c")),
    ("groebot/number.h", include_str!("../c/groebot/number.h")),
    ("groebot/problem.c", include_str!("../c/groebot/problem.c")),
    ("groebot/program.h", include_str!("../c/groebot/program.h")),
    ("groebot/quartic.c", include_str!("../c/groebot/quartic.c")),
    ("groebot/refine.c", include_str!("../c/groebot/refine.c")),
    ("groebot/roots.c", include_str!("../c/groebot/roots.c")),
    ("groebot/roots.h", include_str!("../c/groebot/roots.h")),
    ("groebot/self_motion.c", include_str!("../c/groebot/self_motion.c")),
    ("groebot/shared.h", include_str!("../c/groebot/shared.h")),
    ("groebot/solve.h", include_str!("../c/groebot/solve.h")),
    ("groebot/strays.c", include_str!("../c/groebot/strays.c")),
    ("groebot/trigonometry.c", include_str!("../c/groebot/trigonometry.c")),
    ("groebot/ways.h", include_str!("../c/groebot/ways.h")),
    ("groebot/width.h", include_str!("../c/groebot/width.h")),
    ("groebot/six_axes/answers.c", include_str!("../c/groebot/six_axes/answers.c")),
    ("groebot/six_axes/candidates.c", include_str!("../c/groebot/six_axes/candidates.c")),
    ("groebot/six_axes/chain.c", include_str!("../c/groebot/six_axes/chain.c")),
    ("groebot/six_axes/cluster.c", include_str!("../c/groebot/six_axes/cluster.c")),
    ("groebot/six_axes/curve.c", include_str!("../c/groebot/six_axes/curve.c")),
    ("groebot/six_axes/hessenberg.c", include_str!("../c/groebot/six_axes/hessenberg.c")),
    ("groebot/six_axes/inverse_iteration.c", include_str!("../c/groebot/six_axes/inverse_iteration.c")),
    ("groebot/six_axes/lanes.c", include_str!("../c/groebot/six_axes/lanes.c")),
    ("groebot/six_axes/linear.c", include_str!("../c/groebot/six_axes/linear.c")),
    ("groebot/six_axes/pencil.c", include_str!("../c/groebot/six_axes/pencil.c")),
    ("groebot/six_axes/polish.c", include_str!("../c/groebot/six_axes/polish.c")),
    ("groebot/six_axes/profile.c", include_str!("../c/groebot/six_axes/profile.c")),
    ("groebot/six_axes/rigid.c", include_str!("../c/groebot/six_axes/rigid.c")),
    ("groebot/six_axes/rows.c", include_str!("../c/groebot/six_axes/rows.c")),
    ("groebot/six_axes/screw.c", include_str!("../c/groebot/six_axes/screw.c")),
    ("groebot/six_axes/section.c", include_str!("../c/groebot/six_axes/section.c")),
    ("groebot/six_axes/shifted_qr.c", include_str!("../c/groebot/six_axes/shifted_qr.c")),
    ("groebot/six_axes/solve.c", include_str!("../c/groebot/six_axes/solve.c")),
    ("groebot/six_axes/vector.c", include_str!("../c/groebot/six_axes/vector.c")),
];
