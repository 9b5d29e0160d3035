//! Coupled prismatic joints along one direction: [`Telescope`]. They become one joint whose value is their sum.

use num_traits::{One, ToPrimitive, Zero};

use crate::document::shown;
use crate::kinematics::{Joint, JointKind, Mimic};
use groebot_algebra::number::BigRational;

/// Directions within this angle are equal. Then the length of a sum is the sum of the lengths, in doubles.
const PARALLEL: f64 = 1e-8;
/// Maximum number of characters of a joint's name.
const MAX_NAME: usize = 64;

/// Prismatic joints of a chain that move together, without a revolute joint between them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Telescope {
    /// The index of the leader.
    leader: usize,
    /// The indices of the followers, and whether they move in the leader's direction.
    followers: Vec<(usize, bool)>,
    /// The sum for a leader's value of one: nonzero.
    stride: BigRational,
}

impl Telescope {
    /// The telescopes among the joints of a chain.
    pub fn among(joints: &[Joint]) -> Vec<Telescope> {
        (0..joints.len()).filter_map(|leader| Telescope::led_by(leader, joints)).collect()
    }

    /// The telescope of the joint at `leader`, if all joints that follow it are prismatic and parallel.
    fn led_by(leader: usize, joints: &[Joint]) -> Option<Telescope> {
        let follows =
            |place: &usize| joints[*place].mimic.as_ref().is_some_and(|mimic| mimic.leader == joints[leader].name);
        let places: Vec<usize> = (0..joints.len()).filter(follows).collect();
        let first = places.iter().copied().chain([leader]).min()?;
        let last = places.iter().copied().chain([leader]).max()?;
        let slides = joints[first..=last].iter().all(|joint| joint.kind == JointKind::Prismatic);
        if places.is_empty() || !slides {
            return None;
        }
        let (mut followers, mut stride) = (Vec::new(), BigRational::one());
        for place in places {
            let cosine = joints[leader].direction().dot(&joints[place].direction());
            let across = joints[leader].direction().cross(&joints[place].direction()).norm();
            let mimic = joints[place].mimic.as_ref().filter(|mimic| mimic.offset.is_zero() && across <= PARALLEL)?;
            if cosine > 0.0 {
                stride += &mimic.multiplier;
            } else {
                stride -= &mimic.multiplier;
            }
            followers.push((place, cosine > 0.0));
        }
        (!stride.is_zero()).then_some(Telescope { leader, followers, stride })
    }

    /// The name of the sum: `a + b - c`, or `a + .. - c` if that is too long.
    fn name(&self, joints: &[Joint]) -> String {
        let signed =
            |(place, same): &(usize, bool)| format!(" {} {}", if *same { '+' } else { '-' }, joints[*place].name);
        let leader = &joints[self.leader].name;
        let others: String = self.followers.iter().map(signed).collect();
        let whole = format!("{leader}{others}");
        let ends = || format!("{leader} + ..{}", self.followers.last().map(signed).unwrap_or_default());
        if whole.chars().count() <= MAX_NAME { whole } else { ends().chars().take(MAX_NAME).collect() }
    }

    /// The fraction of the sum for each of the joints.
    fn shares<'j>(&self, joints: &'j [Joint]) -> Vec<(&'j str, BigRational)> {
        let factor = |mimic: &Mimic| &mimic.multiplier / &self.stride;
        let followers = self.followers.iter().map(|(place, _)| &joints[*place]);
        let shares = followers.filter_map(|joint| Some((joint.name.as_str(), factor(joint.mimic.as_ref()?))));
        [(joints[self.leader].name.as_str(), self.stride.recip())].into_iter().chain(shares).collect()
    }

    /// Notes for the user.
    pub fn notes(&self, joints: &[Joint]) -> Vec<String> {
        let share = |(name, share): (&str, BigRational)| {
            format!("{} is {} of it", shown(name), share.to_f64().unwrap_or(f64::NAN))
        };
        let shares: Vec<String> = self.shares(joints).into_iter().map(share).collect();
        vec![format!(
            "{}: coupled prismatic joints are one joint, whose value is this sum; {}",
            self.name(joints),
            shares.join(", ")
        )]
    }

    /// The sum as a joint, at the position of the leader.
    fn joint(&self, joints: &[Joint]) -> Joint {
        let leader = &joints[self.leader];
        let stride = self.stride.to_f64().unwrap_or(f64::NAN);
        let scaled = |(low, high): (f64, f64)| {
            let (a, b) = (low * stride, high * stride);
            (a.min(b), a.max(b))
        };
        // A joint's limits, converted to the sum.
        let of_sum = |(joint, share): (&Joint, &BigRational)| {
            let factor = share.to_f64()?;
            let (a, b) = joint.limits.map(|(low, high)| (low / factor, high / factor))?;
            Some((a.min(b), a.max(b)))
        };
        let shares = self.shares(joints);
        let places = [self.leader].into_iter().chain(self.followers.iter().map(|(place, _)| *place));
        let limits: Vec<(f64, f64)> =
            places.zip(&shares).filter_map(|(place, (_, share))| of_sum((&joints[place], share))).collect();
        let inner = limits.into_iter().reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)));
        let limits = inner.filter(|(low, high)| low <= high).or_else(|| leader.limits.map(scaled));
        Joint { name: self.name(joints), limits, mimic: None, ..leader.clone() }
    }
}

/// `joints` with each telescope as one joint.
pub(super) fn joined(joints: Vec<Joint>, telescopes: &[Telescope]) -> Vec<Joint> {
    if telescopes.is_empty() {
        return joints;
    }
    let follows = |place: usize| telescopes.iter().any(|one| one.followers.iter().any(|(own, _)| *own == place));
    let whole = |place: usize| match telescopes.iter().find(|telescope| telescope.leader == place) {
        Some(telescope) => telescope.joint(&joints),
        None => joints[place].clone(),
    };
    let kept = (0..joints.len()).filter(|place| !follows(*place)).map(whole);
    kept.enumerate().map(|(place, joint)| Joint { symbol: (place + 1).to_string(), ..joint }).collect()
}
