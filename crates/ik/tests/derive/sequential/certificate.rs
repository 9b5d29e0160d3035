//! The certificate of a chain: proved again without search, refused if forged.

use groebot_ik::ErrorKind;
use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::Chain;
use groebot_robot::robots;
use serde_json::Value;

use super::derive;

fn puma() -> (groebot_robot::kinematics::Chain, String) {
    let chain = robots::puma();
    let text = derive(&chain).certificate().unwrap();
    (chain, text)
}

#[test]
fn it_proves_the_same_derivation_again() {
    for robot in robots::ALL {
        let derived = derive(&robot.chain());
        let text = derived.certificate().unwrap();
        assert_eq!(Derivation::prove(&robot.chain(), &text).unwrap(), derived, "{}", robot.name());
        assert_eq!(text, derive(&robot.chain()).certificate().unwrap(), "the same bytes at every run");
        let size: usize = derived.stage_files().unwrap().iter().map(|(_, bytes)| bytes.len()).sum();
        assert!(size < 500_000 && text.len() < 200_000, "{}: {size} {}", robot.name(), text.len());
    }
}

/// Earlier certificates name the method of a step `way`.
#[test]
fn the_former_key_of_a_method_is_read() {
    let (chain, text) = puma();
    let former = text.replace("\"method\":", "\"way\":");
    assert_ne!(former, text);
    assert_eq!(Derivation::prove(&chain, &former), Derivation::prove(&chain, &text));
}

fn refused(change: impl Fn(&mut Value)) -> String {
    let (chain, text) = puma();
    let mut value: Value = serde_json::from_str(&text).unwrap();
    change(&mut value["claims"]);
    let error = Derivation::prove(&chain, &value.to_string()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
    error.message().to_owned()
}

#[test]
fn a_forged_plan_fails_at_its_step() {
    let text = refused(|value| value["plan"]["steps"].as_array_mut().unwrap().swap(0, 3));
    assert!(text.contains("step 1"), "{text}");
    let text = refused(|value| drop(value["plan"]["steps"].as_array_mut().unwrap().pop()));
    assert!(text.contains("every joint"), "{text}");
    let text = refused(|value| value["plan"]["steps"][1]["degree"] = 1.into());
    assert!(text.contains("step 2"), "{text}");
    let text = refused(|value| value["plan"]["dimension"] = 4.into());
    assert!(text.contains("8 solutions"), "{text}");
}

#[test]
fn a_forged_relation_or_form_is_refused() {
    let text = refused(|value| {
        let method = &mut value["plan"]["steps"][1]["method"];
        let relation = if method["single"].is_null() { &mut method["pair"][0] } else { &mut method["single"] };
        let object = relation["moved"].as_object_mut().unwrap().values_mut().next().unwrap();
        object[0] = "7/3".into();
    });
    assert!(text.contains("step 2") && text.contains("does not follow"), "{text}");
    let text = refused(|value| value["forms"][0]["hash"] = "0".repeat(64).into());
    assert!(text.contains("form `angle`"), "{text}");
    let text = refused(|value| value["forms"].as_array_mut().unwrap().swap(0, 1));
    assert!(text.contains("names another form"), "{text}");
    let text = refused(|value| drop(value["forms"].as_array_mut().unwrap().pop()));
    assert!(text.contains("the forms are not those of the steps"), "{text}");
}

/// An equation about the direction zero is 0 = 0. It is true, but every value of the joint solves it.
#[test]
fn an_equation_without_its_joint_is_refused() {
    let chain = Chain::from_toml(include_str!("../../../../../derivations/polar/0_chain.toml")).unwrap();
    let whole: Value = serde_json::from_str(&derive(&chain).certificate().unwrap()).unwrap();
    for step in 0..3 {
        let mut value = whole.clone();
        let direction = &mut value["claims"]["plan"]["steps"][step]["method"]["single"]["fixed"]["direction"];
        assert!(direction.is_array(), "{direction}");
        *direction = serde_json::json!(["0", "0", "0"]);
        let error = Derivation::prove(&chain, &value.to_string()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
        assert!(error.message().contains("does not contain its joint"), "{error}");
    }
}

/// A position does not specify other points of the tip. An equation about such a point holds in the loop, but not for all poses with that position.
#[test]
fn an_equation_about_what_the_task_does_not_see_is_refused() {
    let chain = Chain::from_toml(include_str!("../../../../../derivations/polar/0_chain.toml")).unwrap();
    let mut value: Value = serde_json::from_str(&derive(&chain).certificate().unwrap()).unwrap();
    let point = &mut value["claims"]["plan"]["steps"][0]["method"]["single"]["moved"]["point"];
    assert!(point.as_array().is_some_and(|point| point.len() == 3), "{point}");
    point.as_array_mut().unwrap().swap(0, 1);
    let error = Derivation::prove(&chain, &value.to_string()).unwrap_err();
    assert!(
        error.kind() == ErrorKind::Certificate && error.message().contains("that the task does not specify"),
        "{error}"
    );
}
