#!/usr/bin/env python3
"""The runbook is complete: each alarm code in the sources has a page in English and in Korean, an entry in both catalogues and a
row in docs/reference/alarms.md, and none of these is about a code that no source raises. The pages of a pair name the same
commands, keys and messages, and these commands, keys and metrics exist. The page about plans has every reason that the engine
gives. First it plants violations of each kind and requires that each is found."""

import json
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
sys.dont_write_bytecode = True
from source_tree import CPP_SUFFIXES, list_files, read_text  # noqa: E402

SOURCES = ("libplan/", "libvda5050/", "libopenstream/", "apps/acsd/")
COMMANDS = "apps/acsctl/options/"  # the command line of acsctl
CATALOGUE = "apps/acsd/operator/AlarmCatalog.cpp"
KOREAN_CATALOGUE = "apps/acsd/page/alarms.ko.json"
TABLE = "docs/reference/alarms.md"
PAGES = "docs/runbook/"
INDEXES = (PAGES + "README.md", PAGES + "ko/README.md")
PLAN_PAGE = PAGES + "en/plan-does-not-move.md"
REASON_SOURCES = ("libplan/src/dispatch/WaitReasons.cpp", "libplan/src/dispatch/PortCheck.cpp", "libplan/src/robot/Robot.cpp")
OTHER = "*"  # the entry of unknown codes

COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*")', re.DOTALL)
CODE = re.compile(r'"((?:ACS|AGV|ARM)-[A-Za-z0-9]+)"')
FAMILY = re.compile(r'"((?:AGV|ARM)-)"')  # the begin of codes that a robot completes
ENTRY = re.compile(r'^    \{"([^"]+)",\s*"([^"]+)",(.*?)\},$', re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`([^`\n]+)`")
KEY = re.compile(r"^(?:abort|actions|arm|cancel|drive|errors|history|mcs|mqtt|operator|outbox|pause|queue|restart|robot|robots|"
                 r"site|store|trace|tsc)\.[a-zA-Z_][\w.]*$")
METRIC = re.compile(r"^acsd_[a-z_]+$")
HANGUL = re.compile(r"[\uac00-\ud7a3]")
SECTIONS = {
    "en": ["Effect", "Confirmation", "Remedy", "Clearing", "Prevention", "Contact"],
    "ko": ["생산 영향", "확인", "조치", "해제", "예방", "연락"],
}


def read_tree(root):
    """{path: text} of what this test reads."""
    return {path: read_text(root, path) for path in list_files(root)
            if (path.startswith((*SOURCES, COMMANDS)) and path.endswith(CPP_SUFFIXES)) or path.startswith("docs/")
            or path == KOREAN_CATALOGUE}


def strip_comments(text):
    return COMMENT.sub(lambda match: match.group(1) or " ", text)


def name_page(code):
    """AGV-* has the page AGV-error."""
    return code.replace("*", "error")


def find_codes(tree):
    """{code: path of a source that raises it}"""
    codes = {}
    for path, text in tree.items():
        if path.startswith(SOURCES) and path.endswith(CPP_SUFFIXES) and path != CATALOGUE:
            code_only = strip_comments(text)
            for code in CODE.findall(code_only):
                codes.setdefault(code, path)
            for begin in FAMILY.findall(code_only):
                codes.setdefault(begin + "*", path)
    return codes


def list_headings(text, mark):
    return [line[len(mark) + 1:].strip() for line in text.splitlines() if line.startswith(mark + " ")]


def list_spans(text):
    return {" ".join(span.split()) for span in SPAN.findall(text)}


def check_page(tree, language, code, title):
    path = f"{PAGES}{language}/{name_page(code)}.md"
    if path not in tree:
        yield f"{path}: missing; {code} has no page in this language"
        return
    heading = f"{code.replace('*', '…')}: {title}"
    if list_headings(tree[path], "#") != [heading]:
        yield f"{path}: the heading must be '# {heading}', as in the catalogue"
    if list_headings(tree[path], "##") != SECTIONS[language]:
        yield f"{path}: the sections must be {', '.join(SECTIONS[language])}"


def is_row_of(row, cell):
    """Whether the first cell of the row has the code; "`AGV-" only as the begin of codes, not as that of one code."""
    first = row.split("|")[1]
    return cell in first and (cell.endswith("`") or re.search(re.escape(cell) + "(?:`|…)", first) is not None)


