//! The limits of readers, tested at their boundaries.

use groebot_algebra::limits::{self, is_name, number};
use groebot_robot::model::Robot;
use groebot_robot::motion::StateTable;

#[test]
fn names_have_1_to_200_characters_and_none_acts() {
    let longest = "\u{e4}".repeat(200);
    for name in ["a", "left leg", "\u{4e2d}\u{6587}", longest.as_str()] {
        assert!(is_name(name), "{name}");
    }
    for name in ["", " ", "a\nb", "a\tb", "a\u{200f}b", "\u{feff}a", &format!("{longest}a")] {
        assert!(!is_name(name), "{name:?}");
    }
}

#[test]
fn numbers_of_tables_are_finite_and_not_huge() {
    for (cell, value) in [("1e15", 1e15), ("-1e15", -1e15), (" 2 ", 2.0), ("1e-300", 1e-300), ("-0", -0.0)] {
        assert_eq!(number(cell), Ok(value));
    }
    for cell in ["1e16", "1e160", "-1e400", "inf", "NaN", "", "1,5", "0x10"] {
        assert!(number(cell).is_err(), "{cell}");
    }
}

#[test]
fn a_table_of_states_names_line_and_column() {
    for (cell, word) in [("1e160", "too large"), ("NaN", "not a number"), ("inf", "too large"), ("x", "not a number")] {
        let error = StateTable::from_csv(&format!("q0,v0\r1,2\r3,{cell}\r")).unwrap_err();
        assert_eq!(error.place().line, Some(3), "{cell}");
        assert!(error.message().contains("`v0`") && error.message().contains(word), "{error}");
    }
    assert_eq!(StateTable::from_csv("q0,v0\r1,2\r3,4\r").unwrap().rows.len(), 2);
}

#[test]
fn an_element_has_at_most_so_many_attributes() {
    let robot = |count: usize| {
        let attributes: String = (1..count).map(|number| format!(" a{number}='1'")).collect();
        Robot::from_urdf(&format!("<robot name='r'><link name='a'{attributes}/></robot>"))
    };
    assert!(robot(limits::XML_ATTRIBUTES).is_ok());
    let error = robot(limits::XML_ATTRIBUTES + 1).unwrap_err();
    assert!(error.message().contains("200 attributes"), "{error}");
}
