//! Prints solvers of batches from the programs in `derivations/`: the committed files solve one target at a time.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use groebot::codegen::rust;
use groebot::solver::Program;

const ROBOTS: [&str; 9] =
    ["irb120", "nao_left_leg", "nao_right_leg", "puma", "rh0_left_leg", "rh0_right_leg", "stanford", "teo_leg", "ur5"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    let folder = PathBuf::from(env::var("OUT_DIR")?);
    let mut modules = String::new();
    for name in ROBOTS {
        let path = format!("{}/../../derivations/{name}/5_program.json", env!("CARGO_MANIFEST_DIR"));
        println!("cargo::rerun-if-changed={path}");
        let program = Program::from_json(&fs::read_to_string(path)?)?;
        let file = folder.join(format!("{name}.rs"));
        fs::write(&file, rust::emit_batch(&program).ok_or(name)?)?;
        modules += &format!("#[allow(dead_code, missing_docs)]\n#[path = {file:?}]\npub mod {name};\n");
    }
    Ok(fs::write(folder.join("batches.rs"), modules)?)
}
