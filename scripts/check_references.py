#!/usr/bin/env python3
"""The reference documents list what the sources define: each alarm code and each metric of acsd, and no other."""

import os
import re
import sys

from source_tree import list_files, read_text, run_check

SOURCES = ("libplan/src/", "apps/acsd/")
# document, what sources define as a literal, what the first cells of its tables list
REFERENCES = (
    ("docs/reference/alarms.md", re.compile(r'"(ACS-[0-9]{4}|ARM-[A-Za-z]+)"'), re.compile(r"`((?:ACS|ARM)-[A-Za-z0-9]+)`")),
    ("docs/reference/metrics.md", re.compile(r'"((?:acsd|process)_[a-z_]+)"'),
     re.compile(r"`((?:acsd|process)_[a-z_]+)(?:\{[a-z,]+\})?`")),
)


def find_lines(pattern, text):
    """{name: number of its first line}"""
    found = {}
    for number, line in enumerate(text.splitlines(), 1):
        for name in pattern.findall(line):
            found.setdefault(name, number)
    return found


def check_tree(root):
    files = list_files(root)
    sources = {path: read_text(root, path) for path in files if path.startswith(SOURCES) and path.endswith((".hpp", ".cpp"))}
    for document, literal, cell in REFERENCES:
        text = read_text(root, document) if document in files else ""
        # The first cell of each row of a table.
        cells = "\n".join(line.split("|")[1] if line.startswith("|") else "" for line in text.splitlines())
        listed = find_lines(cell, cells)
        defined = {}
        for path, source in sources.items():
            for name, line in find_lines(literal, source).items():
                defined.setdefault(name, (path, line))
        for name in sorted(defined.keys() - listed.keys()):
            yield f"{defined[name][0]}:{defined[name][1]}: {name} is not listed in {document}"
        for name in sorted(listed.keys() - defined.keys()):
            yield f"{document}:{listed[name]}: {name} is not defined in {' or '.join(SOURCES)}"


if __name__ == "__main__":
    sys.exit(run_check("Compares reference documents with the sources", check_tree))
