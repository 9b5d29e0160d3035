//! `groebot export`: a motion as an animated scene, or a robot in another format.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::named::is_chain;
use super::output::{Force, Kind};
use super::walker::{self, SoleArguments};
use super::{Outcome, console, json, moving};
use crate::{Error, ErrorKind, Result};
use groebot_humanoid::sim::export::Scene;
use groebot_robot::document::{TEXT_LIMIT, read_text, shown};
use groebot_robot::model::Robot;

const EXAMPLES: &str = "Examples:
  groebot export walk.csv --to glb -o walk.glb
  groebot export walk.json --to x3d -o walk.x3d
  groebot export walk.csv --robot talos.urdf --meshes --to glb -o walk.glb
  groebot export nao --to wrl -o nao.wrl
  groebot export arm.wrl --to glb -o arm.glb
  groebot export nao_v5 --to mjcf -o nao.xml
  groebot export robot.toml --to urdf -o robot.urdf
  groebot export panda.xml --to sdf -o panda.sdf
  groebot export jvrc1.urdf --to mjcf --outline=-0.1,0.13,-0.06,0.06,-0.1 -o jvrc1.xml

Robots of groebot: nao_v5, rh0, teo. A walk, a path of an arm or a recording becomes an animated
scene with one node per link, y up, in metres. VRML is read with the nodes of RH0 Fig. 5-4 only.

In MJCF the root moves freely above a floor and every joint has a position servo. Only the floor has
contacts. The root is fixed if its link is called `world`, or if the robot is an arm, a hand or a leg by name. Meshes are referred to by their files; text meshes, which MuJoCo does not read, are
written anew. With --outline the soles are boxes, as in `walk`.";

/// A format of robots or scenes.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Animated scene: binary glTF 2.0
    Glb,
    /// Animated scene: X3D 4.0 in XML
    X3d,
    /// Animated scene: VRML97
    Wrl,
    /// Robot description for ROS
    Urdf,
    /// Robot description for MuJoCo
    Mjcf,
    /// Robot description for Gazebo
    Sdf,
}

/// The motion of a robot's root in MJCF.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Root {
    /// It moves freely
    Free,
    /// It is fixed in the world
    Fixed,
}

/// Exports a motion as an animated scene, or a robot, with masses, shapes, limits and actuators, in another format
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A motion in CSV or JSON, a robot by name, a description in URDF, MJCF, SDF or TOML, or VRML
    #[arg(value_name = "MOTION-or-ROBOT-or-FILE")]
    input: PathBuf,
    /// The output format
    #[arg(long, visible_alias = "format", value_enum)]
    to: Format,
    /// The moving robot, if the motion does not name a robot of groebot
    #[arg(long, value_name = "ROBOT-or-FILE")]
    robot: Option<PathBuf>,
    /// MJCF: the motion of the root link [default: fixed for a link called `world` and for arms, hands and legs by name, else free]
    #[arg(long, value_enum)]
    root: Option<Root>,
    #[command(flatten)]
    soles: SoleArguments,
    /// Include the triangles of STL meshes in the scene
    #[arg(long)]
    meshes: bool,
    /// The output file (default: standard output)
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the path of the written file as JSON, with notes about parts that are not exported
    #[arg(long, requires = "out")]
    json: bool,
    #[command(flatten)]
    force: Force,
}

/// Writes the robot or the scene.
pub fn run(arguments: &Arguments) -> Outcome {
    let read = [Some(&arguments.input), arguments.robot.as_ref()];
    let output =
        arguments.force.output(read.into_iter().flatten().map(PathBuf::as_path)).expects([arguments.out.as_ref()])?;
    let mut omissions = Omissions::default();
    let bytes = match arguments.to {
        Format::Urdf | Format::Mjcf | Format::Sdf => arguments.robot(&mut omissions)?.into_bytes(),
        Format::Glb if arguments.out.is_none() => {
            return Err(refused("a glb is binary; give its file by -o").into());
        }
        Format::Glb => arguments.scene(&mut omissions)?.to_glb()?,
        Format::X3d => arguments.scene(&mut omissions)?.to_x3d()?.into_bytes(),
        Format::Wrl => arguments.scene(&mut omissions)?.to_wrl()?.into_bytes(),
    };
    if !arguments.json {
        omissions.print();
    }
    match &arguments.out {
        Some(file) => output.write(file, arguments.to.kind(), &bytes)?,
        None => console::print(&String::from_utf8_lossy(&bytes))?,
    }
    match arguments.out.as_ref().filter(|_| arguments.json) {
        Some(file) => console::print(&json::text(&omissions.json(file))),
        None => Ok(()),
    }
}

/// Parts that are not exported.
#[derive(Default)]
struct Omissions {
    /// Those of the description that were not read.
    notes: Vec<String>,
    /// Those that the format does not have.
    warnings: Vec<String>,
}

