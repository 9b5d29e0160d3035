//! Expansion of xacro: the cases of `cases.toml` against `expected.json`, which `scripts/xacro/cases.py` writes with the package xacro.

mod refusals;

use std::fs;
use std::path::Path;

use groebot_robot::document::Document;
use groebot_robot::model::{ReadOptions, Robot, xacro};
use serde_json::Value;
use tempfile::{TempDir, tempdir};

/// The start of each description.
const START: &str = "<robot name=\"r\" xmlns:xacro=\"http://ros.org/wiki/xacro\">";

/// Writes a file with its folders.
fn write(folder: &Path, name: &str, text: &str) {
    let file = folder.join(name);
    fs::create_dir_all(file.parent().unwrap()).unwrap();
    fs::write(file, text.replace("<robot>", START)).unwrap();
}

/// A folder with `robot.xacro`, whose robot has the content `body`.
fn described(body: &str) -> TempDir {
    let folder = tempdir().unwrap();
    write(folder.path(), "robot.xacro", &format!("<robot>{body}</robot>"));
    folder
}

fn expand(folder: &TempDir, options: &ReadOptions) -> groebot_robot::Result<xacro::Expanded> {
    xacro::expand(&folder.path().join("robot.xacro"), options)
}

/// The expansion of a robot with the content `body`.
fn expanded(body: &str) -> groebot_robot::Result<xacro::Expanded> {
    expand(&described(body), &ReadOptions::new())
}

/// The text of an expansion after the XML declaration.
fn elements(text: &str) -> &str {
    text.split_once('\n').unwrap().1
}

#[test]
fn cases_expand_as_by_the_package_xacro() {
    let expected: Value = serde_json::from_str(include_str!("expected.json")).unwrap();
    let cases = Document::parse(include_str!("cases.toml")).unwrap();
    let cases = cases.root().required("case").unwrap().tables().unwrap();
    assert_eq!(cases.len(), expected.as_object().unwrap().len());
    let mut wrong = Vec::new();
    for case in cases {
        let [name, body] = ["name", "body"].map(|key| case.required(key).unwrap().text().unwrap());
        let folder = described(body);
        let entries = |key: &str| case.optional(key).map_or(Vec::new(), |node| node.table().unwrap().entries());
        for file in entries("files") {
            write(folder.path(), file.name(), file.text().unwrap());
        }
        let options = entries("arguments")
            .iter()
            .fold(ReadOptions::new(), |options, given| options.argument(given.name(), given.text().unwrap()));
        let found = match expand(&folder, &options) {
            Ok(expanded) => elements(&expanded.text).to_owned(),
            Err(error) => format!("{:?}: {error}", error.kind()),
        };
        let is_right = match expected[name]["text"].as_str() {
            Some(text) => found == text,
            None => found.starts_with(case.required("kind").unwrap().text().unwrap()),
        };
        if !is_right {
            wrong.push(format!("{name}:\n{found}instead of\n{}", expected[name]));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A robot is read from its expansion, and its faults have the lines of the description.
#[test]
fn robots_are_read_with_arguments() {
    let body = "<link name='a'/>\n<link name='$(arg tip)'/>\n\
        <joint name='j' type='revolute'><parent link='a'/><child link='$(arg tip)'/>\n<origin xyz='${0.1 * 3} 0 0'/></joint>";
    let folder = described(body);
    let read = |tip| {
        let options = ReadOptions::new().argument("tip", tip);
        Robot::read_with(folder.path().join("robot.xacro"), &options)
    };
    let robot = read("tool").unwrap();
    assert_eq!(robot.leaves(), ["tool"]);
    let fault = &robot.faults()[0].error;
    assert_eq!(fault.place().line, Some(3), "{fault}");
    assert!(fault.place().file.as_ref().unwrap().ends_with("robot.xacro"));
    assert_eq!(robot.joints()[0].origin.placement.origin[0].to_string(), "7500000000000001/25000000000000000");
    let twice = read("a").unwrap_err();
    assert_eq!(twice.place().line, Some(2), "{twice}");
}

/// Packages are found by name, in folders of packages, and above the description.
#[test]
fn packages_are_found() {
    let folder = described(
        "<xacro:include filename='$(find one)/a.xacro'/><xacro:include filename='package://two/a.xacro'/>\
        <xacro:include filename='$(find own)/own.xacro'/><e f='$(dirname)'/>",
    );
    let others = tempdir().unwrap();
    write(others.path(), "first/a.xacro", "<robot><one/></robot>");
    write(others.path(), "deep/folder/second/package.xml", "<package><name>two</name></package>");
    write(others.path(), "deep/folder/second/a.xacro", "<robot><two/></robot>");
    write(folder.path(), "own.xacro", "<robot><own/></robot>");
    write(folder.path(), "package.xml", "<package><name> own </name></package>");
    let options = ReadOptions::new().package("one", others.path().join("first")).folder(others.path());
    let text = expand(&folder, &options).unwrap().text;
    let dirname = format!("<e f=\"{}\"/>", folder.path().display());
    let expected = format!("<robot name=\"r\">\n  <one/>\n  <two/>\n  <own/>\n  {dirname}\n</robot>\n");
    assert_eq!(elements(&text), expected);
}

#[test]
fn only_used_xacro_is_expanded() {
    let path = Path::new("robot.urdf");
    let unused = "<robot name='a'><xacro:property name='p' value='1'/><xacro:arg name='q' default='2'/></robot>";
    assert!(!xacro::is_xacro(path, unused));
    assert!(xacro::is_xacro(Path::new("robot.urdf.XACRO"), unused));
    for used in [
        "<robot><xacro:property name='p' value='${1}'/></robot>",
        "<robot><xacro:propertys/></robot>",
        "<robot><xacro:if value='1'/></robot>",
    ] {
        assert!(xacro::is_xacro(path, used), "{used}");
    }
    assert!(!xacro::is_xacro(path, "<robot name='${a}'/>"));
}

#[test]
fn notes_are_kept() {
    let body = "<e a=\"${xacro.warning('old')}\" b='$(optenv HOME x)'/><xacro:if value='1'><xacro:attribute name='a' value='1'/></xacro:if>";
    let notes = expanded(body).unwrap().notes;
    assert_eq!(notes.len(), 3, "{notes:?}");
    assert!(notes[0].contains("reports: old") && notes[1].contains("environment variables are not read"));
    assert!(notes[2].starts_with("robot.xacro line 1: xacro:attribute has no effect"), "{notes:?}");
}
