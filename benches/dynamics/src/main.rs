//! Times of equations of motion, as generated code and by the library, compared with Pinocchio: one interleaved run, medians of processor time.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::{CString, c_char, c_double, c_int};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use groebot::dynamics::{Base, Equations, State};
use groebot::model::{JointType, Robot};

#[allow(dead_code, unused_variables, clippy::all)]
mod ur5 {
    include!(concat!(env!("OUT_DIR"), "/ur5.rs"));
}
#[allow(dead_code, unused_variables, clippy::all)]
mod panda {
    include!(concat!(env!("OUT_DIR"), "/panda.rs"));
}
#[allow(dead_code, unused_variables, clippy::all)]
mod humanoid {
    include!(concat!(env!("OUT_DIR"), "/humanoid.rs"));
}

/// Number of states that each contender computes.
const STATES: usize = 256;
/// Number of rounds. The median is reported.
const ROUNDS: usize = 61;
const FUNCTIONS: [&str; 6] = ["inverse", "gravity", "inertia", "coriolis", "forward", "derivatives"];

/// SplitMix64 (Steele, Lea and Flood 2014), numbers between -1 and 1.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn numbers(&mut self, count: usize, most: f64) -> Vec<f64> {
        (0..count).map(|_| most * self.number()).collect()
    }
}

/// Processor time of this thread, ns.
fn now() -> f64 {
    #[repr(C)]
    struct Time {
        seconds: i64,
        nanoseconds: i64,
    }
    unsafe extern "C" {
        fn clock_gettime(clock: c_int, time: *mut Time) -> c_int;
    }
    const THREAD: c_int = 3;
    let mut time = Time { seconds: 0, nanoseconds: 0 };
    // SAFETY: the structure is Linux' timespec.
    unsafe { clock_gettime(THREAD, &mut time) };
    time.seconds as f64 * 1e9 + time.nanoseconds as f64
}

/// Counts allocations. Calls of the library must not allocate.
struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all calls are forwarded to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A contender: one call computes all states.
struct Contender<'a> {
    who: &'static str,
    function: usize,
    run: Box<dyn FnMut() + 'a>,
}

struct Case {
    name: &'static str,
    file: PathBuf,
    held: &'static [&'static str],
    base: Base,
}

struct States {
    q: Vec<Vec<f64>>,
    v: Vec<Vec<f64>>,
    a: Vec<Vec<f64>>,
}

fn states(equations: &Equations, base: Base) -> States {
    let (mut random, joints, count) = (Random(1), equations.joints().len(), equations.freedoms());
    let mut q = || {
        let mut q = if base == Base::Floating { random.numbers(7, 1.0) } else { Vec::new() };
        if base == Base::Floating {
            let length = q[3..].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[3..].iter_mut().for_each(|x| *x /= length);
        }
        q.extend(random.numbers(joints, 1.5));
        q
    };
    let q = (0..STATES).map(|_| q()).collect();
    let mut list = || (0..STATES).map(|_| random.numbers(count, 1.0)).collect();
    States { q, v: list(), a: list() }
}

/// The library, applied to the description.
fn library<'a>(equations: &'a Equations, states: &'a States) -> Vec<Contender<'a>> {
    let contender = |function: usize| {
        let mut room = equations.workspace();
        let run = move || {
            for ((q, v), a) in states.q.iter().zip(&states.v).zip(&states.a) {
                let state = State::new(q, v);
                match function {
                    0 => drop(black_box(equations.inverse(&mut room, state, a).unwrap()[0])),
                    1 => drop(black_box(equations.gravity(&mut room, q).unwrap()[0])),
                    2 => drop(black_box(equations.inertia(&mut room, q).unwrap()[0])),
                    3 => drop(black_box(equations.coriolis(&mut room, state).unwrap()[0])),
                    4 => drop(black_box(equations.forward(&mut room, state, a).unwrap()[0])),
                    _ => drop(black_box(equations.derivatives(&mut room, state, a).unwrap()[0][0])),
                }
            }
        };
        Contender { who: "library", function, run: Box::new(run) }
    };
    (0..6).map(contender).collect()
}

