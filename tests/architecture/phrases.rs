//! Documentation is in plain technical English: it contains no phrase of `phrases.toml`.

use std::fs;
use std::path::Path;

use toml::de::{DeTable, DeValue};

use super::{assert_none, files_below, root, slashed};

/// The content of `phrases.toml`.
struct Rules {
    /// Files, and folders whose Markdown and Rust files are read.
    scope: Vec<String>,
    phrases: Vec<Phrase>,
    exceptions: Vec<Exception>,
}

struct Phrase {
    /// Words in lower case with one space between them; `<number>` is any number.
    not: String,
    /// The replacement.
    but: String,
}

/// A place where a phrase is permitted.
struct Exception {
    file: String,
    /// Words of the file, among them the phrase.
    text: String,
    reason: String,
}

impl Rules {
    fn of(document: &DeTable) -> Self {
        let list = |key: &str| document.get(key).map_or(&[][..], |list| list.get_ref().as_array().unwrap());
        let entry = |table: &DeValue, key: &str| table.get(key).unwrap().get_ref().as_str().unwrap().to_owned();
        let tables = |key| list(key).iter().map(|table| table.get_ref());
        Rules {
            scope: list("scope").iter().map(|file| file.get_ref().as_str().unwrap().to_owned()).collect(),
            phrases: tables("phrase")
                .map(|table| Phrase { not: entry(table, "not"), but: entry(table, "but") })
                .collect(),
            exceptions: (tables("exception"))
                .map(|table| Exception {
                    file: entry(table, "file"),
                    text: entry(table, "text"),
                    reason: entry(table, "reason"),
                })
                .collect(),
        }
    }
}

/// The words of a text with their line numbers, in lower case. Each sign is a separate word, so that no phrase extends across a full stop.
fn words(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut is_inside = false;
        for letter in text.chars().flat_map(char::to_lowercase) {
            let is_letter = letter.is_alphanumeric() || letter == '\'';
            match found.last_mut().filter(|_| is_letter && is_inside) {
                Some((_, word)) => word.push(letter),
                None if letter.is_whitespace() => {}
                None => found.push((line, letter.to_string())),
            }
            is_inside = is_letter;
        }
    }
    found
}

/// The comments of Rust code, in their lines; other text unchanged.
fn prose(file: &str, text: &str) -> String {
    if !file.ends_with(".rs") {
        return text.to_owned();
    }
    let comment =
        |line: &str| line.split_once("//").map_or("", |(_, comment)| comment.trim_start_matches(['/', '!'])).to_owned();
    text.lines().map(comment).collect::<Vec<_>>().join("\n")
}

/// The indices in `text` at which a phrase begins.
fn places(phrase: &str, text: &[(usize, String)]) -> Vec<usize> {
    let wanted: Vec<String> = phrase
        .split("<number>")
        .flat_map(|part| [words(part), vec![(0, "<number>".into())]].concat())
        .map(|(_, word)| word)
        .collect();
    let wanted = &wanted[..wanted.len() - 1];
    let fits = |word: &str, want: &str| {
        word == want || want == "<number>" && word.starts_with(|letter: char| letter.is_ascii_digit())
    };
    let at = |start: &[(usize, String)]| start.iter().zip(wanted).all(|((_, word), want)| fits(word, want));
    text.windows(wanted.len()).enumerate().filter(|(_, window)| at(window)).map(|(place, _)| place).collect()
}

/// The phrases of `file` that no exception covers, one line each.
fn found_in(file: &str, text: &str, rules: &Rules) -> Vec<String> {
    let text = words(&prose(file, text));
    let length = |text: &str| words(text).len();
    let excepted: Vec<(usize, usize)> = (rules.exceptions.iter().filter(|exception| exception.file == file))
        .flat_map(|exception| {
            places(&exception.text, &text).into_iter().map(|place| (place, place + length(&exception.text)))
        })
        .collect();
    let mut found = Vec::new();
    for Phrase { not, but } in &rules.phrases {
        for place in places(not, &text) {
            if !excepted.iter().any(|&(start, end)| start <= place && place < end) {
                found.push(format!("{file}:{}: `{not}`: write {but}", text[place].0));
            }
        }
    }
    found
}

fn rules() -> Rules {
    let text = fs::read_to_string(root().join("tests/architecture/phrases.toml")).unwrap();
    Rules::of(DeTable::parse(&text).unwrap().get_ref())
}

/// The files of a scope, with their texts.
fn texts(scope: &[String]) -> Vec<(String, String)> {
    let is_read = |file: &String| file.ends_with(".md") || file.ends_with(".rs");
    let below = |entry: &String| match root().join(entry).is_file() {
        true => vec![entry.clone()],
        false => files_below(Path::new(entry)).iter().map(|path| slashed(path)).filter(is_read).collect(),
    };
    let mut files: Vec<String> = scope.iter().flat_map(below).collect();
    files.sort();
    files.into_iter().map(|file| (file.clone(), fs::read_to_string(root().join(file)).unwrap())).collect()
}

#[test]
fn documentation_is_plain_technical_english() {
    let rules = rules();
    let texts = texts(&rules.scope);
    assert!(texts.len() > 30, "only {} files are read", texts.len());
    assert_none(&texts.iter().flat_map(|(file, text)| found_in(file, text, &rules)).collect::<Vec<_>>());
}

/// Phrases have two words or more, because a single common word is correct in some place. Each exception covers a
/// phrase.
#[test]
fn the_list_of_phrases_is_in_order() {
    let rules = rules();
    let texts = texts(&rules.scope);
    let mut found: Vec<String> = Vec::new();
    for Phrase { not, but } in &rules.phrases {
        let is_phrase = not.split(' ').count() > 1 && *not == not.to_lowercase() && !not.contains("  ");
        found.extend(
            (!is_phrase || but.is_empty()).then(|| format!("`{not}` is no phrase in lower case with a replacement")),
        );
    }
    for Exception { file, text, reason } in &rules.exceptions {
        let covers = |(_, content): &&(String, String)| !places(text, &words(&prose(file, content))).is_empty();
        let is_needed = rules.phrases.iter().any(|phrase| !places(&phrase.not, &words(text)).is_empty());
        let is_used = texts.iter().filter(|(name, _)| name == file).any(|entry| covers(&entry));
        found.extend(
            (!is_needed || !is_used || reason.is_empty())
                .then(|| format!("{file}: the exception `{text}` covers nothing")),
        );
    }
    assert_none(&found);
}

#[test]
fn phrases_are_found_across_lines_and_not_across_sentences() {
    let rules = Rules {
        scope: vec![],
        phrases: vec![
            Phrase { not: "by numbers".into(), but: "numerically".into() },
            Phrase { not: "issue <number>".into(), but: "its content".into() },
        ],
        exceptions: vec![Exception {
            file: "b.md".into(),
            text: "painted by numbers".into(),
            reason: "a picture".into(),
        }],
    };
    let count = |file, text| found_in(file, text, &rules).len();
    assert_eq!(count("a.md", "Solved By\n  numbers."), 1);
    assert_eq!(count("a.md", "It is stood by. Numbers follow; nearby numbers too."), 0);
    assert_eq!(count("a.md", "see issue 27, and issue of 27"), 1);
    assert_eq!(count("b.md", "painted by numbers, solved by numbers"), 1);
    assert_eq!(count("a.rs", "let by_numbers = \"by numbers\"; // solved by\n/// numbers"), 1);
    assert_eq!(count("a.rs", "let text = \"solved by numbers\";"), 0);
}
