#!/usr/bin/env python3
"""Korean pages translate the English page as it is today: each names the version of its original (scripts/translations.py), and has
the same headings, tables, code and names."""

import os
import re
import sys

from source_tree import list_files, read_text, run_check
from translations import MARK, find_translations, make_version

# Pages that must have a translation.
REQUIRED = re.compile(r"README\.md|docs/guide/get-started\.md|docs/reference/(?:configuration|alarms)\.md|"
                      r"docs/runbook/(?:README|en/[^/]+)\.md")
FENCE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
SPAN = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)#\s]+\.md)(?:#[^)\s]*)?\)")
HANGUL = re.compile(r"[\uac00-\ud7a3]")


def check_version(root, path, original, files):
    mark = MARK.match(read_text(root, path))
    if original not in files:
        yield f"{original}, which this page would translate, does not exist; remove the page or correct its name"
    elif mark is None:
        yield (f"names no version of its original; compare it with {original}, then run "
               f"'scripts/translations.py --done {path}', which writes the first line")
    elif mark.group(1) != original:
        yield f"the first line names {mark.group(1)} as the original, which is {original}; correct it"
    elif mark.group(2) != make_version(read_text(root, original)):
        yield (f"{original} has changed since it was translated here; 'scripts/translations.py {path}' shows what, "
               f"translate it, then run 'scripts/translations.py --done {path}'")


def count_headings(text):
    return [len(line) - len(line.lstrip("#")) for line in text.splitlines() if re.match(r"#+ ", line)]


def check_structure(path, text, original, english):
    if not HANGUL.search(text):
        yield "has no Korean"
    if FENCE.findall(text) != FENCE.findall(english):
        yield f"its code blocks differ from those of {original}; code is not translated"
    text, english = FENCE.sub("", text), FENCE.sub("", english)
    if count_headings(text) != count_headings(english):
        yield f"its headings are not those of {original}, in number or level"
    if len(re.findall(r"^\|", text, re.MULTILINE)) != len(re.findall(r"^\|", english, re.MULTILINE)):
        yield f"its tables have not as many rows as those of {original}"
    spans = set(SPAN.findall(text)) ^ set(SPAN.findall(english))
    if spans:
        yield f"it differs from {original} in {', '.join(f'`{span}`' for span in sorted(spans))}; names are not translated"


def check_links(path, text, original, translations):
    """A reader of Korean stays with Korean pages, but for the link to the original."""
    korean = {english: page for page, english in translations.items()}
    for link in LINK.findall(FENCE.sub("", text)):
        target = os.path.normpath(os.path.join(os.path.dirname(path), link))
        if target != original and target in korean:
            yield f"links to {target}; link to its translation {korean[target]}"


def check_tree(root):
    files = set(list_files(root))
    translations = find_translations(files)
    for path, original in translations.items():
        reasons = list(check_version(root, path, original, files))
        if not reasons:
            text = read_text(root, path)
            reasons = [*check_structure(path, text, original, read_text(root, original)), *check_links(path, text, original, translations)]
        for reason in reasons:
            yield f"{path}:1: {reason}"
    for original in sorted(files - set(translations.values())):
        if REQUIRED.fullmatch(original):
            yield f"{original}:1: has no translation to Korean"


if __name__ == "__main__":
    sys.exit(run_check("Checks that Korean pages translate today's English pages", check_tree))
