"""`repack.py`, which compresses the files of a wheel again: they stay the same, and are no larger."""

import sys
import zipfile
from pathlib import Path

import pytest
from tools import need

need("deflate")
sys.path.append(str(Path(__file__).parents[1]))
import repack  # noqa: E402

# Names with their permissions and contents: text, a program, an empty file, noise (a linear congruential generator) that is stored, and a name in UTF-8.
FILES = {
    "package/__init__.py": (0o644, b"def f(x):\n    return x + 1\n" * 400),
    "package/program": (0o755, bytes(range(256)) * 8),
    "package/empty": (0o600, b""),
    "package/noise": (0o644, bytes((69069 * n * n + 1) >> 9 & 255 for n in range(300))),
    "package/größe": (0o644, b"a" * 70_000),
}


@pytest.fixture
def wheel(tmp_path):
    path = tmp_path / "old.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for place, (name, (mode, data)) in enumerate(FILES.items()):
            entry = zipfile.ZipInfo(name, (1980 + place, 2, 29 - place, 23, 59, 2 * place))
            entry.external_attr = (0o100000 | mode) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return path


def test_files_stay_the_same(wheel, tmp_path):
    out = tmp_path / "new.whl"
    repack.main(str(wheel), str(out))
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(out) as new:
        assert new.testzip() is None
        assert [entry.filename for entry in new.infolist()] == list(FILES)
        for before, after in zip(old.infolist(), new.infolist(), strict=True):
            mode, data = FILES[after.filename]
            assert new.read(after) == data
            assert after.external_attr >> 16 == 0o100000 | mode
            assert (after.CRC, after.date_time, after.create_system) == (before.CRC, before.date_time, before.create_system)
            assert after.compress_size <= min(before.compress_size, len(data))
    assert out.stat().st_size <= wheel.stat().st_size


def test_zipfile_stays_unchanged(wheel, tmp_path):
    before = dict(vars(zipfile))
    repack.main(str(wheel), str(tmp_path / "new.whl"))
    assert dict(vars(zipfile)) == before
