"""Writing of files that are complete or unchanged."""

from __future__ import annotations

import contextlib
import os
import uuid
from collections.abc import Iterator
from pathlib import Path


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """The path of a new file, which replaces `path` at the end. If the block fails, such as on a full disk, `path` is unchanged and the new file is removed.

    A device or a pipe is written directly. A symbolic link is followed.
    """
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        yield target
        return
    aside = target.with_name(f".{target.name}-{os.getpid()}-{uuid.uuid4().hex}.aside")
    try:
        yield aside
        with open(aside, "rb+") as file:
            os.fsync(file.fileno())
        if target.exists():
            os.chmod(aside, target.stat().st_mode & 0o7777)
        os.replace(aside, target)
    finally:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(aside)
