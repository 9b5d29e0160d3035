"""The command `groebot`."""

from __future__ import annotations

import sys

from . import _groebot


def main() -> int:
    """Runs the command with the arguments of this process. Returns the exit status."""
    return _groebot._run(["groebot", *sys.argv[1:]])
