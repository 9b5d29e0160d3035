//! Requests and responses. Main type: [`Session`].

use crate::arm::Arm;
use groebot::gait::{Footprint, Side, Walk};
use groebot::kinematics::Solution;
use groebot::nav::{Piece, Room};
use groebot::sim::{FIGURES, Next, PRESETS, Run, Start, with_fields};
use groebot::solver::{Program, Solver};
use groebot::task::Goal;
use groebot::{Error, ErrorKind, Result, Watch};
use nalgebra::Point2;
use serde::Deserialize;
use serde_json::{Value, json};

/// Requests of a page. Metres, radians; parameters in their own units.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Request {
    /// Load a derived solver, the text of its `5_program.json`: `{"solver": 0, "joints": ["hip", ..], "inputs": ["p.x", ..], "redundant": false}`.
    /// The inputs of a redundant solver are those of the target.
    Open(String),
    /// Solve for a target: `{"solutions": [{"q", "residual", "branch", "free", "chosen"}, ..]}`.
    Solve {
        /// The index that [`Request::Open`] returned.
        solver: usize,
        /// One number for each input.
        target: Vec<f64>,
    },
    /// Compute all arcs of solutions within limits of a redundant solver:
    /// `{"arcs": [{"ends": [{"q", "limit"}, ..], "length", "closed", "unsure", "s", "q", "residual"}, ..], "reason", "unsure", "surface"}`.
    Arcs {
        /// The index that [`Request::Open`] returned.
        solver: usize,
        /// One number for each input.
        target: Vec<f64>,
        /// Joint values. `s` and `q` of an arc are its nearest solution to them.
        near: Vec<f64>,
    },
    /// Compute solutions on an arc of the last target: `{"points": [{"q", "residual"}, ..]}`.
    Points {
        /// The index that [`Request::Open`] returned.
        solver: usize,
        /// The index of the arc.
        arc: usize,
        /// Distances from the start of the arc.
        distances: Vec<f64>,
    },
    /// Place a robot of groebot in a room. The response is the state (the function `state`), with the samples in which the robot
    /// lowers its body.
    Run {
        /// `nao`, `rh0` or `teo`.
        robot: String,
        /// The room, as TOML.
        room: String,
        /// The midpoint of the feet, and the heading.
        start: [f64; 3],
        /// The goal position, with an optional heading.
        goal: Vec<f64>,
        /// Distance of the body from obstacles.
        apart: f64,
    },
    /// Compute the next step. The response has its samples; none when the robot has arrived.
    Step,
    /// Change the goal.
    Goal(Vec<f64>),
    /// Move a piece of furniture to x, y, yaw, or remove it.
    Furniture {
        /// Its name.
        name: String,
        /// Its new pose; `None` removes it.
        at: Option<[f64; 3]>,
    },
    /// Change a parameter of the gait.
    Set {
        /// Its name.
        name: String,
        /// Its value.
        value: f64,
    },
}

/// A loaded solver.
struct Loaded {
    solver: Solver,
    /// The same arm without the given joint of the solver, if it is redundant.
    arm: Option<Arm>,
}

/// The loaded solvers, and the run.
#[derive(Default)]
pub struct Session {
    solvers: Vec<Loaded>,
    run: Option<Run>,
    /// The initial furniture of the room. Removed pieces can be restored.
    furniture: Vec<Piece>,
}

impl Session {
    /// Returns the response to a request; `{"error": TEXT}` if it fails.
    pub fn answer(&mut self, request: &[u8]) -> String {
        let request = serde_json::from_slice(request).map_err(|error| Error::new(ErrorKind::Syntax, error.to_string()));
        let answer = request.and_then(|request| self.take(request));
        answer.unwrap_or_else(|error| json!({ "error": with_fields(&error.to_string()) })).to_string()
    }

    fn take(&mut self, request: Request) -> Result<Value> {
        let watch = Watch::none();
        match request {
            Request::Open(program) => self.open(&program),
            Request::Solve { solver, target } => {
                let solutions: Vec<Solution> = self.loaded(solver)?.solver.solve_numbers(&target)?;
                Ok(json!({ "solutions": solutions }))
            }
            Request::Arcs { solver, target, near } => self.arm(solver)?.arcs(&target, &near),
            Request::Points { solver, arc, distances } => self.arm(solver)?.points(arc, &distances),
            Request::Run { robot, room, start: [x, y, yaw], goal, apart } => {
                let (room, middle) = (Room::from_toml(&room)?, Footprint { x, y, yaw });
                let start = Start::of_robot(&robot, room, middle, Goal::of(&goal)?.into(), apart)?;
                self.furniture.clone_from(&start.room.pieces);
                let run = self.run.insert(Run::new(start, &watch)?);
                let samples = run.walk().references.len();
                Ok(state(run, 0..samples))
            }
            Request::Step => {
                let run = self.running()?;
                match run.step(&watch)? {
                    Next::Step(samples) => Ok(samples_of(run, samples)),
                    Next::Arrived => Ok(json!({ "arrived": true })),
                }
            }
            Request::Goal(goal) => {
                let run = self.running()?;
                run.go_to(Goal::of(&goal)?.into(), &watch)?;
                Ok(state(run, 0..0))
            }
            Request::Furniture { name, at } => {
                let away = self.furniture.iter().find(|piece| piece.name == name).cloned();
                let run = self.running()?;
                let mut room = run.room().clone();
                if at.is_some() && room.piece(&name).is_err() {
                    room.pieces.extend(away);
                }
                let room = match at {
                    Some([x, y, yaw]) => room.with_moved(&name, Point2::new(x, y), yaw)?,
                    None => room.without(&name)?,
                };
                run.refurnish(room, &watch)?;
                Ok(state(run, 0..0))
            }
            Request::Set { name, value } => {
                let run = self.running()?;
                let samples = run.set(&name, value, &watch)?;
                Ok(state(run, samples))
            }
        }
    }

