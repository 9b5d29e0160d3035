//! The check of chains' solvers: the screw solver passes where it is accurate, damaged solvers fail.

use std::f64::consts::PI;

use groebot_algebra::number::BigRational;
use groebot_ik::witness::chain::{check_chain, count_exactly};
use groebot_ik::witness::{ByScrews, Draws, Fault, Kind, Options, Report, Solver, Verdict};
use groebot_ik::{Result, Watch};
use groebot_robot::kinematics::oracle::{Oracle, Unknown};
use groebot_robot::kinematics::{Chain, JointKind, Solution, Task};
use groebot_robot::model::Robot;
use groebot_robot::robots;

const KR6: &str = include_str!("../../../../tests/corpus/urdf/kr6_r900.urdf");

fn run(chain: &Chain, solver: &dyn Solver, bound: Option<usize>, options: Options) -> Report {
    check_chain(chain, solver, bound, &options, &Watch::none()).unwrap()
}

fn assert_none_fails(report: &Report, classes: &[&str]) {
    for class in report.accuracy().classes.iter().filter(|class| classes.contains(&class.name.as_str())) {
        let failures: Vec<String> = report.failures().map(|row| row.to_string()).collect();
        assert_eq!(class.failed, 0, "{}\n{}", class.name, failures.join("\n"));
        assert!(class.residual(0.999).is_none_or(|residual| residual <= 1e-12), "{}", report.accuracy());
    }
}

/// A solver whose solutions are those of another one after a change.
struct Changed<'a, F: Fn(&mut Vec<Solution>)> {
    solver: &'a dyn Solver,
    change: F,
}

impl<F: Fn(&mut Vec<Solution>)> Solver for Changed<'_, F> {
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        let mut answers = self.solver.solve(inputs)?;
        (self.change)(&mut answers);
        Ok(answers)
    }
}

/// The numeric search as a solver, for tasks that screw theory does not solve. It has independent equations.
struct Search {
    chain: Chain,
    unknowns: Vec<usize>,
}

impl Search {
    fn new(chain: &Chain) -> Self {
        let given = chain.given();
        let unknowns = (0..chain.joints().len()).filter(|joint| !given.contains(joint)).collect();
        Search { chain: chain.clone(), unknowns }
    }

    fn joints(&self, inputs: &[f64], values: &[f64]) -> Vec<f64> {
        let given = self.chain.given();
        let mut q = vec![0.0; self.chain.joints().len()];
        let from = inputs.len() - given.len();
        given.iter().zip(&inputs[from..]).for_each(|(&joint, &value)| q[joint] = value);
        self.unknowns.iter().zip(values).for_each(|(&joint, &value)| q[joint] = value);
        q
    }

    fn misses(&self, inputs: &[f64], q: &[f64]) -> Vec<f64> {
        let pose = self.chain.forward(q).unwrap();
        let tip = pose.translation.vector / self.chain.reach().max(1e-9);
        let aim = pose.rotation * self.chain.aim().into_inner();
        let matrix = pose.rotation.to_rotation_matrix().into_inner().transpose();
        let seen: Vec<f64> = match self.chain.task() {
            Task::Position => tip.as_slice().to_vec(),
            Task::Ray => [tip.as_slice(), aim.as_slice()].concat(),
            Task::Direction => aim.as_slice().to_vec(),
            // The columns of the transposed matrix are the rows of the matrix.
            Task::Rotation => matrix.as_slice().to_vec(),
            Task::Pose => [tip.as_slice(), matrix.as_slice()].concat(),
            task => panic!("{task:?}"),
        };
        let lengths = if matches!(self.chain.task(), Task::Direction | Task::Rotation) { 0 } else { 3 };
        let wanted = |k: usize| if k < lengths { inputs[k] / self.chain.reach() } else { inputs[k] };
        seen.iter().enumerate().map(|(k, seen)| seen - wanted(k)).collect()
    }
}

