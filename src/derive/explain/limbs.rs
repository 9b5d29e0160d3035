//! The report of limbs that share motors: how they are put together, then the report of each.

use super::chain;
use super::document::{Document, Line};
use crate::Result;
use crate::derive::closure::Mechanism;
use crate::derive::limbs::DerivedLimbs;

/// The report of `derived`.
///
/// # Errors
/// When a field cannot be built: never for a derivation that was made by this crate.
pub fn document(derived: &DerivedLimbs) -> Result<Document> {
    let parts = derived.limbs.parts();
    let mut page = Document::new(&format!("{}: its inverse kinematics, explained", parts.name));
    for text in [&parts.description, &parts.source].into_iter().flatten() {
        page.paragraph(Line::plain(text));
    }
    motors(&mut page, derived);
    page.say(&format!(
        "The limbs are solved one after the other. A joint whose motor a limb has found is given for the limbs behind it. Every \
         solution of all limbs is one of the first limb, continued by one of the next with the shared joints held, and so on: none \
         is lost. A generic target that the limbs can reach has {} complex solutions. Each answer is polished and measured on the \
         equations of all limbs together.",
        derived.dimension()
    ));
    shared(&mut page, derived)?;
    for stage in &derived.stages {
        page.section(Line::default().name(&derived.title(stage)));
        page.parts.extend(chain::document(&stage.derived)?.parts);
    }
    Ok(page)
}

/// How shared joints are found from both limbs at once.
fn shared(page: &mut Document, derived: &DerivedLimbs) -> Result<()> {
    let Some(coupled) = &derived.coupled else { return Ok(()) };
    page.section(Line::default().name(&derived.coupled_names().join(", ")).and(": from both limbs at once"));
    page.say(
        "Of each limb an equation is taken that holds no unknown joint but shared ones. What is measured stays the same on the arc whose \
         joints drop out, which has been computed; so the equation follows from the limb's loop.",
    );
    for (index, (limb, relation)) in derived.limbs.limbs().iter().zip(coupled.relations()?).enumerate() {
        let meaning = relation.meaning(&Mechanism::new(&limb.chain)?);
        page.paragraph(Line::default().name(&limb.name).and(&format!(": {meaning}.")));
        page.equation(&format!("0.{}", index + 2), relation.to_string());
    }
    page.say(match coupled.steps.as_slice() {
        [_] => "Both are linear in the cosine and sine of the joint, and each is solved alone where the other says nothing.",
        _ => {
            "Both are linear in the cosine and sine of the second joint. Their determinant is an equation in the first joint, of \
             degree two in its cosine and sine; its cofactors are multiplied out in the proof."
        }
    });
    Ok(())
}

/// Which motor moves which joints.
fn motors(page: &mut Document, derived: &DerivedLimbs) {
    page.section(Line::of("The limbs and their motors"));
    let mut rows = vec![["motor", "limb", "joint"].map(Line::of).to_vec()];
    for motor in derived.limbs.motors() {
        for place in &motor.joints {
            let limb = &derived.limbs.limbs()[place.limb];
            let name = limb.chain.joints()[place.joint].name.as_str();
            rows.push([motor.name.as_str(), limb.name.as_str(), name].map(|text| Line::default().name(text)).to_vec());
        }
    }
    page.table(rows);
}
