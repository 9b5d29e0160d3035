#!/bin/sh
# Compiles and runs the tests of the C run time with every compiler that is there, also with sanitizers, compares PUMA's answers with the Rust run
# time's, bit for bit, and asks clang-tidy. What is missing is left out, with GROEBOT_REQUIRE_TOOLS=1 an error.
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

# Whether a tool is there.
has() {
    command -v "$1" >/dev/null && return
    echo "$1 is not here"
    [ "${GROEBOT_REQUIRE_TOOLS:-}" != 1 ] || exit 1
    return 1
}

# Whether a compiler has its sanitizers' libraries.
has_sanitizers() {
    echo 'int main(void) { return 0; }' >empty.c
    "$1" $sanitizers empty.c -o empty 2>/dev/null && return
    echo "$1 has no sanitizers"
    [ "${GROEBOT_REQUIRE_TOOLS:-}" != 1 ] || exit 1
    return 1
}

# The checks of .clang-tidy, for all three files. The last one is for the header's functions, too, in which clang-tidy does not know that of two
# pointers one is not null.
tidy() {
    options="-std=c99 -I. -I$here/.."
    null=clang-analyzer-core.NullDereference,-clang-analyzer-core.NonNullParamChecker
    ask="clang-tidy --quiet --config-file=$here/../.clang-tidy"
    $ask "$here/../groebot.c" "$here/../groebot_six_axes.c" -- $options
    $ask --checks=-$null puma.c -- $options -Xclang -analyzer-opt-analyze-headers
    echo "clang-tidy finds nothing"
}

for end in c h; do
    sed 's/5_solver/puma/' "$puma/5_solver.$end" >"puma.$end"
done

# The Rust answers, if there is a Rust to ask.
if has cargo; then
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
    CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$work/target} cargo run --quiet --release --manifest-path reference/Cargo.toml -- "$work/answers"
    echo "Rust has answered"
fi

# A file of the run time with its parts in their places.
whole() {
    while IFS= read -r line; do
        case $line in
            '#include "groebot/'*) part=${line#*\"} && cat "$here/../${part%\"}" ;;
            *) printf '%s\n' "$line" ;;
        esac
    done <"$here/../$1"
}

# One file of run time and robot: what codegen puts together.
join() {
    echo "#define GB_LINKAGE static GB_UNUSED"
    { whole groebot.h && cat puma.h puma.c && whole groebot.c; } \
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

if has clang-tidy; then
    tidy
fi

sanitizers="-fsanitize=address,undefined -fno-sanitize-recover=all"
for cc in ${CC:-gcc clang}; do
    has "$cc" || continue
    try "$cc" -std=c99 -O2
    try "$cc" -std=c99 -O0
    try "$cc" -std=c99 -O3
    try "$cc" -std=c99 -O2 -DGB_LANES=1
    try "$cc" -std=c99 -O2 -DGB_FLOAT
    try "$cc" -std=gnu17 -O2 -ffp-contract=off -march=native
    if has_sanitizers "$cc"; then
        try "$cc" -std=c99 -O1 -g $sanitizers
    fi
    "$cc" -std=c99 -O2 $strict "$here/compare.c" single.c -lm -o compare
    [ ! -f answers ] || ./compare answers
    for file in puma.c "$here/../groebot.c" single.c; do
        "$cc" -x c++ -std=c++11 -O2 $strict -c "$file" -o object
    done
done
