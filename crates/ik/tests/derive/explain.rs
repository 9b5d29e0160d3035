//! `groebot_ik::derive::report::explain`: the formulas of a report are true, all joints occur, and the LaTeX is well formed.

use std::collections::HashMap;
use std::path::Path;
use std::process::Command;

use groebot_algebra::number::{BigRational, Rationals};
use groebot_algebra::poly::{Expression, Order, PolynomialRing, parse};
use groebot_ik::Watch;
use groebot_ik::derive::report::explain::{Document, Line, Part, Span, explain};
use groebot_ik::derive::{Derivation, Ends, Source};
use groebot_robot::kinematics::Chain;
use groebot_robot::robots;
use num_traits::ToPrimitive;

type Values = HashMap<String, BigRational>;

fn derived(chain: &Chain) -> Derivation {
    Derivation::sequentially(chain, &Watch::none()).unwrap()
}

fn report(derived: &Derivation) -> Document {
    explain(derived).unwrap()
}

/// The report of equations that are solved as one system.
fn sagittal() -> Document {
    of_folder("nao_leg_sagittal")
}

fn of_folder(name: &str) -> Document {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name);
    let source = Source::read_between(&folder, &Ends::default()).unwrap();
    explain(&Derivation::of(&source, &Watch::none()).unwrap()).unwrap()
}

fn chains() -> [Chain; 4] {
    [robots::puma(), robots::ur5(), robots::stanford(), robots::polar()]
}

#[test]
fn every_joint_has_its_step_and_every_relation_is_shown() {
    for chain in chains() {
        let derived = derived(&chain);
        let text = report(&derived).to_markdown();
        for (index, step) in derived.sequential().unwrap().method.steps.iter().enumerate() {
            let name = &chain.joints()[step.joint].name;
            assert!(text.contains(&format!("## Step {}: joint {}, `{name}`\n", index + 1, step.joint + 1)), "{text}");
            for (number, relation) in step.relations.iter().enumerate() {
                let head: String = relation.to_string().split(" = ").next().unwrap().to_owned();
                assert!(text.contains(&format!("    ({}.{})  {head}", index + 1, number + 1)), "{text}");
            }
        }
        assert!(chain.joints().iter().all(|joint| text.contains(&format!("| `{}` |", joint.name))), "{text}");
    }
}

/// Joints cancel only on their own side of the cut. With the elbow between them, the wrist's joint 4 passes through the shoulder only in the zero
/// configuration.
#[test]
fn only_joints_of_its_own_side_leave_a_thing_in_place() {
    let text = report(&derived(&robots::puma())).to_markdown();
    assert!(
        text.contains("* The point `(0, 0.66, 0)`: joints 1 and 2 leave it in place, because it is on their axes."),
        "{text}"
    );
    assert!(
        text.contains("* The point `(0, 1.524, 0)`: joints 4, 5 and 6 leave it in place, because it is on their axes."),
        "{text}"
    );
}

/// All equations of a step vanish at a reached pose, by forward kinematics.
#[test]
fn the_printed_equations_hold_at_reached_poses() {
    for chain in [robots::puma(), robots::ur5()] {
        let derived = derived(&chain);
        let q: Vec<f64> = (0..chain.joints().len()).map(|k| 0.4 + 0.37 * k as f64).collect();
        let mut values = Values::new();
        let target = derived.reached(&q).unwrap();
        for (input, value) in derived.program().inputs.iter().zip(target) {
            values.insert(input.name.clone(), number(value));
        }
        for (joint, q) in chain.joints().iter().zip(&q) {
            values.insert(format!("c{}", joint.symbol), number(q.cos()));
            values.insert(format!("s{}", joint.symbol), number(q.sin()));
        }
        let checked = check_steps(&report(&derived), &values);
        let least =
            derived.sequential().unwrap().method.steps.iter().map(|step| step.relations.len() + 2).sum::<usize>();
        assert!(checked >= least, "{checked} of {least}");
    }
}

/// Checks the equations of all steps and counts them.
fn check_steps(page: &Document, values: &Values) -> usize {
    let mut checked = 0;
    for section in page.parts.split(|part| matches!(part, Part::Section(_))) {
        let formulas: Vec<&str> = section
            .iter()
            .filter_map(|part| match part {
                Part::Equation { formula, .. } => Some(formula.as_str()),
                _ => None,
            })
            .collect();
        if formulas.first().is_none_or(|first| first.starts_with("f1") || first.starts_with("E1")) {
            continue;
        }
        let mut values = values.clone();
        for definition in formulas.iter().filter(|formula| formula.get(1..4) == Some(" = ")) {
            let (name, text) = definition.split_once(" = ").unwrap();
            let value = evaluate(&parse(text).unwrap(), &values).unwrap();
            values.insert(name.to_owned(), value);
        }
        let equations = formulas.iter().filter_map(|formula| formula.split_once(" = "));
        for (left, right) in equations {
            let (Ok(left), Ok(right)) = (parse(left), parse(right)) else { continue };
            let difference = Expression::sum(vec![left.clone(), right.negated()]);
            auxiliary(&difference, &mut values);
            let Some(value) = evaluate(&difference, &values) else { continue };
            assert!(value.to_f64().unwrap().abs() < 1e-12, "{left}: {value}");
            checked += 1;
        }
    }
    checked
}

