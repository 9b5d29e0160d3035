//! The measurement. Contenders take turns, round by round, so that a change of the machine's speed affects all of them. The processor time is measured. The
//! result is written in Criterion's format, for `record_benches` of the main package.

use std::fmt::Write as _;
use std::fs;
use std::io::Result;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Number of rounds of a measurement.
const ROUNDS: usize = 101;
/// Minimum time of one contender in one round.
const TURN: Duration = Duration::from_millis(4);

/// One method: a call processes all inputs once.
pub struct Contender<'a> {
    name: &'a str,
    pass: Box<dyn FnMut() + 'a>,
}

impl<'a> Contender<'a> {
    /// Builds the contender `name`. `pass` processes all inputs once and hides its results from the optimiser.
    pub fn new(name: &'a str, pass: impl FnMut() + 'a) -> Self {
        Contender { name, pass: Box::new(pass) }
    }

    fn time(&mut self, passes: u32) -> Duration {
        let start = processor_time();
        for _ in 0..passes {
            (self.pass)();
        }
        processor_time() - start
    }

    /// Number of calls that fill a turn.
    fn passes(&mut self) -> u32 {
        let mut passes = 1;
        while self.time(passes) < TURN {
            passes *= 2;
        }
        passes
    }
}

/// The processor time of this thread, which does not include other processes.
#[cfg(target_os = "linux")]
fn processor_time() -> Duration {
    #[repr(C)]
    struct Time {
        seconds: i64,
        nanoseconds: i64,
    }
    unsafe extern "C" {
        fn clock_gettime(clock: i32, time: *mut Time) -> i32;
    }
    const CLOCK_THREAD_CPUTIME_ID: i32 = 3;
    let mut time = Time { seconds: 0, nanoseconds: 0 };
    // SAFETY: the C library fills in the two numbers of its `struct timespec`, which are of 64 bits on machines of 64 bits.
    let failed = unsafe { clock_gettime(CLOCK_THREAD_CPUTIME_ID, &mut time) };
    assert_eq!(failed, 0, "a clock of this thread");
    Duration::new(time.seconds as u64, time.nanoseconds as u32)
}

/// The time since the first call.
#[cfg(not(target_os = "linux"))]
fn processor_time() -> Duration {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed()
}

/// Times per input \[ns\] of one contender.
struct Samples {
    bench: String,
    sorted: Vec<f64>,
}

impl Samples {
    /// The median, and its 95 % confidence interval by order statistics.
    fn median(&self) -> [f64; 3] {
        let n = self.sorted.len() as f64;
        let at = |rank: f64| self.sorted[(rank.max(0.0) as usize).min(self.sorted.len() - 1)];
        let spread = 0.98 * n.sqrt();
        [at(n / 2.0 - spread), at(n / 2.0), at(n / 2.0 + spread)]
    }

    /// Writes the three Criterion files from which the record is made.
    fn write(&self, target: &Path) -> Result<()> {
        let folder = target.join("criterion").join(&self.bench).join("new");
        fs::create_dir_all(&folder)?;
        let [low, median, high] = self.median();
        let interval = format!(r#"{{"confidence_level":0.95,"lower_bound":{low},"upper_bound":{high}}}"#);
        let estimate = format!(r#"{{"median":{{"confidence_interval":{interval},"point_estimate":{median}}}}}"#);
        fs::write(folder.join("benchmark.json"), format!(r#"{{"full_id":"{}"}}"#, self.bench))?;
        fs::write(folder.join("sample.json"), format!(r#"{{"times":{:?}}}"#, self.sorted))?;
        fs::write(folder.join("estimates.json"), estimate)
    }
}

/// The median time per input \[ns\] of each contender, over `inputs` inputs per call and `rounds` rounds.
pub fn medians(inputs: usize, rounds: usize, contenders: &mut [Contender<'_>]) -> Vec<f64> {
    let passes: Vec<u32> = contenders.iter_mut().map(Contender::passes).collect();
    let times = times(inputs, rounds, &passes, contenders);
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.into_iter().map(median).collect()
}

/// The times per input \[ns\] of each contender in all rounds. The contenders take turns.
fn times(inputs: usize, rounds: usize, passes: &[u32], contenders: &mut [Contender<'_>]) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for round in 0..rounds {
        for turn in 0..contenders.len() {
            let i = (round + turn) % contenders.len();
            let time = contenders[i].time(passes[i]).as_secs_f64() * 1e9;
            times[i].push(time / f64::from(passes[i]) / inputs as f64);
        }
    }
    times
}

/// Measures all contenders over `inputs` inputs per call, writes the results under `group`, and returns them as lines of text.
///
/// # Errors
/// When a file cannot be written.
pub fn measure(group: &str, inputs: usize, mut contenders: Vec<Contender<'_>>) -> Result<String> {
    let passes: Vec<u32> = contenders.iter_mut().map(Contender::passes).collect();
    let times = times(inputs, ROUNDS, &passes, &mut contenders);
    let mut text = String::new();
    for (contender, mut sorted) in contenders.iter().zip(times) {
        sorted.sort_by(f64::total_cmp);
        let samples = Samples { bench: format!("{group}/{}", contender.name), sorted };
        samples.write(&target())?;
        let [low, median, high] = samples.median();
        let _ = writeln!(text, "{:<40} {median:9.1} ns  [{low:.1}, {high:.1}]", samples.bench);
    }
    Ok(text)
}

/// The folder of build output.
fn target() -> PathBuf {
    let default = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target");
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(default, PathBuf::from)
}
