//! Walkers by name, and from a description, whose legs are derived first.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::Point2;

use super::description::DescriptionArguments;
use super::physics::whole;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::gait::{Footing, GaitDefaults, LegSolver, Walker};
use groebot_humanoid::walkers::{self, Outline};
use groebot_ik::derive::{Description, InputFile, Options};
use groebot_robot::document::{is_stdin, shown};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::{Meshes, ReadOptions, Robot};
use groebot_robot::robots;

/// The law of motion of the centre of mass.
#[derive(Clone, Copy, clap::ValueEnum)]
pub enum GaitName {
    /// The sine of NAO (6.8.1): in single support the centre of mass is at rest
    #[value(alias = "seed")]
    Sine,
    /// Preview control of the zero moment point: the centre of mass always moves
    Preview,
    /// One step goal by its generic laws: the centre of mass stays on a circle on the sole
    Osg,
    /// One step goal by RH0's laws, with parameters that keep it upright in physics
    Rh0,
    /// One step goal by RH0's laws, with the parameters of the thesis' simulations (5.3)
    Rh0Sim,
    /// One step goal by RH0's laws, with the parameters of the thesis' experiments (6.2)
    Rh0Real,
}

impl GaitName {
    /// Its name on the command line, and among the gaits of a walker.
    pub fn name(self) -> String {
        clap::ValueEnum::to_possible_value(&self).map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// The parameters of the gait of that name; of the first one without a name.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a gait that this robot does not have.
pub fn defaults(walker: &Walker, wanted: Option<GaitName>) -> Result<GaitDefaults> {
    wanted.map_or_else(|| Ok(walker.gaits[0].1.clone()), |wanted| walker.gait(&wanted.name()).cloned())
}

/// Moves the gait of that name, if one is wanted, to the front of a walker's gaits.
///
/// # Errors
/// As [`defaults`].
pub fn prefer(walker: &mut Walker, wanted: Option<GaitName>) -> Result<()> {
    if wanted.is_some() {
        let first = defaults(walker, wanted)?;
        walker.gaits.sort_by_key(|(_, gait)| *gait != first);
    }
    Ok(())
}

/// The soles of a robot that is described in a file.
#[derive(clap::Args)]
pub struct SoleArguments {
    /// The link of the left sole [default: searched, the end of one of the two lowest mirrored limbs]
    #[arg(long, value_name = "LINK")]
    left: Option<String>,
    /// The link of the right sole [default: searched]
    #[arg(long, value_name = "LINK")]
    right: Option<String>,
    /// The contact area of the left sole from its link's origin, in the axes of the torso: back, front, right, left,
    /// and optionally its height [m] (default height: 0); mirrored for the right sole [default: the lowest points of
    /// its shapes]
    #[arg(long, value_name = "X0,X1,Y0,Y1[,Z]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    outline: Option<Vec<f64>>,
    #[command(flatten)]
    described: DescriptionArguments,
}

/// A walking robot, as given to a command.
pub struct Named {
    /// Its description, as the walker plans with it: its root link is the torso.
    pub robot: Robot,
    /// The folders of its meshes.
    pub meshes: Meshes,
    /// The walker.
    pub walker: Walker,
    /// What a simulation moves.
    pub shod: Shod,
}

/// A robot with the collision shapes of its soles.
pub struct Shod {
    /// The robot as described.
    pub robot: Robot,
    /// The links of its soles, left and right.
    pub soles: [String; 2],
}

/// The robot of that name, or from a file.
///
/// # Errors
/// As [`Described::read`] and [`Described::walker`].
pub fn named(name: &str, outline: Outline, soles: &SoleArguments, watch: &Watch) -> Result<Named> {
    Described::read(name, soles)?.walker(outline, soles, watch)
}

/// A description that was read, of a robot that may walk.
pub struct Described {
    /// The robot as described.
    pub robot: Robot,
    /// The folders of its meshes.
    pub meshes: Meshes,
    source: Source,
}

/// The source of a description.
enum Source {
    /// A robot of groebot, by its name.
    Name(String),
    File(PathBuf),
}

impl Described {
    /// The robot of that name, or of a file.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for what is neither a robot of groebot nor a file; those of the readers.
    pub fn read(name: &str, soles: &SoleArguments) -> Result<Self> {
        if let Some(robot) = robots::robot(name) {
            return Ok(Described { robot, meshes: Meshes::default(), source: Source::Name(name.to_owned()) });
        }
        let file = Path::new(name);
        if !is_stdin(file) && !file.exists() {
            return Err(neither(name));
        }
        let input = InputFile::read_with(file, &soles.options())?;
        let Description::Robot(robot) = input.description else {
            let text = "this does not describe a robot with links; a walk needs one, in URDF, xacro, MJCF, SDF or TOML";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(&input.path));
        };
        // MuJoCo reads meshes from another folder.
        let meshes = Meshes::beside_with(&whole(&input.path), soles.options());
        Ok(Described { robot, meshes, source: Source::File(input.path) })
    }

    /// Its walker. The legs of a description are derived.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a robot of groebot that does not walk; those of [`Footing::find`],
    /// [`Footing::walker`] and [`Options::derive`].
    pub(super) fn walker(self, outline: Outline, soles: &SoleArguments, watch: &Watch) -> Result<Named> {
        let Described { robot, meshes, source } = self;
        let file = match source {
            Source::Name(name) => {
                let walker = walkers::walker(&name, outline).ok_or_else(|| neither(&name))??;
                let shod = with_soles(robot.clone(), &meshes, soles)?;
                return Ok(Named { robot, meshes, walker, shod });
            }
            Source::File(file) => file,
        };
        let at_file = |error: Error| error.in_file(&file);
        let footing = soles.footing(&robot, &meshes).map_err(at_file)?;
        let leg = |chain: &Chain| -> Result<LegSolver> {
            Ok(Arc::new(Options::new().watch(watch.clone()).derive(chain)?.solver()))
        };
        let walker = footing.walker(leg).map_err(at_file)?;
        let shod = shod(&footing, &robot).map_err(at_file)?;
        let notes = footing.notes().to_vec();
        Ok(Named { robot: footing.robot().clone().with_notes(notes), meshes, walker, shod })
    }
}

fn neither(name: &str) -> Error {
    let text = format!("`{}` is neither a file nor a walking robot; give a file, `nao`, `rh0` or `teo`", shown(name));
    Error::new(ErrorKind::UnknownName, text)
}

/// The robot with the collision shapes of its soles. The soles of a robot of groebot are `l_sole` and `r_sole`.
///
/// # Errors
/// Those of [`Footing::find`] and [`Footing::shod`].
pub fn with_soles(robot: Robot, meshes: &Meshes, soles: &SoleArguments) -> Result<Shod> {
    let own = ["l_sole", "r_sole"];
    let is_known = robots::robot(robot.name()).is_some() && own.iter().all(|link| robot.link(link).is_ok());
    if is_known && !soles.is_given() {
        return Ok(Shod { robot, soles: own.map(str::to_owned) });
    }
    shod(&soles.footing(&robot, meshes)?, &robot)
}

fn shod(footing: &Footing, robot: &Robot) -> Result<Shod> {
    let robot = footing.shod(robot)?.with_notes(footing.notes().to_vec());
    Ok(Shod { robot, soles: footing.soles().map(str::to_owned) })
}

impl SoleArguments {
    /// The options for the reader of the description.
    pub fn options(&self) -> ReadOptions {
        self.described.options()
    }

