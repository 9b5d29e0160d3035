"""Compresses the files of a wheel again, by libdeflate, which makes 3 % less of a wheel than zlib: `repack.py WHEEL OUT`. Files and their order stay the same."""

from __future__ import annotations

import sys
import zipfile

import deflate

# The highest level of libdeflate.
LEVEL = 12


class Whole:
    """Compresses a file when its last part is written: zipfile's interface of zlib's compressor."""

    def __init__(self) -> None:
        self.parts: list[bytes] = []

    def compress(self, part: bytes) -> bytes:
        self.parts.append(bytes(part))
        return b""

    def flush(self) -> bytes:
        return deflate.deflate_compress(b"".join(self.parts), LEVEL)


def main(wheel: str, out: str) -> None:
    # zipfile has no public place for another compressor of the same format.
    zipfile._get_compressor = lambda kind, level=None: Whole() if kind == zipfile.ZIP_DEFLATED else None  # type: ignore[attr-defined]
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(out, "w") as new:
        for entry in old.infolist():
            new.writestr(entry, old.read(entry), zipfile.ZIP_DEFLATED)
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(out) as new:
        assert new.testzip() is None and [(e.filename, e.CRC) for e in old.infolist()] == [(e.filename, e.CRC) for e in new.infolist()]


if __name__ == "__main__":
    main(*sys.argv[1:])
