#!/usr/bin/env bash
# Builds viewer/dist/groebot.wasm, or the given file. Its bytes depend on the path of the sources; its results do not: compare.mjs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
out=${1:-../dist/groebot.wasm}
root=$(cd ../.. && pwd)
export RUSTFLAGS="--remap-path-prefix=$root=/groebot --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}=/cargo --remap-path-prefix=$(rustc --print sysroot)=/rust"
cargo build --locked --release --target wasm32-unknown-unknown
cp "${CARGO_TARGET_DIR:-target}/wasm32-unknown-unknown/release/groebot_page.wasm" "$out"
