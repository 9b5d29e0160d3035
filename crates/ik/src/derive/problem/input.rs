//! Reader of a derivation's input, from a file or a mechanism's folder: a chain, coupled chains, a robot or a system of equations.

use std::path::{Path, PathBuf};

use crate::derive::System;
use crate::derive::coupled::CoupledChains;
use crate::derive::planner::{Choice, is_redundant, joints_to_give};
use crate::derive::problem::description::{from_toml, from_xacro, from_xml};
use crate::derive::problem::ends::{Ends, TASK_NAME, proposed};
use crate::derive::problem::formulate::formulated;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::{DescriptionText, is_stdin};
use groebot_robot::kinematics::ideal::Report;
use groebot_robot::kinematics::{Chain, DhTable, LinkPath, TipChoice};
use groebot_robot::model::{ReadOptions, xacro};
use groebot_robot::robots::{self, Listed};

pub use crate::derive::problem::description::Description;

/// The allowed names of the input in a mechanism's folder: a chain (or a DH table), a system, a URDF robot, coupled chains, a TOML robot.
pub const INPUT_NAMES: [&str; 5] = ["0_chain.toml", "0_system.toml", "0_robot.urdf", COUPLED_NAME, "0_robot.toml"];
/// The name of the description of chains that share actuators, in a mechanism's folder.
pub const COUPLED_NAME: &str = "0_coupled.toml";

/// The name of a description's file in a mechanism's folder.
fn stored_name(description: &Description, is_xml: bool) -> &'static str {
    match description {
        Description::Chain(_) => INPUT_NAMES[0],
        Description::System(_) => INPUT_NAMES[1],
        Description::Robot(_) => INPUT_NAMES[if is_xml { 2 } else { 4 }],
        Description::Coupled(_) => COUPLED_NAME,
    }
}

/// The name of a robot that is meant by `path`: a word without folder and extension that no file has.
pub fn robot_name(path: &Path) -> Option<&str> {
    let is_word = !is_stdin(path) && path.components().count() == 1 && path.extension().is_none();
    let is_free = || path.symlink_metadata().is_err();
    path.to_str().filter(|_| is_word && is_free())
}

/// The robot `name`, which no file has as its name.
///
/// # Errors
/// As [`robots::find`].
pub fn named_robot(name: &str) -> Result<&'static Listed> {
    robots::find(name)
        .map_err(|error| Error::new(error.kind(), format!("there is no such file, and {}", error.message())))
}

/// The end of a message about `folder`, if the folder has the name of a robot.
pub(crate) fn hidden_robot(folder: &Path) -> String {
    let name = folder.to_str().filter(|name| folder.components().count() == 1 && robots::find(name).is_ok());
    name.map_or(String::new(), |name| format!("; it hides the robot `{name}` by name"))
}

/// An input file and its content.
#[derive(Clone, Debug, PartialEq)]
pub struct InputFile {
    /// The path of the file.
    pub path: PathBuf,
    /// The file's name in a mechanism's folder: one of [`INPUT_NAMES`].
    pub name: &'static str,
    /// Its text.
    pub text: String,
    /// The description in the file.
    pub description: Description,
    /// The request in the folder's [`TASK_NAME`]; the default without such a file.
    pub ends: Ends,
}

