#!/usr/bin/env python3
"""House rules about files: names, one class per file, line ends, links of documents, and nothing left over."""

import os
import re
import sys

from source_tree import list_files, read_text, run_check, strip_comments_and_strings

BINARY = (".png", ".ico", ".gz", ".db", ".bin", ".woff2")
PASCAL_NAME = re.compile(r"[A-Z][A-Za-z0-9]*(\.[A-Z][A-Za-z0-9]*)?")
# Names that their place fixes.
FREE_NAMES = (
    re.compile(r"(^|/)main\.cpp$"),
    re.compile(r"^examples/([^/]+/)*e[0-9]{2}_[a-z0-9_]+\.cpp$"),
    re.compile(r"^tests/install/consumer_[A-Za-z0-9]+\.cpp$"),
    re.compile(r"^tests/unit/compile_fail/"),
)
# The C interface and its tests.
C_FOLDERS = ("libacs-protocol/c/include/", "tests/unit/protocol-c/")
# What one reads first: e09 and later are whole programs.
FIRST_EXAMPLE = re.compile(r"^examples/e0[1-8]_[a-z0-9_]+\.cpp$")
FIRST_EXAMPLE_LINES = 150
# Written in two pieces so that this file does not find itself.
UNFINISHED = re.compile(r"\b(?:" + "|".join(("TO" "DO", "FIX" "ME", "X" "XX", "HA" "CK", "W" "IP")) + r")\b"
                        + "|filled in by its " + "own change")
MACHINE_PATH = re.compile(r"(?<![\w.$})/~-])/(?:work|home|root|Users)/\w" + r"|/tm" + r"p/(?:w|h)/")
TYPE = re.compile(r"^(?:template\s*<.*>\s*)?(class|struct|union|enum\s+class|enum|concept|using)\s+"
                  r"(?:ACS_[A-Z]+\s+|\[\[[^\]]*\]\]\s*)?(?:alignas\([^)]*\)\s*)?([A-Za-z_]\w*)(?!\w)(?!\s*::)(?!\w*;)")


# A fenced or inline piece of a document that is code; a link to a file or a heading, not to another site.
DOCUMENT_CODE = re.compile(r"^```.*?^```|`[^`\n]+`", re.DOTALL | re.MULTILINE)
LINK = re.compile(r"\]\((?![a-z]+:)([^)#\s]*)(?:#([^)\s]+))?\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)


def list_anchors(text):
    """The anchors that headings get: lower case, words joined by hyphens, no other signs."""
    without_code = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.strip().lower()).replace(" ", "-") for heading in HEADING.findall(without_code)}


def check_links(root, path, text):
    prose = DOCUMENT_CODE.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)
    for match in LINK.finditer(prose):
        target = os.path.normpath(os.path.join(os.path.dirname(path), match.group(1))) if match.group(1) else path
        line = prose.count("\n", 0, match.start()) + 1
        if not os.path.exists(os.path.join(root, target)):
            yield line, f"a link to {target}, which does not exist"
        elif match.group(2) and target.endswith(".md") and match.group(2) not in list_anchors(read_text(root, target)):
            yield line, f"a link to the heading #{match.group(2)}, which {target} does not have"


def list_types(code):
    """(line, kind, name) of the types that a header defines at namespace scope, nested namespaces Detail left out.
    The house format puts them at column 0."""
    found = []
    detail_depth = None
    depth = 0
    for number, line in enumerate(code.splitlines(), 1):
        namespace = re.match(r"namespace\s+([\w:]+)", line)
        if namespace and namespace.group(1).split("::")[-1] == "Detail":
            detail_depth = detail_depth if detail_depth is not None else depth
        match = TYPE.match(line)
        if detail_depth is None and match and not re.match(r"^[^{=]*;\s*$", line):
            if "namespace" not in line:
                found.append((number, match.group(1), match.group(2)))
        depth += line.count("{") - line.count("}")
        if detail_depth is not None and "}" in line and depth <= detail_depth:
            detail_depth = None
    return found


