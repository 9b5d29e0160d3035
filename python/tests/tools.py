"""What a test asks for beyond groebot and numpy."""

import importlib
import os

import pytest


def need(*modules):
    """Leaves the tests of a file out, aloud, where a module is missing; with GROEBOT_REQUIRE_TOOLS=1 that is an error."""
    if os.environ.get("GROEBOT_REQUIRE_TOOLS") == "1":
        for name in modules:
            importlib.import_module(name)
    for name in modules:
        pytest.importorskip(name, reason=f"{name} is not installed")
