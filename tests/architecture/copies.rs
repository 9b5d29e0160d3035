//! Files that a crate includes are inside its package: they are identical copies of the repository's files.

use std::fs;

use super::root;

/// A file of a package, and the file of which it is a copy.
fn copies() -> Vec<(String, String)> {
    let legs = ["nao_left_leg", "nao_right_leg", "rh0_left_leg", "rh0_right_leg", "teo_leg"];
    let pages = [
        ("robot", "urdf"),
        ("robot", "robot_toml"),
        ("robot", "chain_toml"),
        ("robot", "dh_toml"),
        ("ik", "coupled_toml"),
    ];
    let of_leg = |leg| (format!("crates/humanoid/src/walkers/legs/{leg}.rs"), format!("derivations/{leg}/5_solver.rs"));
    let of_page = |(folder, page)| (format!("crates/{folder}/docs/{page}.md"), format!("docs/{page}.md"));
    let of_room = |room| (format!("crates/humanoid/examples/{room}.toml"), format!("examples/{room}.toml"));
    let of_viewer = |file| (format!("crates/humanoid/src/view/dist/{file}"), format!("viewer/dist/{file}"));
    let viewer = ["page.html", "viewer.js", "groebot.wasm.xz", "LICENSES.txt"];
    (legs.iter().map(of_leg))
        .chain(pages.into_iter().map(of_page))
        .chain(["living_room", "encirclement"].iter().map(of_room))
        .chain(viewer.iter().map(of_viewer))
        .collect()
}

/// With `UPDATE_GOLDEN=1` the copies are written again.
#[test]
fn included_files_are_copies_of_the_repository() {
    for (copy, original) in copies() {
        let [copied, bytes] = [&copy, &original].map(|file| fs::read(root().join(file)).unwrap());
        if copied != bytes && std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(root().join(&copy), &bytes).unwrap();
        } else {
            assert!(copied == bytes, "{copy} differs from {original}: UPDATE_GOLDEN=1 cargo test --test main copies");
        }
    }
}
