#!/usr/bin/env python3
"""Runs clang-tidy 14 (warnings as errors) and the house rules over the sources of build/tidy's compilation database.
What passed is remembered by a hash of all that can change the answer: the source and the headers of this tree that it
includes, without their comments, its compile command and the rules."""

import argparse
import hashlib
import itertools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait

from source_tree import CPP_SUFFIXES, IncludeResolver, list_files, list_includes, read_text

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = os.path.join(ROOT, "build", "tidy")
# Compiled by other presets, by other projects, or not at all.
ELSEWHERE = ("tests/fuzz/", "tests/install/", "tests/style/bad/", "tests/unit/compile_fail/")
# Shared by all clones of a machine, as the compiler's cache is: what passed in one is not checked in another.
CACHE = os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "acs-lint")
QUERIES = os.path.join("scripts", "house-rules.clang-query")
MAX_BUNDLE = 32
# Where the static analyzer looks: at what others link and, if asked, at the programs.
ANALYZED = ("lib",)
ANALYZED_DEEP = ("lib", "apps/", "examples/")
WITHOUT_ANALYZER = "-clang-analyzer-*"
ONLY_ANALYZER = "-*,clang-analyzer-*,-clang-analyzer-optin.cplusplus.VirtualCall"
# Its full depth, which follows calls, takes nine times as long.
SHALLOW = ("-Xclang", "-analyzer-config", "-Xclang", "mode=shallow")
QUOTED_INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
# What changes no answer.
COMMENT = re.compile(r"^[ \t]*//(?!.*NOLINT).*\n|[ \t]*///<(?!.*NOLINT).*", re.MULTILINE)
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
        # Word by word: a clone in a folder with a space in its name has quotes that mean nothing.
        words = " ".join(shlex.split(command)).replace(ROOT, "")
        digest = hashlib.sha256((self._rules + "\0" + words).encode())
        for name in sorted(seen):
            digest.update((name + "\0" + COMMENT.sub("", read_text(ROOT, name))).encode())
        return digest.hexdigest()


def run(*command):
    done = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace")
    return done.returncode, done.stdout


class Source:
    def __init__(self, path, command, stamp, is_analyzed, depth):
        self.path = path
        self.full_path = os.path.join(ROOT, path)
        self.stamp = stamp
        self.complaint = ""
        self.is_analyzed = is_analyzed
        self.depth = depth
        words = shlex.split(command)[1:]
        out = words.index("-o")
        del words[out:out + 2]
        #: All arguments of the compiler except the names of files.
        self.arguments = [word for word in words if word != "-c" and os.path.join(ROOT, word) != self.full_path]
        #: What must be equal for two sources to be checked together: the checks, the arguments and the rules.
        self.kind = (is_analyzed, *self.arguments,
                     *(folder for folder in self.get_folders() if os.path.exists(os.path.join(ROOT, folder, ".clang-tidy"))))

    def get_text(self):
        """Its text, which compiles in another folder, too."""
        folder = os.path.dirname(self.full_path)

        def find(match):
            path = os.path.join(folder, match[1])
            return f'#include "{path}"' if os.path.exists(path) else match[0]
        return f'#line 1 "{self.full_path}"\n' + QUOTED_INCLUDE.sub(find, read_text(ROOT, self.path)) + "\n"

    def get_folders(self):
        folder = os.path.dirname(self.path)
        while folder:
            yield folder
            folder = os.path.dirname(folder)


class Bundle:
    """One file that includes several sources of one kind, and one with their texts: most of the time goes into the headers that
    they share."""

    def __init__(self, folder, number, sources):
        self._sources = sources
        # What shadows a name of another source shadows nothing in its own.
        self._arguments = (*sources[0].arguments, "-Wno-shadow")
        # A place of the same depth: clang-tidy looks for rules in the folders above.
        place = os.path.join(folder, os.path.dirname(sources[0].path))
        os.makedirs(place, exist_ok=True)
        for level in sources[0].get_folders():
            rules = os.path.join(ROOT, level, ".clang-tidy")
            if os.path.exists(rules):
                shutil.copy(rules, os.path.join(folder, level))
        self._path = os.path.join(place, f"bundle{number}.cpp")
        with open(self._path, "w", encoding="utf-8") as file:
            file.writelines(f'#include "{source.full_path}" // NOLINT\n' for source in sources)
        self._analyzed_path = os.path.join(place, f"text{number}.cpp")
        if sources[0].is_analyzed:  # The analyzer passes over what is included.
            with open(self._analyzed_path, "w", encoding="utf-8") as file:
                file.writelines(source.get_text() for source in sources)

    def find_misfits(self):
        """Sources that do not compile behind the others, as when two have a helper of one name."""
        _, output = run("clang++-14", "-fsyntax-only", "-w", "-ferror-limit=0", *self._arguments, self._path)
        broken = set(re.findall(r"^(\S+?):\d+:\d+: (?:fatal )?error: ", output, re.MULTILINE))
        return [source for source in self._sources if source.full_path in broken]

    def is_clean(self):
        code, output = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "--checks=" + WITHOUT_ANALYZER,
                           f"--header-filter=^{re.escape(ROOT)}/(lib|apps/|examples/|tests/)", self._path, "--",
                           *self._arguments)
        complaints = re.findall(r"^.*: (?:error|warning): .*$", output, re.MULTILINE)
        # What is included counts as a header there.
        true_complaints = [line for line in complaints
                           if not re.search(r"\.cpp:.*\[google-global-names-in-headers\b", line)]
        if true_complaints or (code != 0 and not complaints):
            return False
        if query(self._path, "--", *self._arguments):
            return False
        return not self._sources[0].is_analyzed or self._is_clean_to_analyzer()

    def _is_clean_to_analyzer(self):
        code, _ = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "--checks=" + ONLY_ANALYZER, self._analyzed_path, "--",
                      *self._arguments, *self._sources[0].depth)
        return code == 0


