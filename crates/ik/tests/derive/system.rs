//! Systems built in code: checks, added relations and printed text.

use groebot_algebra::poly::{parse, parse_equation};
use groebot_ik::ErrorKind;
use groebot_ik::derive::*;

fn equation(label: &str, text: &str) -> Equation {
    Equation { label: label.into(), expression: parse_equation(text).unwrap() }
}

fn angle(name: &str, cosine: &str, sine: &str) -> JointUnknown {
    let kind = JointKindUnknown::Angle { cosine: cosine.into(), sine: sine.into() };
    JointUnknown { name: name.into(), kind }
}

fn value(name: &str, unknown: &str) -> JointUnknown {
    JointUnknown { name: name.into(), kind: JointKindUnknown::Value { unknown: unknown.into() } }
}

fn input(name: &str, quantity: Quantity) -> Input {
    Input { name: name.into(), quantity, positive: false }
}

fn parameter(name: &str, source: ParameterSource, square: Option<&str>) -> Parameter {
    Parameter { name: name.into(), source, square: square.map(|text| parse(text).unwrap()) }
}

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(|&name| name.to_owned()).collect()
}

/// NAO (6.7.1)-(6.7.2): two joints of the arm in a plane, lengths in millimetres.
fn arm() -> SystemParts {
    SystemParts {
        name: "nao_arm_planar".into(),
        description: "two joints in a plane".into(),
        source: "NAO (6.7.1)-(6.7.4)".into(),
        length_unit: LengthUnit::Millimetre,
        task: None,
        inputs: vec![input("py", Quantity::Length), input("pz", Quantity::Length)],
        parameters: vec![
            parameter("py", ParameterSource::Input(0), None),
            parameter("pz", ParameterSource::Input(1), None),
        ],
        joints: vec![angle("q2", "c2", "s2"), angle("q4", "c4", "s4")],
        order: names(&["c4", "c2", "s4", "s2"]),
        equations: vec![equation("(6.7.1)", "105*c2 + 113.7*s4 = pz"), equation("(6.7.2)", "105*s2 + 113.7*c4 = py")],
        choice: Some(Choice { unknown: "s2".into(), root: Root::Minus }),
    }
}

#[test]
fn circle_relations_stand_once_at_the_end() {
    let circles = |system: &System| system.equations[2..].iter().map(|e| e.expression.to_string()).collect::<Vec<_>>();
    let added = System::new(arm()).unwrap();
    assert_eq!(circles(&added), ["c2^2 + s2^2 - 1", "c4^2 + s4^2 - 1"]);
    assert_eq!(System::new(added.clone().into_parts()).unwrap(), added);
    let mut parts = arm();
    parts.equations.insert(0, equation("(6.7.4)", "1 = s4^2 + c4^2"));
    parts.equations.insert(2, equation("(6.7.3)", "s2^2 = 1 - c2^2"));
    let moved = System::new(parts).unwrap();
    assert_eq!(circles(&moved), circles(&added));
    let labels: Vec<&str> = moved.equations.iter().map(|e| e.label.as_str()).collect();
    assert_eq!(labels, ["(6.7.1)", "(6.7.2)", "(6.7.3)", "(6.7.4)"]);
}

#[test]
fn the_default_order_puts_cosines_first() {
    let mut parts = arm();
    parts.joints.insert(1, value("d3", "d3"));
    assert_eq!(parts.default_order(), ["c2", "c4", "s2", "s4", "d3"]);
    parts.order = parts.default_order();
    assert!(System::new(parts).is_ok());
}

#[test]
fn an_angle_enters_by_related_cosine_and_sine() {
    let mut parts = arm();
    parts.inputs.push(input("phi", Quantity::Angle));
    parts.parameters.push(parameter("cphi", ParameterSource::Cosine(2), None));
    parts.parameters.push(parameter("sphi", ParameterSource::Sine(2), None));
    let system = System::new(parts.clone()).unwrap();
    assert_eq!(system.parameters[3].square.as_ref().unwrap().to_string(), "1 - cphi^2");
    assert_eq!(System::new(system.into_parts()).unwrap().parameters.len(), 4);
    parts.parameters[3].square = Some(parse("1 + cphi^2").unwrap());
    refused(parts, ErrorKind::BadValue, "square of `sphi`");
}

