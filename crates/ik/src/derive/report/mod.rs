//! What is written about a derivation: the numbered stage files and the page ([`stages`]), and the report for a student ([`explain`](mod@explain)).

pub mod explain;
pub mod stages;
