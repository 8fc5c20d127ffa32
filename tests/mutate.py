#!/usr/bin/env python3
"""Breaks the sources in one place at a time and sees whether the tests notice.

    tests/mutate.py [--count N] [--seed S] [--jobs J] [--only PATH] [TREE]

TREE is a checkout to copy (the present one by default). Mutants are drawn at random, evenly over the places in lib/ and cmd/ where one of the
RULES applies; comments, strings of messages and preprocessor lines are left alone. Each is built in a copy, and the tests run in the order
unit, tools, faults, pipeline, up to the first that fails. A mutant that does not build is not counted; one that takes too long is killed.
Ends with `M of N killed` and the survivors; exits with 1 when less than 85 % are.
"""
import argparse, os, random, re, shutil, signal, subprocess, sys, tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import Queue

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
    (r"(?<![\w.'])0(?![\w.'])", ["1"]),
    (r"(?<![\w.'])1(?![\w.'])", ["0", "2"]),
    (r"(?<![\w.'])[2-9](?![\w.'])", ["1"]),
    (r"(?<![\w.'])\d+(?:\.\d+)?e-?\d+(?![\w.'])", ["1"]),
    (r"(?<![\w.'])0\.5(?![\w.'])", ["0.25"]),
    (r"\btrue\b", ["false"]),
    (r"\bfalse\b", ["true"]),
    # statements: a whole line that is a call or an assignment
    (r"^ +(?!return|throw|const|auto|double|using|case|break|else|static|friend|explicit|virtual)[\w.\->\[\]*]+(?:\(.*\)| [-+*/|]?= .*);$", [";"]),
    (r"\bcontinue;", [";"]),
    (r"\bbreak;", [";"]),
]


def places(text):
    """(start, end, replacement) in the code of a file."""
    offset = 0
    found = []
    for line in text.splitlines(keepends=True):
        code = re.split(r"(?<!:)//", line.rstrip("\n"))[0]
        if not re.match(r"\s*(#|extern|template|namespace|constexpr std::string_view)", code) and "asm" not in code:
            bare = re.sub(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'', lambda m: "\x01" * len(m.group()), code)
            for pattern, replacements in RULES:
                for m in re.finditer(pattern, code if pattern.startswith("^") else bare):
                    found += [(offset + m.start(), offset + m.end(), r) for r in replacements]
        offset += len(line)
    return found


def run(command, where, seconds):
    """Exit status, or None after too long. The whole group is ended."""
    process = subprocess.Popen(command, cwd=where, env={**os.environ, "PATH": f"{where}/bin:{os.environ['PATH']}"}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    try:
        output, _ = process.communicate(timeout=seconds)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def tests(tree):
    """The stages, the quickest to find something first."""
    scripts = lambda *names: [str(p) for name in names for p in sorted((tree / "tests").glob(name))]
    return [
        ["build/unit", "--abort"],
        ["tests/run.sh", "tests/tools"],
        ["tests/run.sh", *scripts("house/man-examples.sh", "house/readme.sh", "faults/fields.sh", "faults/options.sh", "faults/output.sh", "faults/surroundings.sh", "faults/numbers.sh")],
        ["tests/run.sh", *scripts("faults/memory.sh", "pipeline/*.sh")],
    ]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--count", type=int, default=150)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--only", default="")
    options.add_argument("tree", nargs="?", default=str(Path(__file__).resolve().parent.parent))
    options = options.parse_args()
    tree = Path(options.tree)
    sources = sorted(p for room in ("lib", "cmd") for p in (tree / room).rglob("*.cpp") if options.only in str(p))
    mutants = [(p.relative_to(tree), *place) for p in sources for place in places(p.read_text())]
    print(f"{len(mutants)} places in {len(sources)} files", flush=True)
    chosen = random.Random(options.seed).sample(mutants, min(options.count, len(mutants)))
    scratch = Path(tempfile.mkdtemp(prefix="mutate."))
    copies = Queue()
    for i in range(options.jobs):
        shutil.copytree(tree, scratch / str(i), symlinks=True, ignore=shutil.ignore_patterns(".git"), copy_function=shutil.copy2)
        copies.put(scratch / str(i))
    make = ["make", "MAKEFLAGS=", "CXXFLAGS=-O1", "all", "build/unit", "build/shim.so"]  # the rest of the objects may be of any build

    def build(copy):
        return run(make, copy, 900)

    def judge(mutant):
        path, start, end, replacement = mutant
        copy = copies.get()
        try:
            source, object = copy / path, copy / "build" / path.with_suffix(".o")
            original, times, built = source.read_text(), source.stat(), object.read_bytes()
            changed = original[:start] + replacement + original[end:]
            line = original.count("\n", 0, start) + 1
            what = f"{path}:{line}: {original.splitlines()[line - 1].strip()} => {changed.splitlines()[line - 1].strip()}"
            source.write_text(changed)
            status, _ = build(copy)
            verdict = "does not build"
            if status == 0:
                verdict = "SURVIVED"
                for stage in tests(copy):
                    status, _ = run(stage, copy, 300)
                    if status != 0:
                        verdict = f"killed by {Path(stage[0]).name} {Path(stage[1]).name}" + (" (too long)" if status is None else "")
                        break
            source.write_text(original)
            os.utime(source, ns=(times.st_atime_ns, times.st_mtime_ns))
            object.write_bytes(built)  # newer than its source, and than what is linked from it
            print(f"{verdict}: {what}", flush=True)
            return verdict, what
        finally:
            copies.put(copy)

    try:
        for copy in list(copies.queue):
            status, output = build(copy)
            if status != 0:
                sys.exit(f"the sources do not build:\n{output[-2000:]}")
        for stage in tests(copy):
            status, output = run(stage, copy, 900)
            if status != 0:
                sys.exit(f"{stage}: fails without a mutation:\n{output[-2000:]}")
        with ThreadPoolExecutor(options.jobs) as pool:
            results = [r for r in pool.map(judge, chosen) if r[0] != "does not build"]
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    survivors = [what for verdict, what in results if verdict == "SURVIVED"]
    killed = len(results) - len(survivors)
    print(f"\n{killed} of {len(results)} killed" + "".join(f"\n  survived: {s}" for s in survivors))
    sys.exit(killed < 0.85 * len(results))


main()
