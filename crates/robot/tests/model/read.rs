//! Robots read from files, whose format follows from the name's end and from the text.

use std::fs;

use groebot_robot::ErrorKind;
use groebot_robot::model::Robot;
use tempfile::tempdir;

const URDF: &str = "<robot name='arm'><link name='base'/><link name='tip'/>\
    <joint name='turn' type='continuous'><parent link='base'/><child link='tip'/></joint></robot>";
const TOML: &str = "name = \"arm\"\n[[link]]\nname = \"base\"\n";

fn read(name: &str, text: &str) -> groebot_robot::Result<Robot> {
    let folder = tempdir().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, text).unwrap();
    Robot::read(&file)
}

#[test]
fn the_format_follows_from_the_text() {
    for (name, text, joints) in [("arm.urdf", URDF, 1), ("arm.XML", URDF, 1), ("arm", URDF, 1), ("arm.toml", TOML, 0)] {
        let robot = read(name, text).unwrap();
        assert_eq!((robot.name(), robot.joints().len()), ("arm", joints), "{name}");
    }
}

#[test]
fn what_is_no_robot_is_refused_with_the_file() {
    let cases = [
        ("arm.urdf", TOML, ErrorKind::Syntax),
        ("arm.json", "{\"name\": \"arm\"}", ErrorKind::Unsupported),
        ("arm.toml", "", ErrorKind::Syntax),
        ("chain.toml", "name = \"arm\"\n[[joint]]\nname = \"j\"\n[tip]\n", ErrorKind::UnknownKey),
    ];
    for (name, text, kind) in cases {
        let error = read(name, text).unwrap_err();
        assert_eq!(error.kind(), kind, "{name}: {error}");
        assert!(error.to_string().contains(name), "{error}");
    }
    assert_eq!(Robot::read("nowhere/arm.urdf").unwrap_err().kind(), ErrorKind::Io);
}
