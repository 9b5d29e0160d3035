//! Tests of `groebot_ik::folder`: a forged file, or a forged record of a certificate, is rejected, or what it claims is still true.

mod cache;
mod files;
mod honest;
mod motion;
mod outputs;
mod records;
