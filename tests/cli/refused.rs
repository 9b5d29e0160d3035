//! Invalid input: each is refused with one clear line, and nothing is written.

use std::fs;

use tempfile::tempdir;

use super::{content, folder_with, leg, refused, root, text};

/// Derives `bytes` as the file `name` of a folder. The error must contain all of `words`, and nothing may be written.
fn refuse_file(name: &str, bytes: &[u8], words: &[&str]) -> String {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join(name), bytes).unwrap();
    let before = content(folder.path());
    let error = refused(&["derive", text(folder.path())]);
    for word in words.iter().chain(&[name]) {
        assert!(error.contains(word), "`{word}` is not in: {error}");
    }
    assert_eq!(content(folder.path()), before);
    error
}

fn chain(from: &str, to: &str) -> Vec<u8> {
    let leg = fs::read_to_string(root("derivations/nao_leg_sagittal/0_chain.toml")).unwrap();
    assert!(leg.contains(from));
    leg.replacen(from, to, 1).into_bytes()
}

/// A system of angles with the unknowns c, s and k, t, the targets p and r, and these equations.
fn system(equations: &[&str]) -> Vec<u8> {
    let mut text = "name = \"bad\"\n[[parameter]]\nname = \"p\"\n[[parameter]]\nname = \"r\"\n\
                    [[joint]]\nname = \"Elbow\"\ncosine = \"c\"\nsine = \"s\"\n\
                    [[joint]]\nname = \"Wrist\"\ncosine = \"k\"\nsine = \"t\"\n"
        .to_owned();
    for equation in equations {
        text += &format!("[[equation]]\nequation = \"{equation}\"\n");
    }
    text.into_bytes()
}

/// Pseudorandom bytes with a fixed seed.
fn noise(count: usize) -> Vec<u8> {
    let mut state = 1u64;
    let mut byte = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 56) as u8
    };
    (0..count).map(|_| byte()).collect()
}

#[test]
fn files_that_are_no_description() {
    refuse_file("0_chain.toml", b"", &["empty"]);
    refuse_file("0_system.toml", &noise(1 << 20), &["too long", "1000000 bytes"]);
    refuse_file("0_chain.toml", &noise(1_000_000), &["line 1:", "UTF-8"]);
    let printable: Vec<u8> = noise(1_000_000).into_iter().map(|byte| b' ' + byte % 95).collect();
    refuse_file("0_chain.toml", &printable, &["line 1:", "TOML"]);
    let missing = refused(&["derive", "no/such/file.toml"]);
    assert!(missing.starts_with("error: no/such/file.toml: "), "{missing}");
}

#[test]
fn mistakes_in_a_description_name_their_line() {
    refuse_file("0_chain.toml", &chain("symbol = \"3\"", "symbl = \"3\""), &["line 20:", "symbl"]);
    refuse_file("0_chain.toml", &chain("axis = [0, 1, 0]", "axis = [0, 0, 0]"), &["line 22:", "axis", "HipPitch"]);
    refuse_file("0_chain.toml", &chain("point = [0, 0, 100.0]", "point = [0, nan, 100.0]"), &["line 30:", "nan"]);
    let twice = String::from_utf8(system(&["c - p"])).unwrap().replace("name = \"p\"", "name = \"c\"");
    refuse_file("0_system.toml", twice.as_bytes(), &["line", "`c`"]);
}

#[test]
fn systems_without_finitely_many_solutions() {
    refuse_file("0_system.toml", &system(&["c - p", "c - p - 1", "k - r"]), &["contradict"]);
    refuse_file("0_system.toml", &system(&["c - p"]), &["Wrist stay free"]);
    let gantry = "name = \"gantry\"\ntask = { kind = \"planar_position\", plane = \"xz\" }\njoint = [\n\
        { name = \"Along\", type = \"prismatic\", axis = [1, 0, 0], point = [0, 0, 0] },\n\
        { name = \"Beside\", type = \"prismatic\", axis = [1, 0, 0], point = [0, 0, 0] },\n]\n\
        tip = { point = [0, 0, 1] }\n";
    let reported = ["some of the 2 unknown joints free", "the value of one of the joints `Along`, `Beside`"];
    refuse_file("0_chain.toml", gantry.as_bytes(), &reported);
}

#[test]
fn folders_without_one_input() {
    let folder = tempdir().unwrap();
    let none = refused(&["derive", text(folder.path())]);
    assert!(none.contains("no input") && none.contains("0_system.toml"), "{none}");
    let folder = folder_with("nao_leg_sagittal", "0_chain.toml");
    fs::write(folder.path().join("0_system.toml"), "name = \"x\"").unwrap();
    let both = refused(&["derive", text(folder.path())]);
    assert!(both.contains("both"), "{both}");
}

#[test]
fn a_file_without_extension_needs_a_folder() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("leg");
    fs::copy(root("derivations/nao_leg_sagittal/0_chain.toml"), &file).unwrap();
    let error = refused(&["derive", text(&file)]);
    assert!(error.contains("--out"), "{error}");
    assert_eq!(content(folder.path()).len(), 1);
}

#[test]
fn targets() {
    let leg = leg().path();
    let cases = [
        ("60,abc", &["cell 2", "`pz`", "abc", "decimal number"][..]),
        ("60", &["1 numbers given", "px, pz"]),
        ("60,150,3", &["3 numbers given", "px, pz"]),
        ("60,NaN", &["`pz`", "NaN", "finite"]),
        ("inf,1", &["`px`", "finite"]),
        ("", &["cell 1", "`px`"]),
    ];
    for (target, words) in cases {
        let error = refused(&["solve", leg, "--target", target]);
        assert!(words.iter().all(|word| error.contains(word)), "{target}: {error}");
    }
}

#[test]
fn programs() {
    let folder = tempdir().unwrap();
    let absent = refused(&["solve", text(folder.path()), "--target", "1,2"]);
    assert!(absent.contains("5_program.json") && absent.contains("groebot derive"), "{absent}");
    let file = folder.path().join("5_program.json");
    fs::write(&file, "{ \"format\": 2,\n \"name\": 3 }").unwrap();
    let malformed = refused(&["solve", text(folder.path()), "--target", "1,2"]);
    assert!(malformed.contains("5_program.json: line 2:"), "{malformed}");
    fs::write(&file, "{ \"name\": \"leg\",\n \"version\": \"0.1.0\" }").unwrap();
    let old = refused(&["solve", text(folder.path()), "--target", "1,2"]);
    assert!(old.contains("written by groebot 0.1.0; 2 to 3 are read: `groebot derive`"), "{old}");
    fs::write(&file, noise(100_000)).unwrap();
    refused(&["solve", text(&file), "--target", "1,2"]);
    let robot = root("tests/corpus/urdf/ur5.urdf");
    for command in [&["solve", text(&robot), "--target", "1,2"][..], &["codegen", text(&robot), "--lang", "c"]] {
        let error = refused(command);
        assert!(
            error.contains("ur5.urdf: this is not a derived solver") && error.contains("groebot derive"),
            "{error}"
        );
    }
}
