//! Joints of a chain that follow others of it, as the fingers of a gripper do, by a [`Mimic`].
//!
//! A joint that follows is given where its leader is: one value is one unknown. What slides with another one is merged into it when a chain
//! is cut out of a [robot](crate::model::Robot::chain).

use super::{Chain, JointKind, Mimic};
use crate::document::shown;
use crate::spatial::angle;
use crate::{Error, ErrorKind, Result};

impl Chain {
    /// The place of the joint that the joint at `place` follows, and by what law.
    pub fn leader(&self, place: usize) -> Option<(usize, &Mimic)> {
        let mimic = self.joints()[place].mimic.as_ref()?;
        let leader = self.joints().iter().position(|joint| joint.name == mimic.leader)?;
        Some((leader, mimic))
    }

    /// The places of the joints whose values are numbers of a target, from the base: those that are given and follow no other.
    pub fn given_inputs(&self) -> Vec<usize> {
        self.given().into_iter().filter(|&place| self.joints()[place].mimic.is_none()).collect()
    }

    /// The values of all given joints, from the base, by those of [`Chain::given_inputs`].
    pub fn given_values(&self, inputs: &[f64]) -> Vec<f64> {
        let places = self.given_inputs();
        let input = |place: usize| places.iter().zip(inputs).find(|(own, _)| **own == place).map_or(0.0, |(_, q)| *q);
        let value =
            |place: usize| self.leader(place).map_or_else(|| input(place), |(leader, law)| law.value(input(leader)));
        self.given().into_iter().map(value).collect()
    }

    /// `q` with the joints that follow others where these bring them.
    pub fn follow(&self, q: &mut [f64]) {
        for place in 0..self.joints().len() {
            if let Some((leader, mimic)) = self.leader(place) {
                q[place] = mimic.value(q[leader]);
            }
        }
    }

    /// The names of the joints that others follow and whose values are not given.
    pub fn open_leaders(&self) -> Vec<String> {
        let given = self.given();
        let followed = |place: &usize| self.followers(*place).next().is_some();
        let open = (0..self.joints().len()).filter(|place| !given.contains(place)).filter(followed);
        open.map(|place| self.joints()[place].name.clone()).collect()
    }

    /// The places of the joints that follow the one at `leader`.
    fn followers(&self, leader: usize) -> impl Iterator<Item = usize> {
        (0..self.joints().len()).filter(move |&place| self.leader(place).is_some_and(|(own, _)| own == leader))
    }

    /// The largest difference of a joint from where the one that it follows brings it, angles the way round that is shorter: radians, or the
    /// length unit.
    ///
    /// # Panics
    /// When `q` has fewer values than the chain has joints.
    pub fn strays(&self, q: &[f64]) -> f64 {
        let strays = |place: usize| {
            let (leader, mimic) = self.leader(place)?;
            let difference = q[place] - mimic.value(q[leader]);
            let turns = self.joints()[place].kind == JointKind::Revolute;
            Some(if turns { angle::wrap(difference).abs() } else { difference.abs() })
        };
        (0..self.joints().len()).filter_map(strays).fold(0.0, f64::max)
    }

    /// Fails where a joint that is not given is followed by others, unless the task sees as many numbers as there are joints and what follows
    /// slides as its leader does, or turns a whole number of times as far: then all are found and those kept that follow.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] with the joint and what helps.
    pub fn check_leaders(&self) -> Result<()> {
        let given = self.given();
        let sees_all = self.joints().len() - given.len() <= self.task().freedoms();
        let is_exact = |place: usize| {
            self.leader(place).is_none_or(|(leader, mimic)| {
                let [kind, other] = [place, leader].map(|joint| self.joints()[joint].kind);
                kind == other && (kind == JointKind::Prismatic || mimic.whole().is_some())
            })
        };
        let is_told = |place: usize| given.contains(&place) || is_exact(place);
        let all_told = sees_all && (0..self.joints().len()).all(is_told);
        let Some(name) = self.open_leaders().into_iter().next().filter(|_| !all_told) else { return Ok(()) };
        let leader = self.joints().iter().position(|joint| joint.name == name).unwrap_or(0);
        let followers: Vec<String> =
            self.followers(leader).map(|place| format!("`{}`", shown(&self.joints()[place].name))).collect();
        let (name, verb) = (shown(&name), if followers.len() == 1 { "follows" } else { "follow" });
        let text = format!(
            "joint `{name}`: {} {verb} it (mimic); give its value (`--given {name}`), and theirs come from it; a search \
             (`groebot ik --numeric`) finds it, too",
            followers.join(", ")
        );
        Err(Error::new(ErrorKind::Unsupported, text))
    }
}
