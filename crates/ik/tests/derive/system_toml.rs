//! The reader of `system.toml`: the arm, constants and angles, and each mistake with its kind, line and message.

use groebot_algebra::poly::parse;
use groebot_ik::ErrorKind::{self, *};
use groebot_ik::derive::*;
use proptest::prelude::*;

/// The line numbers of the mistakes below refer to this text.
const ARM: &str = r#"name = "nao_arm_planar"
description = "two joints in a plane"
source = "NAO (6.7.1)-(6.7.4)"
length_unit = "mm"
order = ["c4", "c2", "s4", "s2"]
[constants]
L1 = 105
L2 = "55.95 + 57.75"
[[parameter]]
name = "py"
[[parameter]]
name = "pz"
positive = true
[[joint]]
name = "q2"
cosine = "c2"
sine = "s2"
[[joint]]
name = "q4"
cosine = "c4"
sine = "s4"
[[equation]]
label = "(6.7.1)"
equation = "L1*c2 + L2*s4 - pz = 0"
[[equation]]
label = "(6.7.2)"
equation = "L1*s2 + L2*c4 - py = 0"
[choice]
unknown = "s2"
root = "minus"
"#;

#[test]
fn the_arm_is_read() {
    let arm = System::from_toml(ARM).unwrap();
    assert_eq!(arm.length_unit, LengthUnit::Millimetre);
    assert_eq!(arm.order, ["c4", "c2", "s4", "s2"]);
    assert_eq!(arm.inputs[1], Input { name: "pz".into(), quantity: Quantity::Length, positive: true });
    assert_eq!(arm.parameters[0], Parameter { name: "py".into(), source: ParameterSource::Input(0), square: None });
    assert_eq!(arm.choice, Some(Choice { unknown: "s2".into(), root: Root::Minus }));
    let texts: Vec<String> = arm.equations.iter().map(|e| e.expression.to_string()).collect();
    let expected = ["105*c2 + 113.7*s4 - pz", "105*s2 + 113.7*c4 - py", "c2^2 + s2^2 - 1", "c4^2 + s4^2 - 1"];
    assert_eq!(texts, expected);
    let json = serde_json::to_string(&arm).unwrap();
    assert_eq!(serde_json::from_str::<System>(&json).unwrap(), arm);
}

#[test]
fn the_documented_example_is_this_arm() {
    let page = include_str!("../../../../docs/system_toml.md");
    let example = page.split("```").nth(1).and_then(|block| block.strip_prefix("toml")).unwrap();
    let (example, arm) = (System::from_toml(example).unwrap(), System::from_toml(ARM).unwrap());
    assert_eq!((&example.equations, &example.order, &example.choice), (&arm.equations, &arm.order, &arm.choice));
}

/// A pose of the arm, computed by trigonometry, satisfies all equations.
#[test]
fn a_pose_of_the_arm_satisfies_the_equations() {
    let (q2, q4) = (0.3_f64, -1.1_f64);
    let pose = |name: &str| match name {
        "c2" => Some(q2.cos()),
        "s2" => Some(q2.sin()),
        "c4" => Some(q4.cos()),
        "s4" => Some(q4.sin()),
        "pz" => Some(105.0 * q2.cos() + (55.95 + 57.75) * q4.sin()),
        "py" => Some(105.0 * q2.sin() + (55.95 + 57.75) * q4.cos()),
        _ => None,
    };
    for equation in &System::from_toml(ARM).unwrap().equations {
        assert!(equation.expression.evaluate_f64(&pose).unwrap().abs() < 1e-12, "{}", equation.label);
    }
}

#[test]
fn what_is_optional_has_defaults() {
    let text = r#"
        name = "rail"
        equations = ["d1 + 2*c = x", "t^2 = 2"]
        [[parameter]]
        name = "x"
        [[joint]]
        name = "d1"
        unknown = "d1"
        [[joint]]
        name = "q"
        cosine = "c"
        sine = "s"
        [[joint]]
        name = "other"
        unknown = "t"
    "#;
    let rail = System::from_toml(text).unwrap();
    assert_eq!(rail.length_unit, LengthUnit::Metre);
    assert_eq!(rail.order, ["c", "s", "d1", "t"]);
    assert_eq!(rail.equations.len(), 3);
    assert!(rail.choice.is_none() && rail.description.is_empty());
}

