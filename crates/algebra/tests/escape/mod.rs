//! Escaping and shortening of untrusted text.

use groebot_algebra::escape::{MOST_ECHOED, is_hidden, line, markdown, message, page};
use groebot_algebra::{Error, ErrorKind};
use proptest::prelude::*;

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn nothing_hidden_is_left(text in any::<String>()) {
        prop_assert!(!line(&text).contains(is_hidden));
        prop_assert!(!page(&text).replace(['\n', '\t'], "").contains(is_hidden));
        prop_assert!(!message(&text).replace(['\n', '\t'], "").contains(is_hidden));
        prop_assert!(!markdown(&text).contains(is_hidden));
    }

    /// An escape in a string of JSON means the character.
    #[test]
    fn json_keeps_its_meaning(text in any::<String>()) {
        let json = serde_json::to_string(&text).unwrap();
        prop_assert_eq!(serde_json::from_str::<String>(&page(&json)).unwrap(), text);
    }

    #[test]
    fn what_is_short_and_plain_stays(text in "[a-zA-Z0-9 ,.;:()'`\"-]{0,180}") {
        prop_assert_eq!(message(&text), text);
    }

    #[test]
    fn quotations_are_cut(before in "[a-z ]{0,20}", sign in "[`\"']", letters in "[a-z ]{201,900}", after in "[a-z .]{0,40}") {
        let text = format!("{before} {sign}{letters}{sign} {after}");
        let shown = message(&text);
        prop_assert!(shown.chars().count() <= before.len() + after.len() + MOST_ECHOED + 8, "{}", shown);
        prop_assert!(shown.starts_with(&before) && shown.ends_with(&after));
    }
}

#[test]
fn an_apostrophe_begins_no_quotation() {
    let prose = format!("the robot's joints {} are IKFast's own", "and more words ".repeat(30));
    assert_eq!(message(&prose), prose);
}

#[test]
fn errors_are_escaped_with_their_files() {
    let error = Error::new(ErrorKind::BadValue, "`a\u{1b}[31m` is no name").in_file("x\u{202e}y".as_ref());
    assert_eq!(error.to_string(), "x\\u202ey: `a\\u001b[31m` is no name");
}

#[test]
fn markdown_is_words() {
    let cases = [
        ("nao_leg_sagittal", "nao_leg_sagittal"),
        ("Universal Robots UR5: z up, the arm along -x (m)", "Universal Robots UR5: z up, the arm along -x (m)"),
        ("<b>", "\\<b\\>"),
        ("[a](b)", "[a\\](b)"),
        ("$(rm)", "\\$(rm)"),
        ("&lt;", "\\&lt;"),
        ("# a", "\\# a"),
        ("_a_", "\\_a\\_"),
        ("a\n<b>", "a \\<b\\>"),
        ("`a`", "\\`a\\`"),
    ];
    cases.into_iter().for_each(|(text, words)| assert_eq!(markdown(text), words));
}
