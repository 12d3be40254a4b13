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
# So few are also compiled alone: in a bundle, or in a unity build, a source could use what another one declares or includes.
MAX_COMPILED_ALONE = 64
# Where the static analyzer looks: at what others link and, if asked, at the programs.
ANALYZED = ("lib",)
ANALYZED_DEEP = ("lib", "apps/", "examples/")
WITHOUT_ANALYZER = "-clang-analyzer-*"
ONLY_ANALYZER = "-*,clang-analyzer-*,-clang-analyzer-optin.cplusplus.VirtualCall"
# Its full depth, which follows calls, takes nine times as long.
SHALLOW = ("-Xclang", "-analyzer-config", "-Xclang", "mode=shallow")
# What may differ between sources that are checked together: folders, macros and the kind of code that is generated.
FOLDER_OPTIONS = ("-I", "-isystem")
CODE_OPTION = re.compile(r"-fPIC|-fPIE|-fvisibility.*|-O\d")
# What a program has once gets another name in a bundle, unless clang-tidy has a check for that name: whether an exception may
# escape from main.
ENTRY_POINT = re.compile(r'^int (main)\(|^extern "C" int (LLVMFuzzerTestOneInput)\(', re.MULTILINE)
CHECKED_MAIN = re.compile(r"^int main\((?!.*NOLINT)", re.MULTILINE)
QUOTED_INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
FAULTY_FILE = re.compile(r"^(.+?):\d+:\d+: (?:fatal )?error: ", re.MULTILINE)
COMPLAINT = re.compile(r"^(.+?):\d+:\d+: (?:fatal )?(?:error|warning): .*$", re.MULTILINE)
# What is included counts as a header in a bundle.
FALSE_COMPLAINT = re.compile(r"\.cpp:.*\[google-global-names-in-headers\b")
# What changes no answer.
COMMENT = re.compile(r"^[ \t]*//(?!.*NOLINT).*\n|[ \t]*///<(?!.*NOLINT).*", re.MULTILINE)
BREACH = re.compile(r"^(.+?):(\d+:\d+): note: \"root\" binds here\n(.*)$", re.MULTILINE)
BROKEN_QUERY = re.compile(r"Error (?:parsing|building)|Matcher not found|Invalid token|unknown command", re.IGNORECASE)


class Fingerprints:
    def __init__(self):
        files = list_files(ROOT)
        self._resolver = IncludeResolver([path for path in files if path.endswith(CPP_SUFFIXES)])
        self._rules = {os.path.dirname(path): read_text(ROOT, path) for path in files if os.path.basename(path) == ".clang-tidy"}
        self._queries = read_text(ROOT, QUERIES)
        self._includes = {}

    def _get_includes(self, path):
        if path not in self._includes:
            found = [self._resolver.find(path, quoted, name)
                     for _, quoted, name in list_includes(read_text(ROOT, path))]
            self._includes[path] = [target for target in found if target is not None]
        return self._includes[path]

    def _get_rules(self, path):
        """Of the folders above, too."""
        return "\0".join([self._queries, *(rules for folder, rules in sorted(self._rules.items())
                                           if not folder or path.startswith(folder + "/"))])

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
        digest = hashlib.sha256((self._get_rules(path) + "\0" + words).encode())
        for name in sorted(seen):
            digest.update((name + "\0" + COMMENT.sub("", read_text(ROOT, name))).encode())
        return digest.hexdigest()


def run(*command):
    done = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace")
    return done.returncode, done.stdout


