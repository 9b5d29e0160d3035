"""Runs a contestant on one processor and measures it from outside."""

import os
import pathlib
import subprocess
import tempfile
import time
from dataclasses import dataclass

MEMORY_KB = 4 << 20


@dataclass
class Outcome:
    """The result of a process: the reason why it has no result (empty if it has one), processor time [s], peak of resident memory [kB], output."""

    stopped: str
    cpu: float
    memory_kb: int
    output: str
    messages: str


def run(command, core, limit, text=""):
    """Runs `command` with `text` as its input, for at most `limit` seconds and in at most MEMORY_KB."""
    with tempfile.TemporaryFile("w+") as given, tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        given.write(text)
        given.seek(0)
        environment = os.environ | {"OMP_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"}
        pinned = ["taskset", "-c", str(core), *map(str, command)]
        child = subprocess.Popen(pinned, stdin=given, stdout=out, stderr=err, env=environment)
        stopped, memory, usage = watch(child, limit)
        out.seek(0)
        err.seek(0)
        texts = [file.read().decode(errors="replace") for file in (out, err)]
        return Outcome(stopped, usage.ru_utime + usage.ru_stime, memory, *texts)


def watch(child, limit):
    """Waits for the end. The kernel's own maximum would include the memory of this interpreter before the start."""
    start, memory, stopped = time.monotonic(), 0, ""
    while True:
        memory = max(memory, resident_peak(child.pid))
        done, status, usage = os.wait4(child.pid, os.WNOHANG)
        if done:
            child.returncode = os.waitstatus_to_exitcode(status)
            return stopped or ("failed" if status else ""), memory, usage
        age = time.monotonic() - start
        if not stopped and (age > limit or memory > MEMORY_KB):
            stopped = f">{limit:.0f}" if age > limit else f">{MEMORY_KB >> 20}GB"
            child.kill()
        time.sleep(0.0005 if age < 0.1 else 0.005)


def resident_peak(pid):
    """The value of VmHWM of a process; 0 if it has ended."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0
    lines = [line.split()[1] for line in status.splitlines() if line.startswith("VmHWM:")]
    return int(lines[0]) if lines else 0
