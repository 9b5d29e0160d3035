//! A fault in one part is an error where the part is used, and a note elsewhere.

use groebot_humanoid::sim::export::Scene;
use groebot_humanoid::view::Page;
use groebot_robot::ErrorKind;
use groebot_robot::dynamics::{Base, Equations, Model};
use groebot_robot::model::{Part, Robot};

/// An arm with two joints, and a camera on a separate branch, with `pan` and `cam` in place of its joint and link.
fn robot(pan: &str, cam: &str) -> String {
    format!(
        "<robot name=\"arm\">\n<link name=\"base\"/>\n<link name=\"upper\"/>\n<link name=\"tip\"/>\n{cam}\n\
         <joint name=\"j1\" type=\"revolute\"><parent link=\"base\"/><child link=\"upper\"/><axis xyz=\"0 0 1\"/>\
         <limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint>\n\
         <joint name=\"j2\" type=\"revolute\"><parent link=\"upper\"/><child link=\"tip\"/><origin xyz=\"0.3 0 0\"/><axis xyz=\"0 0 1\"/>\
         <limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint>\n{pan}\n</robot>\n"
    )
}

const PAN: &str = "<joint name=\"pan\" type=\"revolute\"><parent link=\"base\"/><child link=\"cam\"/><axis xyz=\"0 0 1\"/>\
                   <limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>";
const CAM: &str =
    "<link name=\"cam\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial></link>";

/// Faults of the camera: the replacement in its joint or link, and the message.
const FAULTS: [(&str, &str, ErrorKind, &str); 15] = [
    (
        "lower=\"-1\"",
        "lower=\"3\"",
        ErrorKind::BadValue,
        "joint `pan`: the limits 3..1 are inverted; give the lower limit first, or the type `continuous`",
    ),
    (
        "upper=\"1\"",
        "upper=\"inf\"",
        ErrorKind::BadValue,
        "joint `pan`: the limits -1..inf are not finite; give finite ones, or the type `continuous`",
    ),
    (
        "upper=\"1\"",
        "upper=\"1e999\"",
        ErrorKind::BadValue,
        "are not finite; give finite ones, or the type `continuous`",
    ),
    ("lower=\"-1\"", "lower=\"nan\"", ErrorKind::BadValue, "<limit> has `lower` = \"nan\""),
    (
        "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>",
        "",
        ErrorKind::BadValue,
        "joint `pan`: a revolute joint needs limits",
    ),
    ("effort=\"1\"", "effort=\"inf\"", ErrorKind::BadValue, "joint `pan`: <limit> has `effort` = \"inf\""),
    (
        "<axis xyz=\"0 0 1\"/>",
        "<axis xyz=\"0 0 0\"/>",
        ErrorKind::BadValue,
        "joint `pan`: axis [0, 0, 0] has no direction",
    ),
    ("<axis xyz", "<axes xyz", ErrorKind::UnknownKey, "joint `pan`: <axes> is not an element of a joint"),
    ("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 $(arg z)\"/>", ErrorKind::Unsupported, "is xacro"),
    (
        "</joint>",
        "<mimic joint=\"gone\"/></joint>",
        ErrorKind::UnknownName,
        "joint `pan`: it mimics `gone`, which is not a joint",
    ),
    (
        "</joint>",
        "<mimic joint=\"pan\"/></joint>",
        ErrorKind::BadValue,
        "joint `pan`: the chain of joints that it mimics is a cycle",
    ),
    (
        "</joint>",
        "<mimic joint=\"j1\" multiplier=\"x\"/></joint>",
        ErrorKind::BadValue,
        "joint `pan`: <mimic> has `multiplier`",
    ),
    ("type=\"revolute\"", "type=\"revolut\"", ErrorKind::BadValue, "did you mean `revolute`?"),
    ("ixx=\"1\"", "ixx=\"nan\"", ErrorKind::BadValue, "link `cam`: <inertia> has `ixx` = \"nan\": nan is not finite"),
    ("<mass value=\"1\"/>", "", ErrorKind::MissingKey, "link `cam`: <inertial> has no <mass"),
];

