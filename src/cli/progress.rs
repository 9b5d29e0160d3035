//! A [`Watch`] for an interactive user: a spinner on a terminal, Ctrl-C, a budget.

use std::io::{IsTerminal, stderr};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock, Weak};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::files::stop_writers;

/// The greatest time budget.
const MAX_SECONDS: f64 = groebot_algebra::limits::BUDGET_SECONDS;

/// Budgets, and whether progress is shown.
#[derive(Clone, Copy, Default)]
pub struct Limits {
    /// The time budget.
    pub time: Option<Duration>,
    /// The greatest number of polynomial terms in use.
    pub terms: Option<usize>,
    /// The greatest memory in use, in bytes.
    pub memory: Option<usize>,
    /// No spinner.
    pub quiet: bool,
}

/// The budget of a command, and whether it shows progress.
#[derive(clap::Args)]
pub struct Budget {
    /// The time budget [s] (default: none)
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,
    /// The memory budget [MiB] (default: none)
    #[arg(long, value_name = "MiB", value_parser = mebibytes)]
    memory: Option<usize>,
    /// Print neither progress nor summary
    #[arg(long)]
    pub quiet: bool,
}

impl Budget {
    /// Converts the options to limits of a session.
    pub fn limits(&self) -> Limits {
        Limits { time: self.time, memory: self.memory, terms: None, quiet: self.quiet }
    }
}

/// A watch with its spinner, which is removed when the session ends.
pub struct Session {
    /// The watch for the work.
    pub watch: Watch,
    spinner: Option<ProgressBar>,
    /// The guard of the budgets runs until this is dropped.
    _alive: Arc<()>,
}

impl Session {
    /// Starts to listen for Ctrl-C and to show progress.
    pub fn start(limits: Limits) -> Result<Session> {
        let mut watch = Watch::none().with_cancel(interrupted()?);
        if let Some(time) = limits.time {
            watch = watch.with_time(time);
        }
        if let Some(terms) = limits.terms {
            watch = watch.with_terms(terms);
        }
        let (alive, mut most) = (Arc::new(()), None);
        if let Some(bytes) = limits.memory {
            watch = watch.with_memory(bytes);
            if let Some(meter) = meter(&alive) {
                watch = watch.with_meter(Arc::clone(&meter));
                most = Some((meter, bytes + bytes / 4));
            }
        }
        let spinner = (!limits.quiet && stderr().is_terminal()).then(spinner);
        if let Some(bar) = spinner.clone() {
            watch = watch.with_listener(move |progress| {
                bar.set_message(progress.to_string());
            });
        }
        guard(watch.clone(), Arc::downgrade(&alive), most, spinner.clone());
        Ok(Session { watch, spinner, _alive: alive })
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if let Some(spinner) = &self.spinner {
            spinner.finish_and_clear();
        }
    }
}

/// The interval between two checks of the budgets from outside the work.
const PERIOD: Duration = Duration::from_millis(20);
/// The time that work may continue after the watch has stopped. Most work checks the watch more often.
const GRACE: Duration = Duration::from_secs(1);

/// Ends the process if the work continues for more than [`GRACE`] after the watch has stopped, as in steps that do not
/// check it. Ends it at once if more memory is in use than `most`.
fn guard(watch: Watch, alive: Weak<()>, most: Option<(Arc<AtomicUsize>, usize)>, spinner: Option<ProgressBar>) {
    let is_urgent = move || most.as_ref().is_some_and(|(meter, most)| meter.load(Ordering::Relaxed) > *most);
    std::thread::spawn(move || {
        let mut late = None;
        while alive.strong_count() > 0 {
            match watch.check() {
                Ok(()) => late = None,
                Err(error) => {
                    let since = *late.get_or_insert_with(Instant::now);
                    if (since.elapsed() > GRACE || is_urgent()) && alive.strong_count() > 0 {
                        spinner.iter().for_each(ProgressBar::finish_and_clear);
                        end(&error);
                    }
                }
            }
            std::thread::sleep(PERIOD);
        }
    });
}

/// Reports the error and ends the process, at a time when no file is half-written.
fn end(error: &Error) -> ! {
    let _stopped = stop_writers();
    std::process::exit(i32::from(super::status(&Err(super::Halt::Error(error.clone())))))
}

/// The flag that Ctrl-C sets. Work ends at its next check. If there is no check, the process ends after [`GRACE`], and
/// at once when Ctrl-C is pressed again.
///
/// # Errors
/// [`ErrorKind::Io`] where the system does not permit a handler.
pub fn interrupted() -> Result<Arc<AtomicBool>> {
    static FLAG: OnceLock<Result<Arc<AtomicBool>>> = OnceLock::new();
    FLAG.get_or_init(|| {
        let flag = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&flag);
        let cancelled = || Error::new(ErrorKind::Cancelled, "interrupted");
        let interrupt = move || {
            // The flag is held here and in its cell. Without a third holder, no work checks it.
            if seen.swap(true, Ordering::Relaxed) || Arc::strong_count(&seen) == 2 {
                end(&cancelled());
            }
            std::thread::spawn(move || {
                std::thread::sleep(GRACE);
                end(&cancelled());
            });
        };
        let caught = ctrlc::set_handler(interrupt);
        caught.map_err(|error| Error::new(ErrorKind::Io, format!("Ctrl-C cannot be caught: {error}")))?;
        Ok(flag)
    })
    .clone()
}

/// Fails if Ctrl-C was pressed before the first result is written or printed; output that has begun is completed.
///
/// # Errors
/// [`ErrorKind::Cancelled`].
pub fn begin_output() -> Result<()> {
    static BEGUN: AtomicBool = AtomicBool::new(false);
    if !BEGUN.load(Ordering::Relaxed) {
        if interrupted().is_ok_and(|flag| flag.load(Ordering::Relaxed)) {
            return Err(Error::new(ErrorKind::Cancelled, "interrupted"));
        }
        BEGUN.store(true, Ordering::Relaxed);
    }
    Ok(())
}

/// The memory of this process in bytes, updated until `alive` is dropped. `None` if the system does not report it.
fn meter(alive: &Arc<()>) -> Option<Arc<AtomicUsize>> {
    let meter = Arc::new(AtomicUsize::new(resident_bytes()?));
    let (kept, alive) = (Arc::clone(&meter), Arc::downgrade(alive));
    std::thread::spawn(move || {
        while let (true, Some(bytes)) = (alive.strong_count() > 0, resident_bytes()) {
            kept.store(bytes, Ordering::Relaxed);
            std::thread::sleep(PERIOD);
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
