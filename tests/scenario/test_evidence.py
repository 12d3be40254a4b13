#!/usr/bin/env python3
"""docs/protocols/mcs-acs.md, "Conformance": a row for each sequence, rule, decision and vector of the specification, and in
each row evidence that exists. With ACS_SPEC_DIR the list of rows is compared with the specification itself. SECURITY.md,
"Promises": in each row evidence that exists."""

import os
import pathlib
import re
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = REPOSITORY / "examples" / "scenarios"
TESTS = REPOSITORY / "tests"
TITLE = "## Conformance"
PROMISES = "## Promises"

SEQUENCES = ("Connect", "Plan", "Job failure", "Cancel", "Abort", "Pause", "Resume", "Comm loss")
EXPECTED = [*[f"6 {name}" for name in SEQUENCES], *[f"R{number}" for number in range(1, 20)],
            *[f"D-{number}" for number in range(1, 32) if number != 25],  # the register has no D-25
            *[f"13.{number}" for number in range(1, 13)]]


def read_rows(text, title=TITLE):
    """(row's name, its evidence in the last column), in the order of the table."""
    lines = text.split(title, 1)[1].split("\n## ", 1)[0].splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")]
    return [(row[0], re.findall(r"`([^`]+)`", row[-1])) for row in cells if row[0]]


class Evidence:
    """The evidence in the tree that a row can name."""

    def __init__(self):
        self._sources = {path.name: path.read_text() for folder in ("unit", "integration")
                         for path in (TESTS / folder).rglob("*.cpp")}
        self._scripts = {path.name: path.read_text() for folder in ("scenario", "hardening")
                         for path in (TESTS / folder).glob("*.py")}
        self._fuzzers = (TESTS / "fuzz" / "CMakeLists.txt").read_text()

    def find_error_or_none(self, name):
        if "::" in name:
            file, function = name.split("::")
            found = re.search(rf"^    def {function}\(", self._scripts.get(file, ""), re.MULTILINE)
        elif name.startswith("wire_rules.py: "):
            # The rule's message, and the row of its test.
            rule = re.escape(name.split(": ")[1])
            found = re.search(rf'_note\(f?"[^":]*\b{rule}\b', self._scripts["wire_rules.py"]) \
                and re.search(rf'"{rule}"', self._scripts["test_wire_rules.py"])
        elif ".cpp: " in name:
            file, title = name.split(": ", 1)
            found = re.search(rf'TEST_CASE[A-Z_]*\([^"]*"{re.escape(title)}', self._sources.get(file, ""))
        elif name.endswith("Fuzz.cpp"):
            found = re.search(rf"SOURCE {re.escape(name)}\b", self._fuzzers)
        else:
            found = re.fullmatch(r"[a-z0-9-]+", name) and (SCENARIOS / f"{name}.json").is_file()
        return None if found else f"there is no {name}"

    def find_errors(self, text):
        rows = read_rows(text)
        names = [name for name, _ in rows]
        errors = [f"{name} is missing" for name in EXPECTED if name not in names]
        errors += [f"{name} is there {names.count(name)} times" for name in set(names) if names.count(name) > 1]
        errors += [f"{name} is no row of the specification" for name in names if name not in EXPECTED]
        return errors + self.find_missing(rows)

    def find_missing(self, rows):
        errors = []
        for name, things in rows:
            errors += [] if things else [f"{name} names nothing"]
            found = [self.find_error_or_none(thing) for thing in things]
            errors += [f"{name}: {error}" for error in found if error is not None]
        return errors


class Table(unittest.TestCase):
    def setUp(self):
        self.evidence = Evidence()
        self.text = (REPOSITORY / "docs" / "protocols" / "mcs-acs.md").read_text()

    def test_each_row_is_there_and_names_what_exists(self):
        self.assertEqual(self.evidence.find_errors(self.text), [])

    def test_a_row_that_is_missing_or_names_nothing_that_exists_is_found(self):
        row = next(line for line in self.text.splitlines() if line.startswith("| R12 |"))
        rows = {
            "R12 is missing": "", "R12 names nothing": "| R12 | a status at every change | of course |",
            "R12: there is no robot-dance": row.replace("`robot-status`", "`robot-dance`"),
            "R12: there is no test_mcs.py::test_nothing": row.replace("`robot-status`", "`test_mcs.py::test_nothing`"),
            "R12: there is no test_none.py::test_x": row.replace("`robot-status`", "`test_none.py::test_x`"),
            "R12: there is no wire_rules.py: R99": row.replace("`robot-status`", "`wire_rules.py: R99`"),
            "R12: there is no PlanQueueTest.cpp: D-99": row.replace("`robot-status`", "`PlanQueueTest.cpp: D-99`"),
            "R99 is no row of the specification": row + "\n" + row.replace("R12", "R99"),
            "R12 is there 2 times": row + "\n" + row,
        }
        for error, text in rows.items():
            with self.subTest(error):
                self.assertEqual(self.evidence.find_errors(self.text.replace(row, text)), [error])

    def test_the_rows_are_those_of_the_specification(self):
        if "ACS_SPEC_DIR" not in os.environ:
            self.skipTest("ACS_SPEC_DIR is not set")
        text = (pathlib.Path(os.environ["ACS_SPEC_DIR"]) / "mcs-acs" / "SPEC.md").read_text()
        sections = {match.group(1): match.group(2) for match in
                    re.finditer(r"^## (\d+)\. [^\n]*\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)}
        found = [f"6 {name}" for name in re.findall(r"^\*\*([A-Z][a-z ]+)\*\*", sections["6"], re.MULTILINE)]
        found += re.findall(r"^\| (R\d+) \|", sections["8"], re.MULTILINE)
        found += re.findall(r"^\| (D-\d+) \|", sections["11"], re.MULTILINE)
        found += [f"13.{number}" for number in re.findall(r"^(\d+)\. ", sections["13"], re.MULTILINE)]
        self.assertEqual(found, EXPECTED)


class Promises(unittest.TestCase):
    def setUp(self):
        self.evidence = Evidence()
        self.text = (REPOSITORY / "SECURITY.md").read_text()

    def find_errors(self, text):
        _, *rows = read_rows(text, PROMISES)  # without the head
        self.assertGreater(len(rows), 10)
        return self.evidence.find_missing(rows)

    def test_each_promise_names_tests_that_exist(self):
        self.assertEqual(self.find_errors(self.text), [])

    def test_a_promise_without_a_test_that_exists_is_found(self):
        rows = {
            "All is well names nothing": "| All is well | of course |",
            "All is well: there is no NoneFuzz.cpp": "| All is well | `NoneFuzz.cpp` |",
            "All is well: there is no test_hardening.py::test_x": "| All is well | `test_hardening.py::test_x` |",
        }
        for error, row in rows.items():
            with self.subTest(error):
                self.assertEqual(self.find_errors(f"{self.text}{row}\n"), [error])


if __name__ == "__main__":
    unittest.main()
