#!/bin/sh
# Compiles and runs the tests of the C run time with every installed compiler, also with sanitizers. Compares PUMA's solutions, and arcs of redundant arms,
# bitwise with those of the Rust run time, and runs clang-tidy. A missing tool is skipped; with GROEBOT_REQUIRE_TOOLS=1 it is an error.
#
# CC      compilers to use; default: gcc and clang
# PUMA    PUMA's derivation, whose printed files are compiled; default: the one in derivations/
# WORK    folder for output files; default: a new temporary folder, removed at the end
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

# Whether a tool is installed.
has() {
    command -v "$1" >/dev/null && return
    echo "$1 is not installed"
    [ "${GROEBOT_REQUIRE_TOOLS:-}" != 1 ] || exit 1
    return 1
}

# Whether a compiler has the libraries of its sanitizers.
has_sanitizers() {
    echo 'int main(void) { return 0; }' >empty.c
    "$1" $sanitizers empty.c -o empty 2>/dev/null && return
    echo "$1 has no sanitizers"
    [ "${GROEBOT_REQUIRE_TOOLS:-}" != 1 ] || exit 1
    return 1
}

# The checks of .clang-tidy, for all four files. The last command also checks the header's functions. There clang-tidy cannot know that one of two
# pointers is not null.
tidy() {
    options="-std=c99 -I. -I$here/.."
    null=clang-analyzer-core.NullDereference,-clang-analyzer-core.NonNullParamChecker
    ask="clang-tidy --quiet --config-file=$here/../.clang-tidy"
    $ask "$here/../groebot.c" "$here/../groebot_six_axes.c" "$here/../groebot_redundant.c" -- $options
    $ask --checks=-$null puma.c -- $options -Xclang -analyzer-opt-analyze-headers
    echo "clang-tidy reports nothing"
}

for end in c h; do
    sed 's/5_solver/puma/' "$puma/5_solver.$end" >"puma.$end"
done

# The solutions of the Rust run time, if cargo is installed.
if has cargo; then
    mkdir -p reference/src
    cp "$here/reference.rs" reference/src/main.rs
    cp "$puma/5_solver.rs" reference/src/puma.rs
    cat >reference/Cargo.toml <<END
[package]
name = "reference"
version = "0.0.0"
edition = "2024"
[[bin]]
name = "reference"
path = "src/main.rs"
[[bin]]
name = "redundant"
path = "$here/redundant.rs"
[dependencies]
groebot-runtime = { path = "$runtime" }
[workspace]
END
    for name in reference redundant; do
        CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$work/target} \
            cargo run --quiet --release --manifest-path reference/Cargo.toml --bin "$name" -- "$work/$name.answers"
    done
    mv reference.answers answers
    echo "the Rust run time has written its solutions"
fi

# Prints a file of the run time with its parts inserted.
whole() {
    while IFS= read -r line; do
        case $line in
            '#include "groebot/'*) part=${line#*\"} && cat "$here/../${part%\"}" ;;
            *) printf '%s\n' "$line" ;;
        esac
    done <"$here/../$1"
}

# Prints run time and robot in one file, like codegen.
join() {
    echo "#define GB_LINKAGE static GB_UNUSED"
    { whole groebot.h && cat puma.h puma.c && whole groebot.c; } \
        | sed -e '/^#include "groebot.h"$/d' -e '/^#include "puma.h"$/d' -e 's/^#include "puma.c"$/#include "single.c"/'
}
join >single.c

# Prints run time and tests of redundant arms in one file.
join_redundant() {
    printf '#define GB_LINKAGE static GB_UNUSED\n#define GB_RUNTIME\n'
    { whole groebot.h && whole groebot_six_axes.h && whole groebot_redundant.h && whole groebot.c && whole groebot_redundant.c && cat "$here/redundant.c"; } \
        | sed '/^#include "groebot[a-z_]*.h"$/d'
}
join_redundant >single_redundant.c

# Runs the tests of redundant arms, then compares the results, with one compiler and its flags.
try_redundant() {
    "$@" $strict -I"$here" -lm -o redundant
    ./redundant >redundant.own || { tail -n 1 redundant.own && return 1; }
    [ ! -f redundant.answers ] || cmp redundant.own redundant.answers
    echo "$(grep -c '^target' redundant.own) targets of redundant arms have the same arcs"
}

# Runs the tests, then compares the solutions, with one compiler and its flags.
try() {
    echo "$*"
    "$@" $strict "$here/test.c" -lm -o test
    ./test
    case "$*" in *GB_FLOAT*) return ;; esac
    if [ -f answers ]; then
        "$@" $strict "$here/compare.c" puma.c "$here/../groebot.c" -lm -o compare
        ./compare answers
    fi
    try_redundant "$@" "$here/redundant.c" "$here/../groebot.c" "$here/../groebot_redundant.c"
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
    try_redundant "$cc" -std=c99 -O2 single_redundant.c
    for file in puma.c "$here/../groebot.c" "$here/../groebot_redundant.c" single.c; do
        "$cc" -x c++ -std=c++11 -O2 $strict -c "$file" -o object
    done
done
