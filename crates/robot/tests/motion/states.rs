//! Tables of states: their contents, and refusals with their line.

use groebot_robot::ErrorKind;
use groebot_robot::motion::StateTable;

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
fn columns_may_be_in_any_order() {
    let table = StateTable::from_csv("\u{feff}v1, q0 ,q1,v0,t\n\n 4,1,2,3,0.5\n-4e-1,1,2,3e8,1\n").unwrap();
    assert_eq!((table.coordinates, table.rows.len()), (2, 2));
    let row = &table.rows[0];
    assert_eq!((row.time, &row.q), (Some(0.5), &vec![1.0, 2.0]));
    assert_eq!((&row.velocity, &row.acceleration, &row.torques), (&Some(vec![3.0, 4.0]), &None, &None));
}

#[test]
fn joints_are_named_in_any_order() {
    let text = "v:b,q:b,q0,v:a,q:a\n4,2,0,3,1\n";
    let table = StateTable::from_csv(text).unwrap();
    assert_eq!((table.coordinates, table.numbered, &table.joints), (3, 1, &vec!["b".to_owned(), "a".to_owned()]));
    let names = ["a", "b"].map(str::to_owned);
    let row = &table.clone().in_order_of(&names).unwrap().rows[0];
    assert_eq!((&row.q, &row.velocity), (&vec![0.0, 1.0, 2.0], &Some(vec![3.0, 4.0])));
    let error = table.clone().in_order_of(&names[..1]).unwrap_err();
    assert!(error.message().contains("`q:b`: the robot has no such independent joint"), "{error}");
    let more = ["a", "b", "c"].map(str::to_owned);
    assert!(table.in_order_of(&more).unwrap_err().message().contains("there is no column `q:c`"));
    // Each list names the same joints, once.
    for head in ["q:a,q:b,v:a", "q:a,v0", "q:a,q:a", "q0,v:a"] {
        assert!(StateTable::from_csv(&format!("{head}\n1,1,1\n")).is_err(), "{head}");
    }
}

#[test]
fn a_table_without_rows_and_numbers_out_of_range_are_refused() {
    for text in ["q0\n", "q0,v0\n\n\n"] {
        let error = StateTable::from_csv(text).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::MissingKey, Some(1)), "{error}");
    }
    for cell in ["inf", "NaN", "-1e160", "1e16"] {
        let error = StateTable::from_csv(&format!("t,q0,v0\n1e9,1,2\n1,1,{cell}\n")).unwrap_err();
        assert!(error.place().line == Some(3) && error.message().contains("column `v0`"), "{error}");
    }
}

#[test]
fn mistakes_have_a_line() {
    for (text, line, words) in [
        ("", 1, "the first row is ``"),
        ("\n\nv0,a0\n", 3, "the first row is `v0,a0`"),
        ("q0,q2\n", 1, "each list whole"),
        ("q0,q0\n", 1, "each list whole"),
        ("q0,v0,x\n", 1, "q0, q1, ..."),
        ("q0,v0\n1\n", 2, "1 cells are in the row; the first one has 2 names"),
        ("q0,v0\n1,2\n\n1,two\n", 4, "column `v0`: `two` is not a number"),
    ] {
        let error = StateTable::from_csv(text).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (ErrorKind::Syntax, Some(line)), "{error}");
        assert!(error.message().contains(words), "{error}");
    }
}
