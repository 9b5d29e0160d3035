//! Time of a pose with all its solutions, and with the feature `counters` the time of each phase.

use std::hint::black_box;
use std::time::Instant;

use groebot_runtime::mechanism::Inputs;
use groebot_runtime::{Solution, Solve};

use crate::counts::sets_of;
use crate::path::Chain;

/// Number of slowest poses that are measured again, and number of repetitions.
const SLOWEST: usize = 5;
const REPEATS: usize = 20;

pub fn head() {
    println!("robot,set,poses,us_mean,us_median,us_worst{}", phases::HEAD);
}

pub fn print<M: Solve>(name: &str, mechanism: &M, joints: &[&str], poses: usize) {
    let mut out = vec![Solution::empty(mechanism); mechanism.facts().capacity];
    let mut time = |target: &Inputs<M>| {
        let start = Instant::now();
        let _ = black_box(mechanism.solve(black_box(target), &mut out));
        let time = start.elapsed().as_secs_f64() * 1e6;
        phases::end_of_pose();
        time
    };
    for set in sets_of(name, mechanism, joints, poses) {
        let row = |q: &Vec<f64>| mechanism.forward(&Chain(mechanism).row(q)).expect("a chain has forward kinematics");
        let targets: Vec<_> = set.joints.iter().map(row).collect();
        phases::start();
        let mut times: Vec<(f64, usize)> = targets.iter().map(&mut time).zip(0..).collect();
        let taken = phases::taken(targets.len());
        // Interference by other programs rarely affects a pose twice.
        for (first, index) in &mut times {
            *first = f64::min(*first, time(&targets[*index]));
        }
        let mean = times.iter().map(|(time, _)| time).sum::<f64>() / times.len() as f64;
        times.sort_by(|a, b| b.0.total_cmp(&a.0));
        let median = times[times.len() / 2].0;
        let mut least = |index: usize| (0..REPEATS).map(|_| time(&targets[index])).fold(f64::INFINITY, f64::min);
        let worst = times.iter().take(SLOWEST).map(|(_, index)| least(*index)).fold(0.0, f64::max);
        println!("{name},\"{}\",{},{mean:.2},{median:.2},{worst:.1}{taken}", set.name, targets.len());
    }
}

#[cfg(not(feature = "counters"))]
mod phases {
    pub const HEAD: &str = "";

    pub fn start() {}

    pub fn end_of_pose() {}

    pub fn taken(_: usize) -> &'static str {
        ""
    }
}

#[cfg(feature = "counters")]
mod phases {
    use std::cell::Cell;

    use groebot_runtime::counters::{Event, Phase, take};

    /// The maximum number of steps of a pose. For each phase: calls, steps, short steps and evaluations per pose, and the fraction of the time in percent.
    pub const HEAD: &str = ",most_steps,phases";

    type Counts = [[u64; Event::ALL.len()]; Phase::ALL.len()];

    thread_local! {
        static COUNTS: Cell<Counts> = const { Cell::new([[0; Event::ALL.len()]; Phase::ALL.len()]) };
        static MOST: Cell<u64> = const { Cell::new(0) };
    }

    pub fn start() {
        take();
        COUNTS.set(Counts::default());
        MOST.set(0);
    }

    /// Adds the counters of a pose.
    pub fn end_of_pose() {
        let (counts, mut all) = (take(), COUNTS.get());
        all.iter_mut().flatten().zip(counts.iter().flatten()).for_each(|(sum, count)| *sum += count);
        COUNTS.set(all);
        let steps = |row: &[u64; Event::ALL.len()]| row[Event::Step as usize] + row[Event::Evaluation as usize];
        MOST.set(MOST.get().max(counts.iter().map(steps).sum()));
    }

    pub fn taken(poses: usize) -> String {
        let counts = COUNTS.get();
        let time = |row: &[u64; Event::ALL.len()]| row[Event::Time as usize] as f64;
        let whole: f64 = counts.iter().map(time).sum();
        let mut text = format!(",{}", MOST.get());
        for (phase, row) in Phase::ALL.iter().zip(&counts).filter(|(phase, row)| **phase == Phase::Walk || row[0] > 0) {
            let each = |event: Event| row[event as usize] as f64 / poses as f64;
            text += &format!(
                ",{phase:?} {:.2} calls {:.1} steps {:.1} short {:.1} evaluations {:.0} %",
                each(Event::Call),
                each(Event::Step),
                each(Event::Short),
                each(Event::Evaluation),
                100.0 * time(row) / whole
            );
        }
        text
    }
}
