#!/usr/bin/env bash
# The linker of wheels.sh: zig links against an old glibc ($ZIG_TARGET); then Rust's lld repeats zig's call and puts similar functions next to each other, which makes
# 6 % less of a wheel. zig refuses this option.
set -euo pipefail
# cargo-zigbuild, which is part of maturin, does not read these from the path.
export CARGO_ZIGBUILD_ZIG_COMMAND=python3 CARGO_ZIGBUILD_ZIG_COMMAND_ARGS="-m ziglang" ZIG_VERBOSE_LINK=1
CARGO_ZIGBUILD_ZIG_VERSION=$(python3 -m ziglang version)
export CARGO_ZIGBUILD_ZIG_VERSION
calls=$(maturin zig cc -- -fno-sanitize=all -target "$ZIG_TARGET" "$@" 2>&1) || { printf '%s\n' "$calls" >&2; exit 1; }
read -r -a call < <(grep '^ld\.lld ' <<< "$calls" | tail -n 1)
lld=$(rustc --print sysroot)/lib/rustlib/$(rustc --print host-tuple)/bin/rust-lld
exec "$lld" -flavor gnu "${call[@]:1}" --icf=all --bp-compression-sort=both
