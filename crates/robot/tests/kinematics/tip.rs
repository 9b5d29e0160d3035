//! The default tip link: which names are used, and which are only suggested.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{LinkPath, TipChoice};
use groebot_robot::model::Robot;

/// A robot of links with their parents: `child<parent` moves, `child=parent` is fixed.
fn robot(links: &str) -> Robot {
    let mut text = String::from("<robot name='r'><link name='base'/>");
    for word in links.split(' ') {
        let (child, parent, kind) = match word.split_once('<') {
            Some((child, parent)) => (child, parent, "continuous"),
            None => word.split_once('=').map(|(child, parent)| (child, parent, "fixed")).unwrap(),
        };
        text += &format!(
            "<link name='{child}'/><joint name='to_{child}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>\
             <axis xyz='0 0 1'/></joint>"
        );
    }
    Robot::from_urdf(&(text + "</robot>")).unwrap()
}

/// The tip of a chain and how it was chosen; a refusal with its suggestions.
fn tip(links: &str, base: Option<&str>) -> Result<(String, TipChoice), String> {
    match robot(links).path(base, None) {
        Ok(LinkPath { tip, choice, .. }) => Ok((tip, choice)),
        Err(error) => {
            assert_eq!(error.kind(), ErrorKind::MissingKey);
            Err(error.message().split_once("such as ").unwrap().1.to_owned())
        }
    }
}

#[test]
fn one_leaf_or_one_tip_frame_is_taken() {
    let frame = |link: &str, frame| Ok((link.to_owned(), TipChoice::OnlyFrame(frame)));
    assert_eq!(tip("a<base b<a", None), Ok(("b".to_owned(), TipChoice::OnlyLeaf)));
    // As in ROS-Industrial's arms: the frame of the controller is a leaf too.
    assert_eq!(tip("a<base b<a flange=b tool0=flange ctrl=base", None), frame("tool0", "tool0"));
    assert_eq!(tip("a<base b<a flange=b camera=b", None), frame("flange", "flange"));
    assert_eq!(tip("a<base tcp=a ee_link=a", None), frame("tcp", "tcp"));
    assert_eq!(tip("a<base robot_ee_link=a cam=a", None), frame("robot_ee_link", "ee_link"));
    assert_eq!(tip("a<base TOOL0=a cam=a", None), frame("TOOL0", "tool0"));
    // The fingers of a gripper are the leaves. The arm ends where the gripper begins.
    assert_eq!(tip("a<base tool0=a left<tool0 right<tool0", None), frame("tool0", "tool0"));
}

#[test]
fn several_tip_frames_or_one_of_a_side_are_suggested() {
    let refused = |names: &str| Err(names.to_owned());
    assert_eq!(tip("l<base r<base left_tool0=l right_tool0=r", None), refused("`left_tool0`, `right_tool0`"));
    // A name that occurs several times ends the search: one flange does not determine which arm is meant.
    assert_eq!(tip("a<base b<base a_tool0=a b_tool0=b flange=b", None), refused("`a_tool0`, `b_tool0`, `flange`"));
    assert_eq!(tip("a<base b<base left_tcp=a hand=b", None), refused("`left_tcp`, `hand`"));
    assert_eq!(tip("a<base b<base r_ee_link=a hand=b", None), refused("`r_ee_link`, `hand`"));
    assert_eq!(tip("a<base b<base mytool0=a hand=b", None), refused("`mytool0`, `hand`"));
}

#[test]
fn suggestions_are_leaves_that_move_the_likeliest_first() {
    let robot = robot("hip<base calf<hip foot=calf arm<base hand=arm wrist<arm wrist_flange=wrist imu=base");
    assert_eq!(robot.suggested_tips(robot.root_place()), ["wrist_flange", "foot", "hand"]);
    assert_eq!(tip("hip<base calf<hip foot=calf imu=base", None), Err("`foot`".to_owned()));
    // Links that move below a tip frame are part of a tool: its leaves are not suggested, other leaves are.
    let arm = |side: &str| format!("{side}<base {side}_tool0={side} {side}_thumb<{side}_tool0 {side}_camera={side}");
    let arms = [arm("left"), arm("right")].join(" ");
    assert_eq!(tip(&arms, None), Err("`left_tool0`, `right_tool0`, `left_camera`, `right_camera`".to_owned()));
    // From another base, other links move.
    assert_eq!(tip("hip<base calf<hip foot=calf imu=base", Some("foot")), Err("`imu`".to_owned()));
    assert_eq!(tip("a=base b=base", None), Err("`a`, `b`".to_owned()), "nothing moves: all leaves");
}

#[test]
fn the_carrier_is_the_link_before_the_first_joint_that_moves() {
    let robot = robot("mount=base a<mount b<a tip=b");
    let carrier = |base: &str, tip: &str| robot.carrier(&robot.path(Some(base), Some(tip)).unwrap()).to_owned();
    assert_eq!(carrier("base", "tip"), "mount");
    assert_eq!(carrier("tip", "base"), "b", "upwards the child carries");
    assert_eq!(carrier("base", "mount"), "base");
}
