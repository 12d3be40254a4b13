#!/usr/bin/env python3
"""Whether every JSON example of sections 6.2 to 6.21 of the MCS-ACS document has its fixture, and every fixture its
example: equal except free texts. Exit code 1 and a line per error; 77 (skipped) where $ACS_SPEC_DIR does not
name a folder with the document."""

import json
import os
import pathlib
import re
import sys

FIXTURES = pathlib.Path(__file__).resolve().parent.parent.parent / "fixtures/acs"
FREE_TEXTS = ("message", "reason", "errorCode")
SKIPPED = 77


def find_document_or_none():
    folder = os.environ.get("ACS_SPEC_DIR")
    found = sorted(pathlib.Path(folder).glob("sources/mcs-acs-v1.4.1*.md")) if folder else []
    return found[0] if found else None


def list_examples(text):
    """Pairs of a line number and the value of each JSON example after section 6.1."""
    decoder = json.JSONDecoder()
    begin = text.index("### 6.2 ")
    for block in re.finditer(r"```json\n(.*?)```", text[begin:], re.DOTALL):
        body = re.sub(r"//.*", "", block.group(1))
        body = re.sub(r",(\s*[}\]])", r"\1", body).strip()
        line = text.count("\n", 0, begin + block.start()) + 1
        while body:
            value, end = decoder.raw_decode(body)
            yield line, value
            body = body[end:].strip()


def without_free_texts(value):
    if isinstance(value, dict):
        return {name: bool(inner) if name in FREE_TEXTS else without_free_texts(inner) for name, inner in value.items()}
    return [without_free_texts(inner) for inner in value] if isinstance(value, list) else value


def main():
    document = find_document_or_none()
    if document is None:
        print("skipped: ACS_SPEC_DIR does not name a folder with the document of MCS-ACS")
        return SKIPPED
    fixtures = {path.name: without_free_texts(json.loads(path.read_text(encoding="utf-8")))
                for path in sorted(FIXTURES.glob("*.json"))}
    used = set()
    errors = []
    count = 0
    for line, value in list_examples(document.read_text(encoding="utf-8")):
        count += 1
        names = [name for name, fixture in fixtures.items() if fixture == without_free_texts(value)]
        used.update(names)
        if not names:
            errors.append(f"the example in line {line} ({value.get('command')}) has no fixture")
    errors += [f"{name} is no example of the document" for name in fixtures if name not in used]
    print("\n".join(errors) if errors else f"{count} examples, all with a fixture")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
