//! `groebot view`. `browser.rs` tests its pages in Chromium.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use super::{refused, root, run, succeed, text};

const ARM: &str = "tests/corpus/urdf/ur5.urdf";

#[test]
fn walks_and_robots_become_pages() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let [csv, json, page] = ["walk.csv", "walk.json", "page.html"].map(at);
    for out in [&csv, &json] {
        succeed(&["walk", "nao", "--steps", "2", "-o", text(out), "--quiet"]);
    }
    let html = |arguments: &[&str]| {
        assert_eq!(succeed(&[&["view"], arguments, &["-o", text(&page)]].concat()), format!("{}\n", text(&page)));
        fs::read_to_string(&page).unwrap()
    };
    let has = |html: &str, keys: [bool; 3]| {
        assert_eq!(
            ["\"motion\":", "\"support\":", "\"phases\":"]
                .map(|key| html.contains(&format!("{key}{{")) || html.contains(&format!("{key}["))),
            keys
        );
    };
    let walk = html(&[text(&csv)]);
    assert!(walk.contains("<title>walk.csv</title>"));
    has(&walk, [true, true, false]);
    has(&html(&[text(&json)]), [true, true, true]);
    for robot in ["nao", "nao_v5", "rh0", "teo", text(&root(ARM)), text(&root("crates/robot/src/robots/data/teo.toml"))]
    {
        has(&html(&[robot]), [false, false, false]);
    }
    // A walk whose robot is given by name, and by a file.
    let foreign = fs::read_to_string(&csv).unwrap().replace("# robot: nao_v5", "# robot: somebody");
    fs::write(&csv, foreign).unwrap();
    assert_eq!(html(&[text(&csv), "--robot", "nao"]), walk);
    has(&html(&[text(&csv), "--robot", text(&root("crates/robot/src/robots/data/nao_v5.toml"))]), [true, true, false]);
    let error = refused(&["view", text(&csv), "-o", text(&page)]);
    assert!(
        error.contains("walk.csv: its robot `somebody` is not a robot of groebot") && error.contains("--robot"),
        "{error}"
    );
    let error = refused(&["view", text(&csv), "--robot", text(&root(ARM)), "-o", text(&page)]);
    assert!(error.contains("joint `HeadYaw`: the robot `ur5` has no such joint"), "{error}");
}

#[test]
fn what_is_no_walk_and_no_robot_is_refused() {
    let folder = tempdir().unwrap();
    let at = |name: &str, content: &str| {
        let file = folder.path().join(name);
        fs::write(&file, content).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let page = folder.path().join("page.html");
    let check_message = |arguments: &[&str], words: &str| {
        let error = refused(&[&["view"], arguments, &["-o", text(&page)]].concat());
        assert!(error.contains(words), "{error}");
        assert!(!page.exists());
    };
    check_message(&["nobody"], "there is no such file, and no robot is called `nobody`");
    check_message(&[&at("a.csv", "x,y\n1,2\n")], "a.csv: line 1: the first line is `x,y`; a trajectory begins with");
    check_message(&[&at("b.json", "{\"format\": 1, \"walk\": 3}")], "b.json: line 1: this is no trajectory in JSON");
    check_message(&[&at("c.json", "[]")], "c.json");
    check_message(
        &[&at("d.csv", "# groebot trajectory 1\n# robot: teo\ntime [s]\n")],
        "d.csv: the trajectory has no sample",
    );
    check_message(&[&at("e.urdf", "<robot name=\"dot\"><link name=\"a\"/></robot>")], "nothing to draw");
    check_message(&[&at("f.toml", "unknowns = [\"x\"]\nequations = [\"x - 1\"]\n")], "f.toml");
    check_message(&[text(&root("derivations/puma/0_chain.toml"))], "this does not describe a robot with links");
    check_message(&["nao", "--robot", "teo"], "--robot names the walking robot, but this is not a walk");
    assert_eq!(run(&["view", "nao"]).code, 2);
}

#[test]
fn derivations_and_rooms_become_pages() {
    let folder = tempdir().unwrap();
    let page = folder.path().join("page.html");
    fn with<'a>(page: &'a Path, arguments: &[&'a str]) -> Vec<&'a str> {
        [&["view"], arguments, &["-o", text(page)]].concat()
    }
    let read = |arguments: &[&str]| {
        succeed(&with(&page, arguments));
        fs::read_to_string(&page).unwrap()
    };
    let derived = read(&[text(&root("derivations/ur5"))]);
    assert!(
        derived.contains("\"limbs\":[{\"name\":\"ur5\"")
            && derived.contains("\"wasm\":\"")
            && derived.len() < 2_000_000
    );
    let redundant = read(&[text(&root("derivations/panda"))]);
    assert!(redundant.contains("\"limbs\":[{\"name\":\"panda\"") && redundant.len() < 2_000_000);
    let solved = read(&[text(&root(ARM)), "--tip", "wrist_3_link"]);
    assert!(solved.contains("\"limbs\":[{\"name\":\"wrist_3_link\"") && solved.len() < 2_000_000);
    let reported = refused(&with(&page, &[text(&root(ARM)), "--tip", "tool9"]));
    assert!(reported.contains("tool9"), "{reported}");
    let reported = refused(&with(&page, &["nao", "--tip", "l_sole", "--base", "l_sole"]));
    assert!(reported.contains("no joint moves between"), "{reported}");
    let room = root("examples/living_room.toml");
    let running = read(&["rh0", "--room", text(&room), "--start", "1,2.6,90", "--goal", "7.2,3.4"]);
    assert!(running.contains("\"run\":{\"robot\":\"rh0\"") && running.len() < 2_000_000);
    let reported = refused(&with(&page, &[text(&root(ARM)), "--room", text(&room), "--goal", "1,1"]));
    assert!(reported.contains("no walking robot"), "{reported}");
    // The default start of the room. A start in the wall is refused by the command, not in the page.
    assert!(read(&["rh0", "--room", "living-room", "--goal", "7.2,3.4"]).contains("\"start\":[1.0,2.6,0.0]"));
    let reported =
        refused(&with(&page, &["rh0", "--room", "living-room", "--start", "0.05,0.05", "--goal", "7.2,3.4"]));
    assert!(reported.contains("nearest free place"), "{reported}");
    let reported = refused(&with(&page, &[text(&root("derivations/ur5")), "--room", text(&room), "--goal", "1,1"]));
    assert!(reported.contains("--room and --tip are for robots at rest"), "{reported}");
    let reported = refused(&with(&page, &[text(&root("derivations/nao_legs"))]));
    assert!(reported.contains("is not that of a robot's chain"), "{reported}");
    assert_eq!(run(&with(&page, &["rh0", "--room", text(&room)])).code, 2);
}
