//! Printed C without an operating system or a C library: with the compiler's own headers and `freestanding/math.h`.

use std::fs;
use std::path::Path;
use std::process::Command;

use groebot_ik::codegen::single_file;

use super::harness::build;
use super::stored::all;

const STRICT: &str = "-std=c99 -Wall -Wextra -Werror -pedantic -Wconversion -ffreestanding -nostdinc";

/// Compiler options for a Cortex-M4, whose floating-point unit is for single precision, and for an M7, whose unit is for both.
const CORTEX: [&str; 2] = [
    "-O2 -c -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16",
    "-O2 -c -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16",
];

/// Compiles a file with only the headers of the compiler. `None` if that is not installed (an error with `GROEBOT_REQUIRE_TOOLS=1`).
fn compile(compiler: &str, options: &str, file: &Path) -> Option<()> {
    build(Command::new(compiler).arg("--version"))?;
    let own = Command::new(compiler).arg("-print-file-name=include").output().unwrap();
    let own = String::from_utf8(own.stdout).unwrap();
    let ours = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("crates/ik/tests/codegen/freestanding");
    let mut command = Command::new(compiler);
    command.args(STRICT.split(' ')).args(options.split(' '));
    command.arg("-isystem").arg(own.trim()).arg("-isystem").arg(ours);
    build(command.arg(file).arg("-o").arg(file.with_extension("o")))
}

#[test]
fn every_file_compiles_without_a_system() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("5_solver.c");
    for stored in all() {
        fs::write(&file, single_file::c(&stored.program, "5_solver.c", false)).unwrap();
        if compile("cc", "-fsyntax-only", &file).is_none() {
            return;
        }
    }
}

#[test]
fn single_and_double_precision_compile_for_a_cortex_m() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("5_solver.c");
    for stored in super::stored::named(&["puma", "rh0_arm", "spherical_wrist"]) {
        for (target, text) in
            CORTEX.iter().zip([true, false].map(|single| single_file::c(&stored.program, "5_solver.c", single)))
        {
            fs::write(&file, text).unwrap();
            if compile("arm-none-eabi-gcc", target, &file).is_none() {
                return;
            }
        }
    }
}
