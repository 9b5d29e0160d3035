//! `--base`, `--tip`, `--task`, `--plane`, `--axis`, `--direction`, `--given`, `--snap` and `--exact`: the chain of a
//! URDF, and its task; `--package` and `--arg`.

use serde::Serialize;

use super::description::DescriptionArguments;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, parse_rational};
use groebot_ik::derive::report::explain::{Line, Part};
use groebot_ik::derive::{Ends, Source};
use groebot_robot::document::shown;
use groebot_robot::kinematics::{BaseAxis, ExactVector, LinkPath, Plane, Task, TipChoice};
use groebot_robot::model::ReadOptions;

/// The tasks without a plane or an axis.
const TASKS: [Task; 6] =
    [Task::Pose, Task::Position, Task::Ray, Task::Direction, Task::Rotation, Task::PositionPitchRoll];
/// The tasks with a plane.
const PLANAR: [fn(Plane) -> Task; 2] = [|plane| Task::PlanarPosition { plane }, |plane| Task::PlanarPose { plane }];
/// The tasks with the angle about an axis.
const ABOUT: [fn(BaseAxis) -> Task; 1] = [|axis| Task::PositionYaw { axis }];
/// The planes.
const PLANES: [Plane; 3] = [Plane::Xy, Plane::Xz, Plane::Yz];

/// The first and the last link of the chain, and its task.
#[derive(clap::Args)]
pub struct EndArguments {
    /// Of a robot: the first link of the chain (default: the root)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// Of a robot: the last link of the chain (default: the only leaf link, else the only one named tool0, flange, tcp or
    /// ee_link, in that order)
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// The task of the tip: pose, position, ray, direction, rotation, position_pitch_roll, position_yaw,
    /// planar_position or planar_pose (default: as described; for a robot, pose)
    #[arg(long, value_name = "TASK", value_parser = task)]
    task: Option<RequestedTask>,
    /// The plane of the base frame in which a planar task moves: xy, xz or yz
    #[arg(long, value_name = "PLANE", value_parser = plane)]
    plane: Option<Plane>,
    /// The axis of the base frame for the angle of `position_yaw`: x, y or z (default: z)
    #[arg(long, value_name = "AXIS", value_parser = axis)]
    axis: Option<BaseAxis>,
    /// The direction in the tip frame for `ray`, `direction` and `position_yaw`, such as 1,0,0 (default: z; for
    /// `position_yaw` x, whose angle about z is counted from x)
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    direction: Option<Direction>,
    /// A joint whose value is given with each target (repeatable); `auto`: the planner chooses all redundant joints
    /// (default: as described, else none: of a chain with one redundant joint, `derive` makes the solvers with each
    /// joint given, which find all arcs of solutions; with two to four, it also scans the ranges of up to three joints)
    #[arg(long, value_name = "JOINT", alias = "free")]
    given: Vec<String>,
    #[command(flatten)]
    described: DescriptionArguments,
}

/// The options of [`EndArguments`], and the idealisation.
#[derive(clap::Args)]
pub struct IdealEndArguments {
    #[command(flatten)]
    plain: EndArguments,
    /// Use the ideal robot within this tolerance, in radians and fractions of the reach: nearly intersecting axes then
    /// intersect (default: 1e-6)
    #[arg(long, value_name = "TOLERANCE", value_parser = number, conflicts_with = "exact")]
    snap: Option<BigRational>,
    /// Use every digit of the description: axes at a distance of 1e-17 do not intersect
    #[arg(long)]
    exact: bool,
}

impl IdealEndArguments {
    /// The options for the reader of the description.
    pub fn options(&self) -> ReadOptions {
        self.plain.options()
    }

    /// Converts the options to plain data.
    ///
    /// # Errors
    /// As [`EndArguments::ends`].
    pub fn ends(&self) -> Result<Ends> {
        let snap = if self.exact { Some(BigRational::default()) } else { self.snap.clone() };
        Ok(Ends { snap, ..self.plain.ends()? })
    }
}

/// The last link of a robot's chain, and how it was chosen.
#[derive(Serialize)]
pub struct TipLink {
    name: String,
    chosen_by: String,
    #[serde(skip)]
    is_given: bool,
}

impl TipLink {
    /// The last link of a path.
    pub fn of_path(path: &LinkPath) -> Self {
        TipLink::new(&path.tip, path.choice)
    }

    /// The last link of a source with links.
    pub fn of_source(source: &Source) -> Option<Self> {
        Some(TipLink::new(&source.links.as_ref()?[1], source.choice?))
    }

    fn new(name: &str, choice: TipChoice) -> Self {
        TipLink { name: name.to_owned(), chosen_by: choice.to_string(), is_given: choice == TipChoice::Given }
    }

