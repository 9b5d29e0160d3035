//! Mimic joints in the output of `solve`, `ik` and `derive`.

use groebot_robot::document::shown;
use groebot_robot::kinematics::Mimic;

/// A line for each mimic joint: `finger_2 follows 2 * finger_1`.
pub fn followers<'a>(joints: impl Iterator<Item = (&'a str, Option<&'a Mimic>)>) -> String {
    let line = |(name, mimic): (&str, Option<&Mimic>)| Some(format!("  {} follows {}\n", shown(name), mimic?));
    joints.filter_map(line).collect()
}

/// The leader of each joint, for JSON; `None` where no joint is a mimic joint.
pub fn leaders<'a>(follows: impl Iterator<Item = Option<&'a Mimic>>) -> Option<Vec<Option<&'a str>>> {
    let leaders: Vec<_> = follows.map(|mimic| mimic.map(|mimic| mimic.leader.as_str())).collect();
    leaders.iter().any(Option::is_some).then_some(leaders)
}
