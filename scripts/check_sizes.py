#!/usr/bin/env python3
"""Limits of size for the libraries and the programs: methods and data members of a class, fields of a struct that holds state,
lines of a file; and no cycle of includes between the subfolders of libplan/src. scripts/sizes-exceeded.txt
lists what is still above a limit, with its size today: it may shrink and never grow."""

import os
import re
import sys

from source_tree import (CPP_SUFFIXES, IncludeResolver, list_files, list_includes, read_text, run_check,
                         strip_comments_and_strings)

FOLDERS = ("lib", "apps/")
CYCLE_ROOT = "libplan/src/"
METHODS, MEMBERS, FIELDS, LINES = "methods", "members", "fields", "lines"
LIMITS = {METHODS: 60, MEMBERS: 20, FIELDS: 15, LINES: 500}
# Options, arguments, messages, texts and views are values: they have as many fields as their document has.
VALUE_NAME = re.compile(r"(?:Options|Arguments|Config|Info|Answer|Spec|Message|Record|Summary|Event|Job|Status|State|Limits|Text|View)$")
EXCEEDED = "scripts/sizes-exceeded.txt"
TYPE = re.compile(r"\b(class|struct)\s+(?:ACS_[A-Z]+\s+|\[\[[^\]]*\]\]\s*|alignas\([^)]*\)\s*)?((?:\w+::)*\w+)\s*(?:final\s*)?"
                  r"(?::(?!:)[^;{}()]*)?\{")
LABEL = re.compile(r"\b(?:public|private|protected)\s*:(?!:)")
NO_MEMBER = re.compile(r"^(?:using|friend|typedef|static_assert|enum|class|struct|union|static\s+constexpr|"
                       r"static\s+inline\s+const|inline\s+static)\b")


def find_end(text, start):
    """Index behind the brace that closes the one at start."""
    depth = 0
    for index in range(start, len(text)):
        if text[index] == "{":
            depth += 1
        elif text[index] == "}":
            depth -= 1
            if depth == 0:
                return index + 1
    return len(text)


def strip_pairs(text, opening, closing):
    kept, depth = [], 0
    for letter in text:
        if letter == opening:
            depth += 1
        elif letter == closing and depth > 0:
            depth -= 1
        elif depth == 0:
            kept.append(letter)
    return "".join(kept)


def list_declarations(body):
    """The declarations of a class body, nested braces emptied. After an empty pair a declaration continues with ";", "," or
    an initialiser; anything else begins the next one."""
    flat, index = [], 0
    while index < len(body):
        if body[index] == "{":
            index = find_end(body, index)
            rest = body[index:].lstrip()
            flat.append("{}" if rest[:1] in (";", ",", "{", ")") else "{};")
            continue
        flat.append(body[index])
        index += 1
    text = LABEL.sub(" ", "".join(flat))
    return [" ".join(part.split()) for part in text.split(";") if part.strip(" {}\n")]


def is_method(declaration):
    if "operator" in declaration:
        return True
    plain = strip_pairs(re.sub(r"\[\[[^\]]*\]\]", "", declaration), "<", ">")
    return "(" in plain.split("=")[0].split("{")[0]


def count(body):
    methods = members = 0
    for declaration in list_declarations(body):
        declaration = re.sub(r"^template\s*<[^{}]*?>\s*(?=\S)", "", declaration)
        if NO_MEMBER.match(re.sub(r"^\[\[[^\]]*\]\]\s*", "", declaration)):
            continue
        if is_method(declaration):
            methods += 1
        else:
            members += 1
    return methods, members


def list_types(text):
    """(line, kind, name, body) of each class and struct that is defined, nested ones too."""
    for match in TYPE.finditer(text):
        end = find_end(text, match.end() - 1)
        if text[:match.start()].rstrip().endswith("enum"):
            continue
        yield text.count("\n", 0, match.start()) + 1, match.group(1), match.group(2), text[match.end():end - 1]


def measure_file(path, text):
    """(line, what, measure, size)."""
    yield 1, os.path.basename(path), LINES, text.count("\n")
    for line, kind, name, body in list_types(strip_comments_and_strings(text)):
        methods, members = count(body)
        yield line, name, METHODS, methods
        if kind == "class":
            yield line, name, MEMBERS, members
        elif not VALUE_NAME.search(name) and "/include/" not in path:
            yield line, name, FIELDS, members


def find_cycle(edges):
    """Folders of a cycle, the first one again at the end; None without one."""
    state, stack = {}, []

    def visit(node):
        state[node] = "open"
        stack.append(node)
        for other in sorted(edges.get(node, ())):
            if state.get(other) == "open":
                return stack[stack.index(other):] + [other]
            if other not in state:
                found = visit(other)
                if found:
                    return found
        stack.pop()
        state[node] = "done"
        return None

    for node in sorted(edges):
        if node not in state:
            found = visit(node)
            if found:
                return found
    return None


def get_subfolder(path):
    parts = path[len(CYCLE_ROOT):].split("/")
    return parts[0] if len(parts) > 1 else None


def check_cycles(root, files):
    resolver = IncludeResolver(files)
    edges, places = {}, {}
    for path in (name for name in files if name.startswith(CYCLE_ROOT) and name.endswith(CPP_SUFFIXES)):
        folder = get_subfolder(path)
        for line, quoted, name in list_includes(read_text(root, path)):
            target = resolver.find(path, quoted, name)
            if target is None or not target.startswith(CYCLE_ROOT) or folder is None:
                continue
            other = get_subfolder(target)
            if other not in (None, folder):
                edges.setdefault(folder, set()).add(other)
                places.setdefault((folder, other), f"{path}:{line}")
    cycle = find_cycle(edges)
    if cycle:
        yield f"{places[cycle[0], cycle[1]]}: the subfolders include each other in a cycle: {' -> '.join(cycle)}"


def read_exceeded(root):
    if not os.path.exists(os.path.join(root, EXCEEDED)):
        return {}
    rows = (line.split() for line in read_text(root, EXCEEDED).splitlines())
    return {(path, name, measure): int(size) for path, name, measure, size in rows}


def check_tree(root):
    files = list_files(root)
    left = read_exceeded(root)
    for path in (name for name in files if name.startswith(FOLDERS) and name.endswith(CPP_SUFFIXES)):
        for line, name, measure, size in measure_file(path, read_text(root, path)):
            limit = LIMITS[measure]
            if size <= limit:
                continue
            allowed = left.pop((path, name, measure), limit)
            if size > allowed:
                yield f"{path}:{line}: {name} has {size} {measure}, at most {allowed} are allowed; split it by responsibility"
            elif size < allowed:
                yield f"{path}:{line}: {name} has {size} {measure} now; lower its entry in {EXCEEDED} from {allowed}"
    for path, name, measure in left:
        yield f"{EXCEEDED}:1: {path} {name} is within the limit of {measure} or gone; remove its entry"
    yield from check_cycles(root, files)


if __name__ == "__main__":
    sys.exit(run_check("Checks sizes in the libraries and programs", check_tree))
