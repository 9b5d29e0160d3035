//! Tables of states: what they tell, and refusals with their line.

use groebot::ErrorKind;
use groebot::motion::StateTable;

#[test]
fn lines_end_as_any_program_ends_them() {
    let text = "q0,v0\n1,2\n\n3,4\n";
    let table = StateTable::from_csv(text).unwrap();
    assert_eq!(table.rows.len(), 2);
    for ends in ["\r\n", "\r"] {
        assert_eq!(StateTable::from_csv(&text.replace('\n', ends)), Ok(table.clone()));
    }
    let error = StateTable::from_csv("q0\r1\rx\r").unwrap_err();
    assert_eq!(error.place().line, Some(3), "{error}");
}

#[test]
fn columns_stand_in_any_order() {
    let table = StateTable::from_csv("\u{feff}v1, q0 ,q1,v0,t\n\n 4,1,2,3,0.5\n-4e-1,1,2,inf,1\n").unwrap();
    assert_eq!((table.coordinates, table.rows.len()), (2, 2));
    let row = &table.rows[0];
    assert_eq!((row.time, &row.q), (Some(0.5), &vec![1.0, 2.0]));
    assert_eq!((&row.velocity, &row.acceleration, &row.torques), (&Some(vec![3.0, 4.0]), &None, &None));
    assert_eq!(StateTable::from_csv("q0\n").unwrap().rows, []);
}

#[test]
fn mistakes_have_a_line() {
    for (text, line, words) in [
        ("", 1, "the first row is ``"),
        ("\n\nv0,a0\n", 3, "the first row is `v0,a0`"),
        ("q0,q2\n", 1, "each list whole"),
        ("q0,q0\n", 1, "each list whole"),
        ("q0,v0,x\n", 1, "q0, q1, ..."),
        ("q0,v0\n1\n", 2, "1 cells stand in the row; the first one has 2 names"),
        ("q0,v0\n1,2\n\n1,two\n", 4, "column `v0`: `two` is no number"),
        ("q0\n\n", 0, ""),
    ] {
        let Err(error) = StateTable::from_csv(text) else {
            assert!(words.is_empty(), "{text:?}");
            continue;
        };
        assert_eq!((error.kind(), error.place().line), (ErrorKind::Syntax, Some(line)), "{error}");
        assert!(error.message().contains(words), "{error}");
    }
}
