//! The forms of one joint's equations, solved for all values of their symbols.

use groebot_algebra::number::{Ring, Style};
use groebot_ik::Watch;
use groebot_ik::derive::equations::tree::Outcome;
use groebot_ik::derive::sequential::{Form, FormBasis, Forms};

fn form_basis(form: Form) -> FormBasis {
    FormBasis::derive(form, &Watch::none()).unwrap()
}

/// The proofs in `forms.json`, which certificates name by their hashes, are those that the Groebner engine derives.
#[test]
fn the_stored_forms_are_those_that_are_derived() {
    assert_eq!(Forms::derive_stored(&Watch::none()).unwrap(), Forms::stored());
}

/// Derived by hand: the line A c + B s + C = 0 has the distance |C| / sqrt(A^2 + B^2) from the centre of the circle.
#[test]
fn an_angle_divides_by_the_square_of_a_length_only() {
    let angle = form_basis(Form::Angle);
    let solved = angle.tree.solved().unwrap();
    let ring = &solved.triangular.ring;
    let w = ring.format(&solved.triangular.stairs[0].polynomials[0], Style::Text);
    assert_eq!(w, "w^2 + (-A^2 - B^2 + C^2)");
    let labels: Vec<&str> = angle.tree.walk().iter().map(|node| node.label.as_str()).collect();
    assert_eq!(labels, ["generic", "A = 0, B = 0", "A = 0, B = 0, C = 0"]);
}

/// Only the determinant of a pair has a zero set without description. On it, each equation is solved alone.
#[test]
fn every_stratum_is_derived_but_that_of_the_determinant() {
    for form in [Form::Angle, Form::Rotation, Form::Pair, Form::Linear, Form::Quadratic] {
        let open: Vec<String> = form_basis(form)
            .tree
            .walk()
            .into_iter()
            .filter(|node| matches!(node.outcome, Outcome::Open(_)))
            .map(|node| node.label.clone())
            .collect();
        let expected: &[&str] = if form == Form::Pair { &["B*E - A*F = 0"] } else { &[] };
        assert_eq!(open, expected, "{form:?}");
    }
}

#[test]
fn a_joint_is_free_where_all_symbols_vanish() {
    for form in [Form::Angle, Form::Rotation, Form::Linear, Form::Quadratic] {
        let form_basis = form_basis(form);
        let free = form_basis.tree.walk().into_iter().filter(|node| matches!(node.outcome, Outcome::SelfMotion(_)));
        let free: Vec<usize> = free.map(|node| node.setting.symbols.len()).collect();
        assert_eq!(free, [0], "{form:?}: all symbols are zero on the one stratum");
    }
}
