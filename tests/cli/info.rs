//! `groebot info`: robots, chains and their properties.

use std::fs;

use tempfile::tempdir;

use super::{content, refused, root, succeed, text};

fn file(name: &str) -> String {
    text(&root("tests/corpus/urdf").join(name)).to_owned()
}

fn has(page: &str, words: &[&str]) {
    for word in words {
        assert!(page.contains(word), "`{word}` is not in:\n{page}");
    }
}

#[test]
fn a_robot_shows_its_links_and_the_ends_of_its_limbs() {
    let page = succeed(&["info", &file("nao.urdf")]);
    has(
        &page,
        &[
            "nao: 30 links, 24 joints that move, 5 fixed; root base_link",
            "RHipYawPitch, revolute, follows LHipYawPitch",
        ],
    );
    has(
        &page,
        &[
            "ends of limbs\n  Head, LFoot, RFoot, LWrist, RWrist\n",
            "leaves\n  Head, l_sole, r_sole, l_hand, r_hand\n",
            "--tip Head",
        ],
    );
}

#[test]
fn a_chain_shows_joints_limits_and_geometry() {
    let page = succeed(&["info", &file("nao.urdf"), "--base", "torso", "--tip", "r_sole"]);
    has(&page, &["nao_r_sole: 6 joints, task pose, lengths in m", "from link torso to link r_sole"]);
    has(&page, &["1  RHipYawPitch  turns about (0, 1, 1)  through (0, -0.05, -0.085) m", "-5.90..121.47 deg"]);
    has(&page, &["tip at (0, -0.05, -0.33309) m, roll pitch yaw (0, 0, 0) deg", "parallel, 0.1029 m apart"]);
    has(&page, &["1-3  RHipYawPitch, RHipRoll, RHipPitch   through one point, (0, -0.05, -0.085) m"]);
    has(
        &page,
        &[
            "3-5  RHipPitch, RKneePitch, RAnklePitch  parallel axes",
            "RHipYawPitch: in the robot it follows LHipYawPitch, outside this chain; here it is independent",
        ],
    );
    let across = succeed(&["info", &file("nao.urdf"), "--base", "l_hand", "--tip", "r_hand"]);
    has(&across, &["10 joints", "passed from child to parent", "LShoulderPitch, RShoulderPitch", "the same line"]);
}

#[test]
fn a_single_chain_needs_no_tip_and_rounded_angles_are_reported() {
    let page = succeed(&["info", &file("ur5.urdf")]);
    has(
        &page,
        &[
            "shoulder_lift: roll 1.5708 rad is interpreted as 90 deg when a solver is derived",
            "2-4  shoulder_lift, elbow, wrist_1",
        ],
    );
    let table = succeed(&["info", &file("ur5_standard.toml")]);
    has(
        &table,
        &[
            "ur5: 6 joints",
            "2  shoulder_lift  turns about (0, -1, 0)  through (0, 0, 0.089159) m",
            "-360.00..360.00 deg",
        ],
    );
}

#[test]
fn general_angles_and_slides_read_well() {
    let folder = tempdir().unwrap();
    let robot = folder.path().join("0_robot.urdf");
    let text_of = "<robot name='lift'><link name='a'/><link name='b'/><joint name='rail' type='prismatic'><parent link='a'/>\
                   <child link='b'/><origin rpy='0 0.3 0'/><axis xyz='0 0 2'/><limit lower='0' upper='0.5'/></joint></robot>";
    fs::write(&robot, text_of).unwrap();
    let page = succeed(&["info", text(folder.path())]);
    has(
        &page,
        &[
            "1 joint, ",
            "slides along (0.295520207, 0, 0.955336489)",
            "0..0.5 m",
            "roll pitch yaw (0, 17.188733854, 0) deg",
        ],
    );
    has(&page, &["pitch 0.3 rad has no exact sine"]);
}

#[test]
fn mistakes_name_the_file_and_write_nothing() {
    let folder = tempdir().unwrap();
    let robot = folder.path().join("bad.urdf");
    fs::write(&robot, "<robot name='r'>\n<link name='a'/>\n<link name='a'/></robot>").unwrap();
    let before = content(folder.path());
    has(&refused(&["info", text(&robot)]), &["bad.urdf: line 3: link `a`: another link has this name"]);
    has(&refused(&["derive", text(&robot)]), &["bad.urdf: line 3"]);
    assert_eq!(content(folder.path()), before);
    has(&refused(&["info", &file("ur5_axes.toml"), "--tip", "x"]), &["only a URDF has links"]);
}
