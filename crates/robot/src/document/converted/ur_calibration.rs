//! Kinematics of a calibrated arm of Universal Robots, from the YAML file that the ROS driver's calibration extracts from the controller. Main function:
//! [`to_toml`].

use std::collections::BTreeMap;

use saphyr_parser::{Event, Parser};

use crate::document::shown;
use crate::{Error, ErrorKind, Result};

/// The joints: name, parent, child, and the key of the child's pose in the file. Names and fixed frames are those of the package ur_description.
const JOINTS: [[&str; 4]; 6] = [
    ["shoulder_pan_joint", "base_link_inertia", "shoulder_link", "shoulder"],
    ["shoulder_lift_joint", "shoulder_link", "upper_arm_link", "upper_arm"],
    ["elbow_joint", "upper_arm_link", "forearm_link", "forearm"],
    ["wrist_1_joint", "forearm_link", "wrist_1_link", "wrist_1"],
    ["wrist_2_joint", "wrist_1_link", "wrist_2_link", "wrist_2"],
    ["wrist_3_joint", "wrist_2_link", "wrist_3_link", "wrist_3"],
];
/// The fixed joints: name, parent, child, and roll, pitch, yaw in degrees.
const FIXED: [([&str; 3], [i32; 3]); 3] = [
    (["base_link-base_link_inertia", "base_link", "base_link_inertia"], [0, 0, 180]),
    (["wrist_3-flange", "wrist_3_link", "flange"], [0, -90, -90]),
    (["flange-tool0", "flange", "tool0"], [90, 0, 90]),
];
const NUMBERS: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
/// Nesting of the file: `kinematics`, a joint, a number.
const LEVELS: usize = 3;

/// Whether `text` has the key `kinematics` and at least half of the joints of such a file.
pub fn is_ur_calibration(text: &str) -> bool {
    let has = |key: &str| text.lines().any(|line| line.trim() == key);
    let joints = JOINTS.iter().filter(|[.., key]| has(&format!("{key}:"))).count();
    has("kinematics:") && joints * 2 >= JOINTS.len()
}

/// The robot as TOML in the format of [`crate::model::toml`], with links `base_link` to `tool0` as in the package ur_description. The joints have no limits,
/// because the file has none.
///
/// # Errors
/// With the line: [`ErrorKind::Syntax`] for text that is not YAML; [`ErrorKind::MissingKey`] for a missing number; [`ErrorKind::BadValue`] for a text that is not
/// a number, and for anything but mappings of numbers.
pub fn to_toml(text: &str) -> Result<String> {
    let numbers = read(text)?;
    let vector = |joint: &str, names: &[&str]| {
        let number = |name: &&str| {
            let key = format!("kinematics/{joint}/{name}");
            let missing = || Error::new(ErrorKind::MissingKey, format!("`{joint}` has no `{name}`"));
            numbers.get(&key).map(|number| format!("\"{number}\"")).ok_or_else(missing)
        };
        Ok::<_, Error>(names.iter().map(number).collect::<Result<Vec<_>>>()?.join(", "))
    };
    let mut links = vec!["base_link"];
    let mut joints = String::new();
    for ([name, parent, child], [roll, pitch, yaw]) in &FIXED {
        links.push(child);
        joints += &format!(
            " {{ name = \"{name}\", type = \"fixed\", parent = \"{parent}\", child = \"{child}\", origin = {{ rpy_deg = [{roll}, {pitch}, {yaw}] }} }},\n"
        );
    }
    for [name, parent, child, key] in JOINTS {
        links.push(child);
        let (place, angles) = (vector(key, &NUMBERS[..3])?, vector(key, &NUMBERS[3..])?);
        joints += &format!(
            " {{ name = \"{name}\", type = \"continuous\", parent = \"{parent}\", child = \"{child}\", axis = [0, 0, 1], origin = {{ xyz = [{place}], rpy = [{angles}] }} }},\n"
        );
    }
    let links: String = links.iter().map(|link| format!(" {{ name = \"{link}\" }},\n")).collect();
    let source = numbers.get("kinematics/hash").map_or(String::new(), |hash| format!(", {}", shown(hash)));
    Ok(format!(
        "name = \"ur_calibrated\"\nsource = \"calibration of the controller{source}\"\nlink = [\n{links}]\njoint = [\n{joints}]\n"
    ))
}

/// The scalars of the file by their keys, joined by `/`.
fn read(text: &str) -> Result<BTreeMap<String, String>> {
    let mut found = BTreeMap::new();
    let mut keys: Vec<Option<String>> = Vec::new();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| {
            let text = format!("this is no YAML: {}", shown(error.info()));
            Error::new(ErrorKind::Syntax, text).at_line(error.marker().line())
        })?;
        let wrong = |text: &str| Error::new(ErrorKind::BadValue, text.to_owned()).at_line(span.start.line());
        match event {
            Event::MappingStart(..) if keys.len() == LEVELS => return Err(wrong("nested too deep for a calibration")),
            Event::MappingStart(..) => keys.push(None),
            Event::MappingEnd => {
                keys.pop();
                if let Some(key) = keys.last_mut() {
                    *key = None;
                }
            }
            Event::Scalar(value, ..) => match keys.last_mut() {
                Some(key @ None) => *key = Some(value.into_owned()),
                Some(Some(_)) => {
                    let path: Vec<&str> = keys.iter().flatten().map(String::as_str).collect();
                    let path = path.join("/");
                    if !path.ends_with("/hash") && !value.parse::<f64>().is_ok_and(f64::is_finite) {
                        return Err(wrong(&format!("`{}` is not a number", shown(&value))));
                    }
                    found.insert(path, value.into_owned());
                    if let Some(key) = keys.last_mut() {
                        *key = None;
                    }
                }
                None => return Err(wrong("give mappings of joints and numbers")),
            },
            Event::SequenceStart(..) | Event::Alias(..) => return Err(wrong("give mappings of joints and numbers")),
            _ => {}
        }
    }
    Ok(found)
}