    fn open(&mut self, program: &str) -> Result<Value> {
        let program = Program::from_json(program)?;
        let arm = Arm::new(&program);
        let given = if arm.is_some() { program.given_joints.len() } else { 0 };
        let inputs = program.inputs.iter().take(program.inputs.len() - given);
        let response = json!({
            "solver": self.solvers.len(),
            "joints": program.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>(),
            "inputs": inputs.map(|input| input.name.as_str()).collect::<Vec<_>>(),
            "redundant": arm.is_some(),
        });
        self.solvers.push(Loaded { solver: program.solver(), arm });
        Ok(response)
    }

    fn loaded(&mut self, solver: usize) -> Result<&mut Loaded> {
        let unknown = || Error::new(ErrorKind::UnknownName, format!("there is no solver {solver}"));
        self.solvers.get_mut(solver).ok_or_else(unknown)
    }

    fn arm(&mut self, solver: usize) -> Result<&mut Arm> {
        let single = || {
            Error::new(ErrorKind::Unsupported, format!("solver {solver} is not redundant: its solutions are no arcs"))
        };
        self.loaded(solver)?.arm.as_mut().ok_or_else(single)
    }

    fn running(&mut self) -> Result<&mut Run> {
        self.run
            .as_mut()
            .ok_or_else(|| Error::new(ErrorKind::MissingKey, "there is no run; send the request `run` first"))
    }
}

/// Joints and soles, parameters with their presets, path, furniture, and samples.
fn state(run: &Run, samples: std::ops::Range<usize>) -> Value {
    let mut state = samples_of(run, samples);
    let biped = &run.pilot().walker().biped;
    state["joints"] = biped.joints.iter().map(|joint| joint.name.as_str()).collect();
    let corners = |side: Side| -> Value {
        biped.feet[side as usize].corners.iter().map(|corner| json!([corner.x, corner.y])).collect()
    };
    state["outlines"] = json!([corners(Side::Left), corners(Side::Right)]);
    let figure = |(figure, value): (&groebot::sim::Figure, &f64)| json!({ "name": figure.name, "what": figure.what, "unit": figure.unit, "value": value });
    state["figures"] = FIGURES.iter().zip(&run.figures().values).map(figure).collect();
    state["presets"] =
        PRESETS.iter().map(|preset| json!({ "name": preset.name, "values": preset.figures.values })).collect();
    match run.course() {
        Ok(course) => {
            state["path"] = course.path.points.iter().map(|at| json!([at.x, at.y])).collect();
            state["wide"] = course.is_wide.into();
        }
        Err(blocked) => {
            let middle = |cell: &usize| {
                let at = blocked.map.centre(*cell);
                json!([at.x, at.y])
            };
            state["path"] = Value::Null;
            state["blocked"] = blocked.to_string().into();
            state["enclosure"] = blocked.enclosure.cells.iter().map(middle).collect();
        }
    }
    let piece = |piece: &Piece| json!({ "name": piece.name, "at": [piece.place.x, piece.place.y, piece.yaw] });
    state["furniture"] = run.room().pieces.iter().map(piece).collect();
    state
}

/// All footsteps, and samples of the walk: times, joints, torso and soles (position and quaternion xyzw), soles in contact, centre of mass, zero moment point,
/// margin, support polygon.
fn samples_of(run: &Run, samples: std::ops::Range<usize>) -> Value {
    let walk: &Walk = run.walk();
    let sample = |sample: usize| {
        let (reference, balance) = (&walk.references[sample], &walk.balances[sample]);
        let posture = &walk.motion.postures[sample];
        let sole = |side: Side| numbers(&reference.world_from_soles[side as usize]);
        json!({
            "time": walk.time(sample),
            "q": posture.q,
            "torso": numbers(&posture.world_from_torso),
            "soles": [sole(Side::Left), sole(Side::Right)],
            "stands": reference.stands,
            "com": walk.motion.centres[sample].coords.as_slice(),
            "zmp": [balance.zmp.x, balance.zmp.y],
            "margin": balance.margin,
            "support": balance.support.corners().iter().map(|corner| json!([corner.x, corner.y])).collect::<Value>(),
        })
    };
    let steps = walk.schedule.route.steps.iter().map(|step| {
        let print = &step.print;
        json!({ "foot": step.side.name(), "x": print.x, "y": print.y, "yaw": print.yaw })
    });
    json!({ "samples": samples.map(sample).collect::<Vec<_>>(), "steps": steps.collect::<Vec<_>>() })
}

fn numbers(pose: &groebot::spatial::Pose) -> Value {
    let (at, turn) = (pose.translation.vector, pose.rotation.coords);
    json!([at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w])
}