#[test]
fn text_lists_everything() {
    let mut parts = arm();
    parts.parameters.push(parameter("h", ParameterSource::SquareRoot, Some("1/2")));
    parts.inputs[0].positive = true;
    let text = System::new(parts).unwrap().to_string();
    for line in [
        "# nao_arm_planar: equations",
        "* Input py: a length, assumed greater than zero.",
        "* Known: h > 0, h^2 = 1/2.",
        "* Joint q2: the cosine c2 and the sine s2 of an angle.",
        "The unknowns, greatest first: c4 > c2 > s4 > s2.",
        "    (6.7.1)  f1 = 105*c2 + 113.7*s4 - pz = 0",
        "    (0.4)  f4 = c4^2 + s4^2 - 1 = 0",
        "The published solution has the minus root of s2.",
    ] {
        assert!(text.lines().any(|found| found == line), "`{line}` is not in\n{text}");
    }
}

#[test]
fn serde_reads_back_and_checks() {
    let system = System::new(arm()).unwrap();
    let json = serde_json::to_string(&system).unwrap();
    assert_eq!(serde_json::from_str::<System>(&json).unwrap(), system);
    let error = serde_json::from_str::<System>(&json.replace("\"py\"", "\"q2\"")).unwrap_err();
    assert!(error.to_string().contains("q2"), "{error}");
}

fn refused(parts: SystemParts, kind: ErrorKind, message: &str) {
    let error = System::new(parts).expect_err(message);
    assert!(
        error.kind() == kind && error.message().contains(message),
        "{error} ({:?}) lacks `{message}`",
        error.kind()
    );
}

/// Checks that the arm is refused after a change.
fn changed(change: impl FnOnce(&mut SystemParts), kind: ErrorKind, message: &str) {
    let mut parts = arm();
    change(&mut parts);
    refused(parts, kind, message);
}

#[test]
fn names_mean_one_thing() {
    use ErrorKind::{BadValue, DuplicateName};
    changed(|p| p.name = "two words".into(), BadValue, "cannot name the system");
    changed(|p| p.inputs[0].name = "2py".into(), BadValue, "cannot name an input");
    changed(|p| p.joints[0] = angle("q2", "c 2", "s2"), BadValue, "cannot name an unknown");
    changed(|p| p.joints[0] = angle("", "c2", "s2"), BadValue, "cannot name a joint");
    changed(|p| p.inputs[0].name = "pz".into(), DuplicateName, "`pz` is declared as an input and again as an input");
    changed(|p| p.parameters[0].name = "pz".into(), DuplicateName, "`pz`");
    changed(|p| p.joints[0] = angle("q2", "py", "s2"), DuplicateName, "as an input and again as an unknown");
    changed(|p| p.joints[0] = angle("q2", "c4", "s2"), DuplicateName, "`c4`");
    changed(|p| p.joints[0] = angle("q2", "c2", "c2"), DuplicateName, "`c2`");
    changed(|p| p.joints[0].name = "q4".into(), DuplicateName, "`q4`");
    changed(|p| p.joints[0].name = "s4".into(), DuplicateName, "as an unknown and again as a joint");
    changed(|p| p.joints.push(value("py", "d")), DuplicateName, "`py`");
    changed(
        |p| p.parameters.push(parameter("s2", ParameterSource::SquareRoot, Some("2"))),
        DuplicateName,
        "as a parameter and again as an unknown",
    );
}

