//! `groebot explain`: a stored derivation is proved again and told, as Markdown or as LaTeX.

use std::fs;

use tempfile::tempdir;

use super::{refused, root, succeed, text};

#[test]
fn a_stored_derivation_as_markdown_and_as_latex() {
    let leg = root("derivations/nao_leg_sagittal");
    let page = succeed(&["explain", text(&leg)]);
    assert!(page.starts_with("# nao\\_leg\\_sagittal: ") && page.contains("(6.7.12)-(6.7.15)"), "{page}");
    let folder = tempdir().unwrap();
    let file = folder.path().join("leg.tex");
    assert_eq!(succeed(&["explain", text(&leg), "--latex", "-o", text(&file)]), "");
    let latex = fs::read_to_string(file).unwrap();
    assert!(latex.starts_with("\\documentclass") && latex.ends_with("\\end{document}\n"), "{latex}");
}

#[test]
fn an_input_file_is_derived_first() {
    let page = succeed(&["explain", text(&root("derivations/planar_2r/0_chain.toml"))]);
    assert!(page.contains("## Step 2: "), "{page}");
}

#[test]
fn a_damaged_proof_is_not_told() {
    let folder = tempdir().unwrap();
    let leg = root("derivations/nao_leg_sagittal");
    fs::copy(leg.join("0_chain.toml"), folder.path().join("0_chain.toml")).unwrap();
    let stored = fs::read_to_string(leg.join("certificate.json")).unwrap();
    fs::write(folder.path().join("certificate.json"), stored.replacen("c4 ", "c4 + 1 ", 1)).unwrap();
    assert!(refused(&["explain", text(folder.path())]).contains("certificate.json"));
}
