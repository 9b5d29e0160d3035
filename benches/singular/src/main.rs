//! Times and solutions next to singular poses: see benches/README.md.

mod answers;
mod counts;
mod path;
mod poses;
mod times;

include!(concat!(env!("OUT_DIR"), "/robots.rs"));

use groebot_runtime::Solve;

/// The options of the command line.
struct Arguments {
    command: String,
    poses: usize,
    robots: Vec<String>,
}

impl Arguments {
    fn read() -> Self {
        let mut words = std::env::args().skip(1);
        let command = words.next().unwrap_or_else(|| "times".to_owned());
        let poses = words.next().and_then(|word| word.parse().ok()).unwrap_or(1000);
        Arguments { command, poses, robots: words.collect() }
    }
}

fn run<M: Solve>(name: &str, mechanism: &M, joints: &[&str]) {
    let arguments = Arguments::read();
    if !(arguments.robots.is_empty() || arguments.robots.iter().any(|robot| robot == name)) {
        return;
    }
    match arguments.command.as_str() {
        "times" => times::print(name, mechanism, joints, arguments.poses),
        "answers" => answers::print(name, mechanism, joints, arguments.poses),
        _ => counts::print(name, mechanism, joints, arguments.poses),
    }
}

fn main() {
    match Arguments::read().command.as_str() {
        "times" => times::head(),
        "counts" => counts::head(),
        "answers" => {}
        _ => {
            eprintln!("times, counts or answers; then how many poses of each set; then names of robots");
            std::process::exit(2);
        }
    }
    each_robot!(run);
}
