//! Writes targets and their solutions by the Rust run time, which compare.c reads: words of 64 bits, each a number in double precision.
#[allow(dead_code)]
mod puma;

use groebot_runtime::Error;
use puma::{CAPACITY, INPUTS, JOINTS, Pairs, Solution, Solve, Solver};
use std::fs::File;
use std::io::{BufWriter, Write};

/// Joint values of singular and nearly singular poses.
const SPECIAL: [f64; 7] = [0.0, 1e-9, 1.5707963267948966, 1e-5, 3.141592653589793, 1e-3, -1.5707963267948966];

/// Random numbers in [0, 1): xorshift64 (G. Marsaglia, "Xorshift RNGs", 2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The pose that random joint values reach. Every tenth is singular or nearly so, some are invalid, and some are out of reach.
fn target(number: usize, random: &mut Random) -> [f64; INPUTS] {
    let mut q: [f64; JOINTS] = core::array::from_fn(|_| (2.0 * random.next() - 1.0) * 3.1415);
    if number % 10 == 0 {
        q[number / 10 % JOINTS] = SPECIAL[number / 10 / JOINTS % SPECIAL.len()];
    }
    if number % 50 == 7 {
        q = q.map(|value| if random.next() < 0.6 { SPECIAL[(random.next() * 7.0) as usize] } else { value });
    }
    let mut target = Solver.forward(&q).expect("the joint values determine the pose");
    match number {
        _ if number % 97 == 13 => target[0] += random.next() - 0.5,
        _ if number % 997 == 14 => target[number / 997 % INPUTS] = [f64::NAN, f64::INFINITY, 7.0][number % 3],
        _ if number % 499 == 15 => (target[0], target[2]) = (0.0, 0.0),
        _ => (),
    }
    target
}

fn code(error: Error) -> f64 {
    match error {
        Error::NotFinite => -1.0,
        Error::OpenStratum(_) => -2.0,
        Error::NotRotation => -3.0,
        Error::Unsettled => -5.0,
        _ => -4.0,
    }
}

fn write(file: &mut impl Write, numbers: &[f64]) -> std::io::Result<()> {
    numbers.iter().try_for_each(|number| file.write_all(&number.to_ne_bytes()))
}

fn write_solutions(file: &mut impl Write, count: Result<usize, Error>, out: &[Solution]) -> std::io::Result<()> {
    write(file, &[count.map_or_else(code, |count| count as f64)])?;
    out[..count.unwrap_or(0)].iter().try_for_each(|a| {
        write(file, &a.q)?;
        let flags = [a.chosen, a.settled].map(|flag| f64::from(u8::from(flag)));
        write(file, &[a.residual, a.relative, a.branch as f64, flags[0], flags[1], f64::from(a.free)])
    })
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let mut file = BufWriter::new(File::create(&arguments[1])?);
    let mut random = Random(88_172_645_463_325_252);
    let mut out: Vec<Solution> = vec![Solution::empty(&Solver); CAPACITY];
    let mut pairs: Vec<Pairs> = vec![Pairs::empty(&Solver); CAPACITY];
    for number in 0..20_000 {
        let target = target(number, &mut random);
        write(&mut file, &target)?;
        let count = Solver.solve(&target, &mut out);
        write_solutions(&mut file, count, &out)?;
        let count = Solver.solve_bounded(&target, number % 256, &mut out);
        write_solutions(&mut file, count, &out)?;
        let count = Solver.solve_pairs(&target, &mut pairs);
        write(&mut file, &[count.map_or_else(code, |count| count as f64)])?;
        for a in &pairs[..count.unwrap_or(0)] {
            write(&mut file, a.joints.as_flattened())?;
            write(&mut file, &[a.residual, a.branch as f64, f64::from(a.free)])?;
        }
        let nearest = Solver.solve_or_nearest(&target, &mut out).ok().and_then(|found| found.1);
        write(&mut file, &[nearest.map_or(f64::INFINITY, |nearest| nearest.residual)])?;
    }
    file.flush()
}