#[test]
fn equations_are_checked() {
    use ErrorKind::{BadValue, MissingKey, Overflow, UnknownName};
    changed(|p| p.equations.push(equation("", "c2 + L1")), UnknownName, "equation 3: `L1`");
    changed(|p| p.equations.push(equation("(x)", "q2")), UnknownName, "equation 3 (x): `q2`");
    changed(|p| p.equations.push(equation("", "py/(pz + c2)")), BadValue, "divides by the unknown `c2`");
    changed(|p| p.equations.push(equation("", "((c2 + s2 + py)^1000)^1000")), Overflow, "lower its powers");
    changed(|p| p.equations.push(equation("", "c2 - (2^1000)^1000")), Overflow, "lower");
    changed(|p| p.equations.clear(), MissingKey, "no equations");
    changed(|p| p.equations = vec![equation("", "c2^2 + s2^2 = 1")], MissingKey, "besides circle");
    changed(|p| p.joints.clear(), MissingKey, "no joints");
    let many = |p: &mut SystemParts| {
        p.joints.extend((0..13).map(|i| value(&format!("d{i}"), &format!("x{i}"))));
        p.order = p.default_order();
    };
    changed(many, ErrorKind::Unsupported, "17 unknowns");
}

#[test]
fn order_and_choice_are_checked() {
    use ErrorKind::{BadValue, DuplicateName, UnknownName};
    changed(|p| p.order = names(&["c4", "c2", "s4"]), BadValue, "`s2` is missing");
    changed(|p| p.order = names(&["c4", "c2", "s4", "s2", "py"]), UnknownName, "`py` is not an unknown");
    changed(|p| p.order = names(&["c4", "c2", "s4", "s2", "s2"]), DuplicateName, "`s2` is given twice");
    changed(|p| p.choice.as_mut().unwrap().unknown = "py".into(), UnknownName, "choice: `py`");
}

#[test]
fn sources_of_parameters_are_checked() {
    use ErrorKind::{BadValue, UnknownName};
    let add = |source, square: Option<&'static str>| {
        move |p: &mut SystemParts| p.parameters.push(parameter("v", source, square))
    };
    changed(add(ParameterSource::Input(2), None), BadValue, "refers to input 2");
    changed(add(ParameterSource::Input(0), None), BadValue, "source of an earlier parameter");
    changed(add(ParameterSource::Cosine(0), None), BadValue, "not an angle");
    changed(add(ParameterSource::SquareRoot, None), BadValue, "needs its `square`");
    changed(add(ParameterSource::SquareRoot, Some("w")), UnknownName, "`w`");
    changed(add(ParameterSource::SquareRoot, Some("v + 1")), UnknownName, "`v`");
    changed(|p| p.inputs[0].quantity = Quantity::Angle, BadValue, "use its cosine and sine");
}

#[test]
fn square_roots_of_numbers_are_positive_and_independent() {
    let with = |squares: &[&str]| {
        let mut parts = arm();
        for (i, square) in squares.iter().enumerate() {
            parts.parameters.push(parameter(&format!("r{i}"), ParameterSource::SquareRoot, Some(square)));
        }
        parts
    };
    for fine in [&["2", "3", "5"][..], &["1/2", "2 + r0"], &["2", "py^2 + pz^2"], &["6", "10", "15/7"]] {
        assert!(System::new(with(fine)).is_ok(), "{fine:?}");
    }
    let bad = ErrorKind::BadValue;
    refused(with(&["4"]), bad, "depends on earlier roots");
    refused(with(&["0.25"]), bad, "depends on earlier roots");
    refused(with(&["0"]), bad, "not positive");
    refused(with(&["-2"]), bad, "not positive");
    refused(with(&["2^1000 + 1", "((3^1000)^20)"]), ErrorKind::Overflow, "digits");
    refused(with(&["1/0"]), bad, "division");
    refused(with(&["2", "1 - r0"]), bad, "`r1`: its square is -0.41");
    refused(with(&["2", "8"]), bad, "4/2*r0");
    refused(with(&["6", "10", "15"]), bad, "30/60*r0*r1");
    refused(with(&["2", "3", "5", "7", "11", "13", "17", "19", "23"]), ErrorKind::Unsupported, "more than 8");
}
