"""The docstrings of the stub, which editors show: each is that of the compiled item, and its examples run."""

import ast
import doctest
import inspect
from pathlib import Path

import numpy as np
import pytest

import groebot

TREE = ast.parse(Path(groebot.__file__).with_name("_groebot.pyi").read_text(encoding="utf-8"))


def items(body, prefix=""):
    """The public items with their docstrings. An overloaded function has it once."""
    found = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("_"):
            name = prefix + node.name
            found[name] = found.get(name) or ast.get_docstring(node)
            if isinstance(node, ast.ClassDef):
                found |= items(node.body, f"{name}.")
    return found


ITEMS = items(TREE.body)
EXAMPLES = {name: text for name, text in ITEMS.items() if text and ">>>" in text}


def plain(text):
    """The words before the examples."""
    return " ".join(text.replace("\\[", "[").replace("\\]", "]").partition(">>>")[0].split())


@pytest.mark.parametrize("name", ITEMS)
def test_the_stub_says_what_help_says(name):
    compiled = groebot
    for part in name.split("."):
        compiled = getattr(compiled, part)
    assert plain(ITEMS[name] or "") == plain(inspect.getdoc(compiled)) != ""


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_run(name):
    names = {"groebot": groebot, "np": np}
    test = doctest.DocTestParser().get_doctest(EXAMPLES[name], names, name, "_groebot.pyi", 0)
    assert test.examples
    shown = []
    result = doctest.DocTestRunner(verbose=False).run(test, out=shown.append)
    assert result.failed == 0, "".join(shown)


def test_the_main_functions_have_examples():
    assert {"Solver.solve", "Solver.solve_batch", "Solver.nearest", "Solver.forward", "Solver.placed", "Robot", "derive"} <= set(EXAMPLES)
