//! Every family of subproblems on instances with a known solution: a few hundred always, 1e5 for `benches/record`.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use super::instance::{Random, Verdict};
use super::subproblem_families::{FOUR_CIRCLES, Family, ONE_JOINT, THREE_JOINTS, TWO_JOINTS};

/// The problem of a verdict, if there is one.
fn complaint(verdict: &Verdict) -> Option<&'static str> {
    let accurate = verdict.residuals.iter().all(|residual| *residual <= 1e-11);
    [
        (verdict.is_lost(), "lost"),
        (!accurate, "residual"),
        (verdict.apart <= 1e-9, "twice"),
        (!verdict.in_range, "out of (-pi, pi]"),
    ]
    .into_iter()
    .find_map(|(wrong, name)| wrong.then_some(name))
}

fn check(families: &[Family], cases: u32) {
    for (name, instance) in families {
        // The same instances each time. Of 1e5 singular ones a few are lost (benches/record), which must not fail one
        // run in fifty.
        let config = Config { failure_persistence: None, rng_seed: RngSeed::Fixed(5), ..Config::with_cases(cases) };
        let outcome = TestRunner::new(config).run(&any::<u64>(), |seed| {
            let verdict = instance(&mut Random(seed));
            prop_assert_eq!(complaint(&verdict), None, "{:?}", verdict);
            Ok(())
        });
        if let Err(error) = outcome {
            panic!("{name}: {error}");
        }
    }
}

#[test]
fn one_joint_families() {
    check(ONE_JOINT, 2000);
}

#[test]
fn two_joint_families() {
    check(TWO_JOINTS, 1000);
}

#[test]
fn three_joint_families() {
    check(THREE_JOINTS, 500);
}

#[test]
fn four_circle_families() {
    check(FOUR_CIRCLES, 1000);
}

/// Number of the record's instances that are known to be lost: two solutions coincide where the whole condition is
/// small.
const KNOWN_LOSSES: &[(&str, usize)] = &[("TTS singular", 1)];

/// Prints a line of `benches/record`. Returns its problem, if there is one.
fn record(name: &str, verdicts: &[Verdict]) -> Option<String> {
    let mut residuals: Vec<f64> = verdicts.iter().flat_map(|verdict| &verdict.residuals).copied().collect();
    residuals.sort_by(f64::total_cmp);
    let [half, most, all] = [0.5, 0.999, 1.0].map(|share| residuals[((residuals.len() - 1) as f64 * share) as usize]);
    let lost = verdicts.iter().filter(|verdict| verdict.is_lost()).count();
    let answers = verdicts.iter().map(|verdict| verdict.residuals.len()).max().unwrap_or(0);
    println!("2026-11-21,{name},{},{lost},{half:.1e},{most:.1e},{all:.1e},{answers}", verdicts.len());
    let known = KNOWN_LOSSES.iter().find(|(family, _)| *family == name).map_or(0, |(_, count)| *count);
    let untidy = verdicts.iter().any(|verdict| verdict.apart <= 1e-9 || !verdict.in_range);
    (lost > known || most > 1e-12 || untidy)
        .then(|| format!("{name}: {lost} lost, residual {most:e}, untidy: {untidy}"))
}

#[test]
#[ignore = "a minute: cargo test --release --test main -- --ignored subproblems_record --nocapture"]
fn subproblems_record() {
    println!("date,family,instances,lost,residual_p50,residual_p999,residual_max,answers_max");
    let mut failed = Vec::new();
    for (name, instance) in [ONE_JOINT, TWO_JOINTS, THREE_JOINTS, FOUR_CIRCLES].concat() {
        let verdicts: Vec<Verdict> = (0..100_000).map(|seed| instance(&mut Random(seed))).collect();
        failed.extend(record(name, &verdicts));
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