impl Omissions {
    /// Adds those of the links of `robot`.
    fn add(&mut self, robot: &Robot) {
        let notes = robot.links().iter().flat_map(|link| link.notes.iter().map(|note| (shown(&link.name), note)));
        self.notes.extend(notes.map(|(link, note)| format!("link `{link}`: {note}")));
    }

    fn print(&self) {
        console::print_notes(&self.notes);
        self.warnings.iter().for_each(|note| console::line("warning", note));
    }

    fn json(&self, file: &Path) -> Value {
        let mut value = json::written(&[file]);
        value["notes"] = self.notes.as_slice().into();
        value["warnings"] = self.warnings.as_slice().into();
        value
    }
}

impl Format {
    fn kind(self) -> Kind {
        match self {
            Format::Glb => Kind::Plain,
            Format::Wrl => Kind::Vrml,
            Format::X3d | Format::Urdf | Format::Mjcf | Format::Sdf => Kind::Markup,
        }
    }
}

fn refused(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}

impl Arguments {
    /// The robot in a format without motion.
    fn robot(&self, omissions: &mut Omissions) -> Result<String> {
        if ["csv", "json", "wrl"].iter().any(|end| moving::ends(&self.input, end)) {
            let text =
                "urdf, mjcf and sdf describe a robot, not a motion or a scene; give --to glb, x3d or wrl, or a robot";
            return Err(refused(text).in_file(&self.input));
        }
        if self.robot.is_some() || self.meshes {
            return Err(refused(
                "--robot and --meshes are for motions and scenes; leave them out for urdf, mjcf and sdf",
            ));
        }
        let (robot, meshes) = moving::described(&self.input, &self.soles.options())?;
        robot.check().map_err(|error| error.in_file(&self.input))?;
        let robot = if self.soles.is_given() { walker::with_soles(robot, &meshes, &self.soles)?.robot } else { robot };
        omissions.add(&robot);
        if self.to == Format::Mjcf {
            let text = match self.root_of(&robot) {
                Root::Free => robot.to_mjcf(&meshes, &mut omissions.warnings),
                Root::Fixed => robot.to_mjcf_fixed(&meshes, &mut omissions.warnings),
            };
            return text.map_err(|error| error.in_file(&self.input));
        }
        if self.root.is_some() {
            return Err(refused("--root is for mjcf; leave it out"));
        }
        if self.to == Format::Sdf {
            let text = robot.to_sdf(&mut omissions.warnings).map_err(|error| error.in_file(&self.input))?;
            return self.reread(text, |text| Robot::from_sdf(text, None));
        }
        self.reread(robot.to_urdf(), Robot::from_urdf)
    }

    /// The motion of the root of `robot`.
    fn root_of(&self, robot: &Robot) -> Root {
        let is_fixed = robot.root() == "world" || is_chain(&self.input);
        self.root.unwrap_or(if is_fixed { Root::Fixed } else { Root::Free })
    }

    /// `text` if it is read back as a robot without faults.
    fn reread(&self, text: String, read: impl Fn(&str) -> Result<Robot>) -> Result<String> {
        let again = read(&text).and_then(|again| again.check());
        again.map_err(|error| error.with_context("what is written cannot be read back").in_file(&self.input))?;
        Ok(text)
    }

    fn scene(&self, omissions: &mut Omissions) -> Result<Scene> {
        let file = &self.input;
        if self.root.is_some() {
            return Err(refused("--root is for mjcf; leave it out").in_file(file));
        }
        if self.soles.is_given() {
            let text =
                "--left, --right and --outline are for urdf, mjcf and sdf, where they replace the shapes of the soles";
            return Err(refused(text).in_file(file));
        }
        let motion = moving::motion(file)?.map(|motion| motion.trajectory);
        if motion.is_none() && self.robot.is_some() {
            let text = "--robot names the robot that moves, but this is not a motion; give one in CSV or JSON, or leave it out";
            return Err(refused(text).in_file(file));
        }
        if moving::ends(file, "wrl") {
            return Scene::from_vrml(&read_text(file, TEXT_LIMIT)?).map_err(|error| error.in_file(file));
        }
        let options = &self.soles.options();
        let (robot, meshes) = match &motion {
            Some(motion) => {
                moving::robot_of(motion, self.robot.as_deref(), options).map_err(|error| error.in_file(file))?
            }
            None => moving::described(file, options)?,
        };
        omissions.add(&robot);
        let scene = Scene::of_robot(&robot, self.meshes.then_some(&meshes), motion.as_ref());
        let scene = scene.map_err(|error| error.in_file(file))?;
        omissions.warnings.extend_from_slice(&scene.notes);
        Ok(scene)
    }
}