#[test]
fn a_fault_beside_the_chain_is_a_note() {
    let sound = Robot::from_urdf(&robot(PAN, CAM)).unwrap();
    assert!(sound.faults().is_empty() && sound.check().is_ok());
    for (from, to, kind, words) in FAULTS {
        let read = Robot::from_urdf(&robot(&PAN.replacen(from, to, 1), &CAM.replacen(from, to, 1))).unwrap();
        assert_eq!(read.chain(None, Some("tip")), sound.chain(None, Some("tip")), "{to}");
        let notes = read.notes(&read.path(None, Some("tip")).unwrap());
        assert!(notes.len() == 1 && notes[0].contains(words) && notes[0].contains("line "), "{to}: {notes:?}");
        let [fault] = read.faults() else { panic!("{to}: {:?}", read.faults()) };
        let part = if words.contains("link `cam`") { Part::Link("cam".into()) } else { Part::Joint("pan".into()) };
        assert_eq!((&fault.part, fault.error.kind()), (&part, kind), "{to}");
    }
}

#[test]
fn a_fault_in_the_chain_or_in_the_whole_robot_is_refused() {
    for (from, to, kind, words) in FAULTS {
        let read = Robot::from_urdf(&robot(&PAN.replacen(from, to, 1), &CAM.replacen(from, to, 1))).unwrap();
        let refusals = [
            read.chain(None, Some("cam")).unwrap_err(),
            read.chain(Some("cam"), Some("tip")).unwrap_err(),
            read.check().unwrap_err(),
            Robot::new(read.parts().clone()).unwrap_err(),
            Model::new(&read).unwrap_err(),
            Equations::new(&read, Base::Fixed).unwrap_err(),
            Page::of_robot(&read, None).unwrap_err(),
            Scene::of_robot(&read, None, None).unwrap_err(),
        ];
        for error in refusals {
            assert!(error.kind() == kind && error.message().contains(words), "{to}: {error}");
            assert!(error.place().line.is_some(), "{to}: {error}");
        }
    }
}

/// As in urdfdom; mani_skill's TriFinger has such a description.
#[test]
fn of_two_inertials_the_first_is_taken() {
    let twice = CAM.replacen("</inertial>", "</inertial><inertial><mass value=\"7\"/></inertial>", 1);
    let [once, twice] = [CAM, &twice].map(|cam| Robot::from_urdf(&robot(PAN, cam)).unwrap());
    let mass = |robot: &Robot| robot.links()[robot.link("cam").unwrap()].mass.clone();
    assert!(mass(&once).is_some() && mass(&twice) == mass(&once) && twice.check().is_ok());
    let doubts = twice.doubts();
    assert!(
        doubts.iter().any(|doubt| doubt.contains("`cam`") && doubt.contains("the first one is used")),
        "{doubts:?}"
    );
}

#[test]
fn faults_survive_what_makes_a_robot_of_another_one() {
    let read = Robot::from_urdf(&robot(&PAN.replace("upper=\"1\"", "upper=\"-9\""), CAM)).unwrap();
    let meant = read.as_meant().unwrap();
    assert_eq!(meant.faults(), read.faults());
    // A joint that mimics itself then follows no joint, and the fault remains recorded.
    let turned = PAN.replace("</joint>", "<mimic joint=\"pan\"/></joint>");
    let read = Robot::from_urdf(&robot(&turned, CAM)).unwrap();
    assert!(Robot::new(read.parts().clone()).is_err() && read.as_meant().unwrap().check().is_err());
}

#[test]
fn each_part_has_its_fault_in_the_order_of_the_file() {
    let pan = PAN
        .replace("lower=\"-1\"", "lower=\"3\"")
        .replace("0 0 1", "0 0 0")
        .replace("</joint>", "<mimic joint=\"gone\"/></joint>");
    let read = Robot::from_urdf(&robot(&pan, &CAM.replace("value=\"1\"", "value=\"much\""))).unwrap();
    let messages: Vec<String> = read.faults().iter().map(|fault| fault.error.to_string()).collect();
    assert_eq!(messages.len(), 3, "{messages:?}");
    assert!(
        messages[0].starts_with("line 5: link `cam`") && messages[1].starts_with("line 8: joint `pan`: axis"),
        "{messages:?}"
    );
    assert!(messages[2].contains("mimics `gone`"), "{messages:?}");
}

