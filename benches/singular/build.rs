//! Lists the generated solvers that are measured: some of `derivations/`, or those of the folders in the variable `FOLDERS`, full paths separated by colons.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs};

const ROBOTS: [&str; 8] =
    ["puma", "puma560", "ur5", "irb120", "nao_left_leg", "teo_leg", "rh0_left_leg", "irb4600_rounded"];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo gives it")).join("../../derivations");
    let folders: Vec<PathBuf> = match env::var_os("FOLDERS") {
        Some(paths) => env::split_paths(&paths).collect(),
        None => ROBOTS.iter().map(|robot| root.join(robot)).collect(),
    };
    let (mut modules, mut calls) = (String::new(), String::new());
    for folder in folders {
        let name = folder.file_name().expect("a folder has a name").to_string_lossy().into_owned();
        let file = folder.join("5_solver.rs");
        println!("cargo::rerun-if-changed={}", file.display());
        let _ = writeln!(modules, "#[path = {file:?}] mod robot_{name};");
        let _ = writeln!(calls, "visit({name:?}, &robot_{name}::Solver, &robot_{name}::JOINT_NAMES),");
    }
    println!("cargo::rerun-if-env-changed=FOLDERS");
    let text = format!(
        "{modules}\nmacro_rules! each_robot {{ ($visit:path) => {{{{ use $visit as visit; {} }}}} }}\n",
        calls.replace(",\n", ";\n")
    );
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo gives it")).join("robots.rs");
    fs::write(out, text).expect("a file of the build's own");
}
