//! `--base`, `--tip`, `--task`, `--direction` and `--free`: which chain of a URDF, and what is asked of it.

use crate::derive::Ends;
use crate::kinematics::{Chain, ExactVector, Task};
use crate::number::parse_rational;
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
    /// A joint whose value is given with each target (repeatable)
    #[arg(long, value_name = "JOINT", visible_alias = "given")]
    free: Vec<String>,
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

fn direction(text: &str) -> std::result::Result<Direction, String> {
    let numbers: Option<Vec<_>> = text.split(',').map(|part| parse_rational(part.trim()).ok()).collect();
    let vector = numbers.and_then(|numbers| ExactVector::try_from(numbers).ok());
    vector.map(Direction).ok_or_else(|| "give three numbers with commas between them, such as 1,0,-1/2".to_owned())
}
