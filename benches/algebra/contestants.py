"""The contestants. Each computes the basis of a problem and reports its time, its memory and, on request, its result."""

import functools
import re
import statistics
import tempfile
from dataclasses import dataclass, field

import process
from problems import Problem

WHEELS = "/opt/peers/lib/python3.11/site-packages/sage_wheels/bin"
TRIVIAL = ["x-1", "y-1"]
# The beginning of msolve's output when there are infinitely many solutions, and therefore no parametrisation.
INFINITE = "[1,"


@dataclass
class Result:
    """One run; `seconds` is None with the reason in `note`. `basis`: expanded texts, if requested and printed. `proof`: seconds of the proof, or why there is
    none.
    """

    seconds: float | None
    memory_kb: int = 0
    note: str = ""
    basis: list | None = None
    proof: float | str = ""


@dataclass
class Contestant:
    """Common parts of contestants: the program, the processor on which it runs, and the time limit."""

    program: str
    core: int = 0
    limit: float = 120
    startups: dict = field(default_factory=dict)

    def accepts(self, problem):
        return not problem.parameters

    def process(self, command, text=""):
        return process.run(command, self.core, self.limit, text)

    def startup(self, problem):
        """The processor time for a trivial problem of the same field and order."""
        key = (problem.field, problem.order)
        if key not in self.startups:
            trivial = Problem("trivial", *key, ["x", "y"], TRIVIAL)
            self.startups[key] = statistics.median(self.once(trivial)[1].cpu for _ in range(3))
        return self.startups[key]

    def run(self, problem, with_answer=False):
        own, outcome, basis = self.once(problem, with_answer)
        if outcome.stopped or own is None:
            return Result(None, outcome.memory_kb, outcome.stopped or "failed")
        return Result(self.refined(own, outcome, problem), outcome.memory_kb, basis=basis)

    def refined(self, own, _outcome, _problem):
        """The time that is reported; `own` is the time by the contestant's clock."""
        return own


class Rust(Contestant):
    """A program of program.rs: groebot or the crate `groebner`."""

    def accepts(self, problem):
        return True

    def run(self, problem, with_answer=False):
        return self.reported(problem, ["--print"] * with_answer)

    def reported(self, problem, options):
        """The output of the program. Its memory is that of the first computation."""
        with tempfile.NamedTemporaryFile("w", suffix=".ms") as file:
            file.write(problem.msolve_text())
            file.flush()
            outcome = self.process([self.program, file.name, "--order", problem.order, "--seconds", "0.3", *options])
        head, _, tail = outcome.output.partition("basis\n")
        facts = dict(line.split(" ") for line in head.splitlines())
        memory = int(facts.get("memory_kb", outcome.memory_kb))
        if outcome.stopped or "seconds" not in facts:
            return Result(None, memory, outcome.stopped or "failed")
        basis = tail.splitlines() if "--print" in options else None
        proof = facts.get("proof", "")
        return Result(float(facts["seconds"]), memory, basis=basis, proof=float(proof) if proof[:1].isdigit() else proof)


@dataclass
class Ours(Rust):
    """groebot. Over Q it proves the basis once, with a separate time limit."""

    proof_limit: float = 20
    proofs: dict = field(default_factory=dict)

    def run(self, problem, with_answer=False):
        result = super().run(problem, with_answer)
        if problem.field == "Q" and result.seconds is not None:
            if problem not in self.proofs:
                self.proofs[problem] = self.proof_of(problem)
            result.proof = self.proofs[problem]
        return result

    def proof_of(self, problem):
        """Runs the proof in a separate process. Its limit counts from the start of the proof."""
        limits = self.limit + self.proof_limit
        result = Ours(self.program, self.core, limits).reported(problem, ["--prove", str(self.proof_limit)])
        return result.note if result.seconds is None else result.proof


class Msolve(Contestant):
    """msolve: F4 (and over Q many primes); for lex its rational parametrisation, which has the same information as the basis. Its clock has a resolution of
    0.01 s. The processor time, minus that of the start, refines it within this resolution. Modulo 2^31-1 the parametrisation does not terminate and uses
    gigabytes of memory (version 0.10.1).
    """

    def accepts(self, problem):
        return not problem.parameters and (problem.order == "grevlex" or problem.characteristic < 2**30)

    def once(self, problem, with_answer=False):
        task = ["-g", "2"] if problem.order == "grevlex" else ["-P", "2"]
        with tempfile.NamedTemporaryFile("w", suffix=".ms") as file, tempfile.NamedTemporaryFile("r") as out:
            file.write(problem.msolve_text())
            file.flush()
            outcome = self.process([self.program, *task, "-t", "1", "-v", "1", "-f", file.name, "-o", out.name])
            printed = out.read()
        only_f4 = problem.order == "grevlex" and problem.characteristic
        clock = r"overall\(cpu\)\s+([\d.]+)" if only_f4 else r"msolve overall time.*?([\d.]+) sec \(cpu\)"
        found = re.findall(clock, outcome.output + outcome.messages)
        seconds = float(found[-1]) if found and not printed.startswith(INFINITE) else None
        return seconds, outcome, elements(printed) if with_answer and problem.order == "grevlex" else None

    def refined(self, own, outcome, problem):
        return max(1e-4, min(max(outcome.cpu - self.startup(problem), own - 0.005), own + 0.005))


