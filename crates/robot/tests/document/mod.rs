//! The TOML layer: exact numbers, lines, messages, and no panics.

mod converted;

use std::path::Path;

use groebot_algebra::number::parse_rational;
use groebot_robot::document::{Document, Node, Table, json_text, read_text};
use groebot_robot::{ErrorKind, Result};
use proptest::prelude::*;

use crate::errors::assert_error;

const SAMPLE: &str = "\
# a comment
name = 'leg'   # line 2
whole = 1_000
decimal = 0.1029
fraction = \"1029/10000\"
hex = 0xff
flag = true
vector = [1,
  2.5,
  '1/3']
day = 1979-05-27
nan = nan

[table]
key = -inf

[[row]]
a = 1

[[row]]
a = 2
";

fn sample(check: impl Fn(Table<'_>)) {
    check(Document::parse(SAMPLE).unwrap().root());
}

#[test]
fn values_are_read_exactly() {
    sample(|root| {
        let exact = |key: &str| root.required(key).unwrap().exact().unwrap();
        assert_eq!(root.required("name").unwrap().text().unwrap(), "leg");
        assert_eq!(exact("decimal"), parse_rational("1029/10000").unwrap());
        assert_eq!(exact("fraction"), exact("decimal"));
        assert_eq!(exact("hex"), parse_rational("255").unwrap());
        assert_eq!(root.required("whole").unwrap().count().unwrap(), 1000);
        assert_eq!(root.required("decimal").unwrap().float().unwrap(), 0.1029);
        assert!(root.required("flag").unwrap().boolean().unwrap());
        let vector = root.required("vector").unwrap();
        assert_eq!(vector.exact_vector::<3>().unwrap(), ["1", "2.5", "1/3"].map(|x| parse_rational(x).unwrap()));
        assert_eq!(vector.float_vector::<3>().unwrap(), [1.0, 2.5, 1.0 / 3.0]);
        let rows = root.required("row").unwrap().tables().unwrap();
        let counts: Vec<usize> = rows.iter().map(|row| row.required("a").unwrap().count().unwrap()).collect();
        assert_eq!(counts, [1, 2]);
        assert!(root.optional("absent").is_none());
    });
}

#[test]
fn lines_count_from_one() {
    sample(|root| {
        assert_eq!(root.required("name").unwrap().line(), 2);
        let elements = root.required("vector").unwrap().array().unwrap();
        assert_eq!(elements.iter().map(Node::line).collect::<Vec<_>>(), [8, 9, 10]);
        assert_eq!(root.required("table").unwrap().table().unwrap().line(), 14);
        let rows = root.required("row").unwrap().tables().unwrap();
        assert_eq!(rows.iter().map(Table::line).collect::<Vec<_>>(), [17, 20]);
        let names: Vec<&str> = root.entries().iter().map(Node::name).collect();
        assert_eq!(names[..3], ["name", "whole", "decimal"]);
    });
}

#[test]
fn a_line_ends_with_its_newline() {
    let document = Document::parse("a = [\n1\n,\n2]").unwrap();
    let elements = document.root().required("a").unwrap().array().unwrap();
    assert_eq!(elements.iter().map(Node::line).collect::<Vec<_>>(), [2, 4]);
}

#[test]
fn every_wrong_type_reports_what_is_allowed() {
    type Read = fn(Node<'_>) -> Result<()>;
    let cases: [(&str, Read, usize, &str); 11] = [
        ("whole", |n| n.text().map(drop), 3, "a string"),
        ("flag", |n| n.exact().map(drop), 7, "a number"),
        ("day", |n| n.exact().map(drop), 11, "a date or time"),
        ("nan", |n| n.exact().map(drop), 12, "finite"),
        ("name", |n| n.boolean().map(drop), 2, "true or false"),
        ("decimal", |n| n.count().map(drop), 4, "non-negative integer"),
        ("whole", |n| n.array().map(drop), 3, "an array"),
        ("vector", |n| n.exact_vector::<2>().map(drop), 8, "3 elements are given; give an array of 2 numbers"),
        ("whole", |n| n.exact_vector::<2>().map(drop), 3, "an array of 2 numbers"),
        ("vector", |n| n.tables().map(drop), 8, "[[vector]]"),
        ("table", |n| n.tables().map(drop), 14, "[[table]]"),
    ];
    sample(|root| {
        for (key, read, line, word) in cases {
            let error = read(root.required(key).unwrap()).unwrap_err();
            assert_error(&error, ErrorKind::BadValue, Some(line), word);
        }
        let infinite = root.required("table").unwrap().table().unwrap().required("key").unwrap();
        assert_error(&infinite.exact().unwrap_err(), ErrorKind::BadValue, Some(15), "finite");
        let text = root.required("name").unwrap().exact().unwrap_err();
        assert_error(&text, ErrorKind::Syntax, Some(2), "`name`: `leg` is not an exact number");
        let choice = root.required("name").unwrap().one_of(&[("leg", 1), ("arm", 2)]).unwrap();
        assert_eq!(choice, 1);
        let choice = root.required("name").unwrap().one_of(&[("leggy", 1), ("arm", 2)]).unwrap_err();
        assert_error(&choice, ErrorKind::BadValue, Some(2), "allowed: `leggy`, `arm`");
    });
}

#[test]
fn keys_are_checked() {
    let document = Document::parse("nam = 1\n[joint]\nzzz = 1\nlimit = 2").unwrap();
    let unknown = document.root().deny_unknown(&["name", "joint"]).unwrap_err();
    assert_error(&unknown, ErrorKind::UnknownKey, Some(1), "did you mean `name`?");
    let joint = document.root().required("joint").unwrap().table().unwrap();
    let unknown = joint.deny_unknown(&["axis", "limits"]).unwrap_err();
    assert_error(&unknown, ErrorKind::UnknownKey, Some(3), "`zzz`; allowed: `axis`, `limits`");
    assert_error(&joint.required("axis").unwrap_err(), ErrorKind::MissingKey, Some(2), "`joint` has no `axis`");
    joint.deny_unknown(&["zzz", "limit"]).unwrap();
}

#[test]
fn bad_toml_has_a_line() {
    for (text, line) in
        [("a = 1\nb = ", 2), ("a = 1\n\na = 2", 3), ("[t]\n[t]", 2), ("\n\n=", 3), ("a = 'x", 1), ("a =\nb = 1", 1)]
    {
        assert_error(&Document::parse(text).unwrap_err(), ErrorKind::Syntax, Some(line), "not TOML");
    }
}

#[test]
fn files_are_read_with_typed_errors() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let fails = |path: &Path, kind, line, word| {
        let error = read_text(path, 100).unwrap_err();
        assert_error(&error, kind, line, word);
        assert_eq!(error.place().file.as_deref(), Some(path));
    };
    fails(&folder.path().join("absent"), ErrorKind::Io, None, "No such file");
    fails(folder.path(), ErrorKind::Io, None, "directory");
    fails(&write("empty", b""), ErrorKind::Syntax, None, "empty");
    fails(&write("blank", b" \n"), ErrorKind::Syntax, None, "empty");
    fails(&write("long", &[b'a'; 101]), ErrorKind::BadValue, None, "at most 100 bytes");
    fails(&write("latin1", b"a\nb\n\xe9"), ErrorKind::Syntax, Some(3), "UTF-8");
    assert_eq!(read_text(&write("full", &[b'a'; 100]), 100).unwrap().len(), 100);
}

#[test]
fn nesting_of_every_kind_is_safe() {
    let depth = 5_000;
    let dots = |n: usize| vec!["a"; n].join(".");
    let refused = [
        format!("a = {}1{}", "[".repeat(depth), "]".repeat(depth)),
        format!("a = {}", "[".repeat(500_000)),
        format!("a = {}1{}", "{a=".repeat(depth), "}".repeat(depth)),
        format!("{} = 1", dots(depth)),
        format!("[{}]", dots(depth)),
        format!("[[{}]]", dots(depth)),
    ];
    for text in &refused {
        assert_eq!(Document::parse(text).unwrap_err().kind(), ErrorKind::Syntax);
    }
}

/// Documents with the greatest depth are read and freed with little stack, in any build; deeper ones are refused. Rust's threads have 2 MB.
#[test]
fn the_deepest_documents_need_little_stack() {
    let dots = |n: usize| vec!["a"; n].join(".");
    let nested = |start: &str, end: &str, n: usize| format!("a = {}1{}", start.repeat(n), end.repeat(n));
    let tables = |n: usize| {
        let (header, start) = (dots(78 - 4 * n), format!("{{{} = ", dots(3)).repeat(n));
        format!("\n\n[{header}]\nb = 1\na.a = {start}1{}", "}".repeat(n))
    };
    let documents = [
        (nested("[", "]", 79), nested("[", "]", 80), 1),
        (nested("{ a = ", "}", 39) + " # 1 + 2 * 39 levels", nested("{ a = ", "}", 40), 1),
        (format!("{} = 1", dots(80)), format!("{} = 1", dots(81)), 1),
        (format!("[{}]\na = 1", dots(79)), format!("[{}]\na = 1", dots(80)), 2),
        (format!("[[{}]]\na = 1", dots(78)), format!("\n[[{}]]\na = 1", dots(79)), 3),
        (tables(19), tables(19).replace("[a", "[b.a"), 5),
        // Nested levels that follow one another do not add up.
        (
            format!("a = [{}]", "[[1.5, 2.5], {b.c = 1, d = 2}], ".repeat(200)),
            format!("a = [{}", nested("[", "]", 79)),
            1,
        ),
        // 79 levels in each of 79 keys: the tables of the parser overflowed the stack when they were freed.
        (
            "a = 1".to_owned(),
            format!("{} = {}1{}", dots(79), format!("{{{} = ", dots(79)).repeat(79), "}".repeat(79)),
            1,
        ),
    ];
    let read = move || {
        for (deepest, deeper, line) in &documents {
            Document::parse(deepest).unwrap_or_else(|error| panic!("{error}: {deepest}"));
            assert_error(&Document::parse(deeper).unwrap_err(), ErrorKind::Syntax, Some(*line), "80 levels");
        }
    };
    std::thread::Builder::new().stack_size(512 << 10).spawn(read).unwrap().join().unwrap();
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn noise_never_panics(text in "\\PC{0,200}", bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let _ = Document::parse(&text);
        let _ = Document::parse(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn damaged_text_never_panics(at in 0..SAMPLE.len(), character in any::<char>()) {
        let damaged = format!("{}{character}{}", &SAMPLE[..at], &SAMPLE[at + 1..]);
        if let Ok(document) = Document::parse(&damaged) {
            for node in document.root().entries() {
                let _ = (node.exact(), node.exact_vector::<3>(), node.tables(), node.count(), node.one_of(&[("a", 1)]));
                prop_assert!(node.line() <= damaged.lines().count());
            }
        }
    }

    #[test]
    fn decimals_keep_every_digit(digits in "-?[1-9][0-9]{0,30}\\.[0-9]{1,30}") {
        let text = format!("a = {digits}");
        let read = Document::parse(&text).unwrap().root().required("a").unwrap().exact().unwrap();
        prop_assert_eq!(read, parse_rational(&digits).unwrap());
    }
}

#[test]
fn a_megabyte_of_noise_is_refused() {
    let noise = ["=", "[[", "a=[1,", "\"", "\0", "é\n", "[a]\n", "a.b=1\n", "'''"];
    for piece in noise {
        assert!(Document::parse(&piece.repeat(1_000_000 / piece.len())).is_err());
    }
}

/// A list or an object of up to 120 bytes, indentation and key included, is on one line; longer ones are as serde_json indents them.
#[test]
fn short_lists_and_objects_of_json_are_on_one_line() {
    let value = serde_json::json!({ "a": [1, 2, []], "b": { "c": "x, [", "d": {} }, "long": ["y".repeat(100), [3]], "z": [{ "k": "{" }] });
    let long = "y".repeat(100);
    let expected = format!(
        "{{\n  \"a\": [1, 2, []],\n  \"b\": {{\"c\": \"x, [\", \"d\": {{}}}},\n  \"long\": [\"{long}\", [3]],\n  \"z\": [{{\"k\": \"{{\"}}]\n}}\n"
    );
    assert_eq!(json_text(&value), expected);
    // The line of `long` has 119 bytes; two more do not fit.
    let longer = "y".repeat(102);
    let value = serde_json::json!({ "long": [longer, [3]] });
    assert_eq!(json_text(&value), format!("{{\n  \"long\": [\n    \"{longer}\",\n    [3]\n  ]\n}}\n"));
    for value in [serde_json::json!([]), serde_json::json!(3), serde_json::json!({ "a": [[[[1]], [2]]] })] {
        assert_eq!(json_text(&value), value.to_string().replace(':', ": ").replace(',', ", ") + "\n");
    }
}
