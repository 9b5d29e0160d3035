//! Tests of the rules: each is applied to a small source that violates it and to one that does not.

use std::path::{Path, PathBuf};

use super::{Source, forbidden_uses, leftovers, lexer, mentions, oversized, scan, table};

/// The violations by `text` as the content of `file`, in a crate whose root is `lib.rs` below.
fn uses(file: &str, text: &str) -> Vec<String> {
    let root = Source::new("src/lib.rs", "pub use error::{Error, Result};\npub use solver::Program;".to_owned());
    forbidden_uses(&[root, Source::new(file, text.to_owned())])
}

fn words(text: &str) -> Vec<String> {
    lexer::tokens(text).into_iter().map(|token| token.text).collect()
}

#[test]
fn a_ring_of_files_is_found_behind_lent_names() {
    let house = |ring: &str| {
        let file = |name: &str, text: &str| Source::new(&format!("src/room/{name}.rs"), text.to_owned());
        let facade = "mod ring;\nmod stone;\nmod way;\npub use ring::Ring;\npub use stone::Stone;";
        let (stone, way) = ("use super::way::f;\npub struct Stone;", "use super::{Ring, stone};\npub fn f() {}");
        super::cycles::on_rings(&[file("mod", facade), file("ring", ring), file("stone", stone), file("way", way)])
    };
    let ring = ["room::stone imports room::way", "room::way imports room::stone"];
    assert_eq!(house("pub struct Ring;"), ring);
    let all = house("use super::Stone;\npub struct Ring;");
    assert_eq!(all.len(), 4, "{all:?}");
    assert!(all.contains(&"room::ring imports room::stone".to_owned()), "{all:?}");
}

#[test]
fn a_forbidden_use_is_found_however_it_is_written() {
    for text in [
        "use crate::solver::Program;",
        "use crate::{number::Zp, solver::Program};",
        "use crate::{number::{Zp, Ring}, solver::{self, Program as P}};",
        "use crate::{\n    number,\n    solver as hidden,\n};",
        "use crate::solver::*;",
        "pub(crate) use crate::solver;",
        "use super::super::solver::Program;",
        "use groebot::solver::Program;",
        "use crate::Program;",
        "fn f() -> crate::solver::Program { panic!() }",
        "fn f() { let x = super::super::solver::run(); }",
        "impl Into<crate::solver::Program> for X {}",
        "mod inner { use super::super::super::solver::Program; }",
        "mod inner { fn f() {} } use super::super::solver::Program;",
        "macro_rules! m { () => { $crate::solver::run() } }",
        "fn f() { let c = '\"'; crate::solver::run(); let d = '\"'; }",
        "use r#crate_name::x; use crate::r#solver;",
        "use crate::*;",
        "use crate as everything;",
        "use crate::mystery::Thing;",
    ] {
        assert_eq!(uses("src/poly/ring.rs", text).len(), 1, "{text}: {:?}", uses("src/poly/ring.rs", text));
    }
}

#[test]
fn what_only_looks_like_a_forbidden_use_is_let_through() {
    for text in [
        "use crate::number::Zp; use crate::{Error, Result}; use crate::watch::Watch;",
        "use super::order::Order; use super::super::number::Zp; use self::inner::X;",
        "mod inner { use super::x; use super::super::ring::y; }",
        "// use crate::solver::Program;\n/* crate::solver /* nested */ crate::solver */",
        "/// See [`crate::solver`].\nfn f() {}",
        "fn f() -> &'static str { \"crate::solver::run\" }",
        "fn f() -> &'static str { r#\"a \" crate::solver::run\"# }",
        "fn f() { let s = \"\\\" crate::solver::run\"; }",
        "use std::solver::x; use ::other::crate_::solver;",
        "fn f<'a>(x: &'a str) -> impl Iterator<Item = &'a str> + use<'a> { solver::run(x) }",
        "impl X { fn f(&self) { self.solver.run(); Self::solver(); } }",
    ] {
        assert_eq!(uses("src/poly/ring.rs", text), [] as [String; 0], "{text}");
    }
}

#[test]
fn an_objection_names_the_file_the_line_and_what_is_allowed() {
    let found = uses("src/poly/ring.rs", "use std::fmt;\n\nuse crate::solver::Program;");
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("src/poly/ring.rs:3: `poly` may not use `solver`"), "{}", found[0]);
    assert!(found[0].ends_with("and number, document"), "{}", found[0]);
}

