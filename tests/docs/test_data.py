#!/usr/bin/env python3
"""Code blocks of the documents that are marked as JSON or TOML are valid. First it requires that bad ones are reported."""

import json
import os
import re
import sys
import tomllib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
from source_tree import list_files, read_text  # noqa: E402

BLOCK = re.compile(r"^```(json|toml)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
READ = {"json": json.loads, "toml": tomllib.loads}


def check_page(path, text):
    for match in BLOCK.finditer(text):
        try:
            READ[match.group(1)](match.group(2))
        except ValueError as error:
            yield f"{path}:{text.count(chr(10), 0, match.start()) + 1}: this block is not valid {match.group(1)}: {error}"


def main():
    faults = []
    for name, right, wrong in (("json", '{"one": 1}', '{"one": 1,}'), ("toml", 'one = "1"', "one = 1s")):
        for content, expected in ((right, 0), (wrong, 1)):
            found = list(check_page("page.md", f"# A\n\n```{name}\n{content}\n```\n"))
            if len(found) != expected or not all(fault.startswith("page.md:3: ") for fault in found):
                faults.append(f"self-check: {expected} errors must be reported of {content}, not {found}")
    pages = [path for path in list_files(ROOT) if path.endswith(".md")]
    faults += [fault for path in pages for fault in check_page(path, read_text(ROOT, path))]
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
