//! Other programs, in a Python child process.

use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Command, Stdio};

use groebot::nav::Map;

/// `peers.py`, which runs round by round.
pub struct Peers {
    child: Child,
    answers: BufReader<ChildStdout>,
    file: PathBuf,
    question: String,
}

impl Peers {
    /// Starts them with the Python of `PYTHON`.
    pub fn start() -> Self {
        let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/peers.py");
        let mut command = Command::new(python);
        let mut child =
            command.arg(script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("Python starts");
        let answers = BufReader::new(child.stdout.take().expect("its output is piped"));
        let file = std::env::temp_dir().join(format!("groebot-navigation-{}.map", std::process::id()));
        Peers { child, answers, file, question: String::new() }
    }

    /// Sends them a map and a goal.
    pub fn give(&mut self, map: &Map, goal: usize) {
        let count = map.cells().len();
        let mut bytes: Vec<u8> = (0..count).map(|cell| u8::from(map.is_free(cell))).collect();
        bytes.extend((0..count).flat_map(|cell| map.speeds().map_or(1.0, |speeds| speeds[cell]).to_le_bytes()));
        std::fs::write(&self.file, bytes).expect("the map is written");
        self.question = format!("{} {} {goal}\n", self.file.display(), map.columns());
    }

    /// The processor times of one round, ns.
    pub fn times(&mut self) -> Vec<f64> {
        let input = self.child.stdin.as_mut().expect("its input is piped");
        input.write_all(self.question.as_bytes()).expect("Python reads");
        let mut answer = String::new();
        self.answers.read_line(&mut answer).expect("Python answers");
        answer.split_whitespace().map(|time| time.parse().expect("a number")).collect()
    }
}

impl Drop for Peers {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
        let _ = std::fs::remove_file(&self.file);
    }
}
