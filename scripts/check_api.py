#!/usr/bin/env python3
"""Public headers mark with ACS_API what a source of the library defines: free functions, and classes with such a function or a
virtual one. Without it a shared library hides them. Nested implementation classes are ACS_HIDDEN."""

import re
import sys

from check_sizes import find_end, is_method
from source_tree import list_files, read_text, run_check, strip_comments_and_strings

PUBLIC_HEADER = re.compile(r"^(?:lib[\w-]+|apps/acsd)/(?:.*/)?include/(?!acs/(?:json|net)/).*\.hpp$")
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
LABEL = re.compile(r"\b(?:public|private|protected)\s*$")
TYPE = re.compile(r"\s*(?:class|struct)\s+(ACS_API\s+|ACS_HIDDEN\s+|)(\w+)\s*(?:final\b\s*)?(?::(?!:)|$)")
FORWARD = re.compile(r"\s*(?:class|struct)\s+(ACS_HIDDEN\s+|)(\w+)\s*$")
OTHER = re.compile(r"\s*(?:using|friend|static_assert|typedef|template|enum|namespace)\b")
DEFINED_HERE = re.compile(r"\b(?:inline|constexpr|consteval)\b|=\s*(?:default|delete|0)\s*$")
DEDUCTION_GUIDE = re.compile(r"\s*\w+\s*\([^()]*\)\s*->")


def list_statements(code, begin, end):
    """(begin, text, body) of each declaration between two places; body is None or the two places inside its braces."""
    start, parentheses, index = begin, 0, begin
    while index < end:
        letter = code[index]
        parentheses += (letter == "(") - (letter == ")")
        if letter == "{":
            closing = find_end(code, index)
            if parentheses == 0:
                yield start, code[start:index], (index + 1, closing - 1)
                start = closing
            index = closing
            continue
        if parentheses == 0 and letter == ";":
            yield start, code[start:index], None
            start = index + 1
        elif parentheses == 0 and letter == ":" and LABEL.search(code[start:index]):
            start = index + 1
        index += 1


def is_defined_elsewhere(text):
    return (is_method(re.sub(r"operator(?=\w)", "", text)) and not OTHER.match(text) and not DEFINED_HERE.search(text)
            and not DEDUCTION_GUIDE.match(text))


def check_class(code, body):
    """(needs ACS_API, [(place, name) of each nested class that a source defines and that is not hidden])."""
    needs, shown = False, []
    for place, text, inside in list_statements(code, *body):
        needs |= re.search(r"\b(?:virtual|override)\b", text) is not None
        forward = FORWARD.match(text)
        if forward and inside is None:
            if not forward.group(1) and not re.search(r"\b(?:class|struct)\s+(?:\w+::)*" + forward.group(2) + r"\b[^;{]*\{", code):
                shown.append((place, forward.group(2)))
        elif inside is not None and TYPE.match(text):
            nested, more = check_class(code, inside)
            needs |= nested
            shown += more
        elif inside is None:
            needs |= is_defined_elsewhere(text)
    return needs, shown


def check_scope(code, begin, end):
    """(place, problem) of the declarations of a namespace."""
    for place, text, inside in list_statements(code, begin, end):
        place += len(text) - len(text.lstrip())
        type_ = TYPE.match(text)
        if inside is not None and re.match(r"\s*namespace\b", text):
            yield from check_scope(code, *inside)
        elif inside is not None and type_:
            needs, shown = check_class(code, inside)
            if needs and not type_.group(1):
                yield place, f"{type_.group(2)} has functions that a source defines, or virtual ones: mark it with ACS_API"
            elif needs:
                for nested, name in shown:
                    nested += re.match(r"\s*", code[nested:]).end()
                    yield nested, f"a source defines {name}, which inherits ACS_API: mark it with ACS_HIDDEN"
        elif inside is None and "ACS_API" not in text:
            if re.match(r"\s*extern\s+template\b", text) or is_defined_elsewhere(text):
                yield place, "a source defines this function: mark it with ACS_API"


def check_tree(root):
    for path in (name for name in list_files(root) if PUBLIC_HEADER.match(name)):
        code = strip_comments_and_strings(read_text(root, path))
        code = DIRECTIVE.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), code)
        for place, problem in check_scope(code, 0, len(code)):
            yield f"{path}:{code.count(chr(10), 0, place) + 1}: {problem}"


if __name__ == "__main__":
    sys.exit(run_check("Checks what public headers mark for export", check_tree))
