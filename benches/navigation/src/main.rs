//! Times of distance fields compared with scikit-fmm and scikit-image: one interleaved run, medians of processor time, and the memory peak.

mod maps;
mod measure;
mod peers;

use std::hint::black_box;

use groebot::Watch;
use groebot::nav::{Field, Map, Method, Shape, Window};
use nalgebra::{Point2, Vector2};

use measure::{Peak, median, now};
use peers::Peers;

/// Number of calls of each groebot method in a round.
const CALLS: usize = 3;
/// Cells of a side, and number of rounds. The median of all calls is reported.
const SIDES: [(usize, usize); 3] = [(400, 7), (1000, 5), (2000, 3)];

/// A contender with its results: nanoseconds of each round, and the maximum number of bytes.
struct Contender<'a> {
    who: &'static str,
    /// The measured call. Its inputs are prepared before.
    run: Box<dyn Fn() -> (f64, usize) + 'a>,
    times: Vec<f64>,
    bytes: usize,
}

/// A floor with a goal, and the same floor with a chair.
struct Case {
    map: Map,
    goal: Point2<f64>,
    with_chair: Map,
    chair: usize,
}

impl Case {
    fn new(map: Map) -> Self {
        let goal = map.centre(maps::goal(&map));
        let reach = map.columns() as f64 * map.resolution();
        let place = goal + Vector2::new(0.2 * reach, 0.2 * reach);
        let with_chair = map.with(&[Shape::rectangle(place, 0.5, 0.5, 0.3)]).unwrap();
        let chair = map.cell_at(&place).unwrap();
        Case { map, goal, with_chair, chair }
    }

    fn field(&self, method: Method) -> Field {
        Field::new(&self.map, &[self.goal], method, &Watch::none()).unwrap()
    }

    fn contenders(&self) -> Vec<Contender<'_>> {
        let whole = |who, method| contender(who, move || measured(|| self.field(method)));
        let first = self.field(Method::FastMarching(1));
        let (window, again) = (Window::around(&self.map, self.chair, 50), first.clone());
        vec![
            whole("M3R", Method::M3r),
            whole("fast marching 1", Method::FastMarching(1)),
            whole("fast marching 2", Method::FastMarching(2)),
            contender("window of 101 x 101", move || {
                let field = first.clone();
                measured(|| field.within(&self.with_chair, &window, &Watch::none()).unwrap())
            }),
            contender("after a chair", move || {
                let field = again.clone();
                measured(|| field.after(&self.with_chair, &Watch::none()).unwrap())
            }),
        ]
    }
}

fn contender<'a>(who: &'static str, run: impl Fn() -> (f64, usize) + 'a) -> Contender<'a> {
    Contender { who, run: Box::new(run), times: Vec::new(), bytes: 0 }
}

/// The time of a call and its memory peak.
fn measured<T>(run: impl FnOnce() -> T) -> (f64, usize) {
    let (peak, from) = (Peak::from_here(), now());
    let value = black_box(run());
    let time = now() - from;
    drop(value);
    (time, peak.bytes())
}

fn main() {
    let most: usize =
        std::env::args().nth(1).map_or(usize::MAX, |side| side.parse().expect("the most cells of a side"));
    let mut peers = Peers::start();
    println!("side,floor,speeds,who,median_ms,ns_per_cell,share_of_skfmm,bytes_per_cell");
    for (side, rounds) in SIDES.into_iter().filter(|(side, _)| *side <= most) {
        for (floor, kind) in maps::FLOORS {
            let even = maps::map(kind, side);
            for (speeds, map) in [("even", even.clone()), ("varying", maps::with_speeds(even))] {
                contest(&mut peers, &format!("{side},{floor},{speeds}"), &Case::new(map), rounds);
            }
        }
    }
}

/// The contenders take turns, round by round.
fn contest(peers: &mut Peers, name: &str, case: &Case, rounds: usize) {
    let mut contenders = case.contenders();
    let mut others: [(&str, Vec<f64>); 2] = [("skfmm order 1", Vec::new()), ("MCP_Geometric", Vec::new())];
    peers.give(&case.map, maps::goal(&case.map));
    for _ in 0..rounds {
        for contender in &mut contenders {
            for _ in 0..CALLS {
                let (time, bytes) = (contender.run)();
                contender.times.push(time);
                contender.bytes = contender.bytes.max(bytes);
            }
        }
        peers.times().into_iter().zip(&mut others).for_each(|(time, (_, times))| times.push(time));
    }
    let (cells, base) = (case.map.cells().len() as f64, median(&mut others[0].1));
    let row = |who: &str, time: f64, bytes: String| {
        println!("{name},{who},{:.3},{:.2},{:.4},{bytes}", time * 1e-6, time / cells, time / base);
    };
    for contender in &mut contenders {
        row(contender.who, median(&mut contender.times), format!("{:.1}", contender.bytes as f64 / cells));
    }
    others.iter_mut().for_each(|(who, times)| row(who, median(times), String::new()));
}
