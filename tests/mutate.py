#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks the sources in one place at a time and sees whether the tests notice.

    tests/mutate.py [--count N] [--seed S] [--jobs J] [--only PATH] [--near] [--again OUTPUT] [TREE]

TREE is a checkout to copy (the present one by default). Mutants are drawn at random, evenly over
the places in the files of lib/ and cmd/ where one of the RULES applies; comments, strings of
messages and preprocessor lines are left alone. With --again they are those that survived in the
OUTPUT of an earlier run. Each is built in a copy, and the tests run, those nearest to it first, up
to the first that fails; with --near only the unit tests of its module and those of the tools that
show what it does. A mutant that does not build is not counted; one that takes far longer than the
tests do without it is killed. The compiler is CXX of the environment (`CXX='ccache g++'`).

Ends with `M of N killed` and the survivors; exits with 1 when less than 90 % are.
"""
import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import Queue

NUMBER_BEFORE, NUMBER_AFTER = r"(?<![\w.'])", r"(?![\w.'])"
RULES = [
    # comparisons
    (r"(?<=[\w)\]] )<(?= [\w(*!-])", ["<=", ">"]),
    (r"(?<=[\w)\]] )>(?= [\w(*!-])", [">=", "<"]),
    (r"(?<= )<=(?= )", ["<", ">="]),
    (r"(?<= )>=(?= )", [">", "<="]),
    (r"(?<= )==(?= )", ["!="]),
    (r"(?<= )!=(?= )", ["=="]),
    # signs and operators
    (r"(?<=[\w)\]] )\+(?= [\w(*])", ["-"]),
    (r"(?<=[\w)\]] )-(?= [\w(*])", ["+"]),
    (r"(?<=[\w)\]] )\*(?= [\w(])", ["/"]),
    (r"(?<=[\w)\]] )/(?= [\w(])", ["*"]),
    (r"(?<= )\+=(?= )", ["-="]),
    (r"(?<= )-=(?= )", ["+="]),
    (r"(?<=[=(,] )-(?=[\w(])|(?<=\()-(?=[\w(])", [""]),
    (r"(?<=\w )&&(?= )", ["||"]),
    (r"(?<=\w )\|\|(?= )", ["&&"]),
    (r"(?<=[( ])!(?=[\w(])", [""]),
    (r"\+\+(?=\w)", ["--"]),
    # constants
    (NUMBER_BEFORE + "0" + NUMBER_AFTER, ["1"]),
    (NUMBER_BEFORE + "1" + NUMBER_AFTER, ["0", "2"]),
    (NUMBER_BEFORE + "[2-9]" + NUMBER_AFTER, ["1"]),
    (NUMBER_BEFORE + r"\d+(?:\.\d+)?e-?\d+" + NUMBER_AFTER, ["1"]),
    (NUMBER_BEFORE + r"0\.5" + NUMBER_AFTER, ["0.25"]),
    (r"\btrue\b", ["false"]),
    (r"\bfalse\b", ["true"]),
    # statements: a whole line that is a call or an assignment
    (
        r"^ +(?!return|throw|const|auto|double|using|case|break|else|static|friend|explicit"
        r"|virtual)[\w.\->\[\]*]+(?:\(.*\)| [-+*/|]?= .*);$",
        [";"],
    ),
    (r"\bcontinue;", [";"]),
    (r"\bbreak;", [";"]),
]
NOT_CODE = re.compile(r"\s*(#|extern|template|namespace|constexpr std::string_view)")
LITERAL = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'')

# The tools whose output shows what a module computes.
TOOLS = {
    "base": ["simulate"],
    "cli": ["fitpower", "simulate"],
    "contact": ["energy-ledger", "shift-from-accel"],
    "fit": ["fitpower"],
    "law": ["fitpower", "simulate"],
    "least_squares": ["fitpower"],
    "motion": ["simulate"],
    "noise": ["fitpower"],
    "ode": ["simulate"],
    "report": ["fitpower"],
    "selection": ["smooth"],
    "sensor": ["simulate"],
    "signal": ["smooth", "differentiate"],
    "statistics": ["fitpower"],
    "text": ["smooth", "fitpower"],
}

# The module whose unit tests show most of what another one does for it.
USER = {"base": "fit", "least_squares": "fit", "noise": "fit", "statistics": "fit"}


def places(text):
    """(start, end, replacement) in the code of a file."""
    offset = 0
    found = []
    for line in text.splitlines(keepends=True):
        code = re.split(r"(?<!:)//", line.rstrip("\n"))[0]
        if not NOT_CODE.match(code) and "asm" not in code:
            bare = LITERAL.sub(lambda m: "\x01" * len(m.group()), code)
            for pattern, replacements in RULES:
                for m in re.finditer(pattern, code if pattern.startswith("^") else bare):
                    found += [(offset + m.start(), offset + m.end(), r) for r in replacements]
        offset += len(line)
    return found


def run(command, where, seconds):
    """Exit status (None after too long: the whole group is ended) and output. A mutant may take
    memory without end, so that is limited."""
    process = subprocess.Popen(
        ["prlimit", f"--as={2 << 30}", *command],
        cwd=where,
        env={**os.environ, "PATH": f"{where}/bin:{os.environ['PATH']}"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=seconds)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def make(goals, where):
    """As `run`. What has been built before may have been of another kind."""
    compiler = os.environ.get("CXX", "g++")
    return run(
        ["make", "MAKEFLAGS=", "CXXFLAGS=-O1", f"CXX={compiler}", *goals.split()], where, 900
    )


def cases(tree, tool):
    """The files and folders of cases of a tool."""
    found = sorted((tree / "tests/tools").glob(f"{tool}*"))
    return [str(p.relative_to(tree)) for p in found]


def stages(tree, path, near):
    """(goals of make, command) of the tests that can notice a mutant of path: its own first, the
    long ones last."""
    module = path.parts[1]

    def scripts(folder, names="*"):
        found = []
        for name in names.split():
            found += sorted((tree / "tests" / folder).glob(f"{name}.sh"))
        return [str(p.relative_to(tree)) for p in found]

    if path.parts[0] == "cmd":
        first = [("all", ["tests/run.sh", *cases(tree, path.stem)])]
    else:
        unit = f"build/unit-{module}"
        own = f"{path.stem}_test"
        first = [(unit, [unit, "--abort"])]
        if (tree / "tests/unit" / module / f"{own}.cpp").exists():
            first.insert(0, (unit, [unit, "--abort", "--filenames-as-tags", f"[#{own}]"]))
        if near and module in USER:
            user = f"build/unit-{USER[module]}"
            first.append((user, [user, "--abort"]))
        tools = TOOLS.get(module, [])
        if near and tools:  # whose cases chain them with others
            first.append(
                ("all", ["tests/run.sh", *(c for tool in tools for c in cases(tree, tool))])
            )
    if near:
        return first
    if path.parts[0] == "lib":
        first.append(("build/unit", ["build/unit", "--abort"]))
    pages = scripts("pages", "man-examples readme help-matches-man completion")
    replays = sorted((tree / "tests/fuzz/corpus").iterdir())
    replay = " ".join(f"build/replay/{p.name}" for p in replays)
    return first + [
        ("all build/shim.so", ["tests/run.sh", "tests/tools", *pages]),
        ("all", ["tests/run.sh", *scripts("pipeline")]),
        (
            f"all build/shim.so {replay}",
            ["tests/run.sh", *scripts("faults"), *scripts("pages", "terminal")],
        ),
    ]


def described(tree, mutant):
    """One line: the file, the line, what stands there and what the mutant has instead."""
    path, start, end, replacement = mutant
    original = (tree / path).read_text()
    first, last = original.rfind("\n", 0, start) + 1, original.find("\n", end)
    number = original.count("\n", 0, start) + 1
    before = original[first:last].strip()
    after = (original[first:start] + replacement + original[end:last]).strip()
    return f"{path}:{number}: {before} => {after}"


def judged(copy, mutant, near, usual):
    """Builds the mutant in the copy and tests it; the copy is then as it was."""
    path, start, end, replacement = mutant
    source, built = copy / path, copy / "build" / path.with_suffix(".o")
    original, times = source.read_text(), source.stat()
    built_bytes = built.read_bytes() if path.suffix == ".cpp" else b""
    source.write_text(original[:start] + replacement + original[end:])
    verdict = "SURVIVED"
    for goals, command in stages(copy, path, near):
        if make(goals, copy)[0] != 0:
            verdict = "does not build"
            break
        status, _ = run(command, copy, 30 + 5 * usual[tuple(command)])
        if status != 0:
            words = " ".join(Path(word).name for word in command)
            verdict = f"killed by {words[:60]}" + (" (too long)" if status is None else "")
            break
    source.write_text(original)
    if built_bytes:
        # Newer than its source and than what is linked from it. After a header all that includes
        # it is built again.
        os.utime(source, ns=(times.st_atime_ns, times.st_mtime_ns))
        built.write_bytes(built_bytes)
    return verdict


def times_without_mutation(copies, commands):
    """Seconds that each command takes in the first of the copies, which are built for it."""
    usual = {}
    for copy in copies:
        for goals, command in commands(copy):
            status, output = make(goals, copy)
            if status != 0:
                sys.exit(f"the sources do not build:\n{output[-2000:]}")
            if copy != copies[0]:
                continue
            since = time.monotonic()
            status, output = run(command, copy, 900)
            if status != 0:
                sys.exit(f"{command}: fails without a mutation:\n{output[-2000:]}")
            usual[tuple(command)] = time.monotonic() - since
    return usual


def chosen_mutants(tree, options):
    folders = ("lib", "cmd")
    sources = sorted(p for folder in folders for p in (tree / folder).rglob("*.[ch]*"))
    sources = [p for p in sources if p.suffix in (".cpp", ".h") and options.only in str(p)]
    mutants = [
        (p.relative_to(tree), *place) for p in sources for place in places(p.read_text())
    ]
    print(f"{len(mutants)} places in {len(sources)} files", flush=True)
    if not options.again:
        count = min(options.count, len(mutants))
        return random.Random(options.seed).sample(mutants, count)

    def without_line(what):
        return re.sub(r":\d+:", ":", what, count=1)

    lines = re.findall(r"^SURVIVED: (.*)$", options.again.read_text(), re.M)
    survived = {without_line(what) for what in lines}
    return [m for m in mutants if without_line(described(tree, m)) in survived]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="")
    parser.add_argument("--near", action="store_true")
    parser.add_argument("--again", type=Path)
    parser.add_argument("tree", nargs="?", default=str(Path(__file__).resolve().parent.parent))
    options = parser.parse_args()
    tree = Path(options.tree)
    mutants = chosen_mutants(tree, options)
    scratch = Path(tempfile.mkdtemp(prefix="mutate."))
    copies = Queue()
    for i in range(options.jobs):
        shutil.copytree(
            tree,
            scratch / str(i),
            symlinks=True,
            ignore=shutil.ignore_patterns(".git", "covered", "sanitized", "fuzzing", "arm64"),
            copy_function=shutil.copy2,
        )
        copies.put(scratch / str(i))

    def commands(copy):
        all_stages = [s for m in mutants for s in stages(copy, m[0], options.near)]
        return {str(stage): stage for stage in all_stages}.values()

    def judge(mutant):
        copy = copies.get()
        try:
            verdict, what = judged(copy, mutant, options.near, usual), described(tree, mutant)
            print(f"{verdict}: {what}", flush=True)
            return verdict, what
        finally:
            copies.put(copy)

    try:
        usual = times_without_mutation(list(copies.queue), commands)
        with ThreadPoolExecutor(options.jobs) as pool:
            results = [r for r in pool.map(judge, mutants) if r[0] != "does not build"]
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    survivors = [what for verdict, what in results if verdict == "SURVIVED"]
    killed = len(results) - len(survivors)
    print(f"\n{killed} of {len(results)} killed" + "".join(f"\n  survived: {s}" for s in survivors))
    sys.exit(killed < 0.9 * len(results))


main()
