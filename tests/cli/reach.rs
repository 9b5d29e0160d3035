//! `groebot reach`, and the HTML page of a map.

use std::fs;

use groebot::reach::ReachMap;
use tempfile::tempdir;

use super::{refused, run, succeed, text};

#[test]
fn a_map_is_made_written_and_shown() {
    let folder = tempdir().unwrap();
    let [json, csv, svg, page] = ["map.json", "map.csv", "map.svg", "map.html"].map(|name| folder.path().join(name));
    let requested =
        ["reach", "derivations/ur5", "--x=-0.9:0.9:7", "--y", "0.1:0.9:5", "--z", "0.3", "--orientations", "30"];
    let reported = succeed(&[&requested[..], &["-o", text(&json), "--plot", text(&svg)]].concat());
    let map = ReachMap::from_json(&fs::read_to_string(&json).unwrap()).unwrap();
    assert!((map.orientations, map.grid.places(), map.unit.as_str()) == (30, 35, "m") && map.reached() > 100);
    assert!(
        reported.contains("35 points, 30 orientations each")
            && reported.contains(&format!("{} of 1050 targets", map.reached())),
        "{reported}"
    );
    assert!(fs::read_to_string(&svg).unwrap().contains("<svg "));
    succeed(&[&requested[..], &["-o", text(&csv), "--quiet", "--measure", "manipulability"]].concat());
    assert!(fs::read_to_string(&csv).unwrap().starts_with("x,y,z,reached,answers,open,best,mean\n-0.9,0.1,0.3,"));
    succeed(&["view", "derivations/ur5", "--reach", text(&json), "-o", text(&page)]);
    let shown = fs::read_to_string(&page).unwrap();
    assert!(shown.contains(r#""reach":{"base":0,"of":"ur5, pose""#) && shown.len() < 2_000_000);
}

#[test]
fn axes_that_are_not_given_are_those_of_the_reach() {
    let reported = succeed(&["reach", "derivations/planar_3r", "--orientations", "8"]);
    assert!(reported.contains("441 points, 8 orientations each"), "{reported}");
    let given = ["--given", "0.4", "--measure", "limits", "--x", "0.4", "--y", "0.1:0.2:2", "--z", "0.5"];
    let reported = succeed(&[&["reach", "derivations/iiwa14", "--orientations", "40"][..], &given].concat());
    assert!(reported.contains("reached within limits: 2 points"), "{reported}");
}

#[test]
fn bad_questions_are_refused() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("map.txt");
    let with = |more: &[&str]| {
        refused(&[&["reach", "derivations/ur5", "--x", "0.3", "--y", "0.1", "--z", "0.2"], more].concat())
    };
    assert!(with(&["-o", text(&out)]).contains("end its name in .json or .csv"));
    assert!(with(&["--given", "1"]).contains("0 finite values of given joints"));
    assert!(with(&["--orientations", "0"]).contains("1 to 1000000 are allowed"));
    assert!(refused(&["reach", "derivations/nao_head"]).contains("positions of one tip"));
    assert!(refused(&["reach", "derivations/planar_2r", "--z", "0:1:3"]).contains("has no z"));
    assert!(refused(&["reach", "derivations/planar_2r", "--limits"]).contains("no limits are described"));
    assert!(refused(&["reach", "derivations/ur5/5_program.json"]).contains("give --x FROM:TO:COUNT"));
    for axis in ["", "1:2", "1:0:3", "a:b:c", "0:1:-4", "nan"] {
        let ran = run(&["reach", "derivations/ur5", &format!("--x={axis}")]);
        assert!(ran.code == 2 && ran.err.contains("--x"), "{axis}: {}", ran.err);
    }
    let other = folder.path().join("puma.json");
    succeed(&["reach", "derivations/puma", "--x", "0.3", "--y", "0.1", "--z", "0.2", "-o", text(&other), "--quiet"]);
    let reported = refused(&["view", "derivations/ur5", "--reach", text(&other), "-o", text(&out)]);
    assert!(reported.contains("this is the map of puma"), "{reported}");
    // Prismatic joints have limits, and their range is within the grid.
    assert!(succeed(&["reach", "derivations/gantry", "--orientations", "4"]).contains("9261 points"));
    let broken = folder.path().join("broken.json");
    fs::write(&broken, "{}").unwrap();
    let page = folder.path().join("page.html");
    assert!(refused(&["view", "derivations/ur5", "--reach", text(&broken), "-o", text(&page)]).contains("no `format`"));
    assert!(refused(&["view", "nao", "--reach", text(&broken), "-o", text(&page)]).contains("give the folder"));
    assert!(!page.exists() && !out.exists());
}