def check_codes(tree):
    codes = find_codes(tree)
    entries = {code: (title, "".join(re.findall(r'"([^"]*)"', texts)))
               for code, title, texts in ENTRY.findall(tree.get(CATALOGUE, ""))}
    catalogue = {code: title for code, (title, _) in entries.items()}
    korean = json.loads(tree.get(KOREAN_CATALOGUE, "{}"))
    korean_titles = {code: str(entry.get("title")) for code, entry in korean.items()}
    # document with a row of each code, titles that the row must have
    tables = ((TABLE, ()), (INDEXES[0], (catalogue, korean_titles)), (INDEXES[1], (korean_titles,)))
    for code, source in sorted(codes.items()):
        text = f"{code} of {source}"
        if code not in catalogue:
            yield f"{CATALOGUE}: no entry of {text}"
        entry = korean.get(code, {})
        if not all(HANGUL.search(str(entry.get(member, ""))) for member in ("title", "cause", "remedy")):
            yield f"{KOREAN_CATALOGUE}: no title, cause and remedy in Korean of {text}"
        cell = f"`{code[:-1]}" if code.endswith("*") else f"`{code}`"
        for path, titles in tables:
            row = next((row for row in tree.get(path, "").splitlines() if row.startswith("| ") and is_row_of(row, cell)), None)
            if row is None:
                yield f"{path}: no row of {text}"
            elif not all(f"[{title.get(code)}]" in row for title in titles):
                yield f"{path}: the row of {code} has not its titles in the catalogues"
        yield from check_page(tree, "en", code, catalogue.get(code, "?"))
        yield from check_page(tree, "ko", code, entry.get("title", "?"))
    for code in sorted(entries.keys() & korean.keys()):
        if list_spans(entries[code][1]) != list_spans(f"{korean[code].get('cause')} {korean[code].get('remedy')}"):
            yield f"{KOREAN_CATALOGUE}: the entry of {code} names other commands or keys than {CATALOGUE}"
    known = {*codes, OTHER}
    for path, listed in ((CATALOGUE, catalogue), (KOREAN_CATALOGUE, korean)):
        for code in sorted(listed.keys() - known):
            yield f"{path}: no source raises {code}"
        if OTHER not in listed:
            yield f"{path}: no entry {OTHER}, for all other codes"
    pages = {name_page(code) for code in codes}
    for path in tree:
        match = re.match(re.escape(PAGES) + r"(?:en|ko)/((?:ACS|AGV|ARM)-\w+)\.md$", path)
        if match and match.group(1) not in pages:
            yield f"{path}: no source raises {match.group(1)}"


def check_pairs(tree):
    for path in sorted(tree):
        if not path.startswith(PAGES):
            continue
        twin = {INDEXES[0]: INDEXES[1], INDEXES[1]: INDEXES[0]}.get(path)
        twin = twin or (path.replace("/en/", "/ko/") if "/en/" in path else path.replace("/ko/", "/en/"))
        if twin not in tree:
            yield f"{twin}: missing; {path} has no twin"
        elif "/ko/" not in path and list_spans(tree[path]) != list_spans(tree[twin]):
            differences = sorted(list_spans(tree[path]) ^ list_spans(tree[twin]))
            yield f"{twin}: differs from {path} in {', '.join(f'`{span}`' for span in differences)}"
        if "/ko/" in path and not HANGUL.search(tree[path]):
            yield f"{path}: has no Korean"


def check_names(tree):
    """Commands, keys and metrics that the pages name exist."""
    commands = "".join(text for path, text in tree.items() if path.startswith(COMMANDS))
    keys = tree.get("docs/reference/configuration.md", "")
    metrics = tree.get("docs/reference/metrics.md", "")
    for path, text in tree.items():
        if path.startswith(PAGES) or path in (CATALOGUE, KOREAN_CATALOGUE):
            for span in sorted(list_spans(text)):
                if commands and re.match("acsctl [a-z]", span) and f'"{span.split()[1]}"' not in commands:
                    yield f"{path}: acsctl has no command {span.split()[1]}"
                name = span.split(" = ")[0]
                if KEY.match(name) and not re.search(rf"`{re.escape(name)}(?:\.\*)?`|`{re.escape(name)}\.", keys):
                    yield f"{path}: docs/reference/configuration.md has no key {name}"
                if METRIC.match(span) and f"`{span}" not in metrics:
                    yield f"{path}: docs/reference/metrics.md has no metric {span}"


def list_reasons(text):
    """The first words of each sentence in the literals of a source, without the values in it."""
    for literal in re.findall(r'(?:"(?:\\.|[^"\\\n])*"\s*)+', re.sub(r"#include[^\n]*", "", strip_comments(text))):
        joined = "".join(re.findall(r'"((?:\\.|[^"\\\n])*)"', literal))
        parts = [part.strip(" .:,()%") for part in re.split(r"\{[^}]*\}", joined)]
        words = max(parts, key=len).split()
        if len(words) > 1:
            yield " ".join(words[:4])


def check_reasons(tree):
    page = " ".join(tree.get(PLAN_PAGE, "").split())
    for path in REASON_SOURCES:
        for reason in sorted(set(list_reasons(tree.get(path, "")))):
            if reason.lower() not in page.lower():
                yield f"{PLAN_PAGE}: no row of the reason '{reason} …' of {path}"


def check_tree(tree):
    return [*check_codes(tree), *check_pairs(tree), *check_names(tree), *check_reasons(tree)]


