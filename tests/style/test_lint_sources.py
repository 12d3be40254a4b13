#!/usr/bin/env python3
"""scripts/lint_sources.py on a small tree: sources that are checked together give the findings that each gives alone."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
COPIED = (".clang-tidy", "scripts/lint_sources.py", "scripts/source_tree.py", "scripts/house-rules.clang-query")
CLEAN = "namespace\n{{\n\nint GetOne()\n{{\n    return 1;\n}}\n\n}} // namespace\n\nint Get{0}()\n{{\n    return GetOne();\n}}\n"
ODD_NAME = "int get_odd()\n{\n    return 1;\n}\n"
DEPENDENT = "int GetDependent()\n{\n    return GetOne();\n}\n"


class LintSources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name) / "tree"
        self.cache = pathlib.Path(folder.name) / "cache"
        for name in COPIED:
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(REPOSITORY / name, self.root / name)
        self.commands = []

    def write(self, name, text):
        path = self.root / "libplan" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        if name.endswith(".cpp"):
            self.commands.append({"directory": str(self.root), "file": str(path),
                                  "command": f"clang++-14 -std=c++20 -o {name}.o -c {path}"})

    def lint(self):
        build = self.root / "build/tidy"
        build.mkdir(parents=True, exist_ok=True)
        (build / "compile_commands.json").write_text(json.dumps(self.commands), encoding="utf-8")
        done = subprocess.run(["python3", "-B", self.root / "scripts/lint_sources.py", "--jobs", "2"], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              env={**os.environ, "XDG_CACHE_HOME": str(self.cache)})
        begin = re.search(r"^(\d+) of (\d+) sources to check$", done.stdout, re.MULTILINE)
        self.assertIsNotNone(begin, done.stdout)
        failed = re.findall(r"^FAILED libplan/(\S+)$", done.stdout, re.MULTILINE)
        self.assertEqual(done.returncode, 1 if failed else 0, done.stdout)
        return int(begin[1]), sorted(failed), done.stdout

    def test_two_helpers_of_one_name(self):
        for name in ("First", "Second", "Third"):
            self.write(name + ".cpp", CLEAN.format(name))
        self.assertEqual(self.lint()[:2], (3, []))
        self.assertEqual(self.lint()[:2], (0, []))

    def test_a_finding_is_of_one_source(self):
        for name in ("First", "Third"):
            self.write(name + ".cpp", CLEAN.format(name).replace("GetOne", "GetOneFor" + name))
        self.write("Second.cpp", ODD_NAME)
        count, failed, output = self.lint()
        self.assertEqual((count, failed), (3, ["Second.cpp"]))
        self.assertIn("readability-identifier-naming", output)
        self.assertEqual(self.lint()[:2], (1, ["Second.cpp"]))

    def check_second(self, text, finding):
        self.write("First.cpp", CLEAN.format("First"))
        self.write("Second.cpp", text)
        _, failed, output = self.lint()
        self.assertEqual(failed, ["Second.cpp"])
        self.assertIn(finding, output)

    def test_a_finding_of_the_house_rules(self):
        self.check_second("bool Knows()\n{\n    return true;\n}\n",
                          "breaks a rule of scripts/house-rules.clang-query: bool Knows()")

    def test_a_finding_of_the_analyzer(self):
        self.check_second("int GetQuotient(int size)\n{\n    const int none = 0;\n    return size / none;\n}\n",
                          "clang-analyzer-core.DivideZero")

    def test_a_source_that_needs_another_one(self):
        self.check_second(DEPENDENT, "use of undeclared identifier 'GetOne'")

    def test_a_finding_in_a_header(self):
        self.write("Odd.hpp", "#pragma once\n\ninline " + ODD_NAME)
        for name in ("First", "Second"):
            self.write(name + ".cpp", '#include "Odd.hpp"\n\n' + CLEAN.format(name).replace("GetOne", "GetOneFor" + name))
        self.assertEqual(self.lint()[:2], (2, ["First.cpp", "Second.cpp"]))

    def test_calls_across_sources_are_no_recursion(self):
        self.write("Calls.hpp", "#pragma once\n\nint CallFirst(int count);\nint CallSecond(int count);\n")
        for name, other in (("First", "Second"), ("Second", "First")):
            self.write(name + ".cpp", f'#include "Calls.hpp"\n\nint Call{name}(int count)\n{{\n'
                                      f"    return count > 0 ? Call{other}(count - 1) : 0;\n}}\n")
        self.write("Third.cpp", "int CallThird(int count)\n{\n    return count > 0 ? CallThird(count - 1) : 0;\n}\n")
        _, failed, output = self.lint()
        self.assertEqual(failed, ["Third.cpp"])
        self.assertIn("misc-no-recursion", output)


if __name__ == "__main__":
    unittest.main()
