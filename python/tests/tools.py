"""Requirements of tests other than groebot and numpy."""

import importlib
import os

import pytest


def need(*modules):
    """Skips the tests of a file with a message if a module is missing. With GROEBOT_REQUIRE_TOOLS=1 that is an error."""
    if os.environ.get("GROEBOT_REQUIRE_TOOLS") == "1":
        for name in modules:
            importlib.import_module(name)
    for name in modules:
        pytest.importorskip(name, reason=f"{name} is not installed")
