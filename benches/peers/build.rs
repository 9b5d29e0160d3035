//! Compiles the generated C code of `derivations/` with each available compiler, with run time and robot in one translation unit, and lists it for `by_c`.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

const COMPILERS: [&str; 2] = ["gcc", "clang"];
const ROBOTS: [&str; 9] = [
    "irb120",
    "nao_left_leg",
    "nao_right_leg",
    "puma",
    "rh0_right_leg",
    "spherical_wrist",
    "stanford",
    "teo_leg",
    "ur5",
];

fn main() {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo tells it") + "/../..";
    let out = env::var("OUT_DIR").expect("cargo tells it");
    let (mut declared, mut listed, mut objects) = (String::new(), String::new(), Vec::new());
    for compiler in COMPILERS.into_iter().filter(|compiler| Command::new(compiler).arg("--version").output().is_ok()) {
        for robot in ROBOTS {
            println!("cargo::rerun-if-changed={root}/derivations/{robot}/5_solver.c");
            objects.push(object(&root, &out, compiler, robot));
            let name = format!("{compiler}_{robot}");
            let _ = write!(
                declared,
                "fn {name}_pass(targets: *const f64, count: usize) -> usize;
                 fn {name}_batch(targets: *const f64, count: usize) -> usize;
                 fn {name}_solutions(target: *const f64, q: *mut f64) -> usize;
                 fn {name}_forward(q: *const f64, count: usize);\n"
            );
            let _ = writeln!(
                listed,
                "Compiled {{ robot: {robot:?}, compiler: {compiler:?}, pass: {name}_pass, batch: {name}_batch, \
                 solutions: {name}_solutions, forward: {name}_forward }},"
            );
        }
    }
    println!("cargo::rerun-if-changed={root}/runtime/c");
    println!("cargo::rerun-if-changed=build.rs");
    if !objects.is_empty() {
        run(Command::new("ar").arg("crs").arg(format!("{out}/libprinted_c.a")).args(&objects));
        println!("cargo::rustc-link-search=native={out}");
        println!("cargo::rustc-link-lib=static=printed_c");
        println!("cargo::rustc-link-lib=m");
    }
    let text = format!("unsafe extern \"C\" {{\n{declared}}}\nstatic COMPILED: &[Compiled] = &[\n{listed}];\n");
    fs::write(Path::new(&out).join("printed_c.rs"), text).expect("a file of the build's own");
}

/// The object file of a robot's solver. All symbols except our functions are local, because those of other compilers
/// have the same names.
fn object(root: &str, out: &str, compiler: &str, robot: &str) -> String {
    let (name, upper) = (format!("{compiler}_{robot}"), robot.to_uppercase());
    let text = format!(
        r#"#define GB_LINKAGE static GB_UNUSED
#include "{root}/runtime/c/groebot.h"
#include "{root}/derivations/{robot}/5_solver.h"
#include "{root}/derivations/{robot}/5_solver.c"
#include "{root}/runtime/c/groebot.c"

enum {{ TARGETS = 256, ROOM = 8 * TARGETS }};

size_t {name}_pass(const double *targets, size_t count)
{{
    {robot}_solution out[{upper}_CAPACITY];
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {{
        const int solutions = {robot}_solve(targets + 12 * i, out);
        found += solutions > 0 ? (size_t)solutions : 0;
        __asm__ volatile("" ::"r"(out) : "memory");
    }}
    return found;
}}

size_t {name}_batch(const double *targets, size_t count)
{{
    {robot}_solution out[ROOM];
    int counts[TARGETS];
    size_t found = 0;
    while (count > 0) {{
        const size_t done = {robot}_solve_batch(targets, count < TARGETS ? count : TARGETS, out, ROOM, counts);
        __asm__ volatile("" ::"r"(out) : "memory");
        for (size_t i = 0; i < done; i++) found += counts[i] > 0 ? (size_t)counts[i] : 0;
        targets += 12 * done;
        count -= done;
    }}
    return found;
}}

size_t {name}_solutions(const double *target, double *q)
{{
    {robot}_solution out[{upper}_CAPACITY];
    const int solutions = {robot}_solve(target, out);
    for (int i = 0; i < solutions; i++) memcpy(q + 6 * i, out[i].q, sizeof out[i].q);
    return solutions > 0 ? (size_t)solutions : 0;
}}

void {name}_forward(const double *q, size_t count)
{{
    double target[{upper}_INPUTS];
    for (size_t i = 0; i < count; i++) {{
        {robot}_forward(q + 6 * i, target);
        __asm__ volatile("" ::"r"(target) : "memory");
    }}
}}
"#
    );
    let source = format!("{out}/{name}.c");
    let object = format!("{out}/{name}.o");
    fs::write(&source, text).expect("a file of the build's own");
    let flags = ["-std=gnu99", "-O2", "-ffp-contract=off", "-fPIC"];
    let includes = format!("-I{root}/runtime/c");
    run(Command::new(compiler).args(flags).args([&includes, "-c", &source, "-o", &object]));
    run(Command::new("objcopy").arg("-w").arg(format!("--keep-global-symbol={name}_*")).arg(&object));
    object
}

fn run(command: &mut Command) {
    let status = command.status().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(status.success(), "{command:?}");
}