impl Solver for Search {
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        let unknown = |&joint: &usize| match self.chain.joints()[joint].kind {
            JointKind::Revolute => Unknown::Angle,
            JointKind::Prismatic => Unknown::Displacement { low: -2.0, high: 2.0 },
        };
        let unknowns: Vec<Unknown> = self.unknowns.iter().map(unknown).collect();
        let oracle = Oracle { seeds: 150, ..Oracle::default() };
        let found = oracle.search(&unknowns, |values| self.misses(inputs, &self.joints(inputs, values)))?;
        let answer = |answer: &groebot_robot::kinematics::oracle::Solution| Solution {
            q: answer.q.clone(),
            residual: answer.residual,
            ..Solution::default()
        };
        Ok(found.iter().map(answer).collect())
    }
}

const ARMS: [fn() -> Chain; 4] = [robots::puma, robots::ur5, robots::stanford, robots::nao_left_leg];

#[test]
fn the_screw_solver_passes_at_ordinary_targets_and_near_singular_ones() {
    for robot in ARMS {
        let (chain, options) = (robot(), Options { targets: 120, oracle: 2, exact: 10, seed: 3, ..Options::default() });
        let report = run(&chain, &ByScrews::new(&chain).unwrap(), Some(8), options);
        assert_none_fails(&report, &["ordinary", "1e-3 of singular", "1e-6 of singular"]);
        let summary = report.summary();
        assert!(summary.exact >= 9 && summary.screw == 120 && summary.oracle >= 2, "{}: {summary}", chain.name());
        for class in ["1e-3 of singular", "1e-6 of singular", "1e-9 of singular", "singular"] {
            let found = report.accuracy().classes.iter().any(|c| c.name == class && c.rows >= 10);
            assert!(found, "{}: no targets {class}", chain.name());
        }
    }
}

/// Distances from singular configurations, measured by a Jacobian of central differences of forward kinematics.
#[test]
fn singular_targets_are_singular() {
    let chain = robots::puma();
    let options = Options { targets: 60, oracle: 0, exact: 0, seed: 5, ..Options::default() };
    let report = run(&chain, &ByScrews::new(&chain).unwrap(), None, options);
    for row in report.rows.iter().filter(|row| matches!(row.kind, Kind::Singular | Kind::Near(_))) {
        let determinant = numeric_determinant(&chain, row.joints.as_ref().unwrap()).abs();
        let most = match row.kind {
            Kind::Near(k) => 10.0_f64.powi(-(k as i32)),
            _ => 0.0,
        };
        // PUMA's determinant is a product of three factors of about one each. The error of the differences is 1e-9.
        assert!(determinant <= 2.0 * most + 1e-9, "{row}: {determinant:e}");
    }
}

fn numeric_determinant(chain: &Chain, q: &[f64]) -> f64 {
    let column = |joint: usize| {
        let at = |by: f64| {
            let mut q = q.to_vec();
            q[joint] += by;
            chain.forward(&q).unwrap()
        };
        let (ahead, behind) = (at(1e-5), at(-1e-5));
        let v = (ahead.translation.vector - behind.translation.vector) / 2e-5;
        let w = (ahead.rotation * behind.rotation.inverse()).scaled_axis() / 2e-5;
        [v.as_slice(), w.as_slice()].concat()
    };
    let entries: Vec<f64> = (0..6).flat_map(column).collect();
    nalgebra::DMatrix::from_vec(6, 6, entries).determinant()
}

fn faults_of(chain: &Chain, change: impl Fn(&mut Vec<Solution>)) -> Vec<Fault> {
    let screws = ByScrews::new(chain).unwrap();
    let report = run(
        chain,
        &Changed { solver: &screws, change },
        Some(8),
        Options { targets: 7, oracle: 1, exact: 3, seed: 4, ..Options::default() },
    );
    let faults = report.rows.iter().map(|row| match &row.verdict {
        Verdict::Fail(faults) => faults.clone(),
        _ => Vec::new(),
    });
    faults.flatten().collect()
}

