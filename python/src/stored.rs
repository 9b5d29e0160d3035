//! A solver with its description, and its file format. Main type: [`Stored`].

use std::path::Path;
use std::sync::{Arc, OnceLock};

use groebot::derive::{Derivation, Source};
use groebot::document::read_text;
use groebot::folder::{self, PROGRAM, SolverCache};
use groebot::kinematics::Chain;
use groebot::robots;
use groebot::solver::redundant::{RedundantSolver, ScanningSolver};
use groebot::solver::{self, Condition, Placement, Program, TaskPlacement};
use groebot::{Error, ErrorKind, Result, Watch};
use serde_json::{Value, json};

use crate::arrays::TargetShape;
use crate::compiled::Compiled;
use crate::kernel::{Interpreted, Kernel};
use crate::known;
use crate::origin::{CERTIFICATE, Origin};

/// Maximum length of a stored solver and of a stored proof \[bytes\].
const LIMIT: u64 = 256_000_000;
/// The version number of the format of a stored solver.
const FORMAT: u32 = 1;

/// A derived solver.
pub struct Stored {
    pub program: Program,
    pub kernel: Arc<dyn Kernel>,
    /// Whether it is generated code that was compiled.
    pub is_printed: bool,
    /// The chain of the description, if it is derived from one.
    pub chain: Option<Chain>,
    pub origin: Option<Origin>,
    /// The text of the stored proof.
    certificate: Option<String>,
    proved: OnceLock<Arc<Derivation>>,
    pub target_shape: TargetShape,
    /// Where base and tool are.
    pub placement: Option<TaskPlacement>,
    /// The solver of the library, prepared at its first use.
    library: OnceLock<solver::Solver>,
    /// The redundant solver, prepared at its first use.
    arm: OnceLock<Option<RedundantSolver>>,
    /// The solver with scanned joints, prepared at its first use.
    scan: OnceLock<Option<ScanningSolver>>,
}

impl Stored {
    fn new(program: Program, chain: Option<Chain>, origin: Option<Origin>, certificate: Option<String>) -> Self {
        let printed = known::by_name(&program.name)
            .filter(|known| Program::from_json(known.program).is_ok_and(|printed| printed == program));
        let kernel: Arc<dyn Kernel> = match printed {
            Some(known) => Arc::new(Compiled::new((known.code)(), &program)),
            None => Arc::new(Interpreted::new(&program)),
        };
        let target_shape = target_shape(&program);
        let is_printed = printed.is_some();
        Stored {
            program,
            kernel,
            is_printed,
            chain,
            origin,
            certificate,
            proved: OnceLock::new(),
            target_shape,
            placement: None,
            library: OnceLock::new(),
            arm: OnceLock::new(),
            scan: OnceLock::new(),
        }
    }

    /// The same solver for targets of a tool in a world frame.
    ///
    /// # Errors
    /// As [`TaskPlacement::new`].
    pub fn placed(&self, placement: &Placement) -> Result<Self> {
        let placement = Some(TaskPlacement::new(&self.program, placement)?);
        let (program, kernel) = (self.program.clone(), Arc::clone(&self.kernel));
        let (chain, origin) = (self.chain.clone(), self.origin.clone());
        let (is_printed, target_shape) = (self.is_printed, self.target_shape);
        Ok(Stored {
            program,
            kernel,
            is_printed,
            chain,
            origin,
            certificate: None,
            proved: OnceLock::new(),
            target_shape,
            placement,
            library: OnceLock::new(),
            arm: OnceLock::new(),
            scan: OnceLock::new(),
        })
    }

    /// The solver of the library for this program.
    pub fn library(&self) -> &solver::Solver {
        self.library.get_or_init(|| self.program.solver())
    }

    /// The redundant solver; `None` for a solver that is not redundant, or with scanned joints.
    pub fn arm(&self) -> Option<&RedundantSolver> {
        self.arm.get_or_init(|| self.program.redundant_solver()).as_ref()
    }

    /// The solver with scanned joints; `None` for a solver without them.
    pub fn scan(&self) -> Option<&ScanningSolver> {
        self.scan.get_or_init(|| self.program.scanning_solver()).as_ref()
    }

    /// The names of the scanned joints.
    pub fn scanned(&self) -> Vec<&str> {
        let scanned = self.program.redundancy.as_deref().map(|redundancy| redundancy.scanned()).unwrap_or_default();
        scanned.into_iter().map(|joint| self.program.joints[joint].name.as_str()).collect()
    }

    /// Returns the solver of a robot by name, from the user's cache. Where that cannot be written, the solver is derived at each call.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with similar names; as [`SolverCache::derivation`].
    pub fn cached(name: &str, watch: &Watch) -> Result<Self> {
        let robot = robots::find(name)?;
        if let Ok(cache) = SolverCache::of_user().and_then(|cache| cache.check(robot).map(|()| cache)) {
            return Stored::load(&cache.derivation(robot, watch)?);
        }
        let folder = tempfile::tempdir().map_err(|error| Error::io(&std::env::temp_dir(), &error))?;
        Stored::load(&SolverCache::new(folder.path()).derivation(robot, watch)?)
    }

    /// Returns a solver of the wheel.
    ///
    /// # Errors
    /// None: the wheel's own data.
    pub fn known(known: &known::Known) -> Result<Self> {
        let origin = Origin::of("0_chain.toml", known.chain);
        let chain = Chain::from_toml(known.chain).or_else(|_| Chain::from_dh_toml(known.chain))?;
        Ok(Stored::new(Program::from_json(known.program)?, Some(chain), Some(origin), None))
    }

