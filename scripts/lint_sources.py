#!/usr/bin/env python3
"""Runs clang-tidy 14 (warnings as errors) and the house rules over the sources of build/tidy's compilation database.
What passed is remembered by a hash of all that can change the answer: the source, the headers of this tree that it
includes, its compile command and the rules."""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed

from source_tree import CPP_SUFFIXES, IncludeResolver, list_files, list_includes, read_text

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = os.path.join(ROOT, "build", "tidy")
# Compiled by other presets, by other projects, or not at all.
ELSEWHERE = ("tests/fuzz/", "tests/install/", "tests/style/bad/", "tests/unit/compile_fail/")
# Shared by all clones of a machine, as the compiler's cache is: what passed in one need not be looked at in another.
CACHE = os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "acs-lint")
QUERIES = os.path.join("scripts", "house-rules.clang-query")
BROKEN_QUERY = re.compile(r"Error (?:parsing|building)|Matcher not found|Invalid token|unknown command", re.IGNORECASE)


class Fingerprints:
    def __init__(self):
        files = list_files(ROOT)
        self._resolver = IncludeResolver([path for path in files if path.endswith(CPP_SUFFIXES)])
        rules = [path for path in files if os.path.basename(path) == ".clang-tidy"] + [QUERIES]
        self._rules = "\0".join(read_text(ROOT, path) for path in rules)
        self._includes = {}

    def _get_includes(self, path):
        if path not in self._includes:
            found = [self._resolver.find(path, quoted, name)
                     for _, quoted, name in list_includes(read_text(ROOT, path))]
            self._includes[path] = [target for target in found if target is not None]
        return self._includes[path]

    def make(self, path, command):
        seen = {path}
        waiting = [path]
        while waiting:
            for target in self._get_includes(waiting.pop()):
                if target not in seen:
                    seen.add(target)
                    waiting.append(target)
        digest = hashlib.sha256((self._rules + "\0" + command.replace(ROOT, "")).encode())
        for name in sorted(seen):
            digest.update((name + "\0" + read_text(ROOT, name)).encode())
        return digest.hexdigest()


def run(*command):
    done = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace")
    return done.returncode, done.stdout


def lint(path):
    """What is wrong with one source; empty where nothing is."""
    source = os.path.join(ROOT, path)
    code, output = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "-p", BUILD, source)
    complaint = output if code != 0 else ""
    _, output = run("clang-query-14", "-p", BUILD, "-f", QUERIES, source)
    places = re.findall(r"^(\S+:\d+:\d+): note: \"root\" binds here\n(.*)$", output, re.MULTILINE)
    if BROKEN_QUERY.search(output) or ": error: " in output or output.count(" matches.") + output.count(" match.") == 0:
        complaint += output
    for place, line in dict.fromkeys(places):
        complaint += f"{place}: breaks a rule of {QUERIES}: {line.strip()}\n"
    return complaint


def select(arguments):
    with open(os.path.join(BUILD, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    wanted = {os.path.relpath(path, ROOT) for path in arguments.files}
    commands = {}
    for entry in entries:
        path = os.path.relpath(os.path.join(entry["directory"], entry["file"]), ROOT)
        if path.startswith(("..", "build/")) or (wanted and path not in wanted):
            continue
        commands.setdefault(path, entry["command"])
    unknown = wanted - set(commands)
    if not wanted:
        unknown = {path for path in list_files(ROOT) if path.endswith(".cpp") and not path.startswith(ELSEWHERE)}
        unknown -= set(commands)
    if unknown:
        print("no target of preset tidy compiles, so nobody checks: " + ", ".join(sorted(unknown)))
    fingerprints = Fingerprints()
    chosen = []
    for path, command in sorted(commands.items()):
        stamp = os.path.join(CACHE, fingerprints.make(path, command))
        if arguments.all or not os.path.exists(stamp):
            chosen.append((path, stamp))
    return chosen, len(commands), bool(unknown)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    os.makedirs(CACHE, exist_ok=True)
    chosen, total, bOrphans = select(arguments)
    print(f"{len(chosen)} of {total} sources to look at", flush=True)
    failed = []
    begin = time.monotonic()
    with ThreadPoolExecutor(max_workers=arguments.jobs) as pool:
        jobs = {pool.submit(lint, path): (path, stamp) for path, stamp in chosen}
        for number, job in enumerate(as_completed(jobs), 1):
            path, stamp = jobs[job]
            complaint = job.result()
            verdict = "FAILED" if complaint else "ok"
            print(f"[{number}/{len(chosen)} {time.monotonic() - begin:.0f}s] {verdict} {path}", flush=True)
            if complaint:
                print(complaint, flush=True)
                failed.append(path)
            else:
                with open(stamp, "w", encoding="utf-8") as file:
                    file.write(path + "\n")
    if failed:
        print("failed: " + " ".join(sorted(failed)))
    return 1 if failed or bOrphans else 0


if __name__ == "__main__":
    sys.exit(main())
