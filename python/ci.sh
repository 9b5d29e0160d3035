#!/usr/bin/env bash
# Builds the wheel and tests it as users install it: by pip in empty environments, with the oldest and the newest supported numpy. It needs python3 with venv
# and Rust. With the profile `release` (`python/ci.sh release`), the wheel is the one that is published, and its size is checked. With the path of a wheel
# (`python/ci.sh dist/groebot-0.1.0-cp310-abi3-manylinux_2_17_x86_64.manylinux2014_x86_64.whl`) this one is tested.
set -euo pipefail

profile=${1:-fast}
wheel=
case $profile in *.whl) wheel=$(realpath "$profile") profile=release ;; esac
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

environment() {
    python3 -m venv "$work/$1"
    "$work/$1/bin/pip" install --quiet --disable-pip-version-check --no-compile "${@:2}"
}

if [ -z "$wheel" ]; then
    environment build "maturin>=1.9,<2"
    cargo fmt --check
    # Runs clippy during the compilation of the bindings. A separate `cargo clippy` would check the library again.
    RUSTC_WORKSPACE_WRAPPER=clippy-driver "$work/build/bin/maturin" build \
        --locked --profile "$profile" --compression-level "$([ "$profile" = release ] && echo 9 || echo 1)" --out "$work/wheels" -- -D warnings
    wheel=$(echo "$work"/wheels/*.whl)
    # The source distribution must have each file that its manifests name. (Its build takes as long as that of the wheel.)
    "$work/build/bin/maturin" sdist --out "$work/sdist"
    tar xzf "$work"/sdist/*.tar.gz -C "$work/sdist"
    (cd "$work"/sdist/groebot-*/python && cargo fetch --locked --quiet --target "$(rustc -vV | sed -n 's/^host: //p')")
fi
size=$(stat --format %s "$wheel")
printf '%s: %d bytes\n' "$(basename "$wheel")" "$size"
if [ "$profile" = release ]; then
    export GROEBOT_RELEASE=1
    if [ "$size" -gt 8200000 ]; then
        echo "the wheel is larger than 8.2 MB"
        exit 1
    fi
fi

# The tests do not run in this folder, because its package has no compiled module.
here=$PWD
cd "$work"
# The oldest supported numpy for this Python version.
environment oldest "$wheel" "numpy==1.26.*; python_version < '3.13'" "numpy==2.1.*; python_version >= '3.13'"
oldest/bin/python -c 'import groebot; ur5 = groebot.Solver.named("ur5"); assert len(ur5.solve(ur5.forward([0.1, -1.2, 1.4, -0.3, 0.8, 0.5]))) == 8'
oldest/bin/groebot --version
# Internals of arrays differ between versions of numpy. All other tests run with the newest version.
oldest/bin/pip install --quiet --disable-pip-version-check --no-compile pytest hypothesis "scipy<1.15"
oldest/bin/pytest --quiet -rs "$here"/tests/test_{batch,input}.py

environment newest "${wheel}[dask,notebooks]" "numpy>=2" pytest hypothesis scipy mypy pyright "deflate==0.9.*"
GROEBOT_REQUIRE_TOOLS=1 newest/bin/pytest --quiet -rs --durations=10 "$here/tests"
newest/bin/mypy --config-file "$here/pyproject.toml" --package groebot
newest/bin/mypy --config-file "$here/pyproject.toml" "$here/examples"
newest/bin/python -m mypy.stubtest groebot._groebot
newest/bin/python "$here/examples/first.py"
# pyright inspects the first Python on the path. It installs Node if there is none.
export PATH=$work/newest/bin:$PATH
pyright --verifytypes groebot --ignoreexternal
pyright "$here/examples/first.py"