macro_rules! printed {
    ($module:ident, $count:literal, $states:expr, $c:ident) => {{
        fn fixed<const N: usize>(lists: &[Vec<f64>]) -> Vec<[f64; N]> {
            lists.iter().map(|list| list.as_slice().try_into().unwrap()).collect()
        }
        let (places, rates) = (fixed::<{ $module::COORDINATES }>(&$states.q), [&$states.v, &$states.a]);
        let rates = rates.map(|lists| fixed::<$count>(lists));
        let all = || (places.clone(), rates.clone());
        let mut contenders = Vec::new();
        for function in 0..6 {
            let (q, [v, a]) = all();
            let run = move || {
                for i in 0..STATES {
                    let (q, v, a) = (black_box(&q[i]), &v[i], &a[i]);
                    match function {
                        0 => drop(black_box($module::inverse(q, v, a))),
                        1 => drop(black_box($module::gravity(q))),
                        2 => drop(black_box($module::inertia(q))),
                        3 => drop(black_box($module::coriolis(q, v))),
                        4 => drop(black_box($module::forward(q, v, a))),
                        _ => drop(black_box($module::derivatives(q, v, a))),
                    }
                }
            };
            contenders.push(Contender { who: "printed Rust", function, run: Box::new(run) });
            let (q, [v, a]) = all();
            let mut out = [[0.0; $count * $count]; 2];
            let run = move || {
                for i in 0..STATES {
                    let (q, v, a) = (black_box(&q[i]).as_ptr(), v[i].as_ptr(), a[i].as_ptr());
                    let [first, second] = &mut out;
                    let (first, second) = (first.as_mut_ptr(), second.as_mut_ptr());
                    // SAFETY: the arrays have the lengths in the generated header.
                    unsafe {
                        match function {
                            0 => $c::inverse(q, v, a, first),
                            1 => $c::gravity(q, first),
                            2 => $c::inertia(q, first),
                            3 => $c::coriolis(q, v, first),
                            4 => $c::forward(q, v, a, first),
                            _ => $c::derivatives(q, v, a, first, second),
                        }
                    }
                    black_box(&out);
                }
            };
            contenders.push(Contender { who: "printed C", function, run: Box::new(run) });
        }
        contenders
    }};
}

macro_rules! c_functions {
    ($module:ident, $inverse:literal, $gravity:literal, $inertia:literal, $coriolis:literal, $forward:literal, $derivatives:literal) => {
        mod $module {
            unsafe extern "C" {
                #[link_name = $inverse]
                pub fn inverse(q: *const f64, v: *const f64, a: *const f64, out: *mut f64);
                #[link_name = $gravity]
                pub fn gravity(q: *const f64, out: *mut f64);
                #[link_name = $inertia]
                pub fn inertia(q: *const f64, out: *mut f64);
                #[link_name = $coriolis]
                pub fn coriolis(q: *const f64, v: *const f64, out: *mut f64);
                #[link_name = $forward]
                pub fn forward(q: *const f64, v: *const f64, tau: *const f64, out: *mut f64);
                #[link_name = $derivatives]
                pub fn derivatives(q: *const f64, v: *const f64, a: *const f64, by_q: *mut f64, by_v: *mut f64);
            }
        }
    };
}
c_functions!(c_ur5, "ur5_inverse", "ur5_gravity", "ur5_inertia", "ur5_coriolis", "ur5_forward", "ur5_derivatives");
c_functions!(
    c_panda,
    "panda_inverse",
    "panda_gravity",
    "panda_inertia",
    "panda_coriolis",
    "panda_forward",
    "panda_derivatives"
);
c_functions!(
    c_humanoid,
    "humanoid_inverse",
    "humanoid_gravity",
    "humanoid_inertia",
    "humanoid_coriolis",
    "humanoid_forward",
    "humanoid_derivatives"
);

#[cfg(pinocchio)]
mod pinocchio {
    use super::*;

    enum Handle {}

    unsafe extern "C" {
        fn pinocchio_new(file: *const c_char, held: *const *const c_char, floats: bool, states: c_int) -> *mut Handle;
        fn pinocchio_freedoms(robot: *const Handle) -> c_int;
        fn pinocchio_run(robot: *mut Handle, function: c_int) -> c_double;
    }

