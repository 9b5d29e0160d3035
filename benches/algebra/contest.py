#!/usr/bin/env python3
"""Groebner bases by groebot and its peers, interleaved, on one processor. README.md describes its use.

    contest.py                                           all lines, all peers
    contest.py --only katsura-9,noon-8 --peers msolve,crate --field 'GF(32003)' --order grevlex
    contest.py --corpus --without-ours --peers msolve,giac,crate --rounds 1 --limit 10       whose results agree with the corpus
    contest.py --output ../record/2026-11-21-groebner.csv
"""

import argparse
import csv
import pathlib
import statistics
import subprocess
import sys

import contestants
import problems

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARIES = ROOT / "target" / "release"
PEERS = ["msolve", "giac", "singular", "crate"]
TIMES = ["ours_s", *(f"{name}_s" for name in PEERS)]
COLUMNS = ["system", "field", "order", *TIMES, "proof_s", "best_peer", "ratio", "ours_mb", "best_peer_mb", "notes"]


def main():
    arguments = options()
    players = contestants.roster(arguments)
    names = ["ours"] * (not arguments.without_ours) + arguments.peers
    lines = problems.corpus_lines() if arguments.corpus else problems.lines()
    chosen = [problem for problem in lines if matches(problem, arguments)]
    if not chosen:
        sys.exit("no line of the contest has these --only, --field and --order")
    rows = []
    for problem in chosen:
        rows.append(row(problem, contest(problem, {name: players[name] for name in names}, arguments)))
        print("  ".join(f"{key}={value}" for key, value in rows[-1].items() if value != ""), flush=True)
        if arguments.output:
            write(arguments.output, rows)


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    listed = lambda text: [word.replace("-", "_") for word in text.split(",")]
    parser.add_argument("--only", type=listed, help="systems, such as katsura-9,noon-8")
    parser.add_argument("--corpus", action="store_true", help="every answer of the corpus instead of the lines of the contest")
    parser.add_argument("--field", help="Q, 'GF(32003)' or 'GF(2147483647)'")
    parser.add_argument("--order", help="grevlex or lex")
    parser.add_argument("--peers", type=lambda text: text.split(","), default=PEERS, help="default: " + ",".join(PEERS))
    parser.add_argument("--without-ours", action="store_true")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--once", type=float, default=5, help="a contestant over so many seconds plays one round")
    parser.add_argument("--limit", type=float, default=120, help="seconds of one run")
    parser.add_argument("--limit-of-ours", type=float, help="another limit for groebot")
    parser.add_argument("--core", type=int, default=1, help="the processor that all run on")
    parser.add_argument("--no-check", action="store_true", help="do not compare the answers with the corpus")
    parser.add_argument("--output", type=pathlib.Path, help="a CSV file")
    parser.add_argument("--ours", default=BINARIES / "basis_of")
    parser.add_argument("--crate", default=BINARIES / "crate_basis_of")
    parser.add_argument("--msolve", default=f"{contestants.WHEELS}/msolve")
    parser.add_argument("--giac", default=f"{contestants.WHEELS}/giac")
    return parser.parse_args()


def matches(problem, arguments):
    wanted = [(arguments.field, problem.field), (arguments.order, problem.order)]
    named = not arguments.only or problem.system.replace("-", "_") in arguments.only
    return named and all(asked in (None, value) for asked, value in wanted)


def contest(problem, players, arguments):
    """The results of all contestants, round by round. A contestant that fails, is slow or returns a wrong result is excluded from later rounds."""
    results = {name: [] for name, player in players.items() if player.accepts(problem)}
    for turn in range(arguments.rounds):
        for name, found in results.items():
            if all(result.seconds is not None and result.seconds < arguments.once for result in found):
                check = turn == 0 and problem.known_hash is not None and not arguments.no_check
                found.append(checked(problem, players[name].run(problem, check)))
    return results


def checked(problem, result):
    """The result, without its time if its basis differs from the corpus."""
    if result.basis is not None and problem.known_hash not in (None, problem.hash_of(result.basis)):
        return contestants.Result(None, result.memory_kb, "wrong")
    return result


def row(problem, results):
    """One row of the record: medians of the rounds, the fastest peer, and our time divided by its time."""
    medians = {name: median(found) for name, found in results.items()}
    times = {f"{name}_s": text(medians[name] or results[name][-1].note) for name in results}
    peers = {name: seconds for name, seconds in medians.items() if name != "ours" and seconds}
    best = min(peers, key=peers.get) if peers else ""
    proof = text(results["ours"][0].proof) if "ours" in results else ""
    memory = lambda name: text(max(r.memory_kb for r in results[name]) / 1024) if name in results else ""
    ratio = text(medians["ours"] / peers[best]) if best and medians.get("ours") else ""
    made = {"system": problem.system, "field": problem.field, "order": problem.order, "notes": notes(results), **times}
    made |= {"proof_s": proof, "best_peer": best, "ratio": ratio, "ours_mb": memory("ours"), "best_peer_mb": memory(best)}
    return {column: made.get(column, "") for column in COLUMNS}


def median(found):
    """The median time; None if a run failed."""
    seconds = [result.seconds for result in found]
    return None if None in seconds else statistics.median(seconds)


def notes(results):
    """Singular's method, and the contestants whose results agree with the corpus."""
    method = [f"singular: {found[-1].note}" for name, found in results.items() if name == "singular" and found[-1].seconds]
    agree = [name for name, found in results.items() if found[0].basis is not None]
    return "; ".join(method + ([f"checked: {' '.join(agree)}"] if agree else []))


def text(value):
    return value if isinstance(value, str) else f"{value:.3g}" if value < 100 else f"{value:.0f}"


def write(path, rows):
    """Writes the whole record: the results so far, the machine and the commit."""
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, [*COLUMNS, "machine", "commit"], lineterminator="\n")
        writer.writeheader()
        writer.writerows(entry | {"machine": machine(), "commit": commit()} for entry in rows)


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "unknown")


def commit():
    git = lambda *words: subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    changed = git("status", "--porcelain", "--", ".", ":!benches/record")
    return git("rev-parse", "--short", "HEAD") + ("-dirty" if changed else "")


if __name__ == "__main__":
    main()
