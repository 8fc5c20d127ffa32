#!/usr/bin/env python3
"""Breaks the sources in one place at a time and sees whether the tests notice.

    tests/mutate.py [--count N] [--seed S] [--jobs J] [--only PATH] [--again OUTPUT] [TREE]

TREE is a checkout to copy (the present one by default). Mutants are drawn at random, evenly over the places in the files of lib/ and cmd/
where one of the RULES applies; comments, strings of messages and preprocessor lines are left alone. With --again they are those that survived
in the OUTPUT of an earlier run. Each is built in a copy, and the tests run, those nearest to it first, up to the first that fails. A mutant
that does not build is not counted; one that takes far longer than the tests do without it is killed.
Ends with `M of N killed` and the survivors; exits with 1 when less than 85 % are.
"""
import argparse, os, random, re, shutil, signal, subprocess, sys, tempfile, time
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
    """Exit status (None after too long: the whole group is ended) and output. A mutant may take memory without end, so that is limited."""
    process = subprocess.Popen(["prlimit", f"--as={2 << 30}", *command], cwd=where, env={**os.environ, "PATH": f"{where}/bin:{os.environ['PATH']}"},
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    try:
        output, _ = process.communicate(timeout=seconds)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def make(goals, where):
    """As `run`. What has been built before may have been of another kind."""
    return run(["make", "MAKEFLAGS=", "CXXFLAGS=-O1", *goals.split()], where, 900)


def stages(tree, path):
    """(goals of make, command) of the tests that can notice a mutant of path: its own first, the long ones last."""
    room = path.parts[1]
    if path.parts[0] == "cmd":
        near = [("all", ["tests/run.sh", f"tests/tools/{path.stem}"])]
    else:
        near = [("build/unit", ["build/unit", "--abort", f"[{room}]"]), ("build/unit", ["build/unit", "--abort"])]
    scripts = lambda room, names="*": [str(p.relative_to(tree)) for name in names.split() for p in sorted((tree / "tests" / room).glob(f"{name}.sh"))]
    replay = " ".join(f"build/replay/{p.name}" for p in sorted((tree / "tests/fuzz/corpus").iterdir()))
    return near + [
        ("all build/shim.so", ["tests/run.sh", "tests/tools", *scripts("house", "man-examples readme help-matches-man completion negative-control")]),
        ("all", ["tests/run.sh", *scripts("pipeline")]),
        (f"all build/shim.so {replay}", ["tests/run.sh", *scripts("faults"), *scripts("house", "progress")]),
    ]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--count", type=int, default=150)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--only", default="")
    options.add_argument("--again", type=Path)
    options.add_argument("tree", nargs="?", default=str(Path(__file__).resolve().parent.parent))
    options = options.parse_args()
    tree = Path(options.tree)
    sources = sorted(p for room in ("lib", "cmd") for p in (tree / room).rglob("*.[ch]*") if p.suffix in (".cpp", ".h") and options.only in str(p))
    mutants = [(p.relative_to(tree), *place) for p in sources for place in places(p.read_text())]
    print(f"{len(mutants)} places in {len(sources)} files", flush=True)

    def describe(mutant):
        path, start, end, replacement = mutant
        original = (tree / path).read_text()
        first, last = original.rfind("\n", 0, start) + 1, original.find("\n", end)
        return f"{path}:{original.count(chr(10), 0, start) + 1}: {original[first:last].strip()} => {(original[first:start] + replacement + original[end:last]).strip()}"

    if options.again:
        without_line = lambda what: re.sub(r":\d+:", ":", what, count=1)
        survived = {without_line(what) for what in re.findall(r"^SURVIVED: (.*)$", options.again.read_text(), re.M)}
        chosen = [m for m in mutants if without_line(describe(m)) in survived]
    else:
        chosen = random.Random(options.seed).sample(mutants, min(options.count, len(mutants)))
    chosen = [(m, describe(m)) for m in chosen]
    scratch = Path(tempfile.mkdtemp(prefix="mutate."))
    copies = Queue()
    for i in range(options.jobs):
        shutil.copytree(tree, scratch / str(i), symlinks=True, ignore=shutil.ignore_patterns(".git"), copy_function=shutil.copy2)
        copies.put(scratch / str(i))
    usual = {}  # seconds that a command takes without a mutation

    def judge(one):
        (path, start, end, replacement), what = one
        copy = copies.get()
        try:
            source, object = copy / path, copy / "build" / path.with_suffix(".o")
            original, times, built = source.read_text(), source.stat(), object.read_bytes() if path.suffix == ".cpp" else b""
            source.write_text(original[:start] + replacement + original[end:])
            verdict = "SURVIVED"
            for goals, command in stages(copy, path):
                if make(goals, copy)[0] != 0:
                    verdict = "does not build"
                    break
                status, _ = run(command, copy, 30 + 5 * usual[tuple(command)])
                if status != 0:
                    verdict = f"killed by {' '.join(Path(word).name for word in command[:3])}" + (" (too long)" if status is None else "")
                    break
            source.write_text(original)
            if built:  # newer than its source, and than what is linked from it; after a header all that includes it is built again
                os.utime(source, ns=(times.st_atime_ns, times.st_mtime_ns))
                object.write_bytes(built)
            print(f"{verdict}: {what}", flush=True)
            return verdict, what
        finally:
            copies.put(copy)

    try:
        for copy in list(copies.queue):
            for goals, command in {str(stage): stage for mutant, _ in chosen for stage in stages(copy, mutant[0])}.values():
                status, output = make(goals, copy)
                if status != 0:
                    sys.exit(f"the sources do not build:\n{output[-2000:]}")
                since = time.monotonic()
                status, output = run(command, copy, 900)
                if status != 0:
                    sys.exit(f"{command}: fails without a mutation:\n{output[-2000:]}")
                usual[tuple(command)] = time.monotonic() - since
        with ThreadPoolExecutor(options.jobs) as pool:
            results = [r for r in pool.map(judge, chosen) if r[0] != "does not build"]
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    survivors = [what for verdict, what in results if verdict == "SURVIVED"]
    killed = len(results) - len(survivors)
    print(f"\n{killed} of {len(results)} killed" + "".join(f"\n  survived: {s}" for s in survivors))
    sys.exit(killed < 0.85 * len(results))


main()
