"""The exceptions of groebot. Each has the kind of its error."""

from __future__ import annotations

import errno
import os

import numpy as np
import numpy.typing as npt


class GroebotError(Exception):
    """An error: `kind` is a word for tests in programs, and the message has the allowed values.

    Kinds: io, syntax, unknown_key, missing_key, bad_value, duplicate_name, unknown_name, overflow, inconsistent, positive_dimensional, cancelled, budget,
    unsupported, certificate, no_path, other.
    """

    kind: str
    file: str | None
    line: int | None

    def __init__(self, message: str, kind: str = "other", file: str | None = None, line: int | None = None) -> None:
        place = (f"{file}: " if file else "") + (f"line {line}: " if line else "")
        super().__init__(place + message)
        self.kind, self.file, self.line = kind, file, line
        self._arguments = (message, kind, file, line)

    def __reduce__(self) -> tuple[type[GroebotError], tuple[object, ...]]:
        return type(self), self._arguments


class BadValueError(GroebotError, ValueError):
    """A value, a name or a text that is not allowed."""


class FileError(GroebotError, OSError):
    """A file that cannot be read or written: an `OSError` with `filename`."""

    def __init__(self, message: str, kind: str = "io", file: str | None = None, line: int | None = None) -> None:
        super().__init__(message, kind, file, line)
        self.filename = file

    def __str__(self) -> str:
        return str(self.args[0])


class MissingFileError(FileError, FileNotFoundError):
    """A file that does not exist: a `FileNotFoundError`."""

    errno: int | None

    def __init__(self, message: str, kind: str = "io", file: str | None = None, line: int | None = None) -> None:
        super().__init__(message, kind, file, line)
        self.errno = errno.ENOENT


class NoPathError(GroebotError):
    """There is no path over a map: a body as wide as the robot's core cannot leave the cells of `enclosure`, (N, 2) \\[m\\]."""

    enclosure: npt.NDArray[np.float64]

    def __init__(self, message: str, enclosure: npt.NDArray[np.float64]) -> None:
        super().__init__(message, "no_path")
        self.enclosure = enclosure

    def __reduce__(self) -> tuple[type[GroebotError], tuple[object, ...]]:
        return type(self), (self._arguments[0], self.enclosure)


_VALUES = {"bad_value", "syntax", "unknown_key", "missing_key", "duplicate_name", "unknown_name"}


def of_kind(kind: str, message: str, file: str | None, line: int | None) -> GroebotError:
    """The exception of a kind."""
    return _class(kind, file)(message, kind, file, line)


def _class(kind: str, file: str | None) -> type[GroebotError]:
    if kind == "io":
        return MissingFileError if file is not None and not os.path.lexists(file) else FileError
    return BadValueError if kind in _VALUES else GroebotError
