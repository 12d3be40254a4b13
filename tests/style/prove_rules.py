#!/usr/bin/env python3
"""Shows that the lint rules work: the good samples pass the compiler, clang-tidy, the house rules and clang-format
without output, and each marked line of the bad samples is reported. clang-tidy 14 silently ignores a misspelt option:
a rule without such a line may not be active at all."""

import argparse
import glob
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
RULES = os.path.join(ROOT, ".clang-tidy")
QUERIES = os.path.join(ROOT, "scripts", "house-rules.clang-query")
BROKEN_QUERY = re.compile(r"Error (?:parsing|building)|Matcher not found|Invalid token|unknown command", re.IGNORECASE)


def run(*command):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          cwd=ROOT, text=True, errors="replace")
    return done.returncode, done.stdout, done.stdout + done.stderr


def tidy(path, *options):
    # The root's rules: those for tests are looser.
    return run("clang-tidy-14", "--quiet", "--config-file=" + RULES, *options, path, "--", "-std=c++20")[1]


def query(path):
    return run("clang-query-14", "-f", QUERIES, path, "--", "-std=c++20")[2]


def read_lines(path):
    with open(path, encoding="utf-8") as file:
        return list(enumerate(file.read().splitlines(), 1))


def find_hits(output, path):
    return {int(line) for line in re.findall(re.escape(os.path.basename(path)) + r":(\d+):\d+: note: .*root", output)}


def check_good(path, compiler, flags):
    code, _, output = run(compiler, "-std=c++20", "-O2", *flags, "-Werror", "-c", "-o", os.devnull, path)
    if code != 0:
        yield f"{path}: {compiler} rejects the good sample:\n{output}"
    output = tidy(path)
    if output.strip():
        yield f"{path}: clang-tidy reports the good sample:\n{output}"
    output = query(path)
    if BROKEN_QUERY.search(output) or find_hits(output, path) or "note: \"root\"" in output:
        yield f"{path}: the house rules report the good sample:\n{output}"


def check_format(path, expect_clean):
    code, _, output = run("clang-format-14", "--style=file", "--dry-run", "-Werror", path)
    if (code == 0) != expect_clean:
        yield f"{path}: clang-format {'rejects the good' if expect_clean else 'accepts the bad'} sample\n{output}"


def tidy_in_bundle(path):
    """As in scripts/lint: included by a generated file."""
    with tempfile.TemporaryDirectory() as folder:
        bundle = os.path.join(folder, "bundle.cpp")
        with open(bundle, "w", encoding="utf-8") as file:
            file.write(f'#include "{path}" // NOLINT\n')
        return tidy(bundle, "--header-filter=" + re.escape(path))


def check_bad_tidy(path, output):
    reported = {}
    for line, check in re.findall(re.escape(path) + r":(\d+):\d+: (?:warning|error): .*\[([^\]]+)\]", output):
        reported.setdefault(int(line), "")
        reported[int(line)] += check + ","
    count = 0
    for number, text in read_lines(path):
        mark = re.search(r"// EXPECT ([a-z0-9-]+)$", text)
        if mark:
            count += 1
            if mark.group(1) not in reported.get(number, ""):
                yield f"{path}:{number}: clang-tidy must report {mark.group(1)} here"
    if count == 0:
        yield f"{path}: holds no expectation"


def check_bad_warnings(path, compiler, flags):
    """Not as errors: clang stops at an error of one kind before it looks for the next."""
    flags = [flag for flag in flags if flag != "-Werror"]
    output = run(compiler, "-std=c++20", "-O2", *flags, "-c", "-o", os.devnull, path)[2]
    bClang = "clang" in run(compiler, "--version")[1]
    other = "GNU" if bClang else "CLANG"
    for number, text in read_lines(path):
        mark = re.search(r"// EXPECT-(WARNING|GNU|CLANG) (\S+)$", text)
        if mark and mark.group(1) != other:
            if not re.search(re.escape(path) + rf":{number}:\d+: warning: .*{mark.group(2)}", output):
                yield f"{path}:{number}: {compiler} must report {mark.group(2)} here"


def check_bad_query(path):
    output = query(path)
    if BROKEN_QUERY.search(output):
        yield f"the house rules do not load:\n{output}"
        return
    expected = {number for number, text in read_lines(path) if text.endswith("// EXPECT-QUERY")}
    hits = find_hits(output, path)
    for line in sorted(expected - hits):
        yield f"{path}:{line}: the house rules must report this line"
    for line in sorted(hits - expected):
        yield f"{path}:{line}: the house rules report a valid line"
    if not expected:
        yield f"{path}: holds no expectation"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--compiler", required=True)
    parser.add_argument("--warnings", required=True, help="the project's warning flags, separated by semicolons")
    arguments = parser.parse_args()
    flags = [flag for flag in arguments.warnings.split(";") if flag]
    if "-Wall" not in flags:
        print("prove_rules: the project's warning flags did not arrive")
        return 1

    good = sorted(glob.glob(os.path.join(HERE, "good", "*.cpp")))
    headers = sorted(glob.glob(os.path.join(HERE, "good", "*.hpp")))
    bad = os.path.join(HERE, "bad")
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        jobs = [pool.submit(lambda path: list(check_good(path, arguments.compiler, flags)), path) for path in good]
        jobs += [pool.submit(lambda path: list(check_format(path, True)), path) for path in good + headers]
        jobs.append(pool.submit(lambda: list(check_format(os.path.join(bad, "Unformatted.cpp"), False))))
        for report in (tidy, tidy_in_bundle):
            path = os.path.join(bad, "Bad.cpp")
            jobs.append(pool.submit(lambda report=report, path=path: list(check_bad_tidy(path, report(path)))))
        jobs.append(pool.submit(lambda: list(check_bad_warnings(os.path.join(bad, "BadWarnings.cpp"), arguments.compiler,
                                                                flags))))
        jobs.append(pool.submit(lambda: list(check_bad_query(os.path.join(bad, "BadHouse.cpp")))))
        failures = [failure for job in jobs for failure in job.result()]
    for failure in failures:
        print(failure)
    return 1 if failures or not good else 0


if __name__ == "__main__":
    sys.exit(main())