#[test]
fn constants_are_exact_and_roots_stay_names() {
    let constants = "a = 0.1\nb = \"a/3 - 1e-3\"\nh = { square = \"1/2\" }\nk = \"2*h\"\nr = { square = 2.25 }\n\
                     m = { square = \"2 + h\" }\nz = 0x10\nnegative = -3\nfraction = \"1029/10000\"";
    let text = ARM
        .replace("L1 = 105", &format!("L1 = 105\n{constants}"))
        .replace("L1*c2 + L2*s4 - pz", "b*c2 + k^2*s2 + r*s4 - z*negative + h*m + fraction");
    let system = System::from_toml(&text).unwrap();
    let expression = &system.equations[0].expression;
    let expected = parse("(97/3000)*c2 + (2*h)^2*s2 + 1.5*s4 - 16*(-3) + h*m + 0.1029").unwrap();
    assert_eq!(*expression, expected, "{expression}");
    let names: Vec<&str> = system.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["h", "m", "py", "pz"]);
    assert_eq!(system.parameters[1].square, Some(parse("2 + h").unwrap()));
    assert_eq!(system.parameters[1].source, ParameterSource::SquareRoot);
    let json = serde_json::to_string(&system).unwrap();
    assert_eq!(serde_json::from_str::<System>(&json).unwrap(), system);
}

#[test]
fn an_angle_is_given_by_cosine_and_sine() {
    let angle =
        "name = \"phi\"\nquantity = \"angle\"\ncosine = \"cphi\"\nsine = \"sphi\"\n[[parameter]]\nname = \"pz\"";
    let text = ARM.replace("name = \"pz\"", angle).replace("- pz", "- pz*sphi");
    let system = System::from_toml(&text).unwrap();
    assert_eq!(system.inputs[1].quantity, Quantity::Angle);
    assert_eq!(system.parameters[1].source, ParameterSource::Cosine(1));
    assert_eq!(system.parameters[2].source, ParameterSource::Sine(1));
    assert_eq!(system.parameters[2].square.as_ref().unwrap().to_string(), "1 - cphi^2");
    assert_eq!(system.parameters[3].source, ParameterSource::Input(2));
}

/// Checks that the arm with one `from` replaced by `to` is refused with `kind`, at `line`, and with a message that contains `message`.
fn refused(from: &str, to: &str, kind: ErrorKind, line: usize, message: &str) {
    assert!(ARM.contains(from), "{from}");
    let error = System::from_toml(&ARM.replacen(from, to, 1)).expect_err(message);
    let right = error.kind() == kind && error.place().line == Some(line) && error.message().contains(message);
    assert!(right, "`{error}` ({:?}) for {from} -> {to}", error.kind());
}