#[test]
fn damaged_answers_are_found() {
    for robot in [robots::puma, robots::ur5] {
        let chain = robot();
        assert_eq!(faults_of(&chain, |_| ()), [], "{}", chain.name());
        let lost = faults_of(&chain, |answers| answers.truncate(answers.len() / 2));
        for fault in [Fault::Missing, Fault::Count, Fault::Screw, Fault::Oracle] {
            assert!(lost.contains(&fault), "{fault} is not among {lost:?}");
        }
        let moved = faults_of(&chain, |answers| answers.iter_mut().for_each(|answer| answer.q[0] += 3e-10));
        assert!(moved.contains(&Fault::Residual), "{moved:?}");
        let twice = faults_of(&chain, |answers| answers.extend(answers.clone().first().cloned()));
        assert!(twice.contains(&Fault::Duplicate) && twice.contains(&Fault::Count), "{twice:?}");
        let round = faults_of(&chain, |answers| answers.iter_mut().for_each(|answer| answer.q[0] += 2.0 * PI));
        assert!(round.contains(&Fault::Range), "{round:?}");
        let free = faults_of(&chain, |answers| answers.iter_mut().for_each(|answer| answer.free = vec![3]));
        assert!(free.contains(&Fault::Free), "{free:?}");
        let many = faults_of(&chain, |answers| answers.extend(answers.clone()));
        assert!(many.contains(&Fault::Bound), "{many:?}");
    }
}

/// A solver that loses a solution only where a joint is at a multiple of 15 degrees. Rows with round targets find the fault without a search.
#[test]
fn what_is_lost_at_round_targets_alone_is_found() {
    let chain = robots::puma();
    let screws = ByScrews::new(&chain).unwrap();
    let is_round = |q: &f64| (q / (PI / 12.0) - (q / (PI / 12.0)).round()).abs() < 1e-9;
    let lossy = |answers: &mut Vec<Solution>| {
        if answers.iter().any(|answer| answer.q.iter().all(is_round)) {
            answers.retain(|answer| answer.q.iter().all(is_round));
        }
    };
    let lossy = Changed { solver: &screws, change: lossy };
    for (draws, targets) in [(Draws::All, 48), (Draws::Round, 12)] {
        let options = Options { targets, oracle: 0, exact: 0, seed: 3, draws };
        assert_none_fails(&run(&chain, &screws, None, options), &["round", "aligned"]);
        let report = run(&chain, &lossy, None, options);
        let moved = report.rows.iter().filter(|row| row.verdict.faults().contains(&Fault::Moved));
        assert!(moved.clone().count() >= 3 && moved.clone().all(|row| row.kind.is_round()), "{report:?}");
    }
}

/// PUMA's straight wrist: joints 4 and 6 rotate about one line, so only their sum is determined.
#[test]
fn a_self_motion_must_be_reported() {
    let chain = robots::puma();
    let screws = ByScrews::new(&chain).unwrap();
    let silent = Changed { solver: &screws, change: |answers| answers.iter_mut().for_each(|a| a.free.clear()) };
    let options = Options { targets: 200, oracle: 0, exact: 0, seed: 1, ..Options::default() };
    let faults = |report: &Report| {
        let failed = |row: &&groebot_ik::witness::Row| matches!(&row.verdict, Verdict::Fail(f) if f.contains(&Fault::SelfMotion));
        report.rows.iter().filter(|row| row.kind == Kind::Singular).filter(failed).count()
    };
    let (reported, unreported) =
        (faults(&run(&chain, &screws, None, options)), faults(&run(&chain, &silent, None, options)));
    assert!(
        unreported > reported + 5,
        "{reported} missing self-motions when they are reported, {unreported} when they are not"
    );
}

/// Exact counts compared with the screw solver's, for robots whose solutions are real and complete there.
#[test]
fn exact_counts_are_those_of_screw_theory() {
    for robot in [robots::puma, robots::ur5, robots::nao_left_leg, robots::rh0_right_leg, robots::polar] {
        let chain = robot();
        let solver = ByScrews::new(&chain).unwrap();
        for counted in count_exactly(&chain, 12, 7, &Watch::none()).unwrap() {
            let answers = solver.solve(&counted.inputs).unwrap();
            let exact = counted.solutions.unwrap_or(answers.len());
            assert_eq!(exact, answers.len(), "{}: {:?}", chain.name(), counted.joints);
        }
    }
}

