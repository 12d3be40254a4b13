#!/usr/bin/env python3
"""Which page translates which, and which version of it. The first line of a translation names its original and the version that it
translates, as git's id of that content, so that neither the time of a file nor the history of a clone matters."""

import argparse
import hashlib
import os
import re
import subprocess
import sys

from source_tree import list_files, read_text

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MARK = re.compile(r"<!-- Translation of (\S+), version ([0-9a-f]{40}) -->")


def get_language(path):
    return "ko" if "/ko/" in path or re.search(r"\.ko(?:\.md)?$", path) else "en"


def name_original(path, files):
    """README.ko.md: README.md; docs/runbook/ko/X.md: docs/runbook/en/X.md or docs/runbook/X.md."""
    if path.endswith(".ko.md"):
        return path[:-len(".ko.md")] + ".md"
    in_english = path.replace("/ko/", "/en/")
    return in_english if in_english in files else path.replace("/ko/", "/")


def find_translations(files):
    """{translation: original} of the documents among these files."""
    files = set(files)
    return {path: name_original(path, files) for path in sorted(files) if path.endswith(".md") and get_language(path) == "ko"}


def make_version(text):
    """What git hash-object prints for the file."""
    content = text.replace("\r\n", "\n").encode()
    return hashlib.sha1(b"blob %d\0" % len(content) + content, usedforsecurity=False).hexdigest()


def make_mark(original, text):
    return f"<!-- Translation of {original}, version {make_version(text)} -->"


def show_changes(original, old):
    """What the translation lacks."""
    command = ["git", "-C", ROOT, "--no-pager", "diff", "--word-diff", old, original]
    ran = subprocess.run(command, stderr=subprocess.DEVNULL, check=False)
    if ran.returncode != 0:
        print(f"this clone does not have the version of {original} that was translated: compare both pages from begin to end")


def main():
    parser = argparse.ArgumentParser(
        description="Lists the translations of documents. With files: shows what has changed in their originals since they were "
        "translated.")
    parser.add_argument("--done", action="store_true",
                        help="writes into the first line of each file that it translates the original as it is now")
    parser.add_argument("files", nargs="*", help="translations, such as README.ko.md")
    arguments = parser.parse_args()
    translations = find_translations(list_files(ROOT))
    if arguments.done and not arguments.files:
        parser.error("--done needs the translations that are up to date")
    for path in [os.path.relpath(path, ROOT) for path in arguments.files] or translations:
        if path not in translations:
            parser.error(f"{path} is not a translation")
        original = translations[path]
        text = read_text(ROOT, path)
        mark = MARK.match(text)
        present = make_mark(original, read_text(ROOT, original))
        if not arguments.files:
            state = "current" if mark and mark.group(0) == present else "OUTDATED"
            print(f"{state:8} {path} of {original}")
        elif arguments.done:
            with open(os.path.join(ROOT, path), "w", encoding="utf-8", newline="") as file:
                file.write(MARK.sub(present, text, count=1) if mark else f"{present}\n{text}")
        elif mark and mark.group(0) != present:
            show_changes(original, mark.group(2))
    return 0


if __name__ == "__main__":
    sys.exit(main())