#[test]
fn keys_and_types_are_checked() {
    refused("source", "sources", UnknownKey, 3, "did you mean `source`");
    refused("positive", "positiv", UnknownKey, 13, "positive");
    refused("label = \"(6.7.2)\"", "tag = 1", UnknownKey, 26, "label");
    refused("unknown = \"s2\"", "unknow = \"s2\"", UnknownKey, 29, "unknown");
    refused("cosine = \"c2\"", "cos = \"c2\"", UnknownKey, 16, "cosine");
    refused("L1 = 105", "L1 = { sqare = 2 }", UnknownKey, 7, "square");
    refused("name = \"nao_arm_planar\"\n", "", MissingKey, 1, "name");
    refused("name = \"py\"\n", "", MissingKey, 9, "name");
    refused("sine = \"s2\"\n", "", MissingKey, 14, "cosine and sine");
    refused("sine = \"s2\"\n", "unknown = \"d\"\n", BadValue, 14, "both");
    refused("root = \"minus\"\n", "", MissingKey, 28, "root");
    refused("root = \"minus\"", "root = minus", Syntax, 30, "TOML");
    refused("label = \"(6.7.2)\"\nequation", "label", MissingKey, 25, "no `equation`");
    refused("positive = true", "name = \"px\"", Syntax, 13, "TOML");
    refused("name = \"nao_arm_planar\"", "name = 7", BadValue, 1, "string");
    refused("order = [\"c4\", \"c2\", \"s4\", \"s2\"]", "order = \"c4\"", BadValue, 5, "array");
    refused("\"c4\", \"c2\"", "\"c4\", 2", BadValue, 5, "string");
    refused("length_unit = \"mm\"", "length_unit = \"inch\"", BadValue, 4, "`mm`");
    refused("positive = true", "positive = 1", BadValue, 13, "true or false");
    refused("positive = true", "quantity = \"speed\"", BadValue, 13, "`angle`");
    refused("positive = true", "cosine = \"c\"", BadValue, 13, "only an angle");
    refused("positive = true", "quantity = \"angle\"", MissingKey, 11, "cosine");
    refused("root = \"minus\"", "root = \"left\"", BadValue, 30, "`plus`");
    refused("[choice]", "[[choice]]", BadValue, 28, "table");
    refused("[constants]", "[[constants]]", BadValue, 6, "table");
    refused("L1 = 105", "L1 = true", BadValue, 7, "number");
    refused("L1 = 105", "L1 = nan", BadValue, 7, "finite");
    refused("L1 = 105", "L1 = inf", BadValue, 7, "finite");
}

#[test]
fn expressions_and_names_are_checked() {
    refused("L1*s2", "L1 s2", Syntax, 27, "column 4: a product needs `*`; write `L1*s2`");
    refused("L1*s2 + L2*c4", "L1*s2 + L3*c4", UnknownName, 27, "`L3`");
    refused("L1*s2 + L2*c4", "L1*s2/c4", BadValue, 27, "divides by the unknown `c4`");
    refused("L1*s2 + L2*c4", "(s2 + c2 + py)^1000", Overflow, 27, "lower its powers");
    refused("55.95 + 57.75", "55.95 + ", Syntax, 8, "column 9");
    refused("55.95 + 57.75", "L3 + 1", UnknownName, 8, "`L3`");
    refused("55.95 + 57.75", "L2 + 1", UnknownName, 8, "`L2`");
    refused("55.95 + 57.75", "1/(L1 - 105)", BadValue, 8, "division");
    refused("55.95 + 57.75", "(9^1000)^1000", Overflow, 8, "bits");
    refused("L1 = 105", "\"L 1\" = 105", BadValue, 7, "not a valid name");
    refused("L1 = 105", "L1 = { square = -2 }", BadValue, 7, "not positive");
    refused("L1 = 105", "L1 = { square = 0 }", BadValue, 7, "not positive");
    refused("L2 = \"55.95 + 57.75\"", "a = { square = 2 }\nL2 = { square = 8 }", BadValue, 9, "4/2*a");
    refused("L1 = 105", "py = 105", DuplicateName, 10, "constant already");
    refused("L1 = 105", "c2 = 105", DuplicateName, 16, "constant already");
    refused("L1 = 105", "q4 = 105", DuplicateName, 19, "constant already");
    refused("name = \"pz\"", "name = \"py\"", DuplicateName, 11, "`py`");
    refused("name = \"pz\"", "name = \"s4\"", DuplicateName, 18, "as an input and again as an unknown");
    refused("name = \"q4\"", "name = \"q2\"", DuplicateName, 18, "`q2`");
    refused("cosine = \"c4\"", "cosine = \"c2\"", DuplicateName, 18, "`c2`");
    refused("cosine = \"c4\"", "cosine = \"c-4\"", BadValue, 18, "`c-4`");
    refused("\"nao_arm_planar\"", "\"nao arm\"", BadValue, 1, "the system");
    refused("\"s4\", \"s2\"]", "\"s4\"]", BadValue, 5, "`s2` is missing");
    refused("\"s4\", \"s2\"]", "\"s4\", \"s4\"]", DuplicateName, 5, "twice");
    refused("\"s4\", \"s2\"]", "\"s4\", \"py\"]", UnknownName, 5, "`py` is not an unknown");
    refused("unknown = \"s2\"", "unknown = \"s9\"", UnknownName, 29, "`s9` is not an unknown");
    refused("order", "equations = [\"c2\"]\norder", DuplicateName, 5, "use one of the two");
}

