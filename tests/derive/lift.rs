//! The way from a plan to a program.

use groebot::Watch;
use groebot::derive::closure::*;
use groebot::derive::lift::*;
use groebot::derive::planner::*;
use groebot::number::Zp;
use groebot::robots;

/// A throwaway planner.
fn greedy(mechanism: &Mechanism) -> Plan {
    let pool = mechanism.relations();
    println!("pool {}", pool.len());
    let count = mechanism.joints().len();
    let mut known: Vec<usize> = mechanism.given().to_vec();
    let mut steps = Vec::new();
    let mut seed = 12345u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) % 1_000_003 + 2
    };
    let field = Zp::new(2147483647).unwrap();
    let mut arithmetic = Modular::new(field);
    let coefficients = |relation: &Relation, joint: usize, known: &[usize], arithmetic: &mut Modular, random: &mut dyn FnMut() -> u64| {
        use groebot::number::{Field, Ring};
        let values: Vec<JointValue<u64>> = mechanism.joints().iter().map(|j| {
            let t = random();
            if !j.is_revolute() { return JointValue::Length(t); }
            let n = arithmetic.rational(&j.square);
            let f = &field;
            let nt2 = Ring::mul(f, &n, &Ring::mul(f, &t, &t));
            let inverse = f.inverse(&Ring::add(f, &1, &nt2)).unwrap();
            JointValue::Angle { cosine: Ring::mul(f, &Ring::sub(f, &1, &nt2), &inverse), sine: Ring::mul(f, &Ring::add(f, &t, &t), &inverse) }
        }).collect();
        let zero = Target { position: [0, 0, 0], turn: Turn::Nothing };
        let all = Assignment { joints: values.clone(), target: zero };
        let word = Word((0..count).map(Letter::Joint).collect());
        let get = |v: &Multilinear<u64>| v.constant_term().copied().unwrap_or(0);
        let Image::Point(p) = carry(mechanism, &word, &Object::Point(mechanism.tip_point().clone()), Measure::Offset, &all, arithmetic).unwrap() else { panic!() };
        let mut parameters: Vec<u64> = p.iter().map(get).collect();
        if mechanism.parameters().len() == 12 {
            let m = mechanism.tip_rotation();
            let columns: Vec<Vec<u64>> = (0..3).map(|k| {
                let column = [m[0][k].clone(), m[1][k].clone(), m[2][k].clone()];
                let Image::Direction(v) = carry(mechanism, &word, &Object::Direction(column), Measure::Angle, &all, arithmetic).unwrap() else { panic!() };
                v.iter().map(get).collect()
            }).collect();
            for i in 0..3 { for k in 0..3 { parameters.push(columns[k][i]); } }
        }
        let target = Target::new(mechanism, &parameters, arithmetic).unwrap();
        let joints = (0..count).map(|k| if known.contains(&k) { values[k].clone() } else { JointValue::Unknown }).collect();
        let f = evaluate(mechanism, relation, &Assignment { joints, target }, arithmetic).unwrap();
        let c = |f: &Multilinear<u64>, x: Factor| f.coefficient(&[x]).copied().unwrap_or(0);
        (c(&f, Factor::Cosine(joint)), c(&f, Factor::Sine(joint)), c(&f, Factor::Length(joint)), c(&f, Factor::LengthSquared(joint)))
    };
    while known.len() < count {
        let mut best: Option<PlanStep> = None;
        for joint in (0..count).filter(|j| !known.contains(j)) {
            let usable: Vec<&Relation> = pool
                .iter()
                .filter(|r| r.joints().contains(&joint) && r.joints().iter().all(|k| *k == joint || known.contains(k)))
                .collect();
            let mut nonzero = Vec::new();
            for r in usable {
                let k = coefficients(r, joint, &known, &mut arithmetic, &mut random);
                if k != (0, 0, 0, 0) {
                    nonzero.push(r);
                }
            }
            let is = |step: &PlanStep| best.as_ref().is_none_or(|b| step.degree < b.degree);
            let mut candidates = Vec::new();
            if mechanism.joints()[joint].is_revolute() {
                'pairs: for (i, a) in nonzero.iter().enumerate() {
                    for b in &nonzero[..i] {
                        let mut r1 = { let mut s = 99u64; move || { s = s.wrapping_mul(6364136223846793005).wrapping_add(1); (s >> 33) % 1_000_003 + 2 } };
                        let mut r2 = r1.clone();
                        let x = coefficients(a, joint, &known, &mut arithmetic, &mut r1);
                        let y = coefficients(b, joint, &known, &mut arithmetic, &mut r2);
                        let p = 2147483647u128;
                        let d = (x.0 as u128 * y.1 as u128 + p * p - x.1 as u128 * y.0 as u128) % p;
                        if d != 0 {
                            candidates.push(PlanStep { joint, way: Way::Pair([(*b).clone(), (*a).clone()]), degree: 1 });
                            if candidates.len() > 300 { break 'pairs; }
                        }
                    }
                }
                if let Some(r) = nonzero.first() {
                    candidates.push(PlanStep { joint, way: Way::Single((*r).clone()), degree: 2 });
                }
            } else {
                for r in &nonzero {
                    let k = coefficients(r, joint, &known, &mut arithmetic, &mut random);
                    candidates.push(PlanStep { joint, way: Way::Single((*r).clone()), degree: if k.3 != 0 { 2 } else { 1 } });
                }
            }
            // prefer a turn
            candidates.sort_by_key(|s| s.degree);
            let degree = candidates.first().map(|s| s.degree);
            let turns = candidates.iter().filter(|s| Some(s.degree) == degree).find(|s| matches!(shape_of(mechanism, s), Some(Form::Turn)));
            if let Some(step) = turns.or(candidates.first()) {
                if is(step) {
                    best = Some(step.clone());
                }
            }
        }
        let Some(step) = best else { panic!("stuck at {known:?}: {steps:?}") };
        known.push(step.joint);
        steps.push(step);
    }
    let dimension = steps.iter().map(|s: &PlanStep| s.degree).product();
    Plan { given: mechanism.given().to_vec(), dimension, evidence: Vec::new(), steps }
}

