//! MuJoCo as an external program: a Python with the package `mujoco` simulates a walk by `scripts/physics/play.py`.

use std::fs::{self, File};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use super::feedback::{Feedback, listed};
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
/// The greatest length of the script's output in bytes: a state each 5 ms for hours.
const OUTPUT_LIMIT: u64 = 1 << 32;

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
    /// The noise of measurements, relative to the usual one.
    pub noise: f64,
    /// A push of the torso.
    pub push: Option<Push>,
}

/// A horizontal push at the torso's centre of mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Push {
    /// The start \[s\].
    pub time: f64,
    /// The force \[N\].
    pub force: f64,
    /// The duration \[s\].
    pub duration: f64,
    /// The direction, anticlockwise from ahead \[degrees\].
    pub direction: f64,
}

/// The output of the script for a run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ScriptOutput {
    /// The version of MuJoCo.
    pub mujoco: String,
    /// The time at which the robot fell \[s\].
    #[serde(rename(serialize = "fall_time"))]
    pub fell: Option<f64>,
    /// The motors.
    pub motors: Vec<Motor>,
    /// The greatest stiffness in a description whose gains are not used, because none could hold the robot upright \[N m/rad\].
    pub unused_stiffness: Option<f64>,
    /// The mass of the robot \[kg\].
    pub mass: f64,
    /// The bodies that are described as points, which get moments of inertia.
    pub points: Vec<String>,
}

/// A motor: a position servo.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Motor {
    /// Its joint.
    pub joint: String,
    /// Its stiffness \[N m/rad or N/m\].
    pub stiffness: f64,
    /// Its damping \[N m s/rad or N s/m\].
    pub damping: f64,
    /// Its inertia at the joint \[kg m^2 or kg\].
    pub armature: f64,
    /// Whether its gains are those of the description.
    pub described: bool,
}

impl ScriptOutput {
    /// The stiffness of a joint's motor divided by the factor on the masses; infinite without a motor.
    pub fn stiffness(&self, joint: &str, mass: f64) -> f64 {
        self.motors.iter().find(|motor| motor.joint == joint).map_or(f64::INFINITY, |motor| motor.stiffness / mass)
    }

    /// Whether the robot falls, with its mass and the version of MuJoCo.
    pub fn verdict(&self) -> String {
        let ScriptOutput { mujoco, mass, fell, .. } = self;
        let fate = fell.map_or("the robot does not fall".to_owned(), |time| format!("the robot falls at {time:.2} s"));
        format!("{fate} ({mass:.2} kg, MuJoCo {mujoco})")
    }

    /// Reports that the gains of the description are not used; `None` where they are, or where there are none.
    pub fn unused_gains(&self) -> Option<String> {
        let text = |greatest: f64| {
            format!("of the description are not used: at most {greatest:.1} N m/rad do not hold the robot upright")
        };
        self.unused_stiffness.map(text)
    }

    /// The lines of the report about the motors.
    pub fn motors_text(&self) -> String {
        let points = if self.points.is_empty() {
            String::new()
        } else {
            format!("  moments         assumed of {}, which is described as a point\n", self.points.join(", "))
        };
        let range = |of: fn(&Motor) -> f64, digits: usize| {
            let (low, high) = self
                .motors
                .iter()
                .map(of)
                .fold((f64::INFINITY, 0.0), |(low, high), value| (value.min(low), value.max(high)));
            if low < high { format!("{low:.digits$} to {high:.digits$}") } else { format!("{high:.digits$}") }
        };
        let (stiffness, damping) = (range(|motor| motor.stiffness, 1), range(|motor| motor.damping, 3));
        let armature = range(|motor| motor.armature, 4);
        let described = match self.motors.iter().filter(|motor| motor.described).count() {
            0 => String::new(),
            count => format!("; gains of {count} of {} from the description", self.motors.len()),
        };
        let unused = self.unused_gains().map_or_else(String::new, |text| format!("  gains           {text}\n"));
        format!(
            "{points}  motors          {stiffness} N m/rad, {damping} N m s/rad, {armature} kg m^2{described}\n{unused}"
        )
    }
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

