#!/usr/bin/env python3
"""House conventions that no compiler checks: the order of a class's members, abbreviations at the end of names, and the
names of parameters that may be null."""

import re
import sys

from check_sizes import LABEL, NO_MEMBER, find_end, is_method, list_types
from source_tree import CPP_SUFFIXES, list_files, read_text, run_check, strip_comments_and_strings

# Violates every rule on purpose.
SAMPLES = "tests/style/bad/"
# Public types and constants, data, constructors, then methods from public to private.
TYPES, DATA, CONSTRUCTORS, PUBLIC, PROTECTED, PRIVATE = range(6)
RANKS = ("a public type or constant", "data", "a constructor", "a public method", "a protected method", "a private method")
ACCESS_RANKS = {"public": PUBLIC, "protected": PROTECTED, "private": PRIVATE}
CONSTANT = re.compile(r"^(?:inline\s+|static\s+|constexpr\s+|const\s+)*static\b.*?\b[A-Z][A-Z0-9_]*\s*(?:=|\{|$)")
# An abbreviation at the end of a name is in capitals: OrderID, but HttpCode. RapidJson is a name.
ABBREVIATIONS = "Id Ids Url Urls Uri Json Xml Html Tcp Udp Tls Ssl Http Mqtt Uuid Utc Sql Api Lif Acs Mcs Tsc".split()
NAME = re.compile(r"\b\w*[a-z0-9](?<!Rapid)(?:" + "|".join(ABBREVIATIONS) + r")\b")
PARAMETERS = re.compile(r"(?<!\bif)(?<!\bwhile)(?<!\bfor)(?<!\bswitch)(?<=[\w>\]])\s*\(([^()]*(?:\([^()]*\)[^()]*)*)\)\s*(?:const\b|noexcept\b|override\b|->|;|\{|:|=)")
# An optional that is filled for the caller is a result, and a C string is a text.
OPTIONAL = re.compile(r"^(?:const\s+std::optional<.*>\s*&|(?:const\s+)?std::optional<.*>(?:\s*&&)?)\s+(\w+)\s*(?:=.*)?$", re.DOTALL)
POINTER = re.compile(r"^(?!const\s+char\b)(?:const\s+)?(?:[A-Z][\w:]*|std::[\w:]+|\w+::[\w:]+|void|int|double|char)(?:<.*>)?\s*\*\s*(?:const\s+)?(\w+)\s*(?:=.*)?$", re.DOTALL)
# What a C library passes, and the operand of a product.
FOREIGN = re.compile(r"^(?:argv|data|text|userdata|self|stream|client|memory|_\w+)$")


def list_members(body):
    """(offset, access, declaration) of each member; nested braces are emptied. Access as the class sets it: private first."""
    access, start, index, flat = "private", 0, 0, []
    while index < len(body):
        label = LABEL.match(body, index)
        if label and not "".join(flat).strip():
            access = label.group(0).rstrip(": \n\t")
            index = label.end()
            start = index
            flat = []
            continue
        letter = body[index]
        if letter == "{":
            end = find_end(body, index)
            flat.append("{}")
            rest = body[end:].lstrip()
            if rest[:1] not in (";", ",", "{", ")", ".") and not re.match(r"\w+\s*;", rest):
                yield start, access, " ".join("".join(flat).split())
                flat, start = [], end
            index = end
            continue
        if letter == ";":
            yield start, access, " ".join("".join(flat).split())
            flat, start = [], index + 1
        else:
            if not flat and letter.isspace():
                start = index + 1
            else:
                flat.append(letter)
        index += 1


def rank(declaration, access, name):
    """None for what has no place of its own: private types, friends, assertions."""
    plain = re.sub(r"^(?:\[\[[^\]]*\]\]\s*|template\s*<[^{}]*?>\s*(?=\S))+", "", declaration)
    if not plain or plain.startswith(("friend", "static_assert", "#")):
        return None
    if NO_MEMBER.match(plain) or CONSTANT.match(plain):
        return TYPES if access == "public" else None
    if re.match(r"(?:explicit\s+|virtual\s+|constexpr\s+)*~?" + re.escape(name) + r"\s*\(", plain):
        return CONSTRUCTORS
    if is_method(declaration):
        if "operator" in plain:
            return CONSTRUCTORS if re.search(r"\boperator=\s*\(", plain) else None
        return ACCESS_RANKS[access]
    return DATA if access != "public" else None


def check_order(text):
    for _, kind, name, body in list_types(text):
        if kind != "class":
            continue
        begin = text.index(body)
        highest, before = -1, None
        for offset, access, declaration in list_members(body):
            place = rank(declaration, access, name.split("::")[-1])
            if place is None:
                continue
            if place < highest:
                yield (1 + text.count("\n", 0, begin + offset),
                       f"{RANKS[place]} of {name} is after {before}; order: public types and constants, data, constructors, "
                       "methods from public to private")
                break
            highest, before = place, RANKS[place]


def check_abbreviations(text):
    seen = set()
    for match in NAME.finditer(text):
        name = match.group(0)
        if name not in seen:
            seen.add(name)
            yield 1 + text.count("\n", 0, match.start()), f"{name}: an abbreviation at the end of a name is in capitals"


def split_parameters(text):
    parts, depth, part = [], 0, []
    for letter in text:
        depth += letter in "(<{"
        depth -= letter in ")>}"
        if letter == "," and depth == 0:
            parts.append("".join(part).strip())
            part = []
        else:
            part.append(letter)
    return parts + ["".join(part).strip()]


def check_nullable(text):
    for match in PARAMETERS.finditer(text):
        for parameter in split_parameters(match.group(1)):
            found = OPTIONAL.match(parameter) or POINTER.match(parameter)
            name = found.group(1) if found else "OrNull"
            if "OrNull" in name or FOREIGN.match(name) or re.match(r"b[A-Z]", name) or parameter.startswith("return"):
                continue
            yield (text.count("\n", 0, match.start()) + 1,
                   f"parameter {name} may be null: its name ends in OrNull")


def check_tree(root):
    for path in (name for name in list_files(root) if name.endswith(CPP_SUFFIXES)):
        if path.startswith(SAMPLES):
            continue
        text = strip_comments_and_strings(read_text(root, path))
        for check in (check_order, check_nullable, check_abbreviations):
            for line, problem in check(text):
                yield f"{path}:{line}: {problem}"


if __name__ == "__main__":
    sys.exit(run_check("Checks the order and the names of members", check_tree))