    pub fn contenders<'a>(case: &Case, freedoms: usize) -> Vec<Contender<'a>> {
        let text = |text: &str| CString::new(text).unwrap();
        let held: Vec<CString> = case.held.iter().map(|name| text(name)).collect();
        let held: Vec<*const c_char> = held.iter().map(|name| name.as_ptr()).chain([std::ptr::null()]).collect();
        let file = text(case.file.to_str().unwrap());
        // SAFETY: all texts end with a zero, the list with a null; the robot is never freed.
        let robot =
            unsafe { pinocchio_new(file.as_ptr(), held.as_ptr(), case.base == Base::Floating, STATES as c_int) };
        assert_eq!(unsafe { pinocchio_freedoms(robot) } as usize, freedoms, "{}", case.name);
        let run = |which: c_int| Box::new(move || drop(black_box(unsafe { pinocchio_run(robot, which) })));
        let own = (0..6).map(|function| Contender { who: "Pinocchio", function, run: run(function as c_int) });
        // Pinocchio has two methods for each quantity. The faster one is reported.
        let others =
            [(2, 6), (4, 7)].map(|(function, which)| Contender { who: "Pinocchio", function, run: run(which) });
        own.chain(others).collect()
    }
}

#[cfg(not(pinocchio))]
mod pinocchio {
    use super::*;

    pub fn contenders<'a>(_: &Case, _: usize) -> Vec<Contender<'a>> {
        let _: (Option<CString>, Option<c_char>, Option<c_double>) = (None, None, None);
        Vec::new()
    }
}

fn robot(case: &Case) -> Robot {
    let text = std::fs::read_to_string(&case.file).unwrap();
    let mut parts = Robot::from_urdf(&text).unwrap().parts().clone();
    for joint in parts.joints.iter_mut() {
        joint.mimic = None;
        if case.held.contains(&joint.name.as_str()) {
            (joint.kind, joint.limits) = (JointType::Fixed, None);
        }
    }
    Robot::new(parts).unwrap()
}

fn main() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus/dynamics");
    let fingers: &[&str] = &["panda_finger_joint1", "panda_finger_joint2"];
    let case = |name, file: PathBuf, held, base| Case { name, file, held, base };
    let mut cases = vec![
        case("ur5", corpus.join("ur5.urdf"), &[][..], Base::Fixed),
        case("panda", corpus.join("panda.urdf"), fingers, Base::Fixed),
        case("humanoid", corpus.join("humanoid.urdf"), &[], Base::Floating),
    ];
    if let Some(prefix) = option_env!("PINOCCHIO") {
        let talos = Path::new(prefix).join("share/example-robot-data/robots/talos_data/robots/talos_reduced.urdf");
        cases.push(case("talos", talos, &[], Base::Floating));
    }
    println!("robot,freedoms,function,who,median_ns,share_of_pinocchio");
    for case in &cases {
        let robot = robot(case);
        let equations = Equations::unchecked(&robot, case.base).unwrap().without_friction();
        let states = states(&equations, case.base);
        let mut contenders = pinocchio::contenders(case, equations.freedoms());
        contenders.extend(library(&equations, &states));
        match case.name {
            "ur5" => contenders.extend(printed!(ur5, 6, states, c_ur5)),
            "panda" => contenders.extend(printed!(panda, 7, states, c_panda)),
            "humanoid" => contenders.extend(printed!(humanoid, 35, states, c_humanoid)),
            _ => {}
        }
        let mut times = vec![Vec::with_capacity(ROUNDS); contenders.len()];
        for _ in 0..ROUNDS {
            for (contender, times) in contenders.iter_mut().zip(&mut times) {
                let (start, before) = (now(), ALLOCATIONS.load(Ordering::Relaxed));
                (contender.run)();
                let taken = (now() - start) / STATES as f64;
                let allocated = ALLOCATIONS.load(Ordering::Relaxed) - before;
                times.push(taken);
                assert!(contender.who != "library" || allocated == 0, "{} allocates", FUNCTIONS[contender.function]);
            }
        }
        let median = |times: &mut Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        };
        let medians: Vec<f64> = times.iter_mut().map(median).collect();
        for (function, name) in FUNCTIONS.iter().enumerate() {
            let of = |who: &str| {
                let own = contenders.iter().zip(&medians);
                own.filter(|(one, _)| one.who == who && one.function == function).map(|(_, ns)| *ns).reduce(f64::min)
            };
            for who in ["Pinocchio", "library", "printed Rust", "printed C"] {
                let Some(ns) = of(who) else { continue };
                let share = of("Pinocchio").map_or(String::new(), |peer| format!("{:.3}", ns / peer));
                println!("{},{},{name},{who},{ns:.0},{share}", case.name, equations.freedoms());
            }
        }
    }
}
