//! Common code of the contest programs in Rust: arguments, input, clock and report.
//!
//! `PROGRAM FILE [--order grevlex|lex] [--seconds S] [--prove S] [--print]` reads a file in msolve's format and computes its basis repeatedly for `S` seconds,
//! at least once. It prints `seconds` (the mean processor time), `memory_kb` (the peak), `proof` \[s\] or the limit that the proof exceeds, and, with
//! `--print`, the basis.

use std::fmt::Display;
use std::time::{Duration, Instant};

pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// A system: the first line of the file has the names of the variables. The second line has the characteristic and, after a blank, the parameters.
#[derive(Debug)]
pub struct Input {
    pub variables: Vec<String>,
    pub characteristic: u64,
    pub parameters: Vec<String>,
    pub polynomials: Vec<String>,
}

#[derive(Debug)]
pub struct Arguments {
    pub input: Input,
    pub lex: bool,
    /// The time limit for a proof, if one is requested.
    pub proof: Option<Duration>,
    budget: Duration,
    print: bool,
}

impl Arguments {
    /// Reads the command line and the input file.
    pub fn read() -> Result<Self> {
        let mut words = std::env::args().skip(1);
        let file = words.next().ok_or("usage: FILE [--order grevlex|lex] [--seconds S] [--prove S] [--print]")?;
        let input = Input::parse(&std::fs::read_to_string(&file)?)?;
        let mut found = Arguments { input, lex: false, proof: None, budget: Duration::ZERO, print: false };
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
            match word.as_str() {
                "--order" => found.lex = value()? == "lex",
                "--seconds" => found.budget = Duration::try_from_secs_f64(value()?.parse()?)?,
                "--prove" => found.proof = Some(Duration::try_from_secs_f64(value()?.parse()?)?),
                "--print" => found.print = true,
                _ => return Err(format!("unknown argument {word}").into()),
            }
        }
        Ok(found)
    }

    /// Runs `compute` until the time is used up. Reports the mean processor time, and the memory peak of the first run. Returns the result of the first run.
    pub fn measure<T>(&self, compute: impl Fn() -> Result<T>) -> Result<T> {
        let (start, before) = (Instant::now(), processor_time()?);
        let found = compute()?;
        let memory = peak_memory()?;
        let mut runs = 1;
        while start.elapsed() < self.budget {
            std::hint::black_box(compute()?);
            runs += 1;
        }
        report("seconds", seconds((processor_time()? - before) / runs));
        report("memory_kb", memory);
        Ok(found)
    }

    /// Prints the basis at the end of the output, if requested.
    pub fn show<Lines: Iterator<Item = String>>(&self, lines: impl FnOnce() -> Lines) {
        if self.print {
            println!("basis");
            lines().for_each(|line| println!("{line}"));
        }
    }
}

/// The processor time of this thread (Linux). The kernel updates it some hundred times per second.
pub fn processor_time() -> Result<Duration> {
    let fields = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    let nanoseconds = fields.split(' ').next().ok_or("/proc/thread-self/schedstat is empty")?;
    Ok(Duration::from_nanos(nanoseconds.parse()?))
}

pub fn seconds(time: Duration) -> String {
    format!("{:.9}", time.as_secs_f64())
}

pub fn report(key: &str, value: impl Display) {
    println!("{key} {value}");
}

impl Input {
    fn parse(text: &str) -> Result<Self> {
        let (variables, rest) = text.split_once('\n').ok_or("the file has one line")?;
        let (field, rest) = rest.split_once('\n').ok_or("the file has two lines")?;
        let (characteristic, parameters) = field.split_once(' ').unwrap_or((field, ""));
        Ok(Input {
            variables: names(variables),
            characteristic: characteristic.trim().parse()?,
            parameters: names(parameters),
            polynomials: names(rest),
        })
    }
}

/// The parts of the text between commas; empty for an empty text.
fn names(text: &str) -> Vec<String> {
    text.split(',').map(|piece| piece.trim().to_owned()).filter(|piece| !piece.is_empty()).collect()
}

/// The peak of the resident memory so far, in kB (Linux).
fn peak_memory() -> Result<u64> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("no VmHWM in /proc/self/status")?;
    Ok(line.trim().trim_end_matches("kB").trim().parse()?)
}
