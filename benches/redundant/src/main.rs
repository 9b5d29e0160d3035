//! Completeness and times of the arcs of redundant arms: see benches/README.md.

mod arm;
mod clock;
mod counts;
mod times;
mod vectors;

use std::path::{Path, PathBuf};

use arm::Arm;

const USAGE: &str = "counts RANDOM ROUND [ARM...], times POSES [ARM...], or a URDF and a CSV file of joint vectors";

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus/redundant/arms")
}

/// The descriptions of the named arms, or of all.
fn descriptions(names: &[String]) -> Vec<PathBuf> {
    let files = std::fs::read_dir(corpus()).expect("the corpus is in the repository");
    let mut files: Vec<PathBuf> = files.map(|entry| entry.expect("a readable folder").path()).collect();
    files.sort();
    let is_named = |file: &PathBuf| names.is_empty() || names.iter().any(|name| *name == arm::name(file));
    files.into_iter().filter(is_named).collect()
}

fn number(words: &[String], index: usize) -> usize {
    words.get(index).and_then(|word| word.parse().ok()).unwrap_or_else(|| usage())
}

fn usage() -> ! {
    eprintln!("{USAGE}");
    std::process::exit(2);
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.first().map(String::as_str) {
        Some("counts") => {
            let (random, round) = (number(&words, 1), number(&words, 2));
            counts::head();
            for file in descriptions(&words[3..]) {
                counts::print(&Arm::read(&file), random, round);
            }
        }
        Some("times") => {
            let poses = number(&words, 1);
            times::head();
            for file in descriptions(&words[2..]) {
                times::print(&Arm::read(&file), poses);
            }
        }
        Some(file) if words.len() == 2 => {
            times::each(&Arm::read(Path::new(file)), &vectors::read(Path::new(&words[1])))
        }
        _ => usage(),
    }
}
