"""The page of a solver, tested without a browser."""

import base64
import html
import json
import re
import sys
import types
import webbrowser
import zlib

import pytest
from witness import DERIVATIONS, UR5_URDF

import groebot
from groebot import GroebotError, Robot, Solver


@pytest.fixture
def opened(monkeypatch):
    addresses = []
    monkeypatch.setattr(webbrowser, "open", addresses.append)
    return addresses


def data_of(page):
    (text,) = re.findall(r'<script type="application/json" id="groebot-data">(.*?)</script>', page, re.DOTALL)
    return json.loads(text)


def program_of(limb):
    """The page has it compressed by zlib, in base64."""
    return json.loads(zlib.decompress(base64.b64decode(limb["program"])))


def test_the_page_holds_the_solver_and_opens_in_the_browser(tmp_path, opened, derived):
    view = derived.view(tmp_path / "ur5.html")
    assert view.path == tmp_path / "ur5.html" and opened == [view.path.as_uri()]
    (limb,) = data_of(view.path.read_text())["limbs"]
    assert program_of(limb) == json.loads(derived.to_json())["program"]


def test_a_notebook_shows_the_page_itself(opened, monkeypatch):
    shell = types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))
    view = Solver.named("irb120").view(height=400)
    assert opened == [] and view.path.name == "irb120.html"
    shown = view._repr_html_()
    (inside,) = re.findall(r'srcdoc="([^"]*)"', shown)
    assert html.unescape(inside) == view.path.read_text() and 'height="400"' in shown
    del shell.kernel
    Solver.named("irb120").view()
    assert len(opened) == 1


@pytest.mark.parametrize("name", Solver.names(compiled=True))
def test_every_named_solver_has_a_page(name, tmp_path, opened):
    view = Solver.named(name).view(tmp_path / "page.html", open=False)
    assert len(data_of(view.path.read_text())["limbs"]) == 1 and opened == []


def test_the_chain_ends_at_the_requested_tip(tmp_path):
    joint = '<joint name="to_{0}" type="fixed"><parent link="wrist_3_link"/><child link="{0}"/><origin xyz="0 {1} 0"/></joint><link name="{0}"/>'
    two_tips = joint.format("left", 0.2) + joint.format("right", -0.2)
    text = UR5_URDF.read_text().replace("</robot>", two_tips + "</robot>")
    solver = groebot.derive(Robot.from_urdf(text, tip="right"))
    data = data_of(solver.view(tmp_path / "arm.html", open=False).path.read_text())
    (limb,) = data["limbs"]
    assert program_of(limb)["name"].endswith("right") and limb["name"].endswith("right")


def test_what_has_no_page_is_reported(tmp_path):
    alone = Solver.from_json((DERIVATIONS / "ur5/5_program.json").read_text())
    with pytest.raises(groebot.BadValueError, match="folder of its derivation"):
        alone.view(open=False)
    with pytest.raises(GroebotError, match="nowhere"):
        Solver.named("ur5").view(tmp_path / "nowhere/page.html", open=False)
