//! Walkers by name, and from a description, whose legs are derived first.

use std::path::Path;
use std::sync::Arc;

use nalgebra::Point2;

use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::gait::{Biped, GaitDefaults, LegSolver, Mirrored, Walker};
use groebot_humanoid::walkers::{self, Outline};
use groebot_ik::derive::{Description, InputFile, Options};
use groebot_robot::document::{is_stdin, shown};
use groebot_robot::model::{Meshes, Robot};
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
    /// One step goal by RH0's laws, with the parameters of the thesis' simulations (5.3)
    Rh0,
    /// One step goal by RH0's laws, with the parameters of the thesis' experiments (6.2)
    Rh0Real,
}

/// The parameters of the gait of that name; of the first one without a name.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a gait that this robot does not have.
pub fn defaults(gaits: &[(&'static str, GaitDefaults)], wanted: Option<GaitName>) -> Result<GaitDefaults> {
    let Some(wanted) = wanted else { return Ok(gaits[0].1.clone()) };
    let value = clap::ValueEnum::to_possible_value(&wanted);
    let wanted = value.as_ref().map_or("", |value| value.get_name());
    let found = gaits.iter().find(|(name, _)| *name == wanted);
    found.map(|(_, defaults)| defaults.clone()).ok_or_else(|| {
        let names = gaits.iter().map(|(name, _)| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        Error::new(ErrorKind::BadValue, format!("this robot does not have the gait `{wanted}`; give one of {names}"))
    })
}

/// The soles of a robot that is described in a file.
#[derive(clap::Args)]
pub struct SoleArguments {
    /// The link of the left sole; needed for a description
    #[arg(long, value_name = "LINK")]
    left: Option<String>,
    /// The link of the right sole; needed for a description
    #[arg(long, value_name = "LINK")]
    right: Option<String>,
    /// The contact area of the left sole in its link's frame: back, front, right, left, and optionally its height [m]
    /// (default height: 0); mirrored for the right sole
    #[arg(long, value_name = "X0,X1,Y0,Y1[,Z]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    outline: Option<Vec<f64>>,
}

impl SoleArguments {
    /// The soles that are these links.
    pub fn of_links(left: &str, right: &str) -> Self {
        SoleArguments { left: Some(left.to_owned()), right: Some(right.to_owned()), outline: None }
    }
}

/// A walking robot, as given to a command.
pub struct Named {
    /// Its description.
    pub robot: Robot,
    /// The folders of its meshes.
    pub meshes: Meshes,
    /// The walker.
    pub walker: Walker,
}

/// The robot of that name, or from a file.
///
/// # Errors
/// [`ErrorKind::UnknownName`] for what is neither a robot of this crate nor a file; [`ErrorKind::MissingKey`] without the soles' links; those of
/// the readers, of [`Biped::new`], of [`Options::derive`] and of [`Walker::new`].
pub fn named(name: &str, outline: Outline, soles: &SoleArguments, watch: &Watch) -> Result<Named> {
    match (walkers::walker(name, outline), robots::robot(name)) {
        (Some(walker), Some(robot)) => Ok(Named { robot, meshes: Meshes::default(), walker: walker? }),
        _ => described(Path::new(name), soles, watch),
    }
}

fn described(file: &Path, soles: &SoleArguments, watch: &Watch) -> Result<Named> {
    let name = file.to_string_lossy();
    if !is_stdin(file) && !file.exists() {
        let text =
            format!("`{}` is neither a file nor a walking robot; give a file, `nao`, `rh0` or `teo`", shown(&name));
        return Err(Error::new(ErrorKind::UnknownName, text));
    }
    let input = InputFile::read(file)?;
    let file = &input.path;
    let Description::Robot(robot) = input.description else {
        let text = "this does not describe a robot with links; a walk needs one, in URDF or TOML";
        return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
    };
    let at_file = |error: Error| error.in_file(file);
    let names = soles.links(&robot).map_err(at_file)?;
    let meshes = Meshes::beside(file);
    let biped = match &soles.outline {
        Some(outline) => {
            let (height, outlines) = outlines(outline)?;
            Biped::on_outlines(&robot, names, height, outlines)
        }
        None => Biped::new(&robot, names, &meshes),
    };
    let biped = biped.map_err(at_file)?;
    let leg = |name: &str| -> Result<LegSolver> {
        let chain = robot.chain(None, Some(name)).map_err(at_file)?;
        Ok(Arc::new(Options::new().watch(watch.clone()).derive(&chain)?.solver()))
    };
    let left = leg(names[0])?;
    let right: LegSolver = match Mirrored::right(&biped, &left) {
        Some(right) => Arc::new(right),
        None => leg(names[1])?,
    };
    let solvers = [left, right];
    let walker = Walker::new(&robot, biped, solvers).map_err(at_file)?;
    Ok(Named { robot, meshes, walker })
}

impl SoleArguments {
    /// The links of the soles, left and right.
    fn links(&self, robot: &Robot) -> Result<[&str; 2]> {
        match (&self.left, &self.right) {
            (Some(left), Some(right)) => Ok([left, right]),
            _ => {
                let ends = robot.suggested_tips(robot.root_place()).into_iter().take(20);
                let ends: Vec<String> = ends.map(|link| format!("`{}`", shown(link))).collect();
                let text =
                    format!("which links are the soles? give --left and --right; the limbs end in {}", ends.join(", "));
                Err(Error::new(ErrorKind::MissingKey, text))
            }
        }
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
