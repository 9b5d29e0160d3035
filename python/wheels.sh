#!/usr/bin/env bash
# Makes the wheels of Linux and the source distribution in dist/ of the repository: `python/wheels.sh [TARGET|sdist]...`, by default all of
# x86_64-unknown-linux-gnu, aarch64-unknown-linux-gnu and sdist. It needs python3 with venv, Rust, and for each target the library of rustup. zig links against
# glibc 2.17 on any Linux; maturin refuses a wheel with newer symbols. A wheel beyond the limit of size is an error.
set -euo pipefail
cd "$(dirname "$0")"

# [bytes]
limit=8200000
dist=${DIST:-$PWD/../dist}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
[ "$#" -gt 0 ] || set -- x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu sdist

python3 -m venv "$work"
"$work/bin/pip" install --quiet --disable-pip-version-check "maturin>=1.9,<2" "ziglang==0.17.*" "deflate==0.9.*"
# zig-lld.sh finds maturin and zig by the Python on the path.
export PATH=$work/bin:$PATH
mkdir -p "$dist"
# With frame pointers the tables of unwinding are a fifth smaller, and so is code that reads the stack.
export RUSTFLAGS="-C force-frame-pointers=yes"

wheel() {
    local made="$work/$1" linker name size
    linker=CARGO_TARGET_$(tr a-z- A-Z_ <<< "$1")_LINKER
    env "$linker=$PWD/zig-lld.sh" ZIG_TARGET="${1/-unknown/}.2.17" \
        maturin build --release --locked --compatibility manylinux2014 --target "$1" --out "$made"
    name=$(basename "$made"/*.whl)
    python repack.py "$made/$name" "$dist/$name"
    size=$(stat --format %s "$dist/$name")
    printf '%s: %d bytes\n' "$name" "$size"
    if [ "$size" -gt "$limit" ]; then
        echo "the wheel is larger than $limit bytes" >&2
        exit 1
    fi
}

for part in "$@"; do
    case $part in
        sdist) maturin sdist --out "$dist" ;;
        *) wheel "$part" ;;
    esac
done
