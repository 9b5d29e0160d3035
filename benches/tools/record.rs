//! Appends the results of `cargo bench` to `benches/record/YYYY-MM-DD.csv` (see `benches/README.md`).
//!
//! `cargo run --example record_benches [-- --machine NAME]`

use std::error::Error;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde_json::Value;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const HEADER: &str = "date,machine,bench,median_ns,low_ns,high_ns,samples,commit";

/// Criterion's result for one benchmark: times of one iteration in nanoseconds.
#[derive(Debug, PartialEq)]
struct Measurement {
    bench: String,
    median: f64,
    /// The confidence interval of the median, at Criterion's level (by default 95 %).
    low: f64,
    high: f64,
    samples: usize,
}

impl Measurement {
    /// Reads `benchmark.json`, `estimates.json` and `sample.json` of one benchmark's folder `new`.
    fn read(folder: &Path) -> Result<Self> {
        let benchmark = json(&folder.join("benchmark.json"))?;
        let estimates = json(&folder.join("estimates.json"))?;
        let sample = json(&folder.join("sample.json"))?;
        let number = |pointer: &str| {
            let value = estimates.pointer(pointer).and_then(Value::as_f64);
            value.ok_or_else(|| format!("{}: no number at {pointer}", folder.display()))
        };
        Ok(Measurement {
            bench: benchmark["full_id"].as_str().ok_or("benchmark.json has no full_id")?.to_owned(),
            median: number("/median/point_estimate")?,
            low: number("/median/confidence_interval/lower_bound")?,
            high: number("/median/confidence_interval/upper_bound")?,
            samples: sample["times"].as_array().ok_or("sample.json has no times")?.len(),
        })
    }

    fn row(&self, date: &str, machine: &str, commit: &str) -> String {
        let Measurement { bench, median, low, high, samples } = self;
        format!("{date},{},{},{median:.1},{low:.1},{high:.1},{samples},{commit}", quoted(machine), quoted(bench))
    }
}

fn main() -> Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let (commit, since) = commit(root)?;
    let (date, machine) = (date(SystemTime::now())?, machine()?);
    let mut rows = Vec::new();
    for folder in measured(&target.join("criterion"))? {
        let measurement = Measurement::read(&folder)?;
        if fs::metadata(folder.join("estimates.json"))?.modified()? < since {
            eprintln!("left out, older than the commit: {}", measurement.bench);
        } else {
            rows.push(measurement.row(&date, &machine, &commit));
        }
    }
    let file = root.join("benches/record").join(format!("{date}.csv"));
    let added = append(&file, &rows)?;
    println!("{added} of {} rows are new in {}", rows.len(), file.display());
    Ok(())
}

/// The folders `new` below `folder`, sorted by path.
fn measured(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}; run `cargo bench`", folder.display()))?;
    let mut paths = entries.map(|entry| entry.map(|entry| entry.path())).collect::<std::io::Result<Vec<_>>>()?;
    paths.retain(|path| path.is_dir());
    paths.sort();
    let mut found = Vec::new();
    for path in paths {
        if path.ends_with("new") && path.join("benchmark.json").exists() {
            found.push(path);
        } else {
            found.extend(measured(&path)?);
        }
    }
    Ok(found)
}

/// Adds the rows that `file` does not have yet. Returns their number.
fn append(file: &Path, rows: &[String]) -> Result<usize> {
    let old = fs::read_to_string(file).unwrap_or_default();
    let new: Vec<&String> = rows.iter().filter(|row| !old.lines().any(|line| line == row.as_str())).collect();
    if !new.is_empty() {
        let mut out = fs::OpenOptions::new().create(true).append(true).open(file)?;
        if old.is_empty() {
            writeln!(out, "{HEADER}")?;
        }
        for row in &new {
            writeln!(out, "{row}")?;
        }
    }
    Ok(new.len())
}

