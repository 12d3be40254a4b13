#!/usr/bin/env python3
"""scripts/check_format on small trees: with git, without it, and where git fails, no file is left unchecked in silence."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
GOOD, BAD = "int one = 1;\n", "int   one=1;\n"


class CheckFormat(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("scripts/check_format", ".clang-format"):
            (self.root / name).parent.mkdir(exist_ok=True)
            shutil.copy(REPOSITORY / name, self.root / name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def check(self, *words):
        done = subprocess.run([self.root / "scripts" / "check_format", *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def check_tree(self):
        self.write("lib/Good.cpp", GOOD)
        self.write("tests/style/bad/Bad.cpp", BAD)
        self.assertEqual(self.check(), (0, ""))
        self.write("lib/Bad name.hpp", BAD)
        code, output = self.check()
        self.assertNotEqual(code, 0)
        self.assertIn("Bad name.hpp:1:", output)
        self.assertEqual(self.check("--fix")[0], 0)
        self.assertEqual((self.root / "lib/Bad name.hpp").read_text(encoding="utf-8"), GOOD)
        self.assertEqual((self.root / "tests/style/bad/Bad.cpp").read_text(encoding="utf-8"), BAD)

    def test_a_clone(self):
        subprocess.run(["git", "-C", self.root, "init", "-q"], check=True)
        self.write(".gitignore", "/ignored/\n")
        self.write("ignored/Bad.cpp", BAD)
        self.check_tree()

    def test_an_archive_without_git(self):
        self.write("build/dev/Bad.cpp", BAD)
        self.check_tree()

    def test_git_fails(self):
        self.write(".git", "gitdir: /nonexistent\n")
        self.write("lib/Good.cpp", GOOD)
        code, output = self.check()
        self.assertEqual(code, 1)
        self.assertIn("check_format: git cannot list the files of the tree", output)

    def test_a_tree_without_files(self):
        self.assertEqual(self.check(), (1, "check_format: the tree has no C++ file\n"))


if __name__ == "__main__":
    unittest.main()