impl InputFile {
    /// Reads a mechanism's folder, an input file or, as `-`, standard input. In a folder, it also reads [`TASK_NAME`]. Where there is no file, `path` may be
    /// the name of a robot in [`robots::LISTED`].
    ///
    /// Meshes and files of coupled chains that standard input names are searched from the current folder. The content decides the type:
    /// * a robot: a file `.urdf`, `.xml`, `.xacro`, `.sdf` or `.mjcf`, text that starts with `<` (URDF, xacro, MJCF or SDF), or TOML with a `[[link]]`;
    /// * coupled chains: TOML with a `[[chain]]`;
    /// * a DH table: TOML with a `[dh]`, or CSV with the columns `a` and `alpha`;
    /// * the calibration of an arm of Universal Robots: YAML with `kinematics`;
    /// * a chain: TOML with a `[tip]` or `[task]`;
    /// * a system: other TOML.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for a file that cannot be read; [`ErrorKind::UnknownName`] for a word that is neither a file nor a robot;
    /// [`ErrorKind::BadValue`] for a folder without exactly one input. [`ErrorKind::Unsupported`] for archives, JSON, YAML, tables and other files that are
    /// not descriptions. Those of [`DescriptionText::read`]; as [`xacro::expand`], [`Robot::from_xml`](groebot_robot::model::Robot::from_xml), [`CoupledChains::from_toml`],
    /// [`Chain::from_dh_toml`], [`Chain::from_toml`] and [`System::from_toml`], with file and line.
    pub fn read(path: &Path) -> Result<InputFile> {
        InputFile::read_with(path, &ReadOptions::from_environment())
    }

    /// Same as [`InputFile::read`], but with the packages and arguments of `options` for a description in [xacro], whose expansion is [`InputFile::text`].
    ///
    /// # Errors
    /// As [`InputFile::read`] and [`xacro::expand`].
    pub fn read_with(path: &Path, options: &ReadOptions) -> Result<InputFile> {
        if let Some(name) = robot_name(path) {
            return InputFile::of_robot(named_robot(name)?);
        }
        let file = if path.is_dir() { input_in(path)? } else { path.to_owned() };
        let read = DescriptionText::read(&file)?;
        let described = match read.is_xml {
            true if xacro::is_xacro(&file, &read.text) => from_xacro(&read, &file, options),
            true => from_xml(&read, &file),
            false => from_toml(&read.text, &file).map(|description| (description, read.text.clone())),
        };
        let (description, text) = described.map_err(|error| read.explain(error).in_file(&file))?;
        let ends = read_ends(&file)?;
        Ok(InputFile { path: file, name: stored_name(&description, read.is_xml), text, description, ends })
    }

    /// The description of a robot by name, as a file of this name without folder.
    ///
    /// # Errors
    /// As [`InputFile::read`].
    pub fn of_robot(listed: &Listed) -> Result<InputFile> {
        let path = PathBuf::from(listed.name());
        let description = from_toml(listed.text(), &path).map_err(|error| error.in_file(&path))?;
        let [base, tip] = listed.ends().map_or([None, None], |ends| ends.map(|link| Some(link.to_owned())));
        // A chain between links has the name of both otherwise.
        let name = listed.ends().map(|_| listed.name().to_owned());
        let ends = Ends { base, tip, task: listed.task(), name, ..Ends::default() };
        Ok(InputFile {
            name: stored_name(&description, false),
            text: listed.text().to_owned(),
            path,
            description,
            ends,
        })
    }

    /// The path between the links of a robot for `ends`, completed by the folder's task file. `None` for other descriptions.
    ///
    /// # Errors
    /// As [`Robot::path`](groebot_robot::model::Robot::path), with the file.
    pub fn path(&self, ends: &Ends) -> Result<Option<LinkPath>> {
        let Description::Robot(robot) = &self.description else { return Ok(None) };
        let ends = ends.or(&self.ends);
        robot.path(ends.base.as_deref(), ends.tip.as_deref()).map(Some).map_err(|error| error.in_file(&self.path))
    }

    /// The parts of a robot that are [ignored](groebot_robot::model::Robot::ignored) for its chain between `ends`. Empty for other inputs.
    ///
    /// # Errors
    /// As [`InputFile::path`].
    pub fn ignored(&self, ends: &Ends) -> Result<Vec<String>> {
        let Description::Robot(robot) = &self.description else { return Ok(Vec::new()) };
        Ok(self.path(ends)?.map(|path| robot.ignored(&path)).unwrap_or_default())
    }

