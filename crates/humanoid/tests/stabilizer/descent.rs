//! The lowered torso: it is as low as the legs need, and rises gently.

#[path = "../../src/stabilizer/descent.rs"]
mod law;

use groebot_humanoid::gait::GRAVITY;

use law::{Descent, least};

/// The documented bound of the vertical acceleration, and the greatest lowering, a fraction of the height.
const GENTLE: f64 = 0.15 * GRAVITY;
const LOWEST: f64 = 0.1;

/// A robot (the height of its centre of mass \[m\], the interval \[s\]) whose legs need a lowering: points (time \[s\], fraction of the height), with straight
/// lines between them.
struct Case {
    name: &'static str,
    height: f64,
    dt: f64,
    needed: &'static [(f64, f64)],
}

const CASES: [Case; 7] = [
    Case { name: "a leg is released at once", height: 0.9, dt: 0.005, needed: &[(0.0, 0.0), (0.3, 0.08), (0.3, 0.0)] },
    Case { name: "from the lowest", height: 0.27, dt: 0.005, needed: &[(0.0, 0.1), (0.5, 0.1), (0.5, 0.0)] },
    Case { name: "a jump of one sample", height: 1.1, dt: 0.002, needed: &[(0.2, 0.0), (0.2, 0.05), (0.202, 0.0)] },
    Case { name: "a slow release", height: 0.8, dt: 0.005, needed: &[(0.0, 0.0), (0.4, 0.06), (2.0, 0.0)] },
    Case {
        name: "steps",
        height: 0.6,
        dt: 0.01,
        needed: &[(0.0, 0.0), (0.3, 0.04), (0.3, 0.0), (0.45, 0.0), (0.7, 0.03), (0.7, 0.0)],
    },
    Case {
        name: "needed again while it rises",
        height: 0.9,
        dt: 0.005,
        needed: &[(0.0, 0.09), (0.4, 0.09), (0.4, 0.0), (0.5, 0.0), (0.5, 0.07), (0.6, 0.07), (0.6, 0.0)],
    },
    Case { name: "always needed", height: 0.9, dt: 0.005, needed: &[(0.0, 0.0), (0.5, 0.05), (9.0, 0.05)] },
];

impl Case {
    /// The needed lowering \[m\].
    fn needed(&self, time: f64) -> f64 {
        let after = self.needed.iter().position(|(start, _)| *start > time).unwrap_or(self.needed.len());
        let before = self.needed[after.saturating_sub(1)];
        let next = self.needed.get(after).copied().unwrap_or(before);
        let part = if next.0 > before.0 { ((time - before.0) / (next.0 - before.0)).clamp(0.0, 1.0) } else { 0.0 };
        self.height * (before.1 + part * (next.1 - before.1))
    }

    /// The needed and the actual lowering \[m\] of six seconds.
    fn run(&self) -> Vec<[f64; 2]> {
        let mut descent = Descent::default();
        let samples = (6.0 / self.dt) as usize;
        let needed = (0..samples).map(|sample| self.needed(sample as f64 * self.dt));
        needed.map(|needed| [needed, descent.follow(needed, self.height, self.dt)]).collect()
    }
}

#[test]
fn the_torso_is_as_low_as_the_legs_need() {
    for case in &CASES {
        for (sample, [needed, by]) in case.run().into_iter().enumerate() {
            assert!((needed..=LOWEST * case.height).contains(&by), "{} at {sample}: {by} of {needed}", case.name);
        }
    }
}

/// Where the lowering is more than the legs need, the torso accelerates by at most 0.15 g, up and down: its rise neither starts nor ends at once.
#[test]
fn a_lowered_torso_rises_gently() {
    for case in &CASES {
        let (run, mut free) = (case.run(), 0);
        for (sample, of) in run.windows(3).enumerate() {
            let is_free = of.iter().all(|[needed, by]| by > needed && *by < LOWEST * case.height);
            let acceleration = (of[2][1] - 2.0 * of[1][1] + of[0][1]) / (case.dt * case.dt);
            free += usize::from(is_free);
            assert!(
                !is_free || acceleration.abs() <= GENTLE * (1.0 + 1e-6),
                "{} at {sample}: {acceleration}",
                case.name
            );
        }
        assert!(free > 20, "{}: {free}", case.name);
    }
}

#[test]
fn the_torso_returns_to_its_height() {
    for case in &CASES {
        let [needed, by] = case.run()[(5.9 / case.dt) as usize];
        assert!((by - needed).abs() < 1e-4 * case.height, "{}: {by} of {needed}", case.name);
    }
}

/// After a jump the torso continues downwards with at most a tenth of the speed of a pendulum.
#[test]
fn a_jump_does_not_make_the_torso_fast() {
    let (height, dt): (f64, f64) = (0.9, 0.005);
    let mut descent = Descent::default();
    let (jumped, next) = (descent.follow(0.05 * height, height, dt), descent.follow(0.0, height, dt));
    assert!(next > jumped && next - jumped <= 0.1 * (GRAVITY * height).sqrt() * dt, "{jumped} {next}");
}

/// Heights \[m\] and the lowering from which the legs reach, a fraction of it. The result leaves 0.002 of the height, within 1e-5 of it.
#[test]
fn the_least_lowering_is_found() {
    for height in [0.27, 0.9] {
        for reached in [-0.0019, -0.0005, 0.0, 0.003, 0.0171, 0.05, 0.0999] {
            let found = least(height, |by| by >= reached * height).unwrap() / height - reached - 0.002;
            assert!((-1e-12..=1.1e-5).contains(&found), "{height} {reached}: {found}");
        }
        assert_eq!(least(height, |by| by >= -0.1 * height), Some(0.0), "the legs are not stretched");
        assert_eq!(least(height, |by| by >= 0.2 * height), None, "the soles are out of reach");
    }
}
