//! Texts about a derivation: the numbered stage files and the README ([`stages`]), and the report for students ([`explain`](mod@explain)).

pub mod explain;
pub mod stages;