#[test]
fn missing_parts_are_named() {
    let kind = |text: &str| System::from_toml(text).unwrap_err();
    assert_eq!(kind("").kind(), MissingKey);
    assert!(kind("").to_string().contains("`name`"));
    let joint = "name = \"a\"\n[[joint]]\nname = \"q\"\nunknown = \"x\"";
    assert!(kind("name = \"a\"").message().contains("`joint`"));
    assert!(kind(joint).message().contains("no equations"));
    assert!(kind(&format!("equations = []\n{joint}")).message().contains("no equations"));
    assert!(kind("name = \"a\"\njoint = []").message().contains("no joints"));
    let many: String = (0..17).map(|i| format!("[[joint]]\nname = \"q{i}\"\nunknown = \"x{i}\"\n")).collect();
    assert_eq!(kind(&format!("name = \"a\"\nequations = [\"x1\"]\n{many}")).kind(), Unsupported);
    let many: String = (0..65).map(|i| format!("[[parameter]]\nname = \"p{i}\"\n")).collect();
    assert_eq!(kind(&format!("{joint}\n{many}")).kind(), Unsupported);
}

#[test]
fn constants_cannot_explode() {
    let doubling: String = (1..60).map(|i| format!("a{i} = \"a{}*a{0}\"\n", i - 1)).collect();
    for first in ["{ square = 2 }", "3", "\"1/3\""] {
        let text = ARM.replace("L1 = 105", &format!("a0 = {first}\n{doubling}L1 = 105"));
        assert_eq!(System::from_toml(&text).unwrap_err().kind(), Overflow, "{first}");
    }
    let nested: String = (1..900).map(|i| format!("a{i} = \"1/(1 + a{})\"\n", i - 1)).collect();
    let text = ARM.replace("L1 = 105", &format!("a0 = {{ square = 2 }}\n{nested}L1 = \"a899\""));
    assert_eq!(System::from_toml(&text).unwrap_err().kind(), Overflow);
    let nested: String = (1..240).map(|i| format!("a{i} = \"-a{}\"\n", i - 1)).collect();
    let text = ARM.replace("L1 = 105", &format!("a0 = {{ square = 2 }}\n{nested}L1 = \"a239\""));
    let error = System::from_toml(&text).unwrap_err();
    assert!(error.kind() == Syntax && error.message().contains("with its constants"), "{error}");
}

#[test]
fn files_are_read_with_their_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("system.toml");
    assert_eq!(InputFile::read(&path).unwrap_err().kind(), Io);
    std::fs::write(&path, ARM).unwrap();
    assert_eq!(InputFile::read(&path).unwrap().description, Description::System(System::from_toml(ARM).unwrap()));
    std::fs::write(&path, ARM.replace("order", "ordre")).unwrap();
    assert!(InputFile::read(&path).unwrap_err().to_string().contains("system.toml: line 5: "));
    std::fs::write(&path, "").unwrap();
    assert_eq!(InputFile::read(&path).unwrap_err().kind(), Syntax);
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn noise_never_panics(text in "\\PC{0,60}", at in 0..ARM.len(), length in 0usize..30, noise in "[-\"a-z0-9=*/^()\\[\\]{}., \n]{0,10}") {
        let _ = System::from_toml(&text);
        let end = (at + length).min(ARM.len());
        let _ = System::from_toml(&format!("{}{noise}{}", &ARM[..at], &ARM[end..]));
    }
}