fn shape_of(mechanism: &Mechanism, step: &PlanStep) -> Option<Form> {
    shape(mechanism, step).ok().map(|shape| shape.form)
}

#[test]
fn zz_robots() {
    for robot in robots::ALL {
        let chain = robot.chain();
        if std::env::var("ROBOT").is_ok_and(|name| name != robot.name()) { continue; }
        let mechanism = Mechanism::new(&chain).unwrap();
        let result = std::panic::catch_unwind(|| greedy(&mechanism));
        let Ok(plan) = result else { println!("{} no plan", robot.name()); continue };
        println!("{}\n{plan}", robot.name());
        let start = std::time::Instant::now();
        let derived = match Derived::new(&chain, &mechanism, plan, &Watch::none()) { Ok(d) => d, Err(e) => { println!("ERROR {e}"); continue } };
        println!("lift {:?}", start.elapsed());
        let program = &derived.program;
        for (b, s) in program.blocks.iter().zip(&derived.steps) {
            println!("{} {:?} code {} charts {}", b.label, s.shape.form, b.code.len(), b.charts.len());
        }
        println!("checks {}", program.checks.code.len());
        let mut seed = 1u64;
        let mut random = move || { seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); (seed >> 11) as f64 / (1u64 << 53) as f64 };
        let solver = groebot::kinematics::screw::ScrewSolver::new(&chain);
        let (mut worst, mut missed, mut counts, mut differ) = (0.0f64, 0, std::collections::BTreeMap::new(), 0);
        let mut time = std::time::Duration::ZERO;
        for _ in 0..200 {
            let q: Vec<f64> = chain.joints().iter().map(|j| if j.kind == groebot::kinematics::JointKind::Revolute { (random() - 0.5) * 6.28 } else { 0.2 + random() }).collect();
            let target = target_of(&chain, &q);
            let start = std::time::Instant::now();
            let answers = program.solve(&target).unwrap();
            time += start.elapsed();
            *counts.entry(answers.len()).or_insert(0) += 1;
            if !answers.iter().any(|a| near(&a.q, &q)) { missed += 1; }
            for a in &answers { 
                let got = target_of(&chain, &a.q);
                for (x, y) in got.iter().zip(&target) { worst = worst.max((x - y).abs()); } }
            if let Ok(solver) = &solver {
                let n = solver.solve(&groebot::kinematics::screw::Target::reached(&chain, &q).unwrap()).map(|a| a.len()).unwrap_or(0);
                if n != answers.len() { differ += 1; }
            }
        }
        println!("missed {missed} worst {worst:e} counts {counts:?} differ {differ} {:?} a pose", time / 200);
    }
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(x, y)| { let d = (x - y) / std::f64::consts::TAU; ((d - d.round()) * std::f64::consts::TAU).abs() < 1e-7 || (x - y).abs() < 1e-7 })
}

fn target_of(chain: &groebot::kinematics::Chain, q: &[f64]) -> Vec<f64> {
    let pose = chain.forward(q).unwrap();
    let r = pose.rotation.to_rotation_matrix();
    let p = pose.translation.vector;
    let mut v = vec![p.x, p.y, p.z];
    if chain.task() == groebot::kinematics::Task::Pose {
        for i in 0..3 { for j in 0..3 { v.push(r[(i, j)]); } }
    }
    v
}