/// A base rotated by angles without rational sines, and a tool at such an angle. Neither changes the number of solutions or the time of the count.
#[test]
fn a_turned_base_and_a_tool_leave_the_counts() {
    let count = |text: &str| {
        let chain = Robot::from_urdf(text).unwrap().chain(None, None).unwrap();
        let counted = count_exactly(&chain, 8, 7, &Watch::none()).unwrap();
        counted.into_iter().map(|counted| counted.solutions).collect::<Vec<_>>()
    };
    let straight = count(KR6);
    assert!(straight.iter().all(Option::is_some), "{straight:?}");
    for (rpy, turned) in [("0 0 0.3", "0 0 0"), ("0.3 0.2 0.1", "0.4 -0.7 1.1")] {
        let (first, rest) = KR6.split_once("rpy=\"0 0 0\"").unwrap();
        let (middle, tool) = rest.split_at(rest.rfind("rpy=").unwrap());
        let tool = tool.replacen("0 1.57079632679 0", turned, 1);
        assert_ne!(tool, rest[middle.len()..], "the tool is turned");
        assert_eq!(count(&format!("{first}rpy=\"{rpy}\"{middle}{tool}")), straight, "{rpy}");
    }
}

#[test]
fn infinitely_many_solutions_are_not_counted() {
    // Three joints about one line, for a pose that one joint reaches. Joint values are free.
    let text = "name = \"spin\"\nlength_unit = \"m\"\n[task]\nkind = \"pose\"\n".to_owned()
        + &["a", "b", "c"].map(|name| joint(name, "[0, 0, 1]", "[0, 0, 0]")).concat()
        + "[tip]\npoint = [0.3, 0, 0.2]\n";
    let chain = Chain::from_toml(&text).unwrap();
    let counted = count_exactly(&chain, 2, 1, &Watch::none()).unwrap();
    assert!(counted.iter().all(|counted| counted.solutions.is_none()), "{counted:?}");
}

fn joint(name: &str, axis: &str, point: &str) -> String {
    format!("[[joint]]\nname = \"{name}\"\ntype = \"revolute\"\naxis = {axis}\npoint = {point}\n")
}

fn along(axis: [i64; 3]) -> [BigRational; 3] {
    axis.map(|x| BigRational::from_integer(x.into()))
}

/// Rays, directions, rotations and given joints, solved by numeric search: checked with generating joints and exact counts.
#[test]
fn other_tasks_are_checked_too() {
    let arm = robots::nao_left_arm();
    let elbow = arm.joints()[2].name.clone();
    let four = arm.with_task(Task::Ray, along([1, 0, 2]), Vec::new()).unwrap();
    let given = arm.with_task(Task::Position, along([0, 0, 1]), vec![elbow, arm.joints()[4].name.clone()]).unwrap();
    let head = robots::nao_head().with_task(Task::Direction, along([1, 0, 0]), Vec::new()).unwrap();
    for chain in [four, given, head] {
        let report = run(
            &chain,
            &Search::new(&chain),
            None,
            Options { targets: 9, oracle: 0, exact: 4, seed: 2, ..Options::default() },
        );
        let lost: Vec<String> =
            report.failures().filter(|row| row.kind == Kind::Rational).map(|r| r.to_string()).collect();
        assert!(lost.is_empty(), "{}: {lost:?}", chain.name());
        assert!(report.summary().exact == 4, "{}: {}", chain.name(), report.summary());
    }
}

#[test]
fn the_accuracy_is_reported_by_class() {
    let chain = robots::stanford();
    let report = run(
        &chain,
        &ByScrews::new(&chain).unwrap(),
        None,
        Options { targets: 40, oracle: 0, exact: 0, seed: 1, ..Options::default() },
    );
    let table = report.accuracy().to_string();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 2 + report.accuracy().classes.len());
    let columns = |line: &&str| line.matches('|').count();
    assert!(lines.iter().all(|line| columns(line) == columns(&lines[0])), "{table}");
    let rows: usize = report.accuracy().classes.iter().map(|class| class.rows).sum();
    assert_eq!(rows, 40);
    assert_eq!(report.to_csv().lines().count(), 41);
    assert!(report.to_csv().starts_with("kind,px,py,pz,r11,r12,r13,r21,"), "{}", report.to_csv());
}
