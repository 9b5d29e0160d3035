"""The page of a solver: all solutions, updated while the target is dragged."""

from __future__ import annotations

import html
import json
import re
import subprocess
import sys
import tempfile
import webbrowser
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from ._errors import BadValueError, GroebotError
from ._groebot import Solver


@dataclass(frozen=True)
class View:
    """A self-contained HTML page that shows a solver. Notebooks display it in a frame. It needs no server and makes no network requests."""

    path: Path
    """The path of the HTML file."""
    height: int = 600
    """Its height in a notebook [pixels]."""

    def _repr_html_(self) -> str:
        # The page itself, not its address: a notebook on another machine can also read it.
        page = html.escape(self.path.read_text(encoding="utf-8"))
        style = "width: 100%; border: none"
        return f'<iframe srcdoc="{page}" height="{self.height}" sandbox="allow-scripts allow-downloads" style="{style}"></iframe>'


def view(
    self: Solver,
    path: str | PathLike[str] | None = None,
    *,
    open: bool | None = None,
    height: int = 600,
    reach: str | PathLike[str] | None = None,
) -> View:
    """Writes the page of `groebot view` for this solver: all solutions, updated while the target is dragged.

    `path` is the output file, by default a temporary file. The page is opened in the browser, except in a notebook, which displays the returned object; `open`
    overrides this. `height` is that in a notebook [pixels]. `reach` is a file with a reach map (`ReachMap.save`). For tasks other than a pose the page shows
    only the chain. `BadValueError` for a solver without a chain.
    """
    page = Path(path) if path is not None else Path(tempfile.mkdtemp(prefix="groebot-view-"), f"{_file_name(self.name)}.html")
    with tempfile.TemporaryDirectory(prefix="groebot-view-") as folder:
        _write(self, Path(folder))
        command = [sys.executable, "-m", "groebot", "view", folder, "--out", str(page.absolute())]
        command += [] if reach is None else ["--reach", str(Path(reach).absolute())]
        result = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    if result.returncode:
        raise GroebotError(result.stderr.strip().removeprefix("error: ") or f"`groebot view` ended with {result.returncode}")
    if open or (open is None and not _in_notebook()):
        webbrowser.open(page.absolute().as_uri())
    return View(page, height)


def _write(solver: Solver, folder: Path) -> None:
    """The files of `groebot derive` that the page needs."""
    stored = json.loads(solver.to_json())
    files = stored.get("files")
    if not files:
        raise BadValueError("this solver was read without the description of its chain; load the folder of its derivation", "missing_key")
    for name, text in files.items():
        (folder / Path(name).name).write_text(text, encoding="utf-8")
    (folder / "5_program.json").write_text(json.dumps(stored["program"]), encoding="utf-8")


def _file_name(name: str) -> str:
    return re.sub(r"[^\w-]+", "_", name) or "solver"


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    running = shell.get_ipython() if shell is not None else None
    return running is not None and hasattr(running, "kernel")