    /// Builds the solver of a derivation.
    pub fn derived(source: &Source, proved: Derivation) -> Result<Self> {
        let origin = Origin::of_source(source)?;
        let stored = Stored::new(proved.program().clone(), source.chain.clone(), Some(origin), None);
        let _ = stored.proved.set(Arc::new(proved));
        Ok(stored)
    }

    /// Reads the folder of a derivation, its program, or a file that [`Stored::to_json`] wrote. The program of a thin folder is the one that its certificate
    /// proves.
    ///
    /// # Errors
    /// As [`folder::program`], [`read_text`] and [`Program::from_json`], with the file; [`ErrorKind::Unsupported`] for another version.
    pub fn load(path: &Path) -> Result<Self> {
        let is_folder = path.is_dir();
        let file = if is_folder { path.join(PROGRAM) } else { path.to_owned() };
        if is_folder && !file.exists() {
            let program = folder::program(path)?;
            let source = Source::read(path)?;
            let certificate = read_text(&path.join(CERTIFICATE), LIMIT).ok();
            return Ok(Stored::new(program, source.chain.clone(), Origin::of_source(&source).ok(), certificate));
        }
        let stored = Stored::from_json(&read_text(&file, LIMIT)?).map_err(|error| error.in_file(&file))?;
        let folder = file.parent().filter(|_| file.file_name().is_some_and(|name| name == PROGRAM));
        let Some(folder) = folder else { return Ok(stored) };
        // A program without its description can also be solved.
        let Ok(source) = Source::read(folder) else { return Ok(stored) };
        let certificate = read_text(&folder.join(CERTIFICATE), LIMIT).ok();
        let origin = Origin::of_source(&source).ok();
        Ok(Stored::new(stored.program, source.chain, origin, certificate))
    }

    /// Reads a program's JSON, or that of [`Stored::to_json`].
    ///
    /// # Errors
    /// As [`Stored::load`].
    pub fn from_json(text: &str) -> Result<Self> {
        let syntax =
            |error: serde_json::Error| Error::new(ErrorKind::Syntax, error.to_string()).at_line(error.line().max(1));
        let mut value: Value = serde_json::from_str(text).map_err(syntax)?;
        let Some(format) = value.get("groebot") else {
            return Ok(Stored::new(Program::from_json(text)?, None, None, None));
        };
        if *format != json!(FORMAT) {
            let text = format!("the solver is stored in format {format}; this groebot reads {FORMAT}: derive it again");
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let program = Program::from_json(&value["program"].to_string())?;
        let files = value["files"].take();
        let origin =
            if files.is_null() { None } else { Some(Origin { files: serde_json::from_value(files).map_err(syntax)? }) };
        let chain = origin.as_ref().map(Origin::source).transpose()?.and_then(|source| source.chain);
        Ok(Stored::new(program, chain, origin, None))
    }

    /// Converts the solver and its origin to JSON.
    pub fn to_json(&self) -> String {
        let program: Value = serde_json::from_str(&self.program.to_json()).unwrap_or(Value::Null);
        json!({ "groebot": FORMAT, "program": program, "files": self.origin.as_ref().map(|origin| &origin.files) })
            .to_string()
    }

    /// The input from which it was derived.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a program without its description.
    pub fn source(&self) -> Result<Source> {
        let none = || {
            let text = "this solver was read without its description; load the whole folder of its derivation";
            Error::new(ErrorKind::Unsupported, text)
        };
        self.origin.as_ref().ok_or_else(none)?.source()
    }

    /// The derivation with its proof. It is cached, else proved again from the stored certificate, else derived again.
    ///
    /// # Errors
    /// As [`Stored::source`] and [`Derivation::of`]; [`ErrorKind::Certificate`] if the derivation returns another solver.
    pub fn proved(&self, watch: &Watch) -> Result<Arc<Derivation>> {
        if let Some(proved) = self.proved.get() {
            return Ok(Arc::clone(proved));
        }
        let mut source = self.source()?;
        source.choose_given(watch)?;
        let proved = match &self.certificate {
            Some(certificate) => Derivation::prove_source(&source, certificate)?,
            None => Derivation::of(&source, watch)?,
        };
        let proved = Arc::new(proved.about(&source));
        if *proved.program() != self.program {
            let text = "the description does not lead to this solver; derive it again";
            return Err(Error::new(ErrorKind::Certificate, text));
        }
        Ok(Arc::clone(self.proved.get_or_init(|| proved)))
    }

    /// Same as [`Stored::given`], as owned names.
    pub fn given_names(&self) -> Vec<String> {
        self.given().into_iter().map(str::to_owned).collect()
    }

    /// The names of the joints whose values are given.
    pub fn given(&self) -> Vec<&str> {
        if self.program.tip().is_some() { self.program.given_names() } else { Vec::new() }
    }
}

/// The shape of a program's targets.
fn target_shape(program: &Program) -> TargetShape {
    let given = program.tip().map_or(0, |_| program.given_joints.len());
    let own = program.inputs.len() - given;
    let mut rotations = program.conditions.iter().filter_map(|condition| match condition {
        Condition::Rotation(first) => Some(*first),
        Condition::Unit(_) => None,
    });
    let rotation = rotations.next().filter(|_| rotations.next().is_none());
    TargetShape { own, given, rotation, is_pose: own == 12 && rotation == Some(3) }
}

/// The chain of a solver.
///
/// # Errors
/// `GroebotError` of the kind `unsupported` for a solver without one.
pub fn chain(stored: &Stored) -> pyo3::PyResult<&Chain> {
    stored.chain.as_ref().ok_or_else(|| {
        crate::errors::unsupported(
            "this solver was read without the chain that it is of; load the whole folder of its derivation",
        )
    })
}
