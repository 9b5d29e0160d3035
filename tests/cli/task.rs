//! `groebot task`.

use std::fs;

use groebot::motion::Trajectory;
use groebot::sim::TaskRecord;
use serde_json::Value;
use tempfile::tempdir;

use super::{refused, run, succeed, text};

const ROOM: &str = "size = [3.0, 2.4]\nwall = 0.05\nstart = [0.6, 1.2]\n[[furniture]]\nname = \"chair\"\nbox = [0.4, 0.4]\nat = [2.4, 1.2]\n\
    [[furniture]]\nname = \"ball\"\ncircle = 0.1\nat = [2.8, 2.2]\n";

#[test]
fn a_task_is_done_checked_and_shown() {
    let folder = tempdir().unwrap();
    let [room, json, page, svg] =
        ["room.toml", "task.json", "task.html", "plan.svg"].map(|name| folder.path().join(name));
    fs::write(&room, ROOM).unwrap();
    let requested =
        ["task", "rh0", "--gait", "rh0-sim", "--room", text(&room), "--goal", "chair", "--then", "ball=1.6,2.3@2"];
    let files = ["-o", text(&json), "--view", text(&page), "--plot", text(&svg)];
    let reported = succeed(&[&requested[..], &files].concat());
    for word in ["after step 0, found in", "after step 2, found in", "nearest ", "to floor, ", "rotates at ", "81"] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    let written = fs::read_to_string(&json).unwrap();
    let walk = Trajectory::from_json(&written).unwrap();
    let record = TaskRecord::from_json(&written).unwrap().unwrap();
    // Earlier files name the path of a stage `way`.
    let former = written.replace("\"path\":", "\"way\":");
    assert_ne!(former, written);
    assert_eq!(TaskRecord::from_json(&former).unwrap().unwrap(), record);
    assert_eq!((record.stages.len(), record.stages[1].pieces[1].at), (2, [1.6, 2.3, 0.0]));
    assert!(record.stages[1].from > 0.0 && record.stages[1].from < walk.times[walk.times.len() - 1]);
    let value: Value = serde_json::from_str(&written).unwrap();
    let checks = &value["task"]["checks"];
    assert!(checks["passed"] == true && checks["findings"] == 0 && checks["fastest"]["rpm"].as_f64().unwrap() < 25.0);
    let nearest = &checks["clearances"][0];
    assert!(
        nearest["distance"].as_f64().unwrap() > 0.02 && checks["sole_deviation"].as_f64().unwrap() < 1e-12,
        "{checks}"
    );
    // The robot ends in front of the chair, whose near side is at 2.2.
    let last = |name: &str| {
        let contact = walk.contacts.iter().find(|contact| contact.name == name).unwrap();
        contact.poses[contact.poses.len() - 1].translation.vector
    };
    let middle = (last("left") + last("right")) / 2.0;
    assert!(middle.x < 2.2 && middle.x > 1.4 && (middle.y - 1.2).abs() < 0.2, "{middle}");
    // The page of the file equals that of --view, except for its title.
    let again = folder.path().join("again.html");
    succeed(&["view", text(&json), "-o", text(&again)]);
    let data = |file| {
        let html = fs::read_to_string(file).unwrap();
        let begun = html.split_once("\"robot\":").unwrap().1;
        begun.split_once("</script>").unwrap().0.to_owned()
    };
    assert!(data(&page) == data(&again) && data(&page).contains("\"task\":{\"scene\""));
    assert!(fs::read_to_string(&svg).unwrap().contains("rh0: "));
    let reported: Value = serde_json::from_str(&succeed(&[&requested[..], &["--json"]].concat())).unwrap();
    assert_eq!(reported["checks"]["clearances"], checks["clearances"]);
}

#[test]
fn where_a_change_leaves_no_path_the_exit_status_is_four() {
    let folder = tempdir().unwrap();
    let room = folder.path().join("room.toml");
    fs::write(&room, ROOM.replace("circle = 0.1\nat = [2.8, 2.2]", "box = [0.2, 2.4]\nat = [2.9, 1.2]")).unwrap();
    let requested = ["task", "rh0", "--room", text(&room), "--goal", "2.2,1.8", "--furniture", "chair=2.7,0.3"];
    let requested = [&requested[..], &["--then", "ball=1.6,1.2@1", "--json"]].concat();
    let output = run(&requested);
    assert_eq!(output.code, 4, "{} {}", output.out, output.err);
    assert!(output.err.contains("there is no path: "), "{}", output.err);
    let reported: Value = serde_json::from_str(&output.out).unwrap();
    assert!(reported["passed"] == false && reported["enclosure"].as_array().unwrap().len() > 3, "{reported}");
}

#[test]
fn bad_input_of_tasks_is_refused() {
    let folder = tempdir().unwrap();
    let [room, walk] = ["room.toml", "walk.json"].map(|name| folder.path().join(name));
    fs::write(&room, ROOM.replace("start = [0.6, 1.2]\n", "")).unwrap();
    let start = ["--start", "0.6,1.2"];
    let task = |more: &[&str]| refused(&[&["task", "rh0", "--room", text(&room)][..], more].concat());
    for (more, words) in [
        (&["--goal", "chair"][..], "the room has no start; give --start"),
        (&["--goal", "chairs", start[0], start[1]], "no furniture `chairs` (did you mean `chair`?)"),
        (&["--goal", "1", start[0], start[1]], "--goal takes two or three numbers"),
        (&["--goal", "chair", start[0], start[1], "--then", "ball=1,1"], "give NAME=X,Y@STEPS"),
        (&["--goal", "chair", start[0], start[1], "--then", "bull=1,1@3"], "did you mean `ball`"),
        (&["--goal", "chair", start[0], start[1], "--then", "ball=1@3"], "give NAME=X,Y or"),
        (&["--goal", "chair", start[0], start[1], "--then", "chair=none@2"], "no piece `chair`"),
        (&["--goal", "chair", "--start", "2.4,1.2"], "the nearest free place is ("),
    ] {
        let reported = task(more);
        assert!(reported.contains(words), "{words}: {reported}");
    }
    let reported = refused(&["task", "rh0", "--room", "livingroom", "--goal", "sofa"]);
    assert!(reported.contains("livingroom"), "{reported}");
    // A truncated record.
    fs::write(&room, ROOM).unwrap();
    succeed(&["task", "rh0", "--room", text(&room), "--goal", "0.8,1.2", "-o", text(&walk), "--quiet"]);
    let whole: Value = serde_json::from_str(&fs::read_to_string(&walk).unwrap()).unwrap();
    for (change, words) in [
        (
            Box::new(|value: &mut Value| value["task"]["stages"] = Value::Array(Vec::new())) as Box<dyn Fn(&mut Value)>,
            "`task` has no path",
        ),
        (Box::new(|value| value["task"]["scene"] = Value::Null), "`task` does not have the format of groebot"),
        (
            Box::new(|value| value["task"]["stages"][0]["goal"] = serde_json::json!([1.0])),
            "`task` has no path, or a goal",
        ),
    ] {
        let mut value = whole.clone();
        change(&mut value);
        fs::write(&walk, value.to_string()).unwrap();
        let reported = refused(&["view", text(&walk), "-o", text(&folder.path().join("page.html"))]);
        assert!(reported.contains(words), "{words}: {reported}");
    }
}
