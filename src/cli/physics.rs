//! MuJoCo as an external program: a Python with the package `mujoco` simulates a walk by `scripts/physics/play.py`.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::read_text;
use groebot_robot::motion::Trajectory;
use groebot_robot::motion::table::TABLE_LIMIT;

/// The script of the simulation.
const SCRIPT: &str = include_str!("../../scripts/physics/play.py");
/// The default name of Python, which the variable may replace.
const PYTHON: &str = "python3";
const VARIABLE: &str = "GROEBOT_PYTHON";
/// The exit status of the script without MuJoCo.
const NO_MUJOCO: i32 = 7;
/// The interval between two checks of the script.
const PAUSE: Duration = Duration::from_millis(10);
/// The greatest length of the script's output in bytes.
const OUTPUT_LIMIT: u64 = groebot_algebra::limits::DESCRIPTION_BYTES;

/// The parameters of the world and the motors in a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Case {
    /// The coefficient of friction.
    pub friction: f64,
    /// The rotation of the floor about x and then y \[degrees\]: the left side up, the front down.
    pub slope: [f64; 2],
    /// The factor on all masses.
    pub mass: f64,
    /// The factor on the stiffness of motors.
    pub gain: f64,
    /// The delay of commands \[s\].
    pub latency: f64,
}

/// The output of the script for a run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ScriptOutput {
    /// The version of MuJoCo.
    pub mujoco: String,
    /// The time at which the robot fell \[s\].
    pub fell: Option<f64>,
    /// The stiffness of each motor \[N m/rad\].
    pub stiffness: f64,
    /// Its damping \[N m s/rad\].
    pub damping: f64,
    /// Its inertia at the joint \[kg m^2\].
    pub armature: f64,
    /// The mass of the robot \[kg\].
    pub mass: f64,
    /// The bodies that are described as points, which get moments of inertia.
    pub points: Vec<String>,
}

/// A folder with script, robot and walk.
pub struct Stage {
    folder: TempDir,
    python: PathBuf,
    /// The arguments that all runs share.
    fixed: Vec<String>,
}

/// A process that is ended when this value is dropped.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may already have ended.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Stage {
    /// Makes the folder for a robot in MJCF and a walk. `feet` are the links of the soles, `servo` is stiffness,
    /// damping and armature relative to the robot's size.
    pub fn new(robot: &str, walk: &Trajectory, feet: [&str; 2], servo: Option<&[f64]>) -> Result<Self> {
        let folder = tempfile::tempdir().map_err(|error| Error::io(&std::env::temp_dir(), &error))?;
        for (name, text) in [("play.py", SCRIPT), ("robot.xml", robot), ("walk.csv", &walk.to_csv())] {
            let file = folder.path().join(name);
            fs::write(&file, text).map_err(|error| Error::io(&file, &error))?;
        }
        let mut fixed = vec![format!("--feet={}", feet.join(","))];
        fixed.extend(servo.map(|servo| format!("--servo={}", listed(servo))));
        let python = std::env::var_os(VARIABLE).filter(|name| !name.is_empty()).map_or(PYTHON.into(), PathBuf::from);
        Ok(Stage { folder, python, fixed })
    }

    /// Simulates the walk in a case: the motion of the robot, and the output of the script.
    pub fn play(&self, case: &Case, watch: &Watch) -> Result<(Trajectory, ScriptOutput)> {
        let at = |name: &str| self.folder.path().join(name);
        let file = |name: &str| File::create(at(name)).map_err(|error| Error::io(&at(name), &error));
        let mut command = Command::new(&self.python);
        command.args(["-B", "play.py", "robot.xml", "walk.csv", "answer.csv"]).args(&self.fixed).args(case.arguments());
        command
            .current_dir(self.folder.path())
            .stdin(Stdio::null())
            .stdout(file("output.json")?)
            .stderr(file("errors.txt")?);
        let mut running = Running(command.spawn().map_err(|error| self.no_mujoco(&error.to_string()))?);
        let status = loop {
            if let Some(status) = running.0.try_wait().map_err(|error| Error::io(&self.python, &error))? {
                break status;
            }
            watch.check()?;
            sleep(PAUSE);
        };
        if !status.success() {
            let errors = fs::read_to_string(at("errors.txt")).unwrap_or_default();
            let last = errors.lines().last().unwrap_or("no message");
            return Err(match status.code() {
                Some(NO_MUJOCO) => self.no_mujoco(last),
                _ => Error::new(ErrorKind::Unsupported, format!("MuJoCo cannot simulate this: {last}")),
            });
        }
        let output = read_text(&at("output.json"), OUTPUT_LIMIT)?;
        let output = serde_json::from_str(&output).map_err(|error| {
            Error::new(ErrorKind::Syntax, format!("the output of {} is not understood: {error}", self.python.display()))
        })?;
        Ok((Trajectory::from_csv(&read_text(&at("answer.csv"), TABLE_LIMIT)?)?, output))
    }

    fn no_mujoco(&self, reason: &str) -> Error {
        let text = format!(
            "`{}` cannot run MuJoCo ({reason}); install it by `python3 -m venv mujoco && mujoco/bin/pip install mujoco`, and set the variable to that Python: \
             {VARIABLE}=mujoco/bin/python",
            self.python.display()
        );
        Error::new(ErrorKind::Unsupported, text)
    }
}

impl Case {
    fn arguments(&self) -> [String; 5] {
        let Case { friction, slope, mass, gain, latency } = self;
        [
            format!("--friction={friction}"),
            format!("--slope={}", listed(slope)),
            format!("--mass={mass}"),
            format!("--gain={gain}"),
            format!("--latency={latency}"),
        ]
    }
}

fn listed(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

/// The absolute path, where the file exists.
pub fn whole(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}
