//! Random chains of every family with a derivation. Each is derived from its description alone and checked like a robot.
//!
//! `cargo test --release -- --ignored fifty_chains_of_each_family --nocapture` prints the rows of `benches/record/DATE-derive-families.csv`.

mod draw;
mod list;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_ik::witness::chain::check_chain;
use groebot_ik::witness::{Options, Report};
use groebot_robot::kinematics::Chain;

use list::{FAMILIES, Family};

/// The results for the chains of one family.
#[derive(Default)]
struct Tally {
    chains: usize,
    /// The number of chains by number of complex solutions.
    dimensions: BTreeMap<usize, usize>,
    targets: usize,
    counted: usize,
    screw: usize,
    failures: Vec<String>,
    residuals: Vec<f64>,
    slowest: Duration,
}

impl Tally {
    /// Derives `chains` random chains of `family` and checks each.
    fn of(family: &Family, chains: usize, options: &Options) -> Tally {
        let mut tally = Tally::default();
        for number in 0..chains {
            let chain = family.chain(number, options.seed);
            let start = Instant::now();
            let derived = Derivation::sequentially(&chain, &Watch::none());
            tally.slowest = tally.slowest.max(start.elapsed());
            tally.chains += 1;
            match derived {
                Ok(derived) => tally.check(number, &chain, &derived, options),
                Err(error) => tally.failures.push(format!("{} {number}: not derived: {error}\n{chain}", family.name)),
            }
        }
        tally.residuals.sort_by(f64::total_cmp);
        tally
    }

    fn check(&mut self, number: usize, chain: &Chain, derived: &Derivation, options: &Options) {
        let dimension = derived.dimension().unwrap();
        *self.dimensions.entry(dimension).or_default() += 1;
        match check_chain(chain, derived.program(), Some(dimension), options, &Watch::none()) {
            Ok(report) => self.add(number, &report),
            Err(error) => self.failures.push(format!("chain {number}: {error}\n{chain}")),
        }
    }

    fn add(&mut self, number: usize, report: &Report) {
        let summary = report.summary();
        self.targets += summary.rows;
        self.counted += summary.exact;
        self.screw += summary.screw;
        self.failures.extend(report.failures().map(|row| format!("chain {number}: {row}; from {:?}", row.joints)));
        let ordinary = report.accuracy().classes.into_iter().filter(|class| class.name == "ordinary");
        self.residuals.extend(ordinary.flat_map(|class| class.residuals));
    }

    /// The quantile `share` of the residuals at ordinary targets.
    fn residual(&self, share: f64) -> f64 {
        let last = self.residuals.len().saturating_sub(1);
        self.residuals.get((last as f64 * share).ceil() as usize).copied().unwrap_or(0.0)
    }

    fn row(&self, name: &str) -> String {
        let dimensions: Vec<String> = self.dimensions.iter().map(|(d, chains)| format!("{d}:{chains}")).collect();
        format!(
            "{name},{},{},{},{},{},{},{:.0e},{:.0e},{:.2}",
            self.chains,
            dimensions.join(" "),
            self.targets,
            self.failures.len(),
            self.counted,
            self.screw,
            self.residual(0.5),
            self.residual(0.999),
            self.slowest.as_secs_f64()
        )
    }
}

fn derived_and_checked(family: &Family, chains: usize, options: &Options) -> Tally {
    let tally = Tally::of(family, chains, options);
    println!("{}", tally.row(family.name));
    let shown: Vec<&str> = tally.failures.iter().take(8).map(String::as_str).collect();
    println!("{}", shown.join("\n"));
    tally
}

#[test]
fn a_chain_of_each_family() {
    let options = Options { targets: 20, oracle: 0, exact: 2, seed: 11, ..Options::default() };
    let failed: Vec<&str> = FAMILIES
        .iter()
        .filter(|family| !derived_and_checked(family, 1, &options).failures.is_empty())
        .map(|family| family.name)
        .collect();
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn a_straight_wrist_is_found_behind_an_arm_whose_quartic_costs_digits() {
    // The cosines and sines of this chain's arm have errors up to 1e-9. The wrist's double root has a corresponding error.
    let family = FAMILIES.iter().find(|family| family.name == "three joints, spherical wrist").expect("it is listed");
    let chain = family.chain(40, 12);
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    let mut tally = Tally::default();
    tally.check(40, &chain, &derived, &Options { targets: 200, oracle: 0, exact: 0, seed: 12, ..Options::default() });
    assert!(tally.failures.is_empty(), "{}", tally.failures.join("\n"));
}

#[test]
#[ignore = "takes minutes: cargo test --release -- --ignored fifty_chains_of_each_family --nocapture"]
fn fifty_chains_of_each_family() {
    println!(
        "family,chains,dimensions,targets,failed,counted_exactly,by_screws,residual_p50,residual_p99.9,derive_s_max"
    );
    let options = Options { targets: 200, oracle: 0, exact: 20, seed: 12, ..Options::default() };
    let tallies: Vec<Tally> = FAMILIES.iter().map(|family| derived_and_checked(family, 50, &options)).collect();
    for (family, tally) in FAMILIES.iter().zip(&tallies) {
        assert!(tally.failures.is_empty(), "{}: {} failures", family.name, tally.failures.len());
        assert!(tally.residual(0.999) <= 1e-12, "{}", family.name);
    }
}