    /// Whether an option is given.
    pub fn is_given(&self) -> bool {
        self.left.is_some() || self.right.is_some() || self.outline.is_some()
    }

    fn footing(&self, robot: &Robot, meshes: &Meshes) -> Result<Footing> {
        let outline = self.outline.as_deref().map(outlines).transpose()?;
        Footing::find(robot, meshes, [self.left.as_deref(), self.right.as_deref()], outline)
    }
}

/// The height and the corners of both soles.
fn outlines(outline: &[f64]) -> Result<(f64, [Vec<Point2<f64>>; 2])> {
    let (back, front, right, left, height) = match *outline {
        [back, front, right, left] => (back, front, right, left, 0.0),
        [back, front, right, left, height] => (back, front, right, left, height),
        _ => {
            let text = "--outline takes four or five numbers: back, front, right, left, height, such as -0.1,0.12,-0.06,0.06,-0.1";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
    };
    if !(back < front && right < left) {
        let text = format!("--outline is {back},{front},{right},{left}; give the lower number of each pair first");
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    let corners = |right: f64, left: f64| {
        [(back, right), (front, right), (front, left), (back, left)].map(|(x, y)| Point2::new(x, y)).to_vec()
    };
    Ok((height, [corners(right, left), corners(-left, -right)]))
}
