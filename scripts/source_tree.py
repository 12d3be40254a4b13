"""What the checks share: which files the tree has, and a C++ file without comments and strings."""

import argparse
import os
import re
import subprocess

CPP_SUFFIXES = (".hpp", ".cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
COMMENT_OR_STRING = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^\s()\\]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)


def list_files(root):
    """Paths relative to root, sorted: what git tracks or would track; without git, every file but build folders."""
    if os.path.exists(os.path.join(root, ".git")):
        command = ["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout.decode().split("\0")
        return sorted({name for name in names if name and os.path.isfile(os.path.join(root, name))})
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in ("build", ".git", "__pycache__")]
        found += [os.path.relpath(os.path.join(folder, name), root) for name in names]
    return sorted(found)


def read_text(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace", newline="") as file:
        return file.read()


def _blank(match):
    text = match.group(0)
    if text.startswith("'") and match.start() > 0 and match.string[match.start() - 1].isalnum():
        return text  # a digit separator, 1'000'000
    return re.sub(r"[^\n]", " ", text)


def strip_comments_and_strings(text):
    """The same text with comments and literals blanked: lines and columns stay where they were."""
    return COMMENT_OR_STRING.sub(_blank, text)


def list_includes(text):
    """(line number, bQuoted, name) of every #include."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            found.append((number, match.group(1) == '"', match.group(2)))
    return found


class IncludeResolver:
    """Finds the file of this tree that an #include means, or None if it is a foreign header."""

    def __init__(self, files):
        self._files = set(files)
        self._by_name = {}
        for path in files:
            self._by_name.setdefault(os.path.basename(path), []).append(path)

    def find(self, includer, quoted, name):
        if quoted:
            beside = os.path.normpath(os.path.join(os.path.dirname(includer), name))
            if beside in self._files:
                return beside
        name = os.path.normpath(name)
        candidates = [path for path in self._by_name.get(os.path.basename(name), ())
                      if path == name or path.endswith("/" + name)]
        if not quoted:
            candidates = [path for path in candidates if name.startswith("acs/")]
        # The nearest one: the longest common folder with the includer.
        return max(candidates, key=lambda path: len(os.path.commonprefix([path, includer])), default=None)


def run_check(description, check_tree):
    """The program of a check: prints each violation, one per line. The exit code is 1 if there is one."""
    parser = argparse.ArgumentParser(description=f"{description}; silent when all is well.")
    parser.add_argument("--root", default=os.path.dirname(os.path.dirname(os.path.abspath(__file__))),
                        help="the tree to check (default: this one)")
    violations = list(check_tree(parser.parse_args().root))
    for violation in violations:
        print(violation)
    return 1 if violations else 0
