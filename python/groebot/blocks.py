"""Work in blocks, each of which becomes one parquet file.

A block is a pure function of the work and a range of rows. Its file is written under a temporary name and then renamed. So a file with the final name is
complete, also after a process was killed, and is not computed again, unless its checksums show damage. Several processes may compute the same folder: each
has its own temporary files, and removes only those of ended processes. `Block.write` may be called by any process on any machine. With one version of pyarrow,
the files are bitwise identical. `run` computes the blocks in this process, `groebot.dask` on Dask.

All processes must see the folder under the same path. This module needs pyarrow (`pip install groebot[parquet]`).
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import socket
import time
import uuid
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import Any

import pyarrow as arrow
import pyarrow.parquet as parquet

from ._errors import BadValueError
from ._groebot import __version__

BLOCK = 1_000_000
"""Default number of rows of a block."""
FORMAT = 2
"""The version number of the file format. Since 2, each page has a checksum."""
_ASIDE = ".aside"
_COLUMNS = b"groebot.columns"
_DAMAGES = (OSError, arrow.ArrowException, ValueError)
"""The errors that damaged files cause; `ValueError` for names that are not UTF-8."""
_ABANDONED = 3600.0
"""Age of a temporary file that a living process has not changed [s]: a block takes seconds, and its file grows all the time."""


class Work(ABC):
    """A computation over a range of rows. It is sent to workers by pickle."""

    @property
    @abstractmethod
    def rows(self) -> int:
        """Number of rows."""

    @abstractmethod
    def parameters(self) -> dict[str, Any]:
        """All data on which the result depends, as values that JSON can represent. `Work.key` is its hash."""

    @abstractmethod
    def tables(self, start: int, stop: int) -> Iterator[arrow.Table]:
        """The results for the rows from `start` to before `stop`, as tables. Each table becomes a row group of the file. Repeated calls return equal results.
        """

    @cached_property
    def key(self) -> str:
        """The SHA-256 hash of these data, in hexadecimal."""
        text = json.dumps({"format": FORMAT, "groebot": __version__, **self.parameters()}, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Block:
    """The rows from `start` to before `stop`, and the output folder."""

    folder: str
    start: int
    stop: int

    @property
    def path(self) -> Path:
        return Path(self.folder, f"block-{self.start:012}-{self.stop:012}.parquet")

    def marks(self, work: Work) -> dict[bytes, bytes]:
        """The metadata of the file."""
        metadata = {"key": work.key, "start": self.start, "stop": self.stop, "rows": work.rows, "format": FORMAT}
        return {f"groebot.{name}".encode(): str(value).encode() for name, value in metadata.items()}

    def is_of(self, work: Work) -> bool:
        """Whether the file exists and belongs to this work, by its metadata."""
        marks = _marks(self.path)
        return marks is not None and self.marks(work).items() <= marks.items()

    def is_done(self, work: Work) -> bool:
        """Whether the file exists, belongs to this work, and is undamaged: all its pages are read and their checksums compared, and its columns have the names
        and types that were written."""
        return self.is_of(work) and _is_whole(self.path, self.stop - self.start)

    def write(self, work: Work) -> bool:
        """Computes the block if necessary. Returns whether it was computed."""
        if self.is_done(work):
            return False
        self._compute(work)
        return True

    def _compute(self, work: Work) -> None:
        aside = self.path.with_name(f".{self.path.stem}-{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex}{_ASIDE}")
        try:
            self._write(work, aside)
            with open(aside, "rb+") as file:
                os.fsync(file.fileno())
            os.replace(aside, self.path)
        finally:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(aside)

    def _write(self, work: Work, path: Path) -> None:
        tables = work.tables(self.start, self.stop)
        first = next(tables)
        schema = first.schema.with_metadata({**self.marks(work), _COLUMNS: _columns(first.schema)})
        # Snappy saves two bytes of five, and the time to write them to a disk. Dictionaries of joint values would be as long as the columns.
        with parquet.ParquetWriter(path, schema, compression="snappy", use_dictionary=False, write_page_checksum=True) as writer:
            for table in chain([first], tables):
                writer.write_table(table.replace_schema_metadata(schema.metadata), row_group_size=max(len(table), 1))


@dataclass(frozen=True)
class Done:
    """The result of a run."""

    files: list[Path]
    """One file for each block, in the order of the rows."""
    written: int
    """Number of computed blocks."""
    found: int
    """Number of blocks that existed before."""


Each = Callable[[Sequence[Block]], Iterable[bool]]


def run(work: Work, out: str | os.PathLike[str], block: int = BLOCK, each: Each | None = None) -> Done:
    """Computes all blocks of a work into the folder `out`, which is created if necessary.

    `each` calls `Block.write(work)` for the blocks that it receives, in any order and on any machine, and yields the results. Without it, the blocks are
    computed one after the other in this process. `BadValueError` if the folder has blocks of other work, or of another size.
    """
    blocks = planned(work, out, block)
    left = [one for one in blocks if not one.is_done(work)]
    written = sum(each(left) if each else (one.write(work) for one in left))
    _tidy(Path(out))
    return Done([one.path for one in blocks], written, len(blocks) - written)


def planned(work: Work, out: str | os.PathLike[str], block: int = BLOCK) -> list[Block]:
    """The blocks of a work, after a check of the output folder."""
    if block < 1:
        raise BadValueError(f"a block of {block} rows has none; give 1 or more", "bad_value")
    folder = Path(out).absolute()
    folder.mkdir(parents=True, exist_ok=True)
    edges = range(0, work.rows, block)
    blocks = [Block(str(folder), start, min(start + block, work.rows)) for start in edges]
    wanted = {one.path.name: one for one in blocks}
    for path in sorted(folder.glob("block-*.parquet")):
        marks = _marks(path)
        # A file that cannot be read is written again.
        if path.name not in wanted or (marks is not None and not wanted[path.name].is_of(work)):
            raise BadValueError(f"{path}: this is a block of other work; give an empty folder, or remove it", "bad_value")
    return blocks


def finished(out: str | os.PathLike[str], work: Work | None = None) -> Iterator[tuple[int, Path]]:
    """The files of finished work in order, each with its first row.

    `BadValueError` if a block is missing, or belongs to other work than `work` or than the first block.
    """
    folder, at, rows, key = Path(out), 0, None, None if work is None else work.key.encode()
    for path in sorted(folder.glob("block-*.parquet")):
        marks = _marks(path) or {}
        start, stop, total, own = (marks.get(f"groebot.{name}".encode(), b"-1") for name in ("start", "stop", "rows", "key"))
        if int(start) != at or key not in (None, own):
            raise BadValueError(f"{path}: rows from {at} of the same work should follow; run it again", "bad_value")
        yield at, path
        at, rows, key = int(stop), int(total), own
    if rows != at:
        raise BadValueError(f"{folder}: rows from {at} are missing; run it again", "bad_value")


def _tidy(folder: Path) -> None:
    """Removes the temporary files of killed processes: those of this machine whose process has ended, and any that did not change for an hour."""
    for aside in folder.glob(f".block-*{_ASIDE}"):
        *_, host, pid, _ = aside.name.removesuffix(_ASIDE).rsplit("-", 3)
        with contextlib.suppress(FileNotFoundError):
            is_old = time.time() - aside.stat().st_mtime > _ABANDONED
            has_ended = aside.name.find(f"-{socket.gethostname()}-{pid}-") > 0 and pid.isdigit() and not _is_running(int(pid))
            if is_old or has_ended:
                aside.unlink()


def _is_running(pid: int) -> bool:
    if os.name != "posix":
        # There, the signal 0 would end the process.
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


def read(path: Path) -> arrow.Table:
    """The table of a block, after a comparison of the checksums of all its pages. `OSError` for a damaged file."""
    with parquet.ParquetFile(path, page_checksum_verification=True) as file:
        return file.read(use_threads=False)


def _columns(schema: arrow.Schema) -> bytes:
    """The hash of the names and types of the columns, which have no checksum of their own."""
    # Versions of pyarrow name the values of lists differently.
    text = "\n".join(f"{name}: {re.sub(r'(item|element): ', '', str(kind))}" for name, kind in zip(schema.names, schema.types))
    return hashlib.sha256(text.encode()).hexdigest().encode()


def _is_whole(path: Path, rows: int) -> bool:
    try:
        table = read(path)
        return bool(table.num_rows == rows and (table.schema.metadata or {}).get(_COLUMNS) == _columns(table.schema))
    except _DAMAGES:
        return False


def _marks(path: Path) -> dict[bytes, bytes] | None:
    try:
        return dict(parquet.read_schema(path).metadata or {})
    except _DAMAGES:
        return None
