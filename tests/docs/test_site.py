#!/usr/bin/env python3
"""Runs scripts/site --check on small trees: a right one passes, and each planted violation is reported with its file and line."""

import os
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COPIED = ("scripts/lib.sh", "scripts/setup", "scripts/site", "scripts/site_links.py", "scripts/source_tree.py",
          "scripts/translations.py", "libacs-core/include/acs/core/Version.hpp")

RIGHT = {
    "README.md": "# SDK\n\n[한국어](README.ko.md)\n\n<!-- run -->\n```\ntrue\n```\n\n[Guide](docs/guide/guide.md#the-first-step), "
                 "[source](docs/guide/source.cpp), [elsewhere](https://example.org/a?b=c#d), [documents](docs/README.md)\n",
    "README.ko.md": "# SDK\n\n[English](README.md), [안내](docs/guide/ko/guide.md#첫-단계), [같은 쪽](#sdk)\n",
    "docs/README.md": "# Documents\n\n| Guide | |\n|---|---|\n| [Guide](guide/guide.md) ([한국어](guide/ko/guide.md)) | the guide |\n"
                      "| [Runbook](runbook/README.md) | the runbook |\n",
    "docs/guide/guide.md": "# Guide\n\n## The first step\n\n[Start](../../README.md#sdk), [this](#the-first-step)\n\n"
                           "![Picture](pictures/one.svg)\n",
    "docs/guide/ko/guide.md": "# 안내\n\n## 첫 단계\n\n[위](#첫-단계)\n",
    "docs/guide/source.cpp": "int one;\n",
    "docs/guide/pictures/one.svg": '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>\n',
    "docs/runbook/ko/README.md": "# 런북\n",
    "docs/runbook/en/ACS-1001.md": "# An alarm\n",
    "docs/runbook/ko/ACS-1001.md": "# 알람\n",
    "docs/runbook/README.md": "# Runbook\n",
    "tests/fixtures/README.md": "# Not a page [a](missing.md)\n",
}

# file, content, begin of the report, what the report contains; Sphinx reads all of these in one run
UNREADABLE = (
    ("docs/guide/ko/a.md", "# A\n\n[a](missing.md)\n", "docs/guide/ko/a.md:3", "missing.md"),
    ("docs/guide/ko/b.md", "# B\n\n[b](../guide.md#no-heading)\n", "docs/guide/ko/b.md:3", "guide.md#no-heading"),
    ("docs/guide/ko/c.md", "# C\n\n[c](#없는-제목)\n", "docs/guide/ko/c.md:3", "#없는-제목"),
    ("docs/guide/ko/d.md", "# D\n\n![d](pictures/none.png)\n", "docs/guide/ko/d.md", "none.png"),
    ("docs/guide/ko/e.md", "# E\n\n[e](source.cpp)\n", "docs/guide/ko/e.md:3", "source.cpp"),
    ("docs/guide/orphan.md", "# In no list\n", "docs/guide/orphan.md", "isn't included in any toctree"),
    ("docs/guide/ko/f.md", "# F\n\n### Of a level too deep\n", "docs/guide/ko/f.md:3", "H1 to H3"),
)
# What only the built pages show.
BROKEN = (
    ("docs/guide/ko/g.md", '# G\n\n<a href="none.html">g</a>\n', "none.html", "does not exist"),
    ("docs/guide/ko/h.md", '# H\n\n<a href="guide.html#none">h</a>\n', "guide.html#none", "no anchor #none"),
    ("docs/guide/ko/i.md", "# I\n\n[i](https://example)\n", "https://example", "not a well-formed address"),
    ("docs/guide/ko/j.md", "# J\n\n[j](http://)\n", "http://", "not a well-formed address"),
    ("docs/guide/ko/k.md", "# K\n\n![k](https://example.org/k.png)\n", "https://example.org/k.png", "loaded from another site"),
    ("docs/guide/ko/l.md", '# L\n\n<a href="../../../../../l.html">l</a>\n', "../../../../../l.html", "out of the site"),
)


# page, what it contains: the same anchors as on GitHub, the language, a link to the translation unless the page has one
SHOWN = {
    "README.html": ('<html class="no-js" lang="en">', 'href="docs/guide/guide.html#the-first-step"'),
    "docs/guide/ko/guide.html": ('lang="ko"', 'href="../guide.html" hreflang="en"', 'id="첫-단계"'),
    "docs/runbook/en/ACS-1001.html": ('href="../ko/ACS-1001.html" hreflang="ko" lang="ko">한국어</a>',),
    "index.html": ("url=README.html",),
}


def make_tree(root, files):
    for path in COPIED:
        os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
        shutil.copy(os.path.join(ROOT, path), os.path.join(root, path))
    shutil.copytree(os.path.join(ROOT, "docs/site"), os.path.join(root, "docs/site"))
    for path, text in files.items():
        os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
        with open(os.path.join(root, path), "w", encoding="utf-8") as file:
            file.write(text)


def build(root):
    """The exit code of scripts/site --check, its errors, and the text of SHOWN."""
    command = [os.path.join(root, "scripts/site"), "--check"]
    ran = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, text=True)
    pages = {}
    for name in SHOWN:
        place = os.path.join(root, "build/site/html", name)
        if os.path.exists(place):
            with open(place, encoding="utf-8") as file:
                pages[name] = file.read()
    return ran.returncode, ran.stderr, pages


def run(files):
    with tempfile.TemporaryDirectory() as root:
        make_tree(root, files)
        return build(root)


def check_killed():
    """A build that is killed does not prevent the next one, and leaves the site that was there."""
    with tempfile.TemporaryDirectory() as root:
        make_tree(root, RIGHT)
        settings = os.path.join(root, "docs/site/conf.py")
        with open(settings, encoding="utf-8") as file:
            right = file.read()
        killed = right + "\nimport signal\nos.kill(os.getpid(), signal.SIGKILL)\n"
        found = []
        for text in (killed, right, killed):
            with open(settings, "w", encoding="utf-8") as file:
                file.write(text)
            code, _, pages = build(root)
            found.append((code, len(pages)))
        return found


def main():
    faults = []
    code, errors, pages = run(RIGHT)
    if code != 0:
        faults.append(f"a right tree fails:\n{errors}")
    for page, texts in SHOWN.items():
        faults += [f"{page} does not contain {text}" for text in texts if text not in pages.get(page, "")]
    if "translation" in pages.get("README.html", ""):
        faults.append("README.html has two links to its translation")
    code, errors, _ = run(RIGHT | {path: text for path, text, _, _ in UNREADABLE})
    if code != 1:
        faults.append(f"the exit code is {code} for a tree with warnings, not 1")
    for path, _, begin, reason in UNREADABLE:
        if not any(line.startswith(begin) and reason in line for line in errors.splitlines()):
            faults.append(f"{path} is not reported as '{begin} ... {reason}' but:\n{errors}")
    code, errors, _ = run(RIGHT | {path: text for path, text, _, _ in BROKEN})
    if code != 1:
        faults.append(f"the exit code is {code} for a tree with broken links, not 1")
    for path, _, target, reason in BROKEN:
        page = path.replace(".md", ".html")
        if not any(line.startswith(f"{page}:") and f"'{target}'" in line and reason in line for line in errors.splitlines()):
            faults.append(f"{page} is not reported with '{target}' and '{reason}' but:\n{errors}")
    if (found := check_killed()) != [(1, 0), (0, len(SHOWN)), (1, len(SHOWN))]:
        faults.append(f"exit codes and pages of a killed build, the next one and another killed one: {found}")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