def query(*arguments):
    """What breaks a house rule."""
    complaint = ""
    _, output = run("clang-query-14", "-f", QUERIES, *arguments)
    places = re.findall(r"^(\S+:\d+:\d+): note: \"root\" binds here\n(.*)$", output, re.MULTILINE)
    if BROKEN_QUERY.search(output) or ": error: " in output or output.count(" matches.") + output.count(" match.") == 0:
        complaint += output
    for place, line in dict.fromkeys(places):
        complaint += f"{place}: breaks a rule of {QUERIES}: {line.strip()}\n"
    return complaint


def tidy(source):
    code, output = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "-p", BUILD,
                       "--checks=" + ("" if source.is_analyzed else WITHOUT_ANALYZER),
                       *("--extra-arg=" + word for word in source.depth), source.full_path)
    return output if code != 0 else ""


class Linter:
    """Checks bundles of sources; if one is not clean, its halves, so that each finding is of a source that was checked
    alone."""

    def __init__(self, pool, folder, progress):
        self._pool = pool
        self._folder = folder
        self._progress = progress
        self._numbers = itertools.count()
        self._jobs = set()

    def _submit(self, function, *arguments):
        self._jobs.add(self._pool.submit(function, *arguments))

    def run(self, sources):
        kinds = {}
        for source in sources:
            kinds.setdefault(source.kind, []).append(source)
        for members in kinds.values():
            count = -(-len(members) // MAX_BUNDLE)
            for part in range(count):
                self._submit(self._look_at, members[part::count], False)
        while self._jobs:
            done, self._jobs = wait(self._jobs, return_when=FIRST_COMPLETED)
            for job in done:
                for function, *arguments in job.result():
                    self._submit(function, *arguments)

    def _look_at(self, sources, compiles):
        """Further calls to make."""
        if len(sources) == 1:
            source = sources[0]
            source.complaint += tidy(source) + query("-p", BUILD, source.full_path)
            self._progress(sources)
            return []
        bundle = Bundle(self._folder, next(self._numbers), sources)
        misfits = [] if compiles else bundle.find_misfits()
        if misfits:
            others = [source for source in sources if source not in misfits] or [misfits.pop(0)]
            return [(self._look_at, part, False) for part in (others, misfits) if part]
        if not bundle.is_clean():
            half = len(sources) // 2
            return [(self._look_at, sources[:half], True), (self._look_at, sources[half:], True)]
        self._progress(sources)
        return []


def select(arguments):
    with open(os.path.join(BUILD, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    wanted = {os.path.relpath(path, ROOT) for path in arguments.files}
    commands = {}
    for entry in entries:
        path = os.path.relpath(os.path.join(entry["directory"], entry["file"]), ROOT)
        # C has other names and idioms, and no rules of ours; its compiler's warnings are errors.
        if path.endswith(".c") or path.startswith(("..", "build/")) or (wanted and path not in wanted):
            continue
        commands.setdefault(path, entry["command"])
    unknown = wanted - set(commands)
    if not wanted:
        unknown = {path for path in list_files(ROOT) if path.endswith(".cpp") and not path.startswith(ELSEWHERE)}
        unknown -= set(commands)
    if unknown:
        print("not compiled by a target of preset tidy, so not checked: " + ", ".join(sorted(unknown)))
    fingerprints = Fingerprints()
    analyzed = ANALYZED_DEEP if arguments.deep else ANALYZED
    depth = () if arguments.deep else SHALLOW
    chosen = []
    for path, command in sorted(commands.items()):
        source = Source(path, command, os.path.join(CACHE, fingerprints.make(path, command)),
                        path.startswith(analyzed), depth)
        if arguments.all or arguments.deep or not os.path.exists(source.stamp):
            chosen.append(source)
    return chosen, len(commands), bool(unknown)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--deep", action="store_true", help="the static analyzer also over programs and examples")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    os.makedirs(CACHE, exist_ok=True)
    chosen, total, orphans = select(arguments)
    print(f"{len(chosen)} of {total} sources to check", flush=True)
    begin = time.monotonic()
    made = itertools.count(1)
    lock = threading.Lock()

    def progress(sources):
        with lock:
            for source in sources:
                if source.complaint:
                    print(f"FAILED {source.path}\n{source.complaint}", flush=True)
                else:
                    with open(source.stamp, "w", encoding="utf-8") as file:
                        file.write(source.path + "\n")
                print(f"[{next(made)}/{len(chosen)} {time.monotonic() - begin:.0f}s] {source.path}", flush=True)

    with tempfile.TemporaryDirectory(prefix="lint-", dir=BUILD) as folder:
        with ThreadPoolExecutor(max_workers=arguments.jobs) as pool:
            Linter(pool, folder, progress).run(chosen)
    failed = [source for source in chosen if source.complaint]
    if failed:
        print("failed: " + " ".join(source.path for source in failed))
    return 1 if failed or orphans else 0


if __name__ == "__main__":
    sys.exit(main())
