//! Documentation, comments and texts in code are in plain technical English: they contain no phrase of `phrases.toml`.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use toml::de::{DeTable, DeValue};

use super::{assert_none, files_below, root, slashed};

/// Endings of the files that are read in folders.
const ENDINGS: [&str; 7] = [".md", ".rs", ".c", ".h", ".ts", ".py", ".pyi"];

/// The content of `phrases.toml`.
struct Rules {
    /// Files, and folders whose Markdown, Rust, C, TypeScript and Python files are read.
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

/// The comments and strings of source code, on their lines; other text unchanged. Code between them is a `;`, so that
/// no phrase extends across it.
fn prose(file: &str, text: &str) -> String {
    let (comment, quotes) = match file.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "rs" | "c" | "h" => ("//", "\""),
        "ts" => ("//", "\"'`"),
        "py" | "pyi" => ("#", "\"'"),
        _ => return text.to_owned(),
    };
    let (mut out, mut rest) = (String::new(), text);
    while let Some(letter) = rest.chars().next() {
        let length = if rest.starts_with(comment) {
            let end = rest.find('\n').unwrap_or(rest.len());
            out.push_str(rest[..end].trim_start_matches(['/', '!', '#']));
            end
        } else if quotes.contains(letter) {
            let (inside, length) = string(rest, letter);
            out.push_str(&format!(";{inside};"));
            length
        } else if letter == '\'' {
            character(rest)
        } else {
            out.push(if letter.is_whitespace() { letter } else { ';' });
            letter.len_utf8()
        };
        rest = &rest[length..];
    }
    out
}

/// The content of the string at the start of `text`, with blanks instead of escapes, and its length with the quotes. A
/// string in single quotes ends at the latest at the end of its line.
fn string(text: &str, quote: char) -> (String, usize) {
    let triple = quote.to_string().repeat(3);
    let close = if text.starts_with(&triple) { triple } else { quote.to_string() };
    let (mut inside, mut at) = (String::new(), close.len());
    while let Some(letter) = text[at..].chars().next().filter(|_| !text[at..].starts_with(&close)) {
        if close == "'" && letter == '\n' {
            return (inside, at);
        }
        let escaped = if letter == '\\' { text[at + 1..].chars().next() } else { None };
        inside.push(escaped.map_or(letter, |next| if next == '\n' { '\n' } else { ' ' }));
        at += letter.len_utf8() + escaped.map_or(0, char::len_utf8);
    }
    (inside, (at + close.len()).min(text.len()))
}

/// The length of the character literal at the start of `text`, or of the quote of a lifetime.
fn character(text: &str) -> usize {
    let letters: Vec<char> = text.chars().take(4).collect();
    match letters[..] {
        [_, '\\', second, '\''] => 3 + second.len_utf8(),
        [_, letter, '\'', ..] if letter != '\\' => 2 + letter.len_utf8(),
        _ => 1,
    }
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
    let present: HashSet<&str> = text.iter().map(|(_, word)| word.as_str()).collect();
    let may_occur = |phrase: &&Phrase| phrase.not.split(' ').all(|word| word == "<number>" || present.contains(word));
    let mut found = Vec::new();
    for Phrase { not, but } in rules.phrases.iter().filter(may_occur) {
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
    let is_read = |file: &String| ENDINGS.iter().any(|ending| file.ends_with(ending));
    let below = |entry: &String| match root().join(entry).is_file() {
        true => vec![entry.clone()],
        false => files_below(Path::new(entry)).iter().map(|path| slashed(path)).filter(is_read).collect(),
    };
    let mut files: Vec<String> = scope.iter().flat_map(below).collect();
    files.sort();
    files.into_iter().map(|file| (file.clone(), fs::read_to_string(root().join(file)).unwrap())).collect()
}

#[test]
fn documentation_and_code_are_in_plain_technical_english() {
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
    assert_eq!(count("a.rs", "let by_numbers = \"by numbers\"; // solved by\n/// numbers"), 2);
    assert_eq!(count("a.rs", "let (quote, by, numbers) = ('\"', by, numbers); // by\nlet numbers = \"\";"), 0);
    assert_eq!(count("a.py", "\"\"\"Solved by\nnumbers.\"\"\"\nby = numbers  # by numbers"), 2);
    assert_eq!(count("a.ts", "const text = `by\n numbers`; // solved"), 1);
}
