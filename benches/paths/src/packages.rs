//! Folders of the packages in cargo's registry.

use std::path::PathBuf;
use std::process::Command;

/// The folder of a package. Cargo fetches a missing one.
pub fn folder(name: &str) -> PathBuf {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
    cargo.args(["metadata", "--format-version=1", "--all-features", "--manifest-path", manifest]);
    let output = cargo.output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let all: serde_json::Value = serde_json::from_slice(&output.stdout).expect("cargo prints JSON");
    let mut packages = all["packages"].as_array().expect("packages").iter();
    let own = packages.find(|package| package["name"] == name).expect("the package is a dependency");
    let manifest = own["manifest_path"].as_str().expect("a path");
    PathBuf::from(manifest).parent().expect("a folder").to_owned()
}