    /// The link on a path that carries the first joint that moves.
    pub fn carrier(&self, path: Option<&LinkPath>) -> Option<String> {
        let Description::Robot(robot) = &self.description else { return None };
        path.map(|path| robot.carrier(path).to_owned())
    }

    /// The chain of this input for `ends`, completed by the folder's task file. `None` for a system and for coupled chains.
    ///
    /// # Errors
    /// As [`Robot::chain`](groebot_robot::model::Robot::chain) and [`Chain::with_task`]. [`ErrorKind::BadValue`] for end links of an input without links, and for a task of a system or of coupled
    /// chains. All name the file.
    pub fn chain(&self, ends: &Ends) -> Result<Option<Chain>> {
        let ends = ends.or(&self.ends);
        let bad = |text| Err(Error::new(ErrorKind::BadValue, text));
        let chain = match &self.description {
            Description::Robot(tree) => tree.chain(ends.base.as_deref(), ends.tip.as_deref()).map(Some),
            _ if ends.base.is_some() || ends.tip.is_some() => {
                bad("base and tip are chosen, but only a URDF has links to choose from; omit them")
            }
            Description::Chain(chain) => Ok(Some((**chain).clone())),
            Description::System(_) if ends != Ends::default() => {
                bad("a task is chosen, but a system of equations has its own; omit task, direction and given joints")
            }
            Description::Coupled(_) if ends != Ends::default() => {
                bad("a task is chosen, but each chain has its own; omit task, direction, given joints and tolerance")
            }
            Description::System(_) | Description::Coupled(_) => Ok(None),
        };
        let requested = chain.and_then(|chain| chain.map(|chain| ends.apply_to(chain)).transpose());
        requested.map_err(|error| error.in_file(&self.path))
    }
}

/// Reads the task file next to `file`, when `file` is the input of a mechanism's folder.
fn read_ends(file: &Path) -> Result<Ends> {
    let is_named = file.file_name().is_some_and(|name| INPUT_NAMES.iter().any(|known| name == *known));
    let task_file = file.with_file_name(TASK_NAME);
    if is_named && task_file.is_file() { Ends::read(&task_file) } else { Ok(Ends::default()) }
}

/// An input and its equations.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Source {
    /// The path of the input file.
    pub path: PathBuf,
    /// The file's name in a mechanism's folder: one of [`INPUT_NAMES`].
    pub name: &'static str,
    /// Its text.
    pub text: String,
    /// The chain as described, when the input describes one.
    pub chain: Option<Chain>,
    /// The ideal chain, and a report of the idealised values.
    pub ideal: Option<(Chain, Report)>,
    /// The equations. `None` for coupled chains, and for a chain whose task is only solved joint by joint.
    pub system: Option<System>,
    /// The chains, when the input describes chains that share actuators.
    pub coupled: Option<CoupledChains>,
    /// The request for the solver; may be the default.
    pub ends: Ends,
    /// The links where the chain starts and ends, when the source names them.
    pub links: Option<[String; 2]>,
    /// Notes on the parts of the source that were ignored.
    pub notes: Vec<String>,
    /// The rule that chose the link where the chain ends, when the source has links.
    pub choice: Option<TipChoice>,
    /// The link that carries the first joint that moves, when the source has links.
    pub carrier: Option<String>,
}

impl Source {
    /// Reads a mechanism's folder or an input file, as [`InputFile::read`] does, with the request of its task file. A robot without a task file gives the chain
    /// from its root to its only leaf.
    ///
    /// # Errors
    /// As [`InputFile::read`], [`InputFile::chain`] and [`formulate`](crate::derive::formulate()), with file and line.
    pub fn read(path: &Path) -> Result<Source> {
        Source::read_between(path, &Ends::default())
    }