# A header of functions or tables may declare the struct that they use: it is named for what they do.
FREE_DECLARATION = re.compile(r"^(\[\[nodiscard\]\]|inline|constexpr)\s", re.MULTILINE)


def is_interface(name):
    return re.match(r"I[A-Z][a-z]", name) is not None


def check_header(path, text):
    if not re.search(r"^#pragma once$", text, re.MULTILINE):
        yield 1, "a header needs #pragma once"
    stem = os.path.basename(path).split(".")[0]
    types = list_types(strip_comments_and_strings(text))
    names = [name for _, _, name in types]
    classes = [(line, name) for line, kind, name in types if kind == "class" and not is_interface(name)]
    # Specialisations count: a header full of them is a family, not one class.
    defined = [name for _, kind, name in types if kind not in ("using", "concept")]
    if classes and stem not in names:
        yield classes[0][0], f"class {classes[0][1]} is in a file of another name; rename it to {classes[0][1]}.hpp"
    elif (len(defined) == 1 and stem not in names and stem not in text.split("#pragma once", 1)[-1]
          and not FREE_DECLARATION.search(text)):
        yield 1, f"the file declares {defined[0]} only; call it {defined[0]}.hpp"
    for line, name in classes:
        if name != stem and stem in names:
            yield line, (f"a second class, {name}, beside {stem}; give it a file of its own "
                         "(only interfaces, enums and small structs may share a file)")


def check_cpp_name(path, text):
    if any(pattern.search(path) for pattern in FREE_NAMES):
        return
    name = os.path.basename(path)
    if not PASCAL_NAME.fullmatch(name.rsplit(".", 1)[0]):
        yield 1, f"{name}: a source is called after its class, in PascalCase (Human.cpp, Human.Head.cpp)"
    if path.startswith("tests/") and path.endswith(".cpp") and re.search(r"^(TEST_CASE|SCENARIO|TEMPLATE_TEST_CASE)\(",
                                                                         text, re.MULTILINE):
        if not name.endswith("Test.cpp"):
            yield 1, f"{name} holds test cases; its name ends in Test.cpp"


def check_file(root, path):
    if path.endswith(BINARY):
        return
    text = read_text(root, path)
    if path.startswith(("tests/fixtures/", "tests/fuzz/corpus/")):
        return
    if "\r" in text:
        yield text[:text.index("\r")].count("\n") + 1, "a carriage return; lines end in LF alone"
    if text and not text.endswith("\n"):
        yield text.count("\n") + 1, "the last line has no end"
    for line, content in enumerate(text.splitlines(), 1):
        mark = UNFINISHED.search(content)
        if mark:
            yield line, f"unfinished mark '{mark.group(0)}'; finish it or open an issue"
        place = MACHINE_PATH.search(content)
        if place:
            yield line, "a path of one machine; use a path relative to the repository"
    if path.endswith(".md"):
        yield from check_links(root, path, text)
    if FIRST_EXAMPLE.match(path) and text.count("\n") >= FIRST_EXAMPLE_LINES:
        yield FIRST_EXAMPLE_LINES, f"the first examples have under {FIRST_EXAMPLE_LINES} lines each; this has {text.count(chr(10))}"
    if path.endswith((".hpp", ".cpp")) and not path.startswith("tests/style/bad/"):
        yield from check_cpp_name(path, text)
    if path.endswith(".hpp") and not path.startswith("tests/style/bad/"):
        yield from check_header(path, text)
    if path.endswith((".h", ".cc", ".cxx", ".hh", ".ipp", ".inl")) and not path.startswith(C_FOLDERS):
        yield 1, "C++ files end in .hpp or .cpp"


def check_tree(root):
    for path in list_files(root):
        for line, reason in check_file(root, path):
            yield f"{path}:{line}: {reason}"


if __name__ == "__main__":
    sys.exit(run_check("Checks names and contents of files", check_tree))
