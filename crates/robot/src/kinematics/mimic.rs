//! Mimic joints of a chain, which follow other joints by a [`Mimic`], for example the fingers of a gripper.
//!
//! A mimic joint is given when its leader is given, because both have one unknown. Prismatic joints that move together
//! are merged when a chain is extracted from a [robot](crate::model::Robot::chain).

use super::{Chain, JointKind, Mimic};
use crate::document::shown;
use crate::spatial::angle;
use crate::{Error, ErrorKind, Result};

impl Chain {
    /// The index of the leader of the joint at `place`, and the law.
    #[doc(hidden)]
    pub fn leader(&self, place: usize) -> Option<(usize, &Mimic)> {
        let mimic = self.joints()[place].mimic.as_ref()?;
        let leader = self.joints().iter().position(|joint| joint.name == mimic.leader)?;
        Some((leader, mimic))
    }

    /// The indices of the given joints that are inputs: those that are not mimic joints, from base to tip.
    pub fn given_inputs(&self) -> Vec<usize> {
        self.given().into_iter().filter(|&place| self.joints()[place].mimic.is_none()).collect()
    }

    /// The values of all given joints, from base to tip, for the values of [`Chain::given_inputs`].
    #[doc(hidden)]
    pub fn given_values(&self, inputs: &[f64]) -> Vec<f64> {
        let places = self.given_inputs();
        let input = |place: usize| places.iter().zip(inputs).find(|(own, _)| **own == place).map_or(0.0, |(_, q)| *q);
        let value =
            |place: usize| self.leader(place).map_or_else(|| input(place), |(leader, law)| law.value(input(leader)));
        self.given().into_iter().map(value).collect()
    }

    /// Sets the mimic joints in `q` to the values given by their leaders.
    #[doc(hidden)]
    pub fn follow(&self, q: &mut [f64]) {
        for place in 0..self.joints().len() {
            if let Some((leader, mimic)) = self.leader(place) {
                q[place] = mimic.value(q[leader]);
            }
        }
    }

    /// The indices of the independent joints, which are neither given nor mimic joints, from base to tip. The task must
    /// determine these.
    pub fn independent(&self) -> Vec<usize> {
        let given = self.given();
        (0..self.joints().len()).filter(|place| !given.contains(place) && self.leader(*place).is_none()).collect()
    }

    /// The names of leaders that are not given and whose law has no closed form, each once.
    #[doc(hidden)]
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

    /// Mimic joints that are not given and whose law is not a polynomial in cosines and sines: each after its leader.
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

    /// The largest difference between a mimic joint and the value given by its leader, in radians or the length unit.
    /// For angles it is the shorter rotation.
    ///
    /// # Panics
    /// When `q` has fewer values than the chain has joints.
    #[doc(hidden)]
    pub fn strays(&self, q: &[f64]) -> f64 {
        let strays = |place: usize| {
            let (leader, mimic) = self.leader(place)?;
            let difference = q[place] - mimic.value(q[leader]);
            let turns = self.joints()[place].kind == JointKind::Revolute;
            Some(if turns { angle::wrap(difference).abs() } else { difference.abs() })
        };
        (0..self.joints().len()).filter_map(strays).fold(0.0, f64::max)
    }

    /// Checks that all mimic laws of joints that are not given have a closed form. Prismatic joints may follow
    /// prismatic joints. Revolute joints may follow revolute joints by integers up to eight.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] with both joints and a remedy.
    #[doc(hidden)]
    pub fn check_leaders(&self) -> Result<()> {
        let Some((leader, follower)) = self.unfit_followers().into_iter().next() else { return Ok(()) };
        let law = self.joints()[follower].mimic.as_ref().map(Mimic::to_string).unwrap_or_default();
        let [leader, name] = [leader, follower].map(|place| shown(&self.joints()[place].name));
        let text = format!(
            "joint `{name}` is {law} (mimic): a closed form needs revolute joints that follow revolute joints by an integer up to 8, or prismatic joints that follow prismatic joints; use a numeric search (`groebot ik --numeric`), or a solver with the value of `{leader}` as input (`--given {leader}`)"
        );
        Err(Error::new(ErrorKind::Unsupported, text))
    }
}