    /// Same as [`Source::read`], but for the request `ends`, completed by the task file.
    ///
    /// # Errors
    /// As [`InputFile::read`], [`InputFile::chain`], [`Ends::ideal`] and [`formulate`](crate::derive::formulate()), with file and line.
    pub fn read_between(path: &Path, ends: &Ends) -> Result<Source> {
        Source::read_with(path, ends, &ReadOptions::from_environment())
    }

    /// Same as [`Source::read_between`], but with `options` as in [`InputFile::read_with`].
    ///
    /// # Errors
    /// As [`Source::read_between`] and [`InputFile::read_with`].
    pub fn read_with(path: &Path, ends: &Ends, options: &ReadOptions) -> Result<Source> {
        Source::of(InputFile::read_with(path, options)?, ends)
    }

    /// The source of an input for the request `ends`. If the tip was chosen among several links by its name, the request then names it.
    ///
    /// # Errors
    /// As [`InputFile::chain`], [`Ends::ideal`] and [`formulate`](crate::derive::formulate()), with file and line.
    pub fn of(input: InputFile, ends: &Ends) -> Result<Source> {
        let (chain, link_path, notes) = (input.chain(ends)?, input.path(ends)?, input.ignored(ends)?);
        let mut ends = ends.or(&input.ends);
        if let Some(LinkPath { tip, choice: TipChoice::OnlyFrame(_), .. }) = &link_path {
            ends.tip = Some(tip.clone());
        }
        let carrier = input.carrier(link_path.as_ref());
        let InputFile { path, name, text, description, .. } = input;
        let (system, coupled) = match (&chain, description) {
            (Some(_), _) => (None, None),
            (None, Description::System(system)) => (Some(system), None),
            (None, Description::Coupled(coupled)) => (None, Some(*coupled)),
            (None, _) => return Err(Error::new(ErrorKind::BadValue, "there is no chain and no system").in_file(&path)),
        };
        let choice = link_path.as_ref().map(|path| path.choice);
        let links = link_path.map(|path| [path.base, path.tip]);
        let mut source =
            Source { path, name, text, chain: None, ideal: None, system, coupled, ends, links, notes, choice, carrier };
        chain.map(|chain| source.take(chain)).transpose().map_err(|error| error.in_file(&source.path))?;
        Ok(source)
    }

    /// The source of a chain without a file, for the request `ends`.
    ///
    /// # Errors
    /// As [`Ends::ideal`] and [`formulate`](crate::derive::formulate()).
    pub fn of_chain(chain: Chain, ends: &Ends) -> Result<Source> {
        let mut source = Source {
            path: PathBuf::new(),
            name: INPUT_NAMES[0],
            text: String::new(),
            chain: None,
            ideal: None,
            system: None,
            coupled: None,
            ends: ends.clone(),
            links: None,
            notes: Vec::new(),
            choice: None,
            carrier: None,
        };
        source.take(chain)?;
        Ok(source)
    }

    /// Returns an error if the chain is too far from its base frame to be solved.
    ///
    /// # Errors
    /// As [`Chain::check_base`], with the nearest link and the file.
    pub fn check_base(&self) -> Result<()> {
        let checked = self.chain.as_ref().map_or(Ok(()), |chain| chain.check_base(self.carrier.as_deref()));
        checked.map_err(|error| error.in_file(&self.path))
    }

    /// `error`, with a warning in front if this source's DH table may use the other convention. Neighbouring axes give the evidence.
    #[must_use]
    pub fn advised(&self, error: Error) -> Error {
        match DhTable::doubt_of(&self.text) {
            Some(doubt) => Error::new(error.kind(), format!("{doubt}; {}", error.message())),
            None => error,
        }
    }

