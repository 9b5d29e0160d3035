"""The command `groebot`."""

from __future__ import annotations

import sys

from . import _groebot


def main() -> int:
    """Runs the command on the arguments of this process: the exit status."""
    return _groebot._run(["groebot", *sys.argv[1:]])