class Source:
    def __init__(self, path, command, stamp, is_analyzed, is_deep, is_compiled_alone):
        self.path = path
        self.full_path = os.path.join(ROOT, path)
        self.stamp = stamp
        self.complaint = ""
        self.is_analyzed = is_analyzed
        self.is_compiled_alone = is_compiled_alone
        self.depth = () if is_deep else SHALLOW
        self.folders = []
        self.macros = {}
        text = read_text(ROOT, path)
        self.has_checked_main = bool(CHECKED_MAIN.search(text))
        self.entry_points = [] if self.has_checked_main else [name for match in ENTRY_POINT.findall(text) for name in match if name]
        words = shlex.split(command)[1:]
        out = words.index("-o")
        del words[out:out + 2]
        #: All other arguments of the compiler except the names of files.
        self.arguments = []
        words = iter(word for word in words if word != "-c" and os.path.join(ROOT, word) != self.full_path)
        for word in words:
            option = next((option for option in FOLDER_OPTIONS if word.startswith(option)), None)
            if option is not None:
                self.folders.append((option, word.removeprefix(option) or next(words)))
            elif word.startswith("-D"):
                name, sign, value = word.removeprefix("-D").partition("=")
                self.macros[name] = sign + value
            elif not CODE_OPTION.fullmatch(word):
                self.arguments.append(word)
        #: What must be equal for two sources to be checked together: the checks, the arguments and the rules.
        self.kind = (is_analyzed, *self.arguments,
                     *(folder for folder in self.get_folders() if os.path.exists(os.path.join(ROOT, folder, ".clang-tidy"))))

    def compiles_alone(self):
        code, _ = run("clang++-14", "-fsyntax-only", "-w", *self.arguments, *get_options([self]), self.full_path)
        return code == 0

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


def get_options(sources):
    """Their folders and macros, as arguments of the compiler."""
    folders = dict.fromkeys(option + folder for source in sources for option, folder in source.folders)
    macros = dict.fromkeys(macro for source in sources for macro in source.macros.items())
    return *folders, *(f"-D{name}{value}" for name, value in macros)


class HeaderNames:
    """The names by which the headers of a folder are included. A folder that has a name of another one could hide it."""

    def __init__(self):
        self._names = {}

    def _get(self, folder):
        if folder not in self._names:
            walk = os.walk(folder) if folder.startswith(ROOT) else ()
            self._names[folder] = {os.path.relpath(os.path.join(place, name), folder)
                                   for place, _, names in walk for name in names if name.endswith(".hpp")}
        return self._names[folder]

    def is_disjoint(self, left, right):
        return left == right or self._get(left).isdisjoint(self._get(right))


class Pack:
    """Sources that can be checked together."""

    def __init__(self, names):
        self._names = names
        self._macros = {}
        self._folders = {}
        self._has_checked_main = False
        self.sources = []

    def try_add(self, source):
        if len(self.sources) == MAX_BUNDLE or (self._has_checked_main and source.has_checked_main):
            return False
        if any(self._macros.get(name, value) != value for name, value in source.macros.items()):
            return False
        if not all(self._names.is_disjoint(mine[1], other[1]) for mine in self._folders for other in source.folders):
            return False
        self._macros.update(source.macros)
        self._folders.update(dict.fromkeys(source.folders))
        self._has_checked_main = self._has_checked_main or source.has_checked_main
        self.sources.append(source)
        return True


def pack(sources):
    """First fit: in the order of the paths most sources are beside those of their own target."""
    names = HeaderNames()
    packs = {}
    for source in sources:
        candidates = packs.setdefault(source.kind, [])
        if not any(candidate.try_add(source) for candidate in candidates):
            candidates.append(Pack(names))
            candidates[-1].try_add(source)
    return [candidate.sources for candidates in packs.values() for candidate in candidates]


