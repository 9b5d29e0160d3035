#!/usr/bin/env bash
# Builds the wheel and tries it as people would: installed by pip in empty environments, with the oldest numpy and the newest. It needs python3 with venv, and
# nothing else beyond Rust. Where the profile is `release` (`python/ci.sh release`) the wheel is the one that is sent to people, and its size is looked at.
set -euo pipefail
cd "$(dirname "$0")"

profile=${1:-fast}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

environment() {
    python3 -m venv "$work/$1"
    "$work/$1/bin/pip" install --quiet --disable-pip-version-check --no-compile "${@:2}"
}

environment build "maturin>=1.9,<2"
cargo fmt --check
# Clippy looks at the bindings while it compiles them: `cargo clippy` would read the library once more.
RUSTC_WORKSPACE_WRAPPER=clippy-driver "$work/build/bin/maturin" build \
    --locked --profile "$profile" --compression-level "$([ "$profile" = release ] && echo 9 || echo 1)" --out "$work/wheels" -- -D warnings
wheel=$(echo "$work"/wheels/*.whl)
size=$(stat --format %s "$wheel")
printf '%s: %d bytes\n' "$(basename "$wheel")" "$size"
if [ "$profile" = release ]; then
    export GROEBOT_RELEASE=1
    if [ "$size" -gt 9000000 ]; then
        echo "the wheel has grown beyond 9 MB"
        exit 1
    fi
fi

# Not from here, where the package lies without what is compiled.
here=$PWD
cd "$work"
# The oldest numpy that there is for this Python.
environment oldest "$wheel" "numpy==1.26.*; python_version < '3.13'" "numpy==2.1.*; python_version >= '3.13'"
oldest/bin/python -c 'import groebot; ur5 = groebot.Solver.named("ur5"); assert len(ur5.solve(ur5.forward([0.1, -1.2, 1.4, -0.3, 0.8, 0.5]))) == 8'
oldest/bin/groebot --version
# What arrays are made of differs between versions of numpy; all else is tested with the newest.
oldest/bin/pip install --quiet --disable-pip-version-check --no-compile pytest hypothesis "scipy<1.15"
oldest/bin/pytest --quiet -rs "$here"/tests/test_{batch,input}.py

environment newest "${wheel}[dask,notebooks]" "numpy>=2" pytest hypothesis scipy mypy pyright
GROEBOT_REQUIRE_TOOLS=1 newest/bin/pytest --quiet -rs --durations=10 "$here/tests"
newest/bin/mypy --config-file "$here/pyproject.toml" --package groebot
newest/bin/mypy --config-file "$here/pyproject.toml" "$here/examples"
newest/bin/python -m mypy.stubtest groebot._groebot
newest/bin/python "$here/examples/first.py"
# pyright looks at the python that is found first, and brings Node with it where there is none.
export PATH=$work/newest/bin:$PATH
pyright --verifytypes groebot --ignoreexternal
pyright "$here/examples/first.py"
