//! The format `0_coupled.toml`: accepted descriptions, and error messages for mistakes.

use std::fs;
use std::path::Path;

use groebot_ik::derive::coupled::{CoupledChains, JointPlace};
use groebot_ik::{Error, ErrorKind};
use groebot_robot::kinematics::{LengthUnit, Task};

use crate::errors::assert_error;

const CHAIN: &str = "name = \"arm\"\nlength_unit = \"m\"\ntask = { kind = \"position\" }\ntip = { point = [2, 0, 0] }
[[joint]]\nname = \"hip\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [0, 0, 0]
[[joint]]\nname = \"knee\"\ntype = \"revolute\"\naxis = [0, 1, 0]\npoint = [1, 0, 0]
[[joint]]\nname = \"slide\"\ntype = \"prismatic\"\naxis = [1, 0, 0]\npoint = [1, 0, 0]\n";
const TWO: &str = "name = \"two\"
source = \"none\"
shared = [
  [\"a.hip\", \"b.hip\"],
]
[[chain]]
name = \"a\"
chain = \"arm.toml\"
[[chain]]
name = \"b\"
prefix = \"right_\"
chain = \"arm.toml\"
task = { kind = \"direction\", direction = [0, 0, 2] }
given = [\"slide\"]
";

fn read(text: &str) -> Result<CoupledChains, Error> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.toml"), CHAIN).unwrap();
    fs::write(folder.path().join("mm.toml"), CHAIN.replace("\"m\"", "\"mm\"")).unwrap();
    fs::write(folder.path().join("bad.toml"), CHAIN.replace("[0, 1, 0]", "[0, 0, 0]")).unwrap();
    let path = folder.path().join("0_coupled.toml");
    fs::write(&path, text).unwrap();
    CoupledChains::read(&path)
}

#[test]
fn chains_are_read_with_their_tasks_and_shared_joints() {
    let coupled = read(TWO).unwrap();
    let parts = coupled.parts();
    assert_eq!((parts.name.as_str(), parts.source.as_deref(), &parts.description), ("two", Some("none"), &None));
    let [a, b] = coupled.chains() else { panic!("{coupled:?}") };
    assert_eq!((a.prefix.as_str(), a.chain.task(), a.chain.given()), ("a_", Task::Position, vec![]));
    assert_eq!((b.prefix.as_str(), b.chain.task(), b.chain.given()), ("right_", Task::Direction, vec![2]));
    assert_eq!(b.chain.length_unit(), LengthUnit::Metre);
    let places = [0, 1].map(|member| JointPlace { member, joint: 0 });
    assert_eq!(parts.shared, [places]);
    let names: Vec<&str> = coupled.actuators().iter().map(|actuator| actuator.name.as_str()).collect();
    assert_eq!(names, ["hip", "a_knee", "a_slide", "right_knee", "right_slide"]);
}

#[test]
fn joints_of_other_names_are_one_actuator_with_the_name_of_the_first() {
    let members = read(&TWO.replace("b.hip", "b.knee")).unwrap();
    let names: Vec<&str> = members.actuators().iter().map(|actuator| actuator.name.as_str()).collect();
    assert_eq!(names, ["a_hip", "a_knee", "a_slide", "right_hip", "right_slide"]);
}

#[test]
fn mistakes_stand_at_their_line_and_say_what_is_allowed() {
    let cases = [
        ("shared", "share", ErrorKind::UnknownKey, 3, "did you mean `shared`"),
        ("prefix", "prefiks", ErrorKind::UnknownKey, 11, "allowed: `name`, `prefix`"),
        ("chain = \"arm.toml\"\ntask", "task", ErrorKind::MissingKey, 9, "has no `chain`"),
        ("\"a.hip\"", "\"a.hop\"", ErrorKind::UnknownName, 4, "did you mean `hip`"),
        ("\"a.hip\"", "\"c.hip\"", ErrorKind::UnknownName, 4, "allowed: `a`, `b`"),
        ("\"a.hip\"", "\"hip\"", ErrorKind::BadValue, 4, "is not a joint of a chain"),
        ("\"a.hip\"", "\"b.knee\"", ErrorKind::BadValue, 4, "one of each"),
        ("\"a.hip\", ", "", ErrorKind::BadValue, 4, "two or more chains"),
        ("\"a.hip\"", "\"a.slide\"", ErrorKind::BadValue, 4, "all must be revolute, or all prismatic"),
        ("],\n]", "],\n[\"a.hip\", \"b.knee\"]]", ErrorKind::DuplicateName, 5, "`a.hip` is shared twice"),
        ("name = \"b\"", "name = \"a\"", ErrorKind::UnknownName, 4, "there is no `b`"),
        ("\"right_\"", "\"a_\"", ErrorKind::DuplicateName, 9, "change one of them"),
        ("\"right_\"", "\"1\"", ErrorKind::BadValue, 9, "no digit first"),
        ("name = \"two\"", "name = \"t w o\"", ErrorKind::BadValue, 1, "`name` is not a word"),
        ("prefix = \"right_\"\nchain = \"arm.toml\"", "chain = \"mm.toml\"", ErrorKind::BadValue, 9, "give one unit"),
        ("\"arm.toml\"\ntask", "\"../arm.toml\"\ntask", ErrorKind::BadValue, 12, "not a plain file name"),
        ("\"arm.toml\"\ntask", "7\ntask", ErrorKind::BadValue, 12, "or a table"),
        ("[\"slide\"]", "[\"slid\"]", ErrorKind::UnknownName, 9, "chain `b`"),
        ("\"direction\", direction", "\"pose\", direction", ErrorKind::BadValue, 13, "orients no direction"),
    ];
    for (from, to, kind, line, word) in cases {
        let text = TWO.replacen(from, to, 1);
        assert_ne!(text, TWO, "{from}");
        assert_error(&read(&text).unwrap_err(), kind, Some(line), word);
    }
}

#[test]
fn mistakes_in_a_chain_s_file_stand_there() {
    let error = read(&TWO.replacen("arm.toml", "bad.toml", 1)).unwrap_err();
    assert_error(&error, ErrorKind::BadValue, Some(13), "chain `a`");
    assert!(error.place().file.as_ref().is_some_and(|file| file.ends_with("bad.toml")), "{error}");
    let error = read(&TWO.replacen("arm.toml", "none.toml", 1)).unwrap_err();
    assert_error(&error, ErrorKind::Io, None, "");
    assert_eq!(CoupledChains::read(Path::new("/nowhere/0_coupled.toml")).unwrap_err().kind(), ErrorKind::Io);
}

#[test]
fn more_actuators_than_a_program_holds_are_refused() {
    let member = |name: char| format!("[[chain]]\nname = \"{name}\"\nchain = \"arm.toml\"\n");
    let text: String = "name = \"many\"\n".to_owned() + &('a'..='f').map(member).collect::<String>();
    assert_error(&read(&text).unwrap_err(), ErrorKind::BadValue, Some(1), "18 actuators; 16 are allowed");
}