class Bundle:
    """One file that includes several sources of one kind, and one with their texts: most of the time goes into the headers that
    they share."""

    def __init__(self, folder, number, sources):
        self._sources = sources
        # What shadows a name of another source shadows nothing in its own.
        self._arguments = (*sources[0].arguments, *get_options(sources), "-Wno-shadow")
        # A place of the same depth: clang-tidy looks for rules in the folders above.
        place = os.path.join(folder, os.path.dirname(sources[0].path))
        os.makedirs(place, exist_ok=True)
        for level in sources[0].get_folders():
            rules = os.path.join(ROOT, level, ".clang-tidy")
            if os.path.exists(rules):
                shutil.copy(rules, os.path.join(folder, level))
        self._path = os.path.join(place, f"bundle{number}.cpp")
        with open(self._path, "w", encoding="utf-8") as file:
            for index, source in enumerate(sources):
                file.writelines(f"#define {name} EntryPoint{index} // NOLINT\n" for name in source.entry_points)
                file.write(f'#include "{source.full_path}" // NOLINT\n')
                file.writelines(f"#undef {name}\n" for name in source.entry_points)
        self._analyzed_path = os.path.join(place, f"text{number}.cpp")
        if sources[0].is_analyzed:  # The analyzer passes over what is included.
            with open(self._analyzed_path, "w", encoding="utf-8") as file:
                file.writelines(source.get_text() for source in sources)

    def check(self):
        """What passed, and the parts to check again: each source with a finding alone, and what does not compile behind or
        without the others separately from them."""
        misfits = [source for source in self._sources if source.is_compiled_alone and not source.compiles_alone()]
        if misfits:
            return [], self._separate(misfits)
        _, output = run_queries(self._path, "--", *self._arguments, "-ferror-limit=0")
        if FAULTY_FILE.search(output):
            return [], self._separate(self._find_named(FAULTY_FILE.findall(output)))
        if not has_run_queries(output):
            return [], self._separate([])
        suspects = {match[1] for match in BREACH.finditer(output)}
        code, output = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "--checks=" + WITHOUT_ANALYZER,
                           f"--header-filter=^{re.escape(ROOT)}/(lib|apps/|examples/|tests/)", self._path, "--",
                           *self._arguments, "-ferror-limit=0")
        suspects.update(find_complained(code, output))
        if self._sources[0].is_analyzed:
            code, output = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "--checks=" + ONLY_ANALYZER,
                               self._analyzed_path, "--", *self._arguments, *self._sources[0].depth)
            suspects.update(find_complained(code, output))
        suspected = self._find_named(suspects)
        if len(suspected) < len(suspects):  # A header, for one.
            return [], self._separate([])
        return [source for source in self._sources if source not in suspected], [[source] for source in suspected]

    def _find_named(self, paths):
        paths = set(paths)
        return [source for source in self._sources if source.full_path in paths]

    def _separate(self, misfits):
        """Without known misfits the first half is one part."""
        misfits = misfits or self._sources[:len(self._sources) // 2]
        if len(misfits) == len(self._sources):
            misfits = misfits[1:]
        return [misfits, [source for source in self._sources if source not in misfits]]


def find_complained(code, output):
    """The files of clang-tidy's findings; an empty name if it failed without any."""
    complaints = list(COMPLAINT.finditer(output))
    files = {match[1] for match in complaints if not FALSE_COMPLAINT.search(match[0])}
    return files if complaints or code == 0 else {""}


def run_queries(*arguments):
    return run("clang-query-14", "-f", QUERIES, *arguments)


def has_run_queries(output):
    is_broken = BROKEN_QUERY.search(output) or ": error: " in output
    return not is_broken and output.count(" matches.") + output.count(" match.") > 0


def query(*arguments):
    """What breaks a house rule."""
    _, output = run_queries(*arguments)
    complaint = "" if has_run_queries(output) else output
    for match in dict.fromkeys(BREACH.findall(output)):
        complaint += f"{match[0]}:{match[1]}: breaks a rule of {QUERIES}: {match[2].strip()}\n"
    return complaint


def tidy(source):
    code, output = run("clang-tidy-14", "--quiet", "--warnings-as-errors=*", "-p", BUILD,
                       "--checks=" + ("" if source.is_analyzed else WITHOUT_ANALYZER),
                       *("--extra-arg=" + word for word in source.depth), source.full_path)
    return output if code != 0 else ""


class Linter:
    """Checks bundles of sources, and what is not clean in one again, so that each finding is of a source that was checked
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
        for members in pack(sources):
            self._submit(self._look_at, members)
        while self._jobs:
            done, self._jobs = wait(self._jobs, return_when=FIRST_COMPLETED)
            for job in done:
                for part in job.result():
                    self._submit(self._look_at, part)

    def _look_at(self, sources):
        """The parts to check separately."""
        if len(sources) == 1:
            source = sources[0]
            source.complaint += tidy(source) + query("-p", BUILD, source.full_path)
            self._progress(sources)
            return []
        passed, parts = Bundle(self._folder, next(self._numbers), sources).check()
        self._progress(passed)
        return parts


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
    stamps = {path: os.path.join(CACHE, fingerprints.make(path, command)) for path, command in sorted(commands.items())}
    chosen = [path for path, stamp in stamps.items() if arguments.all or arguments.deep or not os.path.exists(stamp)]
    is_compiled_alone = arguments.deep or len(chosen) <= MAX_COMPILED_ALONE
    sources = [Source(path, commands[path], stamps[path], path.startswith(analyzed), arguments.deep, is_compiled_alone)
               for path in chosen]
    return sources, len(commands), bool(unknown)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--deep", action="store_true",
                        help="each source also compiled alone; the static analyzer at full depth, over programs and examples too")
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