def plant(tree):
    """(what, tree with the violation, begins of violations that must be found)"""
    def without(path):
        return {name: text for name, text in tree.items() if name != path}

    def replace(path, old, new):
        assert old in tree[path], f"{path} has no '{old}' to plant a violation"
        return {**tree, path: tree[path].replace(old, new)}

    new_source = "libplan/src/transaction/Planted.hpp"
    raised = 'constexpr std::string_view ALARM_PLANTED = "ACS-1999";\n'
    yield "a new code", {**tree, new_source: raised}, [
        f"{CATALOGUE}: no entry of ACS-1999", f"{KOREAN_CATALOGUE}: no title", f"{TABLE}: no row of ACS-1999",
        *(f"{path}: no row of ACS-1999" for path in INDEXES),
        f"{PAGES}en/ACS-1999.md: missing", f"{PAGES}ko/ACS-1999.md: missing"]
    yield "a new code of an adapter", {**tree, "apps/acsd/robots/Planted.cpp": 'Raise("ARM-planted");\n'}, [
        f"{CATALOGUE}: no entry of ARM-planted", f"{PAGES}en/ARM-planted.md: missing"]
    yield "a new family", {**tree, "apps/acsd/robots/Planted.cpp": 'Raise("ARM-" + name);\n'}, [
        f"{CATALOGUE}: no entry of ARM-*", f"{PAGES}en/ARM-error.md: missing"]
    for language in ("en", "ko"):
        path = f"{PAGES}{language}/ACS-1002.md"
        yield "a page is missing", without(path), [f"{path}: missing; ACS-1002"]
    yield "no entry", replace(CATALOGUE, '{"ACS-1002"', '{"ACS-1992"'), [
        f"{CATALOGUE}: no entry of ACS-1002", f"{CATALOGUE}: no source raises ACS-1992"]
    yield "no Korean entry", replace(KOREAN_CATALOGUE, '"ACS-1002": {', '"ACS-1992": {'), [
        f"{KOREAN_CATALOGUE}: no title, cause and remedy in Korean of ACS-1002"]
    yield "no row", replace(TABLE, "| [`ACS-1002`]", "| [`ACS-1992`]"), [f"{TABLE}: no row of ACS-1002"]
    yield "another title in the index", replace(INDEXES[0], "[Robot disconnected]", "[Robot lost]"), [
        f"{INDEXES[0]}: the row of ACS-1002"]
    yield "another title", replace(f"{PAGES}en/ACS-1002.md", "# ACS-1002: ", "# ACS-1002: A "), [
        f"{PAGES}en/ACS-1002.md: the heading"]
    yield "no section", replace(f"{PAGES}ko/ACS-1002.md", "## 예방", "## 기타"), [f"{PAGES}ko/ACS-1002.md: the sections"]
    yield "a page of no code", {**tree, f"{PAGES}en/ACS-1999.md": ""}, [f"{PAGES}en/ACS-1999.md: no source raises ACS-1999"]
    yield "another command", replace(f"{PAGES}ko/ACS-1008.md", "`acsctl resolve PLAN JOB again`", ""), [
        f"{PAGES}ko/ACS-1008.md: differs"]
    yield "a page without a twin", without(f"{PAGES}ko/plan-does-not-move.md"), [f"{PAGES}ko/plan-does-not-move.md: missing"]
    yield "an unknown key", replace(f"{PAGES}en/ACS-1009.md", "drive.stall_timeout", "drive.stall_limit"), [
        f"{PAGES}en/ACS-1009.md: docs/reference/configuration.md has no key drive.stall_limit"]
    planted = replace(f"{PAGES}en/ACS-1009.md", "acsctl abort", "acsctl abandon")
    yield "an unknown command", {**planted, COMMANDS + "Planted.cpp": 'Add("abort");\n'}, [
        f"{PAGES}en/ACS-1009.md: acsctl has no command abandon"]
    yield "another command in Korean", replace(KOREAN_CATALOGUE, "acsctl maintenance ROBOT on", "acsctl maintenance ROBOT off"), [
        f"{KOREAN_CATALOGUE}: the entry of ACS-1002 names other commands"]
    yield "a new reason", {**tree, REASON_SOURCES[0]: tree[REASON_SOURCES[0]] + 'Add("{} is planted for a test");\n'}, [
        f"{PLAN_PAGE}: no row of the reason 'is planted for a "]
    yield "only a comment", {**tree, new_source: "// " + raised}, []


def main():
    tree = read_tree(ROOT)
    failures = check_tree(tree)
    present = set(failures)
    for what, planted, expected in plant(tree):
        found = [failure for failure in check_tree(planted) if failure not in present]
        for begin in expected:
            if not any(failure.startswith(begin) for failure in found):
                failures.append(f"self-check: {what}: '{begin}…' is not found, only {found}")
        if not expected and found:
            failures.append(f"self-check: {what}: must be accepted, not {found}")
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