    /// Gives joint values with each target if the chain has more joints than its task determines. The planner chooses these joints.
    ///
    /// Returns the choice with its alternatives. More than one joint is chosen only with [`Ends::AUTO`].
    ///
    /// # Errors
    /// As [`Source::check_base`], [`joints_to_give`] and [`Ends::ideal`]. [`ErrorKind::PositiveDimensional`] with a proposal, if more than one joint must be
    /// given. All name the file.
    pub fn choose_given<'w>(&mut self, watch: impl Into<Option<&'w Watch>>) -> Result<Option<Choice>> {
        let watch = Watch::or_none(watch);
        self.check_base()?;
        self.give(watch).map_err(|error| self.advised(error).in_file(&self.path))
    }

    fn give(&mut self, watch: &Watch) -> Result<Option<Choice>> {
        let led = self.give_leaders()?;
        let (Some(chain), Some((ideal, _))) = (self.chain_by_steps(), &self.ideal) else { return Ok(None) };
        let is_redundant = !self.ends.chooses && chain.given().is_empty() && is_redundant(chain);
        let Some(choice) = joints_to_give(ideal, watch)? else { return Ok(led) };
        if choice.given.len() > chain.given_inputs().len() + 1 && !self.ends.chooses && !is_redundant {
            return Err(proposed(chain, &choice));
        }
        let chain = chain.with_task(chain.task(), chain.direction().clone(), choice.given.clone())?;
        self.ends.given.clone_from(&choice.given);
        self.ends.redundant = is_redundant;
        self.take(chain)?;
        Ok(Some(choice))
    }

    /// Gives the values of the leaders: joints that others follow by a law without a derived closed form. One value then moves all its followers. Does nothing
    /// if the task does not leave that many joints free.
    fn give_leaders(&mut self) -> Result<Option<Choice>> {
        let Some(chain) = self.chain_by_steps() else { return Ok(None) };
        let leaders = chain.open_leaders();
        if leaders.is_empty() || chain.independent().len() < chain.task().freedoms() + leaders.len() {
            return Ok(None);
        }
        let given = [chain.parts().given.clone(), leaders].concat();
        let chain = chain.with_task(chain.task(), chain.direction().clone(), given.clone())?;
        self.ends.given.clone_from(&given);
        self.take(chain)?;
        Ok(Some(Choice { given, candidates: Vec::new() }))
    }

    /// Stores `chain`, its ideal robot and, if its task can be solved as one system, its equations.
    fn take(&mut self, chain: Chain) -> Result<()> {
        let (ideal, report) = self.ends.ideal(&chain)?;
        self.system = formulated(if report.is_same() { &ideal } else { &chain })?;
        (self.chain, self.ideal) = (Some(chain), Some((ideal, report)));
        Ok(())
    }

    /// The names of the files that the input refers to: those of coupled chains.
    pub fn referenced_files(&self) -> impl Iterator<Item = &str> {
        self.coupled.iter().flat_map(CoupledChains::chains).filter_map(|member| member.file.as_deref())
    }

    /// The file of a derivation's folder that stores the request: its name, [`TASK_NAME`], and its text.
    pub fn task_file(&self) -> Option<(String, Vec<u8>)> {
        (self.ends != Ends::default()).then(|| (TASK_NAME.to_owned(), self.ends.to_toml().into_bytes()))
    }

    /// The chain, if it is solved joint by joint. A chain with an order of unknowns or a choice of root is solved as one system instead.
    pub(crate) fn chain_by_steps(&self) -> Option<&Chain> {
        self.chain.as_ref().filter(|chain| chain.order().is_none() && chain.choice().is_none())
    }
}

/// The only input of a folder.
fn input_in(folder: &Path) -> Result<PathBuf> {
    let present: Vec<&str> = INPUT_NAMES.into_iter().filter(|name| folder.join(name).is_file()).collect();
    match present.as_slice() {
        [file] => Ok(folder.join(file)),
        [] => {
            let text = format!(
                "this folder has no input; give a file, or add one of {}{}",
                INPUT_NAMES.map(|name| format!("`{name}`")).join(", "),
                hidden_robot(folder)
            );
            Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
        }
        [first, second, ..] => {
            let text = format!("this folder has both `{first}` and `{second}`; keep one of them");
            Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
        }
    }
}
