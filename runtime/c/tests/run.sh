#!/bin/sh
# Compiles and runs the tests of the C run time with every compiler that is there, and compares PUMA's answers with the Rust run time's, bit for bit.
#
# CC      compilers to try; gcc and clang
# PUMA    PUMA's derivation, whose printed files are compiled; the one in derivations/
# WORK    where files go; a new temporary folder, removed at the end
set -eu
here=$(cd "$(dirname "$0")" && pwd)
runtime=$(cd "$here/../.." && pwd)
puma=${PUMA:-$runtime/../derivations/puma}
if [ -z "${WORK:-}" ]; then
    WORK=$(mktemp -d)
    trap 'rm -rf "$WORK"' EXIT
fi
work=$WORK
strict="-Wall -Wextra -Wpedantic -Werror -I. -I$here/.."
cd "$work"

for end in c h; do
    sed 's/5_solver/puma/' "$puma/5_solver.$end" >"puma.$end"
done

# The Rust answers, if there is a Rust to ask.
if command -v cargo >/dev/null; then
    mkdir -p reference/src
    cp "$here/reference.rs" reference/src/main.rs
    cp "$puma/5_solver.rs" reference/src/puma.rs
    cat >reference/Cargo.toml <<END
[package]
name = "reference"
version = "0.0.0"
edition = "2024"
[dependencies]
groebot-runtime = { path = "$runtime" }
[workspace]
END
    if CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$work/target} cargo run --quiet --release --manifest-path reference/Cargo.toml -- "$work/answers"; then
        echo "Rust has answered"
    else
        echo "no Rust answers: the reference does not compile"
    fi
fi

# One file of run time and robot: what codegen puts together.
join() {
    echo "#define GB_LINKAGE static GB_UNUSED"
    cat "$here/../groebot.h" puma.h puma.c "$here/../groebot.c" \
        | sed -e '/^#include "groebot.h"$/d' -e '/^#include "puma.h"$/d' -e 's/^#include "puma.c"$/#include "single.c"/'
}
join >single.c

# The strict test, then the answers, of one compiler with flags for C.
try() {
    echo "$*"
    "$@" $strict "$here/test.c" -lm -o test
    ./test
    case "$*" in *GB_FLOAT*) return ;; esac
    if [ -f answers ]; then
        "$@" $strict "$here/compare.c" puma.c "$here/../groebot.c" -lm -o compare
        ./compare answers
    fi
}

for cc in ${CC:-gcc clang}; do
    command -v "$cc" >/dev/null || continue
    try "$cc" -std=c99 -O2
    try "$cc" -std=c99 -O0
    try "$cc" -std=c99 -O3
    try "$cc" -std=c99 -O2 -DGB_LANES=1
    try "$cc" -std=c99 -O2 -DGB_FLOAT
    try "$cc" -std=gnu17 -O2 -ffp-contract=off -march=native
    if [ -z "${SKIP_SANITIZERS:-}" ]; then
        try "$cc" -std=c99 -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all
    fi
    "$cc" -std=c99 -O2 $strict "$here/compare.c" single.c -lm -o compare
    [ ! -f answers ] || ./compare answers
    for file in puma.c "$here/../groebot.c" single.c; do
        "$cc" -x c++ -std=c++11 -O2 $strict -c "$file" -o object
    done
done
