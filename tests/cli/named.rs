//! Robots by name, the cache of their solvers, and completions.

use std::fs;
use std::process::Output;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{groebot, refused, root, run, succeed, text};

/// A run in a folder of its own, with a cache of its own.
fn run_in(folder: &TempDir, arguments: &[&str]) -> Output {
    let mut command = groebot(arguments);
    command.current_dir(folder.path()).env("GROEBOT_CACHE", folder.path().join("cache")).output().unwrap()
}

/// The standard output of a run that must succeed.
fn printed(folder: &TempDir, arguments: &[&str]) -> String {
    let output = run_in(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn robots_are_listed_by_vendor() {
    let list = succeed(&["robots"]);
    for line in ["Universal Robots\n", "ABB\n", "  ur5 ", "unchecked\n"] {
        assert!(list.contains(line), "{line}");
    }
    assert_eq!(succeed(&["robots", "so", "100"]), succeed(&["robots", "so 100"]));
    let only = succeed(&["robots", "Universal"]);
    assert!(only.contains("  ur5 ") && !only.contains("ABB"));
    assert!(refused(&["robots", "c3po"]).contains("contains `c3po`"));
    for (words, name) in [
        ("Stäubli", "staubli_rx160"),
        ("kuka iiwa", "kuka_iiwa7"),
        ("UR-10e", "ur10e"),
        ("interbotix", "trossen_wx250"),
    ] {
        let found = succeed(&["robots", words]);
        assert!(found.contains(&format!("  {name} ")), "{words}: {found}");
    }
}

#[test]
fn robots_are_listed_as_json() {
    let list: Value = serde_json::from_str(&succeed(&["robots", "ur5", "--json"])).unwrap();
    let robot = list["robots"].as_array().unwrap().iter().find(|robot| robot["name"] == "ur5").unwrap();
    assert_eq!((robot["vendor"].as_str(), robot["kind"].as_str()), (Some("Universal Robots"), Some("arm")));
    assert!(robot["source"].as_str().is_some_and(|source| !source.is_empty()));
}

#[test]
fn a_name_is_solved_as_its_derivation() {
    let folder = tempdir().unwrap();
    let target = ["--target", "0.3,0.2,0.5"];
    let committed = succeed(&["solve", text(&root("derivations/polar")), target[0], target[1]]);
    for _ in 0..2 {
        assert_eq!(printed(&folder, &["solve", "polar", target[0], target[1]]), committed);
    }
    let cached = fs::read_dir(folder.path().join("cache")).unwrap().count();
    assert_eq!(cached, 1);
}

#[test]
fn no_cache_derives_and_stores_nothing() {
    let folder = tempdir().unwrap();
    let code = printed(&folder, &["codegen", "polar", "--lang", "rust", "--no-cache"]);
    assert!(code.contains("polar"));
    assert!(!folder.path().join("cache").exists());
}

#[test]
fn a_folder_with_the_name_of_a_robot_is_reported() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("polar")).unwrap();
    for arguments in [&["info", "polar"][..], &["solve", "polar", "--target", "0.3,0.2,0.5"]] {
        let error = String::from_utf8(run_in(&folder, arguments).stderr).unwrap();
        assert!(error.contains("it hides the robot `polar` by name"), "{error}");
    }
}

/// As in a container with a read-only file system, or without a home folder.
#[test]
fn a_cache_that_cannot_be_written_is_a_note() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "mine").unwrap();
    let expected = printed(&folder, &["solve", "polar", "--target", "0.3,0.2,0.5"]);
    let solve = || {
        let mut command = groebot(&["solve", "polar", "--target", "0.3,0.2,0.5"]);
        command.current_dir(folder.path());
        command
    };
    let blocked = solve().env("GROEBOT_CACHE", &file).output().unwrap();
    let below = solve().env("GROEBOT_CACHE", file.join("below")).output().unwrap();
    let homeless =
        solve().env_remove("GROEBOT_CACHE").env_remove("HOME").env_remove("XDG_CACHE_HOME").output().unwrap();
    for output in [blocked, below, homeless] {
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(String::from_utf8_lossy(&output.stdout), expected, "{error}");
        assert!(error.contains("note: `polar` is derived at each call") && error.contains("GROEBOT_CACHE"), "{error}");
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
}

#[test]
fn a_name_is_derived_into_a_folder_of_its_name() {
    let folder = tempdir().unwrap();
    printed(&folder, &["derive", "polar"]);
    let program = fs::read(folder.path().join("polar/5_program.json")).unwrap();
    assert_eq!(program, fs::read(root("derivations/polar/5_program.json")).unwrap());
    // From now on the folder has this name.
    assert!(printed(&folder, &["check", "polar"]).contains("certificate.json"));
    assert!(!folder.path().join("cache").exists());
}

#[test]
fn limbs_of_humanoids_have_names() {
    let pose = |arguments: &[&str]| {
        succeed(arguments)
            .lines()
            .skip_while(|line| !line.contains("tip in the base frame"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let q = ["--q", "0.1,0.2,-0.3,0.4,-0.2,0.1"];
    assert_eq!(
        pose(&["fk", "nao_left_leg", q[0], q[1]]),
        pose(&["fk", text(&root("derivations/nao_left_leg")), q[0], q[1]])
    );
}

#[test]
fn an_unknown_name_is_neither_a_file_nor_a_robot() {
    for command in
        [&["derive", "ur5x"][..], &["solve", "ur5x", "--target", "1"], &["info", "ur5x"], &["fk", "ur5x", "--q", "1"]]
    {
        let error = refused(command);
        assert!(error.contains("no such file") && error.contains("did you mean `ur5`?"), "{error}");
    }
}

#[test]
fn shells_complete_commands() {
    for (shell, word) in [("bash", "complete -F"), ("zsh", "#compdef groebot"), ("fish", "complete -c groebot")] {
        let script = succeed(&["completions", shell]);
        assert!(script.contains(word) && script.contains("navigate"), "{shell}");
    }
    assert_eq!(run(&["completions", "cmd"]).code, 2);
}
