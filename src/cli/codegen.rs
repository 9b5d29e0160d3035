//! `groebot codegen`: the solver of a derivation as source code, or its formulas as LaTeX.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::named::CacheArguments;
use super::output::{Force, Kind, Output};
use super::solve::read_program;
use super::{Outcome, console, explain, json};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_ik::codegen::c99::Pair;
use groebot_ik::codegen::{ikfast, is_run_time, is_word, rust, single_file};
use groebot_ik::folder::PROGRAM;
use groebot_ik::solver::Program;
use groebot_robot::document::shown;
use groebot_robot::files::{MARK, write_folder_atomically};

const EXAMPLES: &str = "Examples:
  groebot codegen derivations/puma --lang c -o puma.c
  groebot codegen derivations/puma --lang c --single-file -o puma.c
  groebot codegen derivations/puma --lang c --prefix left_arm -o left_arm.c
  groebot codegen derivations/ur5 --lang ikfast -o ur5_manipulator_ikfast_solver.cpp
  groebot codegen derivations/ur5 --lang rust > src/ur5.rs
  groebot codegen derivations/ur5 --lang rust --single-file -o src/ur5.rs
  groebot codegen derivations/nao_leg_sagittal --lang latex -o leg.tex

The first comment of each file describes its use. See also docs/generated_code.md and
docs/ikfast.md.";

/// Generates the solver of a derivation as C, Rust or IKFast C++, or its formulas as LaTeX
#[derive(Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A folder that `groebot derive` wrote, or its 5_program.json, or a robot's name (`groebot robots`); for LaTeX a
    /// folder, an input file or a name
    #[arg(value_name = "DERIVATION")]
    derivation: PathBuf,
    #[command(flatten)]
    cache: CacheArguments,
    /// The language
    #[arg(long, value_name = "LANGUAGE")]
    lang: Language,
    /// The output file (default: standard output); a file that groebot did not write is not replaced. C is written as
    /// `NAME.c` with `NAME.h`, and to standard output as one file
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Use single precision: in the whole solver (c), or in the interface only (ikfast)
    #[arg(long)]
    float: bool,
    /// Include the run time in the same file (c, rust); standard output and IKFast files always include it
    #[arg(long)]
    single_file: bool,
    /// The namespace of the functions (ikfast) (default: none)
    #[arg(long, value_name = "NAME")]
    namespace: Option<String>,
    /// The prefix of all function names (c) (default: the mechanism's name)
    #[arg(long, value_name = "NAME")]
    prefix: Option<String>,
    /// Print the paths of the written files as JSON
    #[arg(long, requires = "output")]
    json: bool,
    #[command(flatten)]
    force: Force,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Language {
    /// C99: a header and a source file that need groebot.h and groebot.c, or one complete file
    C,
    /// Rust without std: one file that needs the crate `groebot-runtime`
    Rust,
    /// C++11 with the interface of IKFast, for MoveIt and OpenRAVE
    Ikfast,
    /// An article that needs only amsmath
    Latex,
}

/// Generates the code and writes it.
pub fn run(arguments: &Arguments) -> Outcome {
    arguments.refuse_idle_options()?;
    let derivation = arguments.cache.derivation(&arguments.derivation)?;
    let arguments = &Arguments { derivation: derivation.path().to_owned(), ..arguments.clone() };
    let Some(path) = &arguments.output else { return console::print(&arguments.text()?) };
    let in_two = arguments.lang == Language::C && !arguments.single_file;
    let header = if in_two { Some(header_of(path)?) } else { None };
    let output = arguments.force.output([arguments.derivation.as_path()]).expects([Some(path), header.as_ref()])?;
    match &header {
        None => output.write(path, Kind::Plain, arguments.text()?)?,
        Some(header) => {
            let Pair { header, source, .. } = arguments.pair(header)?;
            write_pair(&output, path, [header, source])?;
        }
    }
    if !arguments.json {
        return Ok(());
    }
    let files: Vec<&Path> = header.as_deref().into_iter().chain([path.as_path()]).collect();
    console::print(&json::text(&json::written(&files)))
}

/// The path of the header of a C file.
fn header_of(path: &Path) -> Result<PathBuf> {
    refuse_run_time(path)?;
    if included_as(path).is_some_and(|name| name.len() > 2 && name.ends_with(".c")) {
        return Ok(path.with_extension("h"));
    }
    let text = "give a name that ends in `.c`, without quotation marks, `\\` and `?`: its header is written beside it; without -o one \
                file that is its own header is printed";
    Err(Error::new(ErrorKind::BadValue, text).in_file(path))
}

/// Checks that a C file does not replace a file of the run time, which it includes.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the file.
pub(super) fn refuse_run_time(path: &Path) -> Result<()> {
    if !path.file_stem().and_then(|stem| stem.to_str()).is_some_and(is_run_time) {
        return Ok(());
    }
    let text = "the run time has a file of this name; give another name";
    Err(Error::new(ErrorKind::BadValue, text).in_file(path))
}