    /// Simulates the walk in a case, with feedback or in open loop: the motion of the robot, and the output of the script.
    pub fn play(
        &self,
        case: &Case,
        feedback: Option<&mut Feedback>,
        watch: &Watch,
    ) -> Result<(Trajectory, ScriptOutput)> {
        let at = |name: &str| self.folder.path().join(name);
        let mut command = Command::new(&self.python);
        command.args(["-B", "play.py", "robot.xml", "walk.csv", "answer.csv"]).args(&self.fixed).args(case.arguments());
        command.args(feedback.as_ref().map(|feedback| feedback.arguments()).unwrap_or_default());
        let errors = File::create(at("errors.txt")).map_err(|error| Error::io(&at("errors.txt"), &error))?;
        command.current_dir(self.folder.path()).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(errors);
        let mut running = Running(command.spawn().map_err(|error| self.no_mujoco(&error.to_string()))?);
        let (Some(input), Some(output)) = (running.0.stdin.take(), running.0.stdout.take()) else {
            return Err(self.no_mujoco("its input and output cannot be used"));
        };
        let last = Exchange { lines: lines(output), input, watch }.run(feedback)?;
        let status = running.0.wait().map_err(|error| Error::io(&self.python, &error))?;
        if !status.success() {
            let errors = fs::read_to_string(at("errors.txt")).unwrap_or_default();
            let message = message(&errors);
            return Err(match status.code() {
                Some(NO_MUJOCO) => self.no_mujoco(&message),
                _ => Error::new(ErrorKind::Unsupported, format!("MuJoCo cannot simulate this: {message}")),
            });
        }
        let output = serde_json::from_str(&last).map_err(|error| {
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

/// The message of an exception, which may have several lines: all after the indented lines of the traceback.
fn message(errors: &str) -> String {
    let lines: Vec<&str> = errors.lines().filter(|line| !line.trim().is_empty()).collect();
    let start = lines.iter().rposition(|line| line.starts_with(' ')).map_or(0, |place| place + 1);
    if lines.is_empty() { "no message".to_owned() } else { lines[start.min(lines.len() - 1)..].join("; ") }
}

/// The lines that a process writes; a thread of their own reads them.
fn lines(output: ChildStdout) -> Receiver<String> {
    let (sender, lines) = channel();
    thread::spawn(move || {
        let output = BufReader::new(output.take(OUTPUT_LIMIT));
        for line in output.lines().map_while(std::result::Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    lines
}

/// The exchange of states and targets with the script.
struct Exchange<'a> {
    lines: Receiver<String>,
    input: ChildStdin,
    watch: &'a Watch,
}

impl Exchange<'_> {
    /// Answers each state until the script ends. Returns its last line.
    fn run(mut self, feedback: Option<&mut Feedback>) -> Result<String> {
        let mut last = String::new();
        let mut feedback = feedback.map(|feedback| (feedback, false));
        while let Some(line) = self.next()? {
            match &mut feedback {
                Some((feedback, started @ false)) => {
                    feedback.start(&line)?;
                    *started = true;
                }
                Some((feedback, true)) if !line.starts_with('{') => {
                    let answer = feedback.answer(&line)?;
                    // When the script has ended, its status has the reason.
                    if self.input.write_all(answer.as_bytes()).and_then(|()| self.input.flush()).is_err() {
                        break;
                    }
                }
                _ => last = line,
            }
        }
        Ok(last)
    }

    fn next(&self) -> Result<Option<String>> {
        loop {
            self.watch.check()?;
            match self.lines.recv_timeout(PAUSE) {
                Ok(line) => return Ok(Some(line)),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
            }
        }
    }
}

impl Default for Case {
    /// A level floor with friction 0.8; the robot as described.
    fn default() -> Self {
        Case { friction: 0.8, slope: [0.0; 2], mass: 1.0, gain: 1.0, latency: 0.0, noise: 0.0, push: None }
    }
}

impl Case {
    fn arguments(&self) -> Vec<String> {
        let Case { friction, slope, mass, gain, latency, noise, push } = self;
        let push = push.map(|Push { time, force, duration, direction }| {
            format!("--push={}", listed(&[time, force, duration, direction]))
        });
        let mut arguments = vec![
            format!("--friction={friction}"),
            format!("--slope={}", listed(slope)),
            format!("--mass={mass}"),
            format!("--gain={gain}"),
            format!("--latency={latency}"),
            format!("--noise={noise}"),
        ];
        arguments.extend(push);
        arguments
    }
}

/// The absolute path, where the file exists.
pub fn whole(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}