/// The checked-out commit, with `-dirty` if files other than the records differ from it, and its time.
fn commit(root: &Path) -> Result<(String, SystemTime)> {
    let git = |arguments: &[&str]| -> Result<String> {
        let output = Command::new("git").args(arguments).current_dir(root).output()?;
        let fine = output.status.success();
        let text = if fine { output.stdout } else { output.stderr };
        let text = String::from_utf8(text)?.trim().to_owned();
        if fine { Ok(text) } else { Err(text.into()) }
    };
    let changes = git(&["status", "--porcelain", "--", ".", ":!benches/record"])?;
    let name = git(&["rev-parse", "--short", "HEAD"])? + if changes.is_empty() { "" } else { "-dirty" };
    let seconds: u64 = git(&["log", "-1", "--format=%ct"])?.parse()?;
    Ok((name, UNIX_EPOCH + Duration::from_secs(seconds)))
}

/// The value of `--machine`, or the processor and its number of available threads.
fn machine() -> Result<String> {
    let mut arguments = std::env::args().skip(1);
    match arguments.next().as_deref() {
        Some("--machine") => return arguments.next().ok_or_else(|| "--machine needs a name".into()),
        Some(other) => return Err(format!("unknown argument {other}; only --machine NAME is known").into()),
        None => {}
    }
    let threads = std::thread::available_parallelism()?;
    let information = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = information.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let model = model.map_or(std::env::consts::ARCH, |(_, name)| name.trim());
    Ok(format!("{model} x{threads} {}", std::env::consts::OS))
}

/// The date of `time` in UTC, as YYYY-MM-DD.
fn date(time: SystemTime) -> Result<String> {
    let mut days = time.duration_since(UNIX_EPOCH)?.as_secs() / 86_400;
    let (mut year, mut month) = (1970, 1);
    while days >= (1..=12).map(|month| days_of(year, month)).sum() {
        days -= (1..=12).map(|month| days_of(year, month)).sum::<u64>();
        year += 1;
    }
    while days >= days_of(year, month) {
        days -= days_of(year, month);
        month += 1;
    }
    Ok(format!("{year:04}-{month:02}-{:02}", days + 1))
}

fn days_of(year: u64, month: u64) -> u64 {
    let is_leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    match month {
        2 => 28 + u64::from(is_leap),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

fn json(file: &Path) -> Result<Value> {
    let text = fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(serde_json::from_str(&text).map_err(|error| format!("{}: {error}", file.display()))?)
}

fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n']) { format!("\"{}\"", field.replace('"', "\"\"")) } else { field.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, text) in [
            (0, "1970-01-01"),
            (951_782_400, "2000-02-29"),
            (1_000_000_000, "2001-09-09"),
            (1_704_067_199, "2023-12-31"),
            (1_704_067_200, "2024-01-01"),
            (4_107_542_400, "2100-03-01"),
        ] {
            assert_eq!(date(UNIX_EPOCH + Duration::from_secs(seconds)).unwrap(), text);
        }
    }

    #[test]
    fn a_folder_of_criterion_becomes_one_row() {
        let target = tempfile::tempdir().unwrap();
        let new = target.path().join("group/solve, all/new");
        fs::create_dir_all(&new).unwrap();
        let median = r#"{"confidence_interval":{"lower_bound":1.5,"upper_bound":3.25},"point_estimate":2.0}"#;
        fs::write(new.join("benchmark.json"), r#"{"full_id":"group/solve, all"}"#).unwrap();
        fs::write(new.join("estimates.json"), format!(r#"{{"median":{median}}}"#)).unwrap();
        fs::write(new.join("sample.json"), r#"{"iters":[1,2,3],"times":[4,5,6]}"#).unwrap();
        assert_eq!(measured(target.path()).unwrap(), vec![new.clone()]);
        let row = Measurement::read(&new).unwrap().row("2026-01-02", "cpu", "abc");
        assert_eq!(row, "2026-01-02,cpu,\"group/solve, all\",2.0,1.5,3.2,3,abc");
        fs::write(new.join("estimates.json"), "{}").unwrap();
        assert!(Measurement::read(&new).is_err());
    }

    #[test]
    fn a_row_is_recorded_once() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("day.csv");
        assert_eq!(append(&file, &["a".into(), "b".into()]).unwrap(), 2);
        assert_eq!(append(&file, &["b".into(), "c".into()]).unwrap(), 1);
        assert_eq!(fs::read_to_string(&file).unwrap(), format!("{HEADER}\na\nb\nc\n"));
    }
}