/// The name by which C includes a file, if that is possible.
fn included_as(path: &Path) -> Option<&str> {
    let can_be_included = |name: &&str| !name.contains(['"', '\\', '?']) && !name.chars().any(char::is_control);
    path.file_name().and_then(|name| name.to_str()).filter(can_be_included)
}

impl Arguments {
    /// Refuses options that have no effect in the language.
    fn refuse_idle_options(&self) -> Result<()> {
        let (c, ikfast) = (self.lang == Language::C, self.lang == Language::Ikfast);
        let idle = [
            (self.float && !c && !ikfast, "--float is for `--lang c` and `--lang ikfast`"),
            (
                self.namespace.is_some() && !ikfast,
                "--namespace is for `--lang ikfast`: C has none, and a Rust file is a module",
            ),
            (self.single_file && self.lang == Language::Latex, "--single-file is for solvers"),
            (
                self.float && c && self.output.is_some() && !self.single_file,
                "--float is for `--single-file`; compile the two files and groebot.c with -DGB_FLOAT instead",
            ),
            (self.prefix.is_some() && !c, "--prefix is for `--lang c`: the names of the other languages need none"),
        ];
        match idle.iter().find(|(is_idle, _)| *is_idle) {
            None => Ok(()),
            Some((_, text)) => Err(Error::new(ErrorKind::BadValue, *text)),
        }
    }

    /// The name of the output file, by which it includes itself.
    fn file_name(&self) -> Result<Option<&str>> {
        let Some(path) = &self.output else { return Ok(None) };
        let text = "give a name without quotation marks, `\\` and `?`: the file includes itself by it";
        included_as(path).map(Some).ok_or_else(|| Error::new(ErrorKind::BadValue, text).in_file(path))
    }

    fn text(&self) -> Result<String> {
        match self.lang {
            Language::C => {
                let program = self.program()?;
                let own = format!("{}.c", program.name);
                Ok(single_file::c(&program, self.file_name()?.unwrap_or(&own), self.float))
            }
            Language::Rust if self.single_file => self.program().map(|program| single_file::rust(&program)),
            Language::Rust => self.program().map(|program| rust::emit(&program)),
            Language::Ikfast => {
                let file = self.file_name()?.map(str::to_owned);
                let options = ikfast::Options { namespace: self.namespace.clone(), single: self.float, file };
                ikfast::emit(&self.program()?, &options).map_err(|error| error.in_file(&self.derivation))
            }
            Language::Latex => {
                let is_program = self.derivation.file_name().is_some_and(|name| name == PROGRAM);
                let folder = self.derivation.parent().filter(|_| is_program);
                let folder = folder.map(|folder| if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
                let article = explain::document(folder.unwrap_or(&self.derivation))?.to_latex();
                Ok(format!("% @{MARK} {}\n{article}", env!("CARGO_PKG_VERSION")))
            }
        }
    }

    /// The two files of C, with the header at `header`.
    fn pair(&self, header: &Path) -> Result<Pair> {
        let program = self.program()?;
        let stem = header.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Pair::new(&program, &stem))
    }

    /// The program, under the requested name.
    fn program(&self) -> Result<Program> {
        let program = read_program(&self.derivation)?;
        match &self.prefix {
            None => Ok(program),
            Some(prefix) if is_word(prefix) => Ok(Program { name: prefix.clone(), ..program }),
            Some(prefix) => {
                let text = format!("prefix `{}`: give a letter, then letters, digits and `_`", shown(prefix));
                Err(Error::new(ErrorKind::BadValue, text))
            }
        }
    }
}

/// Writes a C file and its header, both or none.
///
/// # Errors
/// As [`Output::accepts`] and [`StagedFolder::commit`].
pub(super) fn write_pair(output: &Output, source: &Path, texts: [String; 2]) -> Result<()> {
    let files = [source.with_extension("h"), source.to_owned()].into_iter().zip(texts.map(String::into_bytes));
    let files: Vec<(PathBuf, Vec<u8>)> = files.collect();
    files.iter().try_for_each(|(path, content)| output.accepts(path, content))?;
    let named = |(path, content): (PathBuf, Vec<u8>)| {
        let name = path.file_name().unwrap_or_default().to_str().map(str::to_owned);
        let text = "the name of the file is not UTF-8; give another one";
        name.map(|name| (name, content)).ok_or_else(|| Error::new(ErrorKind::BadValue, text).in_file(source))
    };
    let files: Vec<(String, Vec<u8>)> = files.into_iter().map(named).collect::<Result<_>>()?;
    let folder = source.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(Error::new(ErrorKind::Io, "there is no such folder; make it first").in_file(folder));
    }
    write_folder_atomically(folder, &files, &Watch::none())
}
