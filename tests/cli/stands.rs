//! Walks of the documentation in MuJoCo with feedback. CI plays five of them; the `--ignored` test plays all.

use std::fs;
use std::path::Path;

use groebot::motion::Trajectory;
use tempfile::tempdir;

use super::simulate::{is_skipped, number, reported, with_python};
use super::{root, succeed, text};

/// Four steps ahead, RH0 5.3.1.
const FOUR_STEPS: &str = "out right, stride left, stride right, in left";

/// Commands of the documentation that plan walks with today's defaults. The first five are short.
fn commands() -> Vec<Vec<String>> {
    let room = text(&root("examples/living_room.toml")).to_owned();
    let through = format!("--map {room} --start 1.4,1.5,0 --goal 3.2,1.6");
    let lines = [
        "walk nao --steps 8",
        "walk nao --steps 8 --length 0 --turn 40",
        "walk teo --goal 1,0.5",
        "walk rh0 --plan FOUR",
        "walk rh0 --plan TURN",
        "walk nao --steps 8 --length 0 --aside 0.02 --amplitude 0.04",
        "walk nao --steps 12 --gait preview",
        "walk nao --turn 8",
        "walk nao --goal 2,0",
        "walk nao --gait osg --goal 0.3,0.1",
        "walk teo --goal 1,0",
        "walk rh0",
        "walk rh0 --gait rh0-real --crouched --plan FOUR",
        "walk rh0 --gait rh0-real --crouched --plan TURN",
        "walk rh0 --goal 2,1",
        &format!("navigate rh0 {through}"),
        &format!("navigate rh0 --gait rh0-real {through} --method m3r"),
        "task rh0 --room living-room --goal sofa --furniture piano=1.2,0.4",
    ];
    let words = |word: &str| match word {
        "FOUR" => FOUR_STEPS.to_owned(),
        "TURN" => "turn left 90".to_owned(),
        word => word.to_owned(),
    };
    lines.iter().map(|line| line.split(' ').map(words).collect()).collect()
}

/// Plans and simulates a walk. It stands, arrives within 10 % of its way and 5 cm, and its heading is within 3 degrees.
fn stands(command: &[String]) {
    let folder = tempdir().unwrap();
    let file = text(&folder.path().join("walk.json")).to_owned();
    let arguments: Vec<&str> = command.iter().map(String::as_str).collect();
    succeed(&[&arguments[..], &["--quiet", "-o", &file]].concat());
    let Some(report) = reported(&[&file], 0) else { return };
    let compared = &report["comparison"];
    let [planned, walked] =
        ["planned", "simulated"].map(|route| ["forward", "left", "turn"].map(|name| number(&compared[route][name])));
    let off = (walked[0] - planned[0]).hypot(walked[1] - planned[1]);
    let turned = (walked[2] - planned[2]).to_degrees();
    let margin = 1e3 * number(&report["usage"]["margin"][0]);
    println!("{command:?}: {:.0} mm and {turned:.1} deg off the plan, least margin {margin:.1} mm", 1e3 * off);
    assert!(report["run"]["fall_time"].is_null() && compared["landings"][0] == compared["landings"][1], "{command:?}");
    assert!(off < 0.05 + 0.1 * planned[0].hypot(planned[1]) && turned.abs() < 3.0, "{command:?}: {off} {turned}");
}

#[test]
fn walks_of_the_documentation_stand() {
    commands()[..5].iter().for_each(|command| stands(command));
}

#[test]
#[ignore = "plays 18 walks for some minutes"]
fn all_walks_of_the_documentation_stand() {
    commands().iter().for_each(|command| stands(command));
}

/// NAO's description with this torque of all motors [N m].
fn nao_with_efforts(effort: &str) -> String {
    let urdf = succeed(&["export", "nao", "--to", "urdf"]);
    let parts = urdf.split("effort=\"").enumerate().map(|(place, part)| match (place, part.split_once('"')) {
        (1.., Some((_, rest))) => format!("effort=\"{effort}\"{rest}"),
        _ => part.to_owned(),
    });
    parts.collect()
}

/// NAO with motors of 1.8 N m falls by its default gait, and stands when it walks more slowly. What is written is the walk that stands.
#[test]
fn a_walk_that_falls_is_repaired() {
    let folder = tempdir().unwrap();
    let [model, fallen, repaired] = ["weak.urdf", "fallen.csv", "repaired.csv"].map(|name| folder.path().join(name));
    fs::write(&model, nao_with_efforts("1.8")).unwrap();
    let walked = ["walk", text(&model), "--goal", "0.1,0", "--gait", "preview"];
    let falls = with_python(&[&walked[..], &["--verify", "-o", text(&fallen)]].concat(), None);
    if is_skipped(&falls) {
        return;
    }
    assert!(falls.code == 5 && !fallen.exists(), "{}", falls.err);
    assert!(falls.err.contains("error: simulated: the robot falls at ") && falls.out.is_empty(), "{}", falls.err);
    succeed(&[&walked[..], &["-o", text(&fallen), "--quiet"]].concat());
    let stands = with_python(&[&walked[..], &["--repair", "-o", text(&repaired)]].concat(), None);
    assert!(stands.code == 0, "{}", stands.err);
    let note = stands.err.lines().find(|line| line.starts_with("note: simulated: the robot would fall at ")).unwrap();
    assert!(note.contains("it stands with steps that last "), "{note}");
    let seconds = |file: &Path| *Trajectory::read_csv(file).unwrap().times.last().unwrap();
    assert!(seconds(&repaired) > seconds(&fallen));
    for (file, code) in [(&fallen, 5), (&repaired, 0)] {
        let report = reported(&[text(file), "--model", text(&model)], code).unwrap();
        assert_eq!(report["run"]["fall_time"].is_null(), code == 0);
    }
}

/// A walk that stands is written; without MuJoCo, or if it falls, nothing is. The robot that falls is NAO with motors too weak for its weight.
#[test]
fn a_plan_is_verified_before_it_is_written() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (file, nowhere, weak) = (at("walk.csv"), at("no_python"), at("weak.urdf"));
    fs::write(&weak, nao_with_efforts("0.6")).unwrap();
    let ran = |arguments: &[&str], python: Option<&Path>| {
        with_python(&[&["walk"], arguments, &["-o", text(&file)]].concat(), python)
    };
    let lost = ran(&["nao", "--steps", "3", "--verify"], Some(&nowhere));
    assert!(lost.code == 1 && lost.err.contains("GROEBOT_PYTHON") && !file.exists(), "{}", lost.err);
    let falls = ["--goal", "0.1,0", "--gait", "osg", "--crouched"];
    for (option, words) in [("--verify", "--repair plans again"), ("--repair", "so do slower, wider and lower walks")] {
        let fallen = ran(&[&[text(&weak), option], &falls[..]].concat(), None);
        if is_skipped(&fallen) {
            return;
        }
        assert!(fallen.code == 5 && fallen.err.contains(words) && !file.exists(), "{}", fallen.err);
    }
    let stands = ran(&["nao", "--steps", "3", "--repair"], None);
    assert!(stands.code == 0 && stands.err.contains("note: simulated: the robot stands"), "{}", stands.err);
    assert!(fs::read_to_string(&file).unwrap().starts_with("# groebot trajectory 1\n"));
}
