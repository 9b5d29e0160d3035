//! `--base`, `--tip`, `--task`, `--direction`, `--free` and `--snap`: which chain of a URDF, and what is asked of it.

use crate::derive::Ends;
use crate::kinematics::{Chain, ExactVector, Task};
use crate::number::{BigRational, parse_rational};
use crate::{Error, ErrorKind, Result};

/// The tasks that need no plane.
const TASKS: [Task; 5] = [Task::Pose, Task::Position, Task::Ray, Task::Direction, Task::Rotation];

/// The links between which a chain is wanted, and its task.
#[derive(clap::Args)]
pub struct EndArguments {
    /// URDF: the link where the chain starts (default: the root)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// URDF: the link where the chain ends (default: the only leaf)
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// What is asked of the tip: pose, position, ray, direction or rotation (default: as described; of a URDF, pose)
    #[arg(long, value_name = "TASK", value_parser = task)]
    task: Option<Task>,
    /// The direction in the tip frame that `ray` and `direction` aim, such as 1,0,0 (default: z)
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    direction: Option<Direction>,
    /// A joint whose value is given with each target (repeatable; default: as described, else one of the planner's choice where the
    /// task leaves one joint too many)
    #[arg(long, value_name = "JOINT", visible_alias = "given")]
    free: Vec<String>,
}

/// Whether the ideal robot is meant.
#[derive(clap::Args)]
pub struct SnapArgument {
    /// Take the ideal robot within this tolerance (radians, and metres), such as 1e-5: axes that almost meet do
    #[arg(long, value_name = "TOLERANCE", value_parser = exact)]
    snap: Option<BigRational>,
}

impl SnapArgument {
    /// What `arguments` ask, of the ideal robot.
    pub fn ends(&self, arguments: &EndArguments) -> Ends {
        Ends { snap: self.snap.clone(), ..arguments.ends() }
    }
}

/// Three exact numbers, as one value of an option.
#[derive(Clone)]
struct Direction(ExactVector);

impl EndArguments {
    /// The same as plain data.
    pub fn ends(&self) -> Ends {
        Ends {
            base: self.base.clone(),
            tip: self.tip.clone(),
            task: self.task,
            direction: self.direction.as_ref().map(|direction| direction.0.clone()),
            given: self.free.clone(),
            snap: None,
        }
    }

    /// `chain`, which is no URDF's, for the task that is asked.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for links; as [`Ends::ask`].
    pub fn ask(&self, chain: Chain) -> Result<Chain> {
        if self.base.is_some() || self.tip.is_some() {
            let text = "base and tip are chosen, but only a URDF has links to choose from; leave them out";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        self.ends().ask(chain)
    }
}

fn task(text: &str) -> std::result::Result<Task, String> {
    let names = TASKS.map(Task::name).join(", ");
    TASKS.into_iter().find(|task| task.name() == text).ok_or_else(|| format!("give one of {names}"))
}

fn exact(text: &str) -> std::result::Result<BigRational, String> {
    parse_rational(text.trim()).map_err(|error| error.message().to_owned())
}

fn direction(text: &str) -> std::result::Result<Direction, String> {
    let numbers: Option<Vec<_>> = text.split(',').map(|part| parse_rational(part.trim()).ok()).collect();
    let vector = numbers.and_then(|numbers| ExactVector::try_from(numbers).ok());
    vector.map(Direction).ok_or_else(|| "give three numbers with commas between them, such as 1,0,-1/2".to_owned())
}
