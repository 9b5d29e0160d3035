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

    /// The places of the joints that are not given and follow no other, from the base: what a task has to determine.
    pub fn independent(&self) -> Vec<usize> {
        let given = self.given();
        (0..self.joints().len()).filter(|place| !given.contains(place) && self.leader(*place).is_none()).collect()
    }

    /// The names of the joints that are not given and that others follow by a law of which no closed form is derived, each once.
    pub fn open_leaders(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (leader, _) in self.unfit_followers() {
            let name = &self.joints()[leader].name;
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        names
    }

    /// The joints that are not given and follow others by a law that is no polynomial in cosines and sines: each behind its leader.
    fn unfit_followers(&self) -> Vec<(usize, usize)> {
        let given = self.given();
        let unfit = |place: usize| {
            let (leader, mimic) = self.leader(place)?;
            let [kind, other] = [place, leader].map(|joint| self.joints()[joint].kind);
            let fits = kind == other && (kind == JointKind::Prismatic || mimic.whole().is_some());
            (!fits && !given.contains(&place)).then_some((leader, place))
        };
        (0..self.joints().len()).filter_map(unfit).collect()
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

    /// Fails where a joint that is not given is followed by another one by a fraction of a turn, or by one of the other kind: a closed form takes
    /// slides that follow slides, and turns that follow turns by whole numbers up to eight.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] with both joints and what helps.
    pub fn check_leaders(&self) -> Result<()> {
        let Some((leader, follower)) = self.unfit_followers().into_iter().next() else { return Ok(()) };
        let law = self.joints()[follower].mimic.as_ref().map(Mimic::to_string).unwrap_or_default();
        let [leader, name] = [leader, follower].map(|place| shown(&self.joints()[place].name));
        let text = format!(
            "joint `{name}` is {law} (mimic): a closed form takes turns that follow turns by a whole number up to 8, and slides that follow slides; \
             a search (`groebot ik --numeric`) finds joint values, and so does a solver to which the value of `{leader}` is given \
             (`--given {leader}`)"
        );
        Err(Error::new(ErrorKind::Unsupported, text))
    }
}
