//! A certificate proves its derivation without the Groebner engine, and a damaged certificate does not.

use std::sync::OnceLock;

use groebot_ik::ErrorKind;
use groebot_ik::derive::Derivation;
use proptest::prelude::*;
use serde_json::Value;

use super::seed::{derive, source, symbolic_leg};

/// The leg, derived once, and its certificate.
fn leg() -> &'static (Derivation, String) {
    static LEG: OnceLock<(Derivation, String)> = OnceLock::new();
    LEG.get_or_init(|| {
        let derivation = derive(source("nao_leg_sagittal").system.unwrap());
        let text = derivation.certificate().unwrap();
        (derivation, text)
    })
}

#[test]
fn what_is_written_is_proved_again() {
    for system in [source("nao_leg_sagittal").system.unwrap(), source("nao_arm_planar").system.unwrap(), symbolic_leg()]
    {
        let derivation = derive(system);
        let text = derivation.certificate().unwrap();
        assert_eq!(Derivation::prove(derivation.problem().clone(), &text).unwrap(), derivation);
    }
}

/// Applies `damage` to the parsed certificate and returns the error.
fn damaged(damage: impl FnOnce(&mut Value)) -> groebot_ik::Error {
    let (derivation, text) = leg();
    let mut whole: Value = serde_json::from_str(text).unwrap();
    let before = whole.clone();
    damage(&mut whole["claims"]);
    let value = whole;
    assert_ne!(value, before, "the damage took effect");
    Derivation::prove(derivation.problem().clone(), &value.to_string()).unwrap_err()
}

fn expect(error: &groebot_ik::Error, words: &str) {
    assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
    assert!(error.message().contains(words), "{error}");
}

#[test]
fn forged_claims_are_refused_and_located() {
    let basis = |value: &mut Value, tree: &str, stratum: usize| value[tree][stratum]["claim"]["basis"].take();
    let error = damaged(|v| v["requested"][0]["claim"]["basis"][1] = "s4".into());
    expect(
        &error,
        "requested order: stratum `generic`: the combination of the generators with the cofactors of basis element 2",
    );
    let error = damaged(|v| v["requested"][0]["claim"]["cofactors"][2][0] = "0".into());
    expect(&error, "the cofactors of basis element 3");
    let error = damaged(|v| {
        let mut list = basis(v, "searched", 0);
        list.as_array_mut().unwrap().pop();
        v["searched"][0]["claim"]["basis"] = list;
        v["searched"][0]["claim"]["cofactors"].as_array_mut().unwrap().pop();
    });
    expect(&error, "searched order: stratum `generic`");
    let error = damaged(|v| drop(v["requested"].as_array_mut().unwrap().remove(1)));
    expect(&error, "stratum `pz = 0` is missing");
    let error = damaged(|v| {
        let extra = v["requested"][1].clone();
        v["requested"].as_array_mut().unwrap().push(extra);
    });
    expect(&error, "does not belong");
    let error = damaged(|v| v["requested"][1]["claim"]["kind"] = "inconsistent".into());
    expect(&error, "not of the claimed kind");
    let error = damaged(|v| v["requested"][0]["claim"]["order"] = serde_json::json!(["c4", "c3", "s4", "c4"]));
    expect(&error, "the order is not one of the unknowns");
    let (derivation, text) = leg();
    let other = text.replacen("\"name\": \"nao_leg_sagittal\"", "\"name\": \"another\"", 1);
    expect(
        &Derivation::prove(derivation.problem().clone(), &other).unwrap_err(),
        "this certificate proves the equations `another`",
    );
    let error = damaged(|v| drop(v.as_object_mut().unwrap().remove("requested")));
    assert_eq!(error.kind(), ErrorKind::Syntax, "{error}");
}

#[test]
fn an_open_claim_does_not_pass_for_a_derivation() {
    let open = serde_json::json!({"kind": "open", "reason": "", "order": [], "basis": [], "cofactors": []});
    let error = damaged(|v| v["requested"] = serde_json::json!([{"stratum": "generic", "claim": open}]));
    expect(&error, "it is claimed to be open, but it can be derived");
}

/// Every stratum of the leg can be derived in both orders, so none may be claimed to be open.
#[test]
fn a_stratum_that_can_be_derived_is_not_open() {
    let (_, text) = leg();
    let value: Value = serde_json::from_str(text).unwrap();
    let mut count = 0;
    for tree in ["requested", "searched"] {
        for at in 1..value["claims"][tree].as_array().unwrap().len() {
            for reason in ["", "strata nest too deep"] {
                let open =
                    serde_json::json!({"kind": "open", "reason": reason, "order": [], "basis": [], "cofactors": []});
                let error = damaged(|v| v[tree][at]["claim"] = open);
                expect(&error, "it is claimed to be open, but it can be derived");
                count += 1;
            }
        }
    }
    assert!(count >= 4, "{count}");
}

/// Where a divisor vanishes, the equations do not determine the joints. The derivation leaves that stratum open. Its certificate may do so too, but only with
/// that reason.
#[test]
fn a_stratum_that_the_derivation_leaves_open_may_be_open() {
    let system = groebot_ik::derive::System::from_toml(
        "name = \"divided\"\nlength_unit = \"m\"\norder = [\"x\"]\n[[parameter]]\nname = \"a\"\n[[parameter]]\nname = \"b\"\n\
         [[joint]]\nname = \"x\"\nunknown = \"x\"\n[[equation]]\nlabel = \"(1)\"\nequation = \"x/a - b = 0\"\n",
    );
    let derivation = derive(system.unwrap());
    let text = derivation.certificate().unwrap();
    assert!(text.contains("\"kind\": \"open\""), "{text}");
    assert_eq!(Derivation::prove(derivation.problem().clone(), &text).unwrap(), derivation);
    let start = text.find("\"reason\": \"").unwrap() + "\"reason\": \"".len();
    let forged = format!("{}it is hot{}", &text[..start], &text[start..]);
    expect(&Derivation::prove(derivation.problem().clone(), &forged).unwrap_err(), "another reason");
}

#[test]
fn the_certificate_of_another_mechanism_proves_nothing() {
    let (_, text) = leg();
    let mut parts = source("nao_leg_sagittal").system.unwrap().into_parts();
    parts.equations[0].expression = groebot_algebra::poly::parse("100*s3 + 103*(s3*c4 + c3*s4) - px").unwrap();
    let other = groebot_ik::derive::System::new(parts).unwrap();
    expect(&Derivation::prove(other, text).unwrap_err(), "stratum `generic`");
}

proptest! {
    #![proptest_config(crate::cases(60))]

    /// After a change of one character, the text either has the same meaning or is refused. It never panics.
    #[test]
    fn one_changed_character_never_proves_something_else(place in 0.0..1.0f64, letter in "[ -~]") {
        let (derivation, text) = leg();
        let mut bytes = text.clone().into_bytes();
        let index = (place * bytes.len() as f64) as usize;
        bytes[index] = letter.as_bytes()[0];
        let changed = String::from_utf8(bytes).unwrap();
        if let Ok(proved) = Derivation::prove(derivation.problem().clone(), &changed) {
            prop_assert_eq!(proved.program(), derivation.program());
        }
    }

    #[test]
    fn noise_is_no_certificate(noise in "\\PC{0,400}") {
        let (derivation, _) = leg();
        prop_assert!(Derivation::prove(derivation.problem().clone(), &noise).is_err());
    }
}