    /// One sentence if it was chosen by default.
    pub fn note(&self) -> Option<String> {
        let text = || format!("tip link `{}`: {}; --tip chooses another", shown(&self.name), self.chosen_by);
        (!self.is_given).then(text)
    }

    /// The sentence as a paragraph of a report.
    pub fn paragraph(&self) -> Option<Part> {
        let line = || Line::of("Tip link ").name(&self.name).and(&format!(": {}; ", self.chosen_by));
        (!self.is_given).then(|| Part::Paragraph(line().name("--tip").and(" chooses another.")))
    }

    /// The sentence as a separate line.
    pub fn line(tip: Option<&TipLink>) -> String {
        tip.and_then(TipLink::note).map(|note| note + "\n").unwrap_or_default()
    }
}

/// A task, or one that needs a plane, or an axis.
#[derive(Clone, Copy)]
enum RequestedTask {
    Spatial(Task),
    Planar(fn(Plane) -> Task),
    About(fn(BaseAxis) -> Task),
}

/// Three exact numbers, as one value of an option.
#[derive(Clone)]
struct Direction(ExactVector);

impl EndArguments {
    /// The options for the reader of the description.
    pub fn options(&self) -> ReadOptions {
        self.described.options()
    }

    /// Converts the options to plain data.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] for a planar task without a plane; [`ErrorKind::BadValue`] for a plane or an axis
    /// without a task that has one.
    pub fn ends(&self) -> Result<Ends> {
        Ok(Ends {
            base: self.base.clone(),
            tip: self.tip.clone(),
            task: self.task()?,
            direction: self.direction.as_ref().map(|direction| direction.0.clone()),
            given: self.given.iter().filter(|joint| *joint != Ends::AUTO).cloned().collect(),
            chooses: self.given.iter().any(|joint| joint == Ends::AUTO),
            redundant: false,
            name: None,
            snap: None,
        })
    }

    fn task(&self) -> Result<Option<Task>> {
        if self.axis.is_some() && !matches!(self.task, Some(RequestedTask::About(_))) {
            let text = "--axis belongs to the task position_yaw; give --task position_yaw, or leave it out";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        match (self.task, self.plane) {
            (Some(RequestedTask::About(task)), None) => Ok(Some(task(self.axis.unwrap_or(BaseAxis::Z)))),
            (Some(RequestedTask::Planar(task)), Some(plane)) => Ok(Some(task(plane))),
            (Some(RequestedTask::Planar(_)), None) => {
                let text = "a planar task moves in a plane of the base frame; give it by --plane xy, xz or yz";
                Err(Error::new(ErrorKind::MissingKey, text))
            }
            (_, Some(_)) => {
                let text =
                    "--plane belongs to a planar task; give --task planar_position or planar_pose, or leave it out";
                Err(Error::new(ErrorKind::BadValue, text))
            }
            (Some(RequestedTask::Spatial(task)), None) => Ok(Some(task)),
            (None, None) => Ok(None),
        }
    }
}

fn task(text: &str) -> std::result::Result<RequestedTask, String> {
    let spatial = TASKS.into_iter().map(|task| (task.name(), RequestedTask::Spatial(task)));
    let planar = PLANAR.into_iter().map(|task| (task(Plane::Xy).name(), RequestedTask::Planar(task)));
    let about = ABOUT.into_iter().map(|task| (task(BaseAxis::Z).name(), RequestedTask::About(task)));
    let known: Vec<_> = spatial.chain(about).chain(planar).collect();
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let found = known.iter().find(|(name, _)| *name == text).map(|(_, task)| *task);
    found.ok_or_else(|| format!("give one of {}", names.join(", ")))
}

fn plane(text: &str) -> std::result::Result<Plane, String> {
    PLANES.into_iter().find(|plane| plane.name() == text).ok_or_else(|| "give xy, xz or yz".to_owned())
}

fn axis(text: &str) -> std::result::Result<BaseAxis, String> {
    BaseAxis::ALL.into_iter().find(|axis| axis.name() == text).ok_or_else(|| "give x, y or z".to_owned())
}

fn number(text: &str) -> std::result::Result<BigRational, String> {
    parse_rational(text.trim()).map_err(|error| error.message().to_owned())
}

fn direction(text: &str) -> std::result::Result<Direction, String> {
    let numbers: Option<Vec<_>> = text.split(',').map(|part| parse_rational(part.trim()).ok()).collect();
    let vector = numbers.and_then(|numbers| ExactVector::try_from(numbers).ok());
    vector.map(Direction).ok_or_else(|| "give three numbers separated by commas, such as 1,0,-1/2".to_owned())
}