def elements(text):
    """The polynomials of `[f,\ng]:` without the leading comments."""
    lines = "".join(line for line in text.splitlines() if not line.startswith("#"))
    return lines.strip("[]: ").split(",")


class Giac(Contestant):
    """giac's gbasis, over Q with its probabilistic check. Its results modulo primes above 1073741789 are wrong."""

    def accepts(self, problem):
        return not problem.parameters and problem.characteristic <= 1073741789

    def once(self, problem, with_answer=False):
        p, names = problem.characteristic, [f"v{i}" for i in range(len(problem.variables))]
        texts = ",".join(f"({text})%{p}" if p else text for text in problem.reduced(names))
        order = {"grevlex": "revlex", "lex": "plex"}[problem.order]
        after = 'for(k:=0;k<size(B);k++){print("element "+string(B[k]));}' if with_answer else "size(B)"
        call = f"gbasis([{texts}],[{','.join(names)}],{order})"
        outcome = self.process([self.program], f'T:=time(B:={call}):;\nprint("clock "+string(T));\n{after};\n')
        found = re.search(r"clock \[([\d.e-]+),([\d.e-]+)\]", outcome.messages + outcome.output)
        basis = [line.split(" ", 1)[1] for line in outcome.messages.splitlines() if line.startswith("element ")]
        seconds = min(map(float, found.groups())) if found else None
        return seconds, outcome, [plain(text, problem.variables) for text in basis] or None


def plain(text, variables):
    """giac's text without residue marks, in the names of the problem: `e` and `i` are constants for giac."""
    return re.sub(r"v(\d+)", lambda found: variables[int(found[1])], re.sub(r"[()]|%\d+", "", text))


class Singular(Contestant):
    """Singular's fastest method: all methods in the first round, then the fastest one."""

    METHODS = {
        ("grevlex", True): ["std", "slimgb"],
        ("grevlex", False): ["std", "slimgb", "modStd"],
        ("lex", True): ["fglm", "slimgb_fglm"],
        ("lex", False): ["fglm", "slimgb_fglm"],
        ("parameters", False): ["std", "slimgb", "fglm", "slimgb_fglm"],
        ("parameters", True): ["std", "slimgb", "fglm", "slimgb_fglm"],
    }

    def accepts(self, problem):
        return True

    def run(self, problem, with_answer=False):
        kind = "parameters" if problem.parameters else problem.order
        names = [self.best[problem]] if problem in self.best else self.METHODS[kind, problem.characteristic > 0]
        results = {name: self.by(name, problem, with_answer) for name in names}
        finished = {name: result for name, result in results.items() if result.seconds is not None}
        if not finished:
            return next(iter(results.values()))
        self.best[problem] = min(finished, key=lambda name: finished[name].seconds)
        return finished[self.best[problem]]

    @functools.cached_property
    def best(self):
        return {}

    def by(self, method, problem, with_answer):
        outcome = self.process([self.program, "-q", "--no-rc", "--no-tty"], script(method, problem, with_answer))
        found = re.search(r"@time (\d+) (\d+)", outcome.output)
        if not found or "? " in outcome.output:
            return Result(None, outcome.memory_kb, outcome.stopped or "failed")
        milliseconds, repetitions = map(int, found.groups())
        basis = outcome.output.partition("@basis\n")[2].replace("\n", "").split(",") if with_answer else None
        return Result(milliseconds / 1e3 / repetitions, outcome.memory_kb, method, basis)


def script(method, problem, with_answer):
    """Repeats the computation for three tenths of a second in one session; the clock counts processor time."""
    order = "dp" if problem.order == "grevlex" or method.endswith("fglm") else "lp"
    coefficients = ",".join([str(problem.characteristic), *problem.parameters])
    names = ",".join(problem.variables)
    first = {"fglm": "std", "slimgb_fglm": "slimgb"}.get(method, method)
    change = f"ring s = ({coefficients}),({names}),lp; short = 0; ideal G;" if method.endswith("fglm") else ""
    there, back = ("setring s; G = fglm(r, G);", "setring r;") if change else ("", "")
    return f"""{'LIB "modstd.lib";' if method == "modStd" else ""}
system("--cpus", 1); system("--ticks-per-sec", 1000); option(redSB);
ring r = ({coefficients}),({names}),{order}; short = 0;
ideal I = {",".join(problem.reduced())};
ideal G; {change} int n; int t = timer;
while (n == 0 or timer - t < 300) {{ {back} G = {first}(I); {there} n++; }}
"@time " + string(timer - t) + " " + string(n);
{'"@basis"; string(G);' if with_answer else ""}
exit;
"""


def roster(arguments):
    """All contestants by name; groebot is first."""
    common = (arguments.core, arguments.limit)
    return {
        "ours": Ours(arguments.ours, arguments.core, arguments.limit_of_ours or arguments.limit),
        "msolve": Msolve(arguments.msolve, *common),
        "giac": Giac(arguments.giac, *common),
        "singular": Singular("Singular", *common),
        "crate": Rust(arguments.crate, *common),
    }
