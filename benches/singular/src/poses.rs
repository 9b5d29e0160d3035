//! Pseudorandom joint values: general ones, ones next to singular ones, and multiples of a right angle.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use groebot_runtime::Solve;

use crate::path::Chain;

/// Random numbers (xorshift, G. Marsaglia 2003).
pub struct Random(u64);

impl Random {
    pub fn new() -> Self {
        Random(88_172_645_463_325_252)
    }

    /// In `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn angle(&mut self) -> f64 {
        PI - 2.0 * PI * self.unit()
    }

    fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { -1.0 } else { 1.0 }
    }

    /// A multiple of a right angle.
    fn corner(&mut self) -> f64 {
        [-FRAC_PI_2, 0.0, FRAC_PI_2, PI][(4.0 * self.unit()) as usize]
    }
}

/// A set of joint values with its name.
pub struct Set {
    pub name: String,
    pub joints: Vec<Vec<f64>>,
}

impl Set {
    fn new(name: String, count: usize, mut joints: impl FnMut(&mut Random) -> Vec<f64>) -> Self {
        let mut random = Random::new();
        Set { name, joints: (0..count).map(|_| joints(&mut random)).collect() }
    }
}

/// All sets of a robot with six angles, with `count` poses each.
pub fn sets<M: Solve>(chain: &Chain<'_, M>, names: &[&str], count: usize) -> Vec<Set> {
    let anywhere = |random: &mut Random| (0..chain.joints()).map(|_| random.angle()).collect::<Vec<f64>>();
    let mut sets = vec![Set::new("random".into(), count, anywhere)];
    for (joint, values) in singular(chain) {
        let place = |random: &mut Random, route: f64| {
            let mut q = anywhere(random);
            let value = values[(values.len() as f64 * random.unit()) as usize];
            q[joint] = value;
            q[joint] = exactly(chain, &q, joint) + random.sign() * route;
            q
        };
        let name = names[joint];
        for digits in (3..=14).filter(|digits| *digits < 11 || digits % 2 == 0) {
            let route = 10_f64.powi(-digits);
            sets.push(Set::new(format!("{name} 1e-{digits}"), count, |random| place(random, route)));
        }
        sets.push(Set::new(format!("{name} 0"), count, |random| place(random, 0.0)));
    }
    let corners = |random: &mut Random| -> Vec<f64> {
        (0..chain.joints()).map(|_| if random.unit() < 0.4 { random.angle() } else { random.corner() }).collect()
    };
    sets.push(Set::new("corners".into(), count, corners));
    sets.push(Set::new("corners, noise".into(), count, |random| {
        let noise = |random: &mut Random| random.sign() * 10_f64.powf(-3.0 - 11.0 * random.unit());
        corners(random).iter().map(|value| value + noise(random)).collect()
    }));
    sets.push(Set::new("grid".into(), count, |random| (0..chain.joints()).map(|_| random.corner()).collect()));
    sets
}

/// A UR5 arm with straight elbow and wrist and with the wrist's offset in line, which has several singularities at
/// once.
pub fn stretched(count: usize) -> Set {
    Set::new("stretched".into(), count, |random| {
        let [pan, lift, last] = [(); 3].map(|()| random.angle());
        let wrist = if random.unit() < 0.5 { 0.0 } else { PI };
        vec![pan, lift, 0.0, -FRAC_PI_2, wrist, last]
    })
}

/// The joints that make a robot singular for all values of the others, each with its values.
fn singular<M: Solve>(chain: &Chain<'_, M>) -> Vec<(usize, Vec<f64>)> {
    let mut random = Random::new();
    let bases: Vec<Vec<f64>> = (0..3).map(|_| (0..chain.joints()).map(|_| random.angle()).collect()).collect();
    let common = |joint: usize| -> Vec<f64> {
        let lists: Vec<Vec<f64>> = bases.iter().map(|q| roots(chain, q, joint)).collect();
        let is_in = |list: &Vec<f64>, value: f64| list.iter().any(|other| (other - value).abs() < 1e-3);
        lists[0].iter().copied().filter(|value| lists.iter().all(|list| is_in(list, *value))).collect()
    };
    let all = (0..chain.joints()).map(|joint| (joint, common(joint)));
    all.filter(|(_, values)| !values.is_empty()).collect()
}

/// The values of a joint at which the determinant changes its sign.
fn roots<M: Solve>(chain: &Chain<'_, M>, q: &[f64], joint: usize) -> Vec<f64> {
    const PARTS: usize = 360;
    let place = |k: usize| -PI + 0.0123 + k as f64 * 2.0 * PI / PARTS as f64;
    let mut values = Vec::new();
    for k in 0..PARTS {
        values.extend(root(chain, q, joint, [place(k), place(k + 1)]));
    }
    values
}

/// The root in an interval.
fn root<M: Solve>(chain: &Chain<'_, M>, q: &[f64], joint: usize, [mut low, mut high]: [f64; 2]) -> Option<f64> {
    let mut q = q.to_vec();
    let mut at = |value: f64| {
        q[joint] = value;
        chain.determinant(&q)
    };
    let sign = at(low);
    if sign * at(high) > 0.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if sign * at(middle) > 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// The root next to a joint's value; a multiple of 45 degrees if it is one.
fn exactly<M: Solve>(chain: &Chain<'_, M>, q: &[f64], joint: usize) -> f64 {
    let value = root(chain, q, joint, [q[joint] - 2e-3, q[joint] + 2e-3]).unwrap_or(q[joint]);
    let round = (value / FRAC_PI_4).round() * FRAC_PI_4;
    if (round - value).abs() < 1e-7 { round } else { value }
}
