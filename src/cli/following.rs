//! Joints that follow others by `mimic`, in the output of `solve`, `ik` and `derive`.

use groebot_robot::document::shown;
use groebot_robot::kinematics::Mimic;

/// A line for each joint that follows another one: `finger_2 follows 2 * finger_1`.
pub fn followers<'a>(joints: impl Iterator<Item = (&'a str, Option<&'a Mimic>)>) -> String {
    let line = |(name, mimic): (&str, Option<&Mimic>)| Some(format!("  {} follows {}\n", shown(name), mimic?));
    joints.filter_map(line).collect()
}

/// By joint, the joint that it follows, for JSON; `None` where no joint follows.
pub fn leaders<'a>(follows: impl Iterator<Item = Option<&'a Mimic>>) -> Option<Vec<Option<&'a str>>> {
    let leaders: Vec<_> = follows.map(|mimic| mimic.map(|mimic| mimic.leader.as_str())).collect();
    leaders.iter().any(Option::is_some).then_some(leaders)
}
