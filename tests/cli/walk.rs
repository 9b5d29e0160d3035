//! `groebot walk`.

use std::fs;

use tempfile::tempdir;

use super::{refused, run, succeed, text};

#[test]
fn eight_steps_are_written_as_csv_json_and_svg() {
    let folder = tempdir().unwrap();
    let [csv, json, svg] = ["walk.csv", "walk.json", "walk.svg"].map(|name| folder.path().join(name));
    let told = succeed(&["walk", "nao", "--steps", "8", "-o", text(&csv), "--json", text(&json), "--plot", text(&svg)]);
    for word in ["8 steps", "0.280 m", "least margin", "joint limits", "none had to be slowed down"] {
        assert!(told.contains(word), "{word}: {told}");
    }
    let table = fs::read_to_string(&csv).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    assert_eq!(header[0], "time");
    let column = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let (left, right, margin) = (column("LHipYawPitch"), column("RHipYawPitch"), column("margin"));
    for (row, line) in table.lines().skip(1).enumerate() {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields[0].parse::<f64>().unwrap(), row as f64 / 100.0);
        assert_eq!(fields[left], fields[right]);
        assert!(fields[margin].parse::<f64>().unwrap() >= 0.01);
    }
    let walk: serde_json::Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(walk["samples"].as_array().unwrap().len(), table.lines().count() - 1);
    assert!(fs::read_to_string(&svg).unwrap().contains("zero moment point"));
}

#[test]
fn turns_files_of_footsteps_and_preview_control_are_walked() {
    let told = succeed(&["walk", "nao", "--length", "0", "--turn=-40", "--first", "right"]);
    assert!(told.contains("turn -40.0 deg"), "{told}");
    let told = succeed(&["walk", "nao", "--gait", "preview"]);
    assert!(told.contains("preview control") && told.contains("5.3 cm/s"), "{told}");
    let told = succeed(&["walk", "nao", "--sole", "seed", "--steps", "2"]);
    assert!(told.contains("2 steps"), "{told}");
    assert_eq!(succeed(&["walk", "nao", "--steps", "1", "--quiet"]), "");
    let folder = tempdir().unwrap();
    let (steps, out) = (folder.path().join("steps.csv"), folder.path().join("out.json"));
    fs::write(&steps, "foot,x,y,yaw\nleft,0.03,0.05,0.05\nright,0.05,-0.05,0.05\nleft,0.05,0.05,0.05\n").unwrap();
    assert!(succeed(&["walk", "nao", "--footsteps", text(&steps), "-o", text(&out)]).contains("3 steps"));
    let walk: serde_json::Value = serde_json::from_str(&fs::read_to_string(&out).unwrap()).unwrap();
    assert_eq!(walk["steps"][2]["foot"], "left");
}

#[test]
fn what_cannot_be_walked_is_refused_and_writes_nothing() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("walk.csv");
    let refusals = [
        (&["--hip-height", "0.3"][..], "out of reach"),
        (&["--amplitude", "0.01"], "the soles allow an amplitude of"),
        (&["--lift", "0.06"], "`LAnkleRoll`"),
        (&["--steps", "0"], "give 1 to 10000"),
        (&["--double-support", "1"], "between 0 and 1"),
        (&["--footsteps", "/nowhere.csv"], "/nowhere.csv"),
    ];
    for (arguments, word) in refusals {
        let mut all = vec!["walk", "nao", "-o", text(&out)];
        all.extend(arguments);
        let told = refused(&all);
        assert!(told.contains(word), "{word}: {told}");
        assert!(!out.exists());
    }
    for wrong in [&["walk"][..], &["walk", "teapot"], &["walk", "nao", "--footsteps", "a.csv", "--steps", "3"]] {
        assert_eq!(run(wrong).code, 2, "{wrong:?}");
    }
}