/// w = A s - B c, as the page defines it.
fn auxiliary(expression: &Expression, values: &mut Values) {
    let names: Vec<String> = expression.names().iter().map(|name| (*name).to_owned()).collect();
    for name in names.iter().filter(|name| name.starts_with('w')) {
        let joint = &name[1..];
        let definition = parse(&format!("A*s{joint} - B*c{joint}")).unwrap();
        let value = evaluate(&definition, values).unwrap();
        values.insert(name.clone(), value);
    }
}

/// The cofactors that a report prints multiply out to the basis that it prints, at values of the symbols.
#[test]
fn the_printed_cofactors_multiply_out() {
    for page in [report(&derived(&robots::puma())), sagittal()] {
        let mut values: Values = Values::new();
        let mut prime = 3;
        let mut rows = 0;
        for part in &page.parts {
            let Part::Equation { formula, .. } = part else { continue };
            let pieces: Vec<&str> = formula.split(" = ").collect();
            let [name, middle, last] = pieces[..] else { continue };
            let (middle, last) = (parse(middle).unwrap(), parse(last).unwrap());
            for unknown in middle.names() {
                values.entry(unknown.to_owned()).or_insert_with(|| {
                    prime += 4;
                    BigRational::new(prime.into(), 5.into())
                });
            }
            let value = evaluate(&middle, &values).unwrap();
            match name.starts_with('f') {
                true => drop(values.insert(name.to_owned(), value)),
                false => {
                    assert_eq!(evaluate(&last, &values).unwrap(), value, "{formula}");
                    rows += 1;
                }
            }
        }
        assert!(rows >= 3, "{rows} rows");
    }
}

#[test]
fn a_system_is_reported_with_its_source_s_numbers_and_its_strata() {
    let text = sagittal().to_markdown();
    for words in [
        "(0.1)  f1 = 102.9*c4*s3 + 102.9*c3*s4 + 100*s3 - px = 0",
        "`HipPitch`",
        "`KneePitch`",
        "c4 > c3 > s4 > s3",
        "S-polynomial",
        "* Where `pz = 0`",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn latex_is_well_formed() {
    let hostile = "50% of a_b & {c} ~ \\x #1 $5 ^";
    let mut page = Document::new(hostile);
    page.paragraph(Line::plain(hostile).name(hostile));
    page.items(vec![Line(vec![Span::Formula("a_1 + 5%*{x}".to_owned())])]);
    let pages =
        chains().into_iter().map(|chain| report(&derived(&chain))).chain([of_folder("puma560"), sagittal(), page]);
    for (number, page) in pages.enumerate() {
        let text = page.to_latex();
        assert_well_formed(&text);
        compile(number, &text);
    }
}

/// Environments are nested correctly, braces are paired, and special characters are used only with their meaning.
fn assert_well_formed(text: &str) {
    let (mut open, mut depth, mut math) = (Vec::new(), 0, false);
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let name = || rest[rest.find('{').unwrap() + 1..rest.find('}').unwrap()].to_owned();
        if rest.starts_with("\\begin{") {
            open.push(name());
        } else if rest.starts_with("\\end{") {
            assert_eq!(open.pop(), Some(name()), "{rest}");
        }
        let display = open.iter().any(|name| name.starts_with("equation") || name == "gather*");
        match c {
            '\\' => {
                rest = &rest[1 + rest[1..].chars().next().map_or(0, char::len_utf8)..];
                continue;
            }
            '{' => depth += 1,
            '}' => depth -= 1,
            '$' => math = !math,
            '&' => assert!(open.iter().any(|name| name == "tabular" || name == "split"), "{rest}"),
            '_' | '^' => assert!(math || display, "{rest}"),
            '#' | '%' | '~' => panic!("unescaped: {rest}"),
            '\n' => assert!(!math, "a formula across lines: {rest}"),
            _ => {}
        }
        assert!(depth >= 0, "{rest}");
        rest = &rest[c.len_utf8()..];
    }
    assert!(open.is_empty() && depth == 0 && !math, "{open:?} {depth} {math}");
}

/// Compiles the text with LaTeX, if it is installed.
fn compile(number: usize, text: &str) {
    if Command::new("pdflatex").arg("--version").output().is_err() {
        println!("pdflatex is not here: the LaTeX is not compiled");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("page.tex"), text).unwrap();
    let run = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", "page.tex"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(run.status.success(), "page {number}: {}", String::from_utf8_lossy(&run.stdout));
}

fn number(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

/// The value of an expression; `None` if a name has no value.
fn evaluate(expression: &Expression, values: &Values) -> Option<BigRational> {
    if expression.names().iter().any(|name| !values.contains_key(*name)) {
        return None;
    }
    let put = |name: &str| values.get(name).cloned().map(Expression::Number);
    let ring = PolynomialRing::new(Rationals, &["x"], Order::Lex).unwrap();
    let value = expression.substitute(&put).evaluate(&ring).unwrap();
    Some(ring.as_constant(&value).unwrap())
}
