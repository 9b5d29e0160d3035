#!/usr/bin/env bash
# Builds viewer/dist/groebot.wasm.xz, or the given file, not compressed. Its bytes depend on the path of the sources; its results do not: compare.mjs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
root=$(cd ../.. && pwd)
export RUSTFLAGS="--remap-path-prefix=$root=/groebot --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}=/cargo --remap-path-prefix=$(rustc --print sysroot)=/rust"
cargo build --locked --release --target wasm32-unknown-unknown
made=${CARGO_TARGET_DIR:-target}/wasm32-unknown-unknown/release/groebot_page.wasm
if [ $# -gt 0 ]; then
    cp "$made" "$1"
else
    xz -9e --check=crc64 --stdout "$made" > ../dist/groebot.wasm.xz
fi