#[test]
fn an_actuator_without_its_joint_moves_nothing_of_a_chain() {
    let more =
        "<transmission name=\"t\"><joint name=\"pan\"/><joint name=\"tilt\"/><actuator name=\"m\"/></transmission>";
    let read = Robot::from_urdf(&robot(&format!("{PAN}\n{more}"), CAM)).unwrap();
    assert!(read.chain(None, Some("tip")).is_ok() && read.chain(None, Some("cam")).is_ok());
    assert_eq!((read.faults()[0].part.clone(), read.actuators().len()), (Part::Actuator("m".into()), 0));
    let error = Equations::new(&read, Base::Fixed).unwrap_err();
    assert!(error.message().contains("actuator `m`: the robot has no joint `tilt`"), "{error}");
    assert_eq!(error.place().line, Some(9));
}

#[test]
fn what_the_tree_rests_on_is_refused_everywhere() {
    for (from, to, words) in [
        ("<parent link=\"base\"/>", "", "joint `pan`: <joint> has no <parent"),
        ("<parent link=\"base\"/>", "<parnt link=\"base\"/>", "did you mean `parent`?"),
        ("<parent link=\"base\"/>", "<parent link=\"bse\"/>", "joint `pan`: its parent `bse` is not a link"),
        ("<child link=\"cam\"/>", "<child link=\"tip\"/>", "is already the child of joint `j2`"),
        ("<parent link=\"base\"/>", "<parent link=\"cam\"/>", "loop"),
        ("name=\"pan\"", "", "<joint> has no `name`"),
        ("name=\"pan\"", "name=\"j1\"", "joint `j1`: another joint has this name"),
        ("</joint>", "", "not XML"),
    ] {
        assert!(PAN.contains(from), "{from}");
        let error = Robot::from_urdf(&robot(&PAN.replacen(from, to, 1), CAM)).unwrap_err();
        assert!(error.message().contains(words) && error.place().line.is_some(), "{to}: {error}");
    }
}

#[test]
fn a_slide_has_no_remedy_in_turning() {
    let slide = PAN.replace("revolute", "prismatic").replace("lower=\"-1\"", "lower=\"3\"");
    let error = Robot::from_urdf(&robot(&slide, CAM)).unwrap().check().unwrap_err();
    assert!(error.message().ends_with("the limits 3..1 are inverted; give the lower limit first"), "{error}");
}

#[test]
fn xacro_that_nothing_uses_is_a_note() {
    let left = "<xacro:property name=\"width\" value=\".2\"/><xacro:arg name=\"prefix\" default=\"${width}\"/>";
    let read = Robot::from_urdf(&robot(&format!("{PAN}\n{left}"), CAM)).unwrap();
    assert_eq!(read.chain(None, Some("tip")), Robot::from_urdf(&robot(PAN, CAM)).unwrap().chain(None, Some("tip")));
    let note = "line 9: unused definitions of xacro are ignored: `width`, `prefix`";
    assert_eq!(read.notes(&read.path(None, Some("tip")).unwrap()), [note]);
    assert!(read.check().is_ok(), "the whole robot is sound");
}

#[test]
fn xacro_that_something_uses_is_to_be_expanded() {
    let property = "<xacro:property name=\"width\" value=\".2\"/>";
    for (pan, cam, line) in [
        (PAN.replace("0 0 1", "0 0 ${width}"), CAM.to_owned(), 8),
        (PAN.replace("\"pan\"", "\"${prefix}pan\""), CAM.to_owned(), 8),
        (
            PAN.to_owned(),
            CAM.replace("</link>", "<visual><geometry><sphere radius=\"${width}\"/></geometry></visual></link>"),
            5,
        ),
        (PAN.replace("</joint>", "<xacro:limits/></joint>"), CAM.to_owned(), 8),
        (format!("{PAN}\n<xacro:macro name=\"m\"/>"), CAM.to_owned(), 9),
    ] {
        for more in ["", property] {
            let error = Robot::from_urdf(&robot(&format!("{pan}{more}"), &cam)).unwrap_err();
            assert_eq!((error.kind(), error.place().line), (ErrorKind::Unsupported, Some(line)), "{error}");
            assert!(error.message().contains("give its file, which is expanded when it is read"), "{error}");
        }
    }
}

#[test]
fn a_colour_that_is_none_is_a_note() {
    let material = "<material name=\"red\"><color rgba=\"1 0 0\"/></material>";
    let read = Robot::from_urdf(&robot(&format!("{PAN}\n{material}"), CAM)).unwrap();
    assert!(
        read.check().is_ok() && read.parts().notes[0].contains("3 found; give 4 numbers"),
        "{:?}",
        read.parts().notes
    );
}
