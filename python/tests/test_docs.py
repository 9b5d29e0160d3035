"""The snippets of docs/from_other_solvers.md run. If the other packages are installed, their snippets run too, and find the same solutions."""

import importlib.util
import re
import shutil

import numpy as np
import pytest
from witness import REPOSITORY, same_angles

PAGE = REPOSITORY / "docs/from_other_solvers.md"
SECTIONS = dict(re.findall(r"^## From (\S+)\n(.*?)(?=^## |\Z)", PAGE.read_text(), re.DOTALL | re.MULTILINE))
MODULES = {"ssik": "ssik", "EAIK": "eaik", "ik-geo": "ik_geo", "py-opw-kinematics": "py_opw_kinematics"}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    shutil.copy(REPOSITORY / "tests/corpus/dynamics/ur5.urdf", tmp_path / "ur5.urdf")
    (toml,) = re.findall(r"```toml\n# arm.toml\n(.*?)```", PAGE.read_text(), re.DOTALL)
    (tmp_path / "arm.toml").write_text(toml)
    monkeypatch.chdir(tmp_path)


def run(section, names, is_wanted):
    for code in re.findall(r"```python\n(.*?)```", SECTIONS[section], re.DOTALL):
        if is_wanted("import groebot" in code):
            exec(compile(code, f"{PAGE.name}, from {section}", "exec"), names)
    return names


@pytest.mark.parametrize("section", SECTIONS)
def test_snippets_of_groebot(section, folder, capsys):
    names = run(section, {}, lambda is_ours: is_ours)
    assert len(names.get("ours", [0] * 8)) == 8


@pytest.mark.parametrize("section", MODULES)
def test_snippets_of_others_find_the_same(section, folder):
    if importlib.util.find_spec(MODULES[section]) is None:
        pytest.skip(f"{section} is not installed")
    names = run("EAIK", {}, lambda is_ours: is_ours) if section == "ik-geo" else {}
    if section == "ik-geo":
        names |= {name: np.array(value) for name, value in (("H", AXES), ("P", OFFSETS))}
    run(section, names, lambda is_ours: True)
    ours, theirs = np.array(names["ours"]), np.array(names["theirs"])
    assert len(theirs) == len(ours) == 8
    assert all(same_angles(theirs, q).min() < 1e-6 for q in ours)


AXES = [[0.0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0]]
OFFSETS = [[0, 0, 0.29], [0, 0, 0], [0, 0, 0.27], [0.302, 0, 0.07], [0, 0, 0], [0, 0, 0], [0.16, 0, 0]]
