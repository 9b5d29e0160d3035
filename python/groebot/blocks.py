"""Work that is cut into blocks, each of which becomes one parquet file.

A block is a pure function of the work and of a range of rows. Its file is written aside and then renamed: what is there is whole, whoever is killed, and is not done again. Who calls
`Block.write`, and on how many machines, does not matter: the files are the same to the last byte with one version of pyarrow. `run` does it here, `groebot.dask` on Dask.

The folder is on a disk that all who work see under the same path. This module needs pyarrow (`pip install groebot[parquet]`).
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import socket
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
"""Rows of a block, unless told."""
FORMAT = 1
"""The number of the format of the files."""
_ASIDE = ".aside"


class Work(ABC):
    """What is done for a range of rows. It travels to those who do it by pickle."""

    @property
    @abstractmethod
    def rows(self) -> int:
        """How many rows there are."""

    @abstractmethod
    def told(self) -> dict[str, Any]:
        """All that the result depends on, as what JSON can hold. `Work.key` is its hash."""

    @abstractmethod
    def tables(self, start: int, stop: int) -> Iterator[arrow.Table]:
        """What becomes of the rows from `start` to before `stop`, in pieces: the same whenever it is asked. Each becomes a row group of the file."""

    @cached_property
    def key(self) -> str:
        """The SHA-256 of what is told, in hexadecimal."""
        text = json.dumps({"format": FORMAT, "groebot": __version__, **self.told()}, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Block:
    """The rows from `start` to before `stop`, and the folder that takes them."""

    folder: str
    start: int
    stop: int

    @property
    def path(self) -> Path:
        return Path(self.folder, f"block-{self.start:012}-{self.stop:012}.parquet")

    def marks(self, work: Work) -> dict[bytes, bytes]:
        """What the file says of itself."""
        said = {"key": work.key, "start": self.start, "stop": self.stop, "rows": work.rows, "format": FORMAT}
        return {f"groebot.{name}".encode(): str(value).encode() for name, value in said.items()}

    def is_done(self, work: Work) -> bool:
        """Whether the file is there, whole, and of this work."""
        marks = _marks(self.path)
        return marks is not None and self.marks(work).items() <= marks.items()

    def write(self, work: Work) -> bool:
        """Does the block where it is not done: whether it was to be done."""
        if self.is_done(work):
            return False
        aside = self.path.with_name(f".{self.path.stem}-{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex}{_ASIDE}")
        try:
            self._write(work, aside)
            with open(aside, "rb+") as file:
                os.fsync(file.fileno())
            os.replace(aside, self.path)
        finally:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(aside)
        return True

    def _write(self, work: Work, path: Path) -> None:
        tables = work.tables(self.start, self.stop)
        first = next(tables)
        schema = first.schema.with_metadata(self.marks(work))
        # Snappy saves two bytes of five, and the time to write them to a disk. Dictionaries of joint values would be as long as the columns.
        with parquet.ParquetWriter(path, schema, compression="snappy", use_dictionary=False) as writer:
            for table in chain([first], tables):
                writer.write_table(table.replace_schema_metadata(schema.metadata), row_group_size=max(len(table), 1))


@dataclass(frozen=True)
class Done:
    """What a run did."""

    files: list[Path]
    """One file a block, in the order of the rows."""
    written: int
    """Blocks that were done."""
    found: int
    """Blocks that had been done before."""


Each = Callable[[Sequence[Block]], Iterable[bool]]


def run(work: Work, out: str | os.PathLike[str], block: int = BLOCK, each: Each | None = None) -> Done:
    """Does all blocks of a work into the folder `out`, which is made where it is not there.

    `each` calls `Block.write(work)` for the blocks that it is given, in any order and wherever it likes, and yields what that tells; without it they are done one after the other, here.
    `BadValueError` where the folder has blocks of other work, or of another size.
    """
    blocks = planned(work, out, block)
    left = [one for one in blocks if not one.is_done(work)]
    written = sum(each(left) if each else (one.write(work) for one in left))
    # Killed processes leave unfinished temporary files.
    for aside in Path(out).glob(f".block-*{_ASIDE}"):
        aside.unlink(missing_ok=True)
    return Done([one.path for one in blocks], written, len(blocks) - written)


def planned(work: Work, out: str | os.PathLike[str], block: int = BLOCK) -> list[Block]:
    """The blocks of a work, after a look at the folder that takes them."""
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
        if path.name not in wanted or (marks is not None and not wanted[path.name].is_done(work)):
            raise BadValueError(f"{path}: this is a block of other work; give an empty folder, or remove it", "bad_value")
    return blocks


def finished(out: str | os.PathLike[str], work: Work | None = None) -> Iterator[tuple[int, Path]]:
    """The files of finished work in order, each with its first row.

    `BadValueError` where a block is missing, or is of other work than `work`, or than the first.
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


def _marks(path: Path) -> dict[bytes, bytes] | None:
    try:
        return dict(parquet.read_schema(path).metadata or {})
    except (OSError, arrow.ArrowInvalid):
        return None
