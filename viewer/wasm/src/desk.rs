//! Requests and their answers. Main type: [`Desk`].

use groebot::kinematics::Solution;
use groebot::solver::{Program, Solver};
use groebot::{Error, ErrorKind, Result};
use serde::Deserialize;
use serde_json::{Value, json};

/// What a page asks for.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Request {
    /// Take a derived solver, the text of its `5_program.json`: `{"solver": 0, "joints": ["hip", ..], "inputs": ["p.x", ..]}`.
    Open(String),
    /// Solve for a target: `{"solutions": [{"q", "residual", "branch", "free", "chosen"}, ..]}`.
    Solve {
        /// The number that [`Request::Open`] gave it.
        solver: usize,
        /// One number an input.
        target: Vec<f64>,
    },
}

/// What was taken, by numbers.
#[derive(Default)]
pub struct Desk {
    solvers: Vec<Solver>,
}

impl Desk {
    /// The answer to a request; `{"error": TEXT}` where it cannot be answered.
    pub fn answer(&mut self, request: &[u8]) -> String {
        let request = serde_json::from_slice(request).map_err(|error| Error::new(ErrorKind::Syntax, error.to_string()));
        let answer = request.and_then(|request| self.take(request));
        answer.unwrap_or_else(|error| json!({ "error": error.to_string() })).to_string()
    }

    fn take(&mut self, request: Request) -> Result<Value> {
        match request {
            Request::Open(program) => {
                let program = Program::from_json(&program)?;
                self.solvers.push(program.solver());
                Ok(json!({
                    "solver": self.solvers.len() - 1,
                    "joints": program.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>(),
                    "inputs": program.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>(),
                }))
            }
            Request::Solve { solver, target } => {
                let unknown = || Error::new(ErrorKind::UnknownName, format!("there is no solver {solver}"));
                let solutions: Vec<Solution> =
                    self.solvers.get(solver).ok_or_else(unknown)?.solve_numbers(&target)?;
                Ok(json!({ "solutions": solutions }))
            }
        }
    }
}
