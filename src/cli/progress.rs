//! A [`Watch`] that a person follows and stops: a spinner on a terminal, Ctrl-C, a budget.

use std::io::{IsTerminal, stderr};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::{Error, ErrorKind, Result, Watch};

/// The longest time budget: about thirty years.
const MAX_SECONDS: f64 = 1e9;

/// How much may be spent, and whether to show it.
#[derive(Clone, Copy, Default)]
pub struct Limits {
    /// The time budget.
    pub time: Option<Duration>,
    /// The most polynomial terms alive.
    pub terms: Option<usize>,
    /// The most memory in use, in bytes.
    pub memory: Option<usize>,
    /// No spinner.
    pub quiet: bool,
}

/// How much a command may spend, and whether it tells of it.
#[derive(clap::Args)]
pub struct Budget {
    /// The time budget
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,
    /// The memory budget
    #[arg(long, value_name = "MiB", value_parser = mebibytes)]
    memory: Option<usize>,
    /// Neither progress nor summary
    #[arg(long)]
    pub quiet: bool,
}

impl Budget {
    /// The same as limits of a session.
    pub fn limits(&self) -> Limits {
        Limits { time: self.time, memory: self.memory, terms: None, quiet: self.quiet }
    }
}

/// A watch with its spinner, which goes when the session ends.
pub struct Session {
    /// What the work asks.
    pub watch: Watch,
    spinner: Option<ProgressBar>,
}

impl Session {
    /// Starts to listen for Ctrl-C and to show progress.
    pub fn start(limits: Limits) -> Result<Session> {
        let cancel = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&cancel);
        let interrupt = move || {
            // The work ends at its next look at the watch; who cannot wait for that asks twice. Staging looks before each file,
            // so that the second time finds nothing half-written.
            if flag.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        };
        ctrlc::set_handler(interrupt)
            .map_err(|error| Error::new(ErrorKind::Io, format!("Ctrl-C cannot be caught: {error}")))?;
        let mut watch = Watch::none().with_cancel(cancel);
        if let Some(time) = limits.time {
            watch = watch.with_time(time);
        }
        if let Some(terms) = limits.terms {
            watch = watch.with_terms(terms);
        }
        if let Some(bytes) = limits.memory {
            watch = watch.with_memory(bytes);
            if let Some(meter) = meter() {
                watch = watch.with_meter(meter);
            }
        }
        let spinner = (!limits.quiet && stderr().is_terminal()).then(spinner);
        if let Some(bar) = spinner.clone() {
            watch = watch.with_listener(move |progress| {
                bar.set_message(progress.to_string());
            });
        }
        Ok(Session { watch, spinner })
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if let Some(spinner) = &self.spinner {
            spinner.finish_and_clear();
        }
    }
}

/// How often the memory in use is measured.
const METER_PERIOD: Duration = Duration::from_millis(20);

/// The bytes that this process has in memory, kept up to date; `None` where the system does not tell.
fn meter() -> Option<Arc<AtomicUsize>> {
    let meter = Arc::new(AtomicUsize::new(resident_bytes()?));
    let kept = Arc::downgrade(&meter);
    std::thread::spawn(move || {
        while let (Some(meter), Some(bytes)) = (kept.upgrade(), resident_bytes()) {
            meter.store(bytes, Ordering::Relaxed);
            drop(meter);
            std::thread::sleep(METER_PERIOD);
        }
    });
    Some(meter)
}

/// `VmRSS` of Linux' proc(5).
fn resident_bytes() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<usize>().ok()?.checked_mul(1024)
}

fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(120));
    bar
}

/// Reads a memory budget in MiB, as bytes.
pub fn mebibytes(text: &str) -> std::result::Result<usize, String> {
    let bytes = text.parse::<usize>().ok().filter(|&n| n > 0).and_then(|n| n.checked_mul(1 << 20));
    bytes.ok_or_else(|| "give a whole number of MiB greater than 0".to_owned())
}

/// Reads a time budget in seconds.
pub fn seconds(text: &str) -> std::result::Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= MAX_SECONDS => Ok(Duration::from_secs_f64(value)),
        _ => Err(format!("give a number of seconds greater than 0 and at most {MAX_SECONDS:e}")),
    }
}