#[test]
fn the_screw_solver_and_the_derived_solver_stay_apart() {
    let screw = "src/kinematics/screw/subproblems.rs";
    for module in ["poly", "groebner", "derive", "solver"] {
        assert_eq!(uses(screw, &format!("use crate::{module}::x;")).len(), 1, "{module}");
    }
    assert_eq!(uses(screw, "use crate::{spatial::x, number::y, roots::z, kinematics::chain::w};").len(), 0);
    assert_eq!(uses("src/derive/mod.rs", "use crate::kinematics::screw::x;").len(), 1);
    assert_eq!(uses("src/derive/mod.rs", "use crate::kinematics::{chain::x, screws::y};").len(), 0);
}

#[test]
fn main_uses_the_command_line_only() {
    assert_eq!(uses("src/main.rs", "fn main() { groebot::cli::run() }").len(), 0);
    assert_eq!(uses("src/main.rs", "use groebot::solver;").len(), 1);
}

#[test]
fn root_modules_use_no_other_module() {
    assert_eq!(uses("src/files.rs", "use crate::{Error, watch};").len(), 0);
    assert_eq!(uses("src/files.rs", "use crate::document::Document;").len(), 1);
    assert_eq!(uses("src/error.rs", "use crate::number::Zp;").len(), 1);
}

#[test]
fn documents_stand_on_numbers_and_below_the_rest() {
    assert_eq!(uses("src/document.rs", "use crate::{Error, files, number::Zp};").len(), 0);
    assert_eq!(uses("src/document.rs", "use crate::kinematics::Chain;").len(), 1);
    assert_eq!(uses("src/kinematics/toml.rs", "use crate::document::Document;").len(), 0);
    assert_eq!(uses("src/number/mod.rs", "use crate::document::Document;").len(), 1);
}

#[test]
fn an_unknown_module_is_reported() {
    let found = uses("src/helpers/mod.rs", "");
    assert!(found.len() == 1 && found[0].contains("`helpers` is not in the table"), "{found:?}");
    assert!(table::knows("poly") && table::knows("files") && !table::knows("helpers"));
}

#[test]
fn long_files_and_long_functions_are_found() {
    let lines = |count: usize| "\n".repeat(count);
    let source = |text: String| [Source::new("src/poly/mod.rs", text)];
    assert_eq!(oversized(&source(lines(800))).len(), 0);
    assert_eq!(oversized(&source(lines(801))).len(), 1);
    assert_eq!(oversized(&source(format!("// @generated by the printer\n{}", lines(900)))).len(), 0);
    assert_eq!(oversized(&source(format!("fn f() {{{}}}", lines(79)))).len(), 0);
    assert_eq!(oversized(&source(format!("fn f() {{{}}}", lines(80)))).len(), 1);
}

#[test]
fn functions_are_measured_from_their_name_to_their_last_brace() {
    let text = "fn a(x: [u8; 2]) -> u8\nwhere\n{\n    if x { '}' } else { \"}\" }\n}\n\
        trait T { fn b(); fn c() {\n fn d() {} } }\ntype F = fn(u8) -> u8;";
    let found = scan::functions(&lexer::tokens(text));
    let found: Vec<_> = found.iter().map(|f| (f.name.as_str(), f.line, f.lines)).collect();
    assert_eq!(found, [("a", 1, 5), ("c", 6, 2), ("d", 7, 1)]);
}

#[test]
fn stubs_and_prints_are_found() {
    let found = |file: &str, text: &str| leftovers(&[Source::new(file, text.to_owned())]).len();
    assert_eq!(found("src/poly/mod.rs", "fn f() { todo!() }\nfn g() { unimplemented! {} }\nfn h() { dbg!(1); }"), 3);
    assert_eq!(found("src/poly/mod.rs", "fn f() { println!(\"a\"); eprint!(\"b\"); }"), 2);
    assert_eq!(found("src/poly/mod.rs", "fn f() { if todo != 1 { \"dbg!(x)\"; } } // todo!()"), 0);
    assert_eq!(found("src/cli/derive.rs", "fn f() { println!(\"a\"); }"), 0);
    assert_eq!(found("src/cli/derive.rs", "fn f() { todo!() }"), 1);
}

#[test]
fn a_path_is_found_in_any_file() {
    let files = [("a", "see ../there"), ("b", "see ..there")].map(|(path, text)| (PathBuf::from(path), text.into()));
    assert_eq!(mentions(&files, "../there"), [Path::new("a")]);
}

#[test]
fn the_lexer_drops_comments_strings_and_characters() {
    assert_eq!(
        words("a::b /* c */ \"d\" b\"e\" 'f' '\\'' b'g' r\"h\" r#\"i\"# 'j: &'k l"),
        ["a", "::", "b", "j", ":", "&", "k", "l"]
    );
    assert_eq!(words("unterminated \"string"), ["unterminated"]);
    assert_eq!(words("r#type é_1 /* open"), ["type", "é_1"]);
}
