//! Expands descriptions in xacro, for programs that compare expansions.
//!
//! Each line of standard input is a JSON object: `file`, `packages` (folders by name) and `arguments` (values by name).
//! Each line of standard output is its answer: `text`, `notes`, or `error`.

use std::collections::BTreeMap;
use std::io::{BufRead, stdin};
use std::path::PathBuf;

use groebot_robot::model::{ReadOptions, xacro};

/// A request.
#[derive(serde::Deserialize)]
struct Request {
    file: PathBuf,
    #[serde(default)]
    packages: BTreeMap<String, PathBuf>,
    #[serde(default)]
    arguments: BTreeMap<String, String>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for line in stdin().lock().lines() {
        let request: Request = serde_json::from_str(&line?)?;
        let options = ReadOptions::new();
        let options = request.packages.into_iter().fold(options, |options, (name, path)| options.package(name, path));
        let options =
            request.arguments.into_iter().fold(options, |options, (name, value)| options.argument(name, value));
        let answer = match xacro::expand(&request.file, &options) {
            Ok(expanded) => serde_json::json!({ "text": expanded.text, "notes": expanded.notes }),
            Err(error) => serde_json::json!({ "error": error.to_string() }),
        };
        println!("{answer}");
    }
    Ok(())
}
