//! The list of robots by name. Main type: [`Listed`].

use std::fmt;

use crate::Result;
use crate::kinematics::{Chain, Task};
use crate::model::Robot;

/// The kind of a listed robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// One arm, from its base to its flange or hand.
    Arm,
    /// One leg, from the body to the sole.
    Leg,
    /// One finger of a hand.
    Hand,
    /// Another chain, such as a neck.
    Chain,
    /// A robot with several chains.
    Robot,
}

impl Kind {
    /// All kinds, in the order of lists.
    pub const ALL: [Kind; 5] = [Kind::Arm, Kind::Leg, Kind::Hand, Kind::Chain, Kind::Robot];

    /// The word for the kind: `arm`, `leg`, `hand`, `chain` or `robot`.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Arm => "arm",
            Kind::Leg => "leg",
            Kind::Hand => "hand",
            Kind::Chain => "chain",
            Kind::Robot => "robot",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// A robot that groebot knows by name. Its numbers are data of this crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listed {
    pub(super) name: &'static str,
    pub(super) vendor: &'static str,
    pub(super) model: &'static str,
    pub(super) kind: Kind,
    pub(super) source: &'static str,
    pub(super) checked: Option<&'static str>,
    pub(super) ends: Option<[&'static str; 2]>,
    pub(super) task: Option<Task>,
    pub(super) text: &'static str,
}

impl Listed {
    /// The name, in lower case with underscores, such as `franka_panda`.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The vendor.
    pub fn vendor(&self) -> &'static str {
        self.vendor
    }

    /// The vendor's name of the model.
    pub fn model(&self) -> &'static str {
        self.model
    }

    /// Whether it is an arm, a leg, a hand or a whole robot.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The source of the numbers: a maker's drawing, a Denavit-Hartenberg table or a published description.
    pub fn source(&self) -> &'static str {
        self.source
    }

    /// The independent description with which forward kinematics were compared, and the largest difference. `None` for an unchecked robot.
    pub fn checked(&self) -> Option<&'static str> {
        self.checked
    }

    /// The links at both ends of the chain, if the description is that of a larger robot.
    pub fn ends(&self) -> Option<[&'static str; 2]> {
        self.ends
    }

    /// The task of the chain between [`Listed::ends`]. `None` where the description states the task.
    pub fn task(&self) -> Option<Task> {
        self.task
    }

    /// The description as TOML: a chain, a Denavit-Hartenberg table, or a robot with links.
    pub fn text(&self) -> &'static str {
        self.text
    }

    /// The chain; `None` for a robot with several chains. A chain between [`Listed::ends`] has the name of the robot's description.
    pub fn chain(&self) -> Option<Chain> {
        if self.kind == Kind::Robot {
            return None;
        }
        let chain = match self.ends {
            Some([base, tip]) => self.between(base, tip),
            None => Chain::from_toml(self.text).or_else(|_| Chain::from_dh_toml(self.text)),
        };
        Some(chain.expect("the crate's own data, which tests/robots reads"))
    }

    /// The chain between two links of the robot that the text describes.
    fn between(&self, base: &str, tip: &str) -> Result<Chain> {
        let chain = Robot::from_toml(self.text)?.chain(Some(base), Some(tip))?;
        chain.with_task(self.task.unwrap_or(chain.task()), chain.direction().clone(), Vec::new())
    }
}
