#!/usr/bin/env python3
"""test_check_abi.py COMPILER: scripts/check_abi with packages of a small library."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parent.parent.parent / "scripts" / "check_abi"
COMPILER = "g++"
HEADER = "namespace ACS\n{{\nstruct Robot\n{{\n    int number;\n{field}}};\nint Drive(const Robot& robot);\n{function}}} // namespace ACS\n"
SOURCE = "#include <acs/toy.hpp>\nint ACS::Drive(const Robot& robot) {{ return robot.number; }}\n{function}\n"


def run(*command):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{command}: {done.stdout}")
    return done.stdout


class CheckAbi(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-abi-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.former = self.make_packages("former")

    def make_packages(self, name, field="", function=False, libraries=(("toy", "0.1"),), without_drive=False, without=()):
        """Packages as of scripts/package, with libraries of one function: (name, soversion)."""
        root = self.folder / f"{name}-build"
        header = root / "libacs-dev/usr/include/acs/toy.hpp"
        header.parent.mkdir(parents=True)
        header.write_text(HEADER.format(field=field, function="int Stop();\n" if function else ""), encoding="utf-8")
        source = root / "toy.cpp"
        text = SOURCE.format(function="int ACS::Stop() { return 1; }" if function else "")
        source.write_text("int unused() { return 0; }\n" if without_drive else text, encoding="utf-8")
        for library_name, soversion in libraries:
            self.make_library(root, root / f"libacs0/usr/lib/x86_64-linux-gnu/libacs_{library_name}.so.{soversion}")
        output = self.folder / name
        output.mkdir()
        for package in {"libacs0", "libacs0-dbgsym", "libacs-dev"} - set(without):
            control = root / package / "DEBIAN" / "control"
            control.parent.mkdir()
            control.write_text(f"Package: {package}\nVersion: 1\nArchitecture: all\nMaintainer: X <x@x.org>\nDescription: x\n", encoding="utf-8")
            run("dpkg-deb", "--build", "--root-owner-group", root / package, output / f"{package}_1_all.deb")
        return output

    @staticmethod
    def make_library(root, library):
        library.parent.mkdir(parents=True, exist_ok=True)
        run(COMPILER, "-g", "-shared", "-fPIC", "-Wl,--build-id", f"-Wl,-soname,{library.name}", "-I", root / "libacs-dev/usr/include",
            root / "toy.cpp", "-o", library)
        identity = re.search(r"Build ID: ([0-9a-f]+)", run("readelf", "-n", library)).group(1)
        symbols = root / "libacs0-dbgsym/usr/lib/debug/.build-id" / identity[:2] / f"{identity[2:]}.debug"
        symbols.parent.mkdir(parents=True, exist_ok=True)
        run("objcopy", "--only-keep-debug", library, symbols)
        run("strip", "--strip-unneeded", library)

    def check(self, current):
        done = subprocess.run([CHECK, self.former, current], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        return done.returncode, done.stdout

    def test_the_same_interface(self):
        code, text = self.check(self.make_packages("same"))
        self.assertEqual((code, text), (0, "== the binary interface has not changed\n"))

    def test_a_function_is_added(self):
        code, text = self.check(self.make_packages("more", function=True))
        self.assertEqual(code, 0, text)
        self.assertIn("is compatible with the former one", text)

    def test_a_field_is_added(self):
        code, text = self.check(self.make_packages("wider", field="    int speed;\n"))
        self.assertEqual(code, 1, text)
        self.assertIn("type size changed from 32 to 64", text)

    def test_a_function_is_removed(self):
        code, text = self.check(self.make_packages("less", without_drive=True))
        self.assertEqual(code, 1, text)
        self.assertIn("not compatible", text)

    def test_another_soversion_is_another_interface(self):
        code, text = self.check(self.make_packages("next", field="    int speed;\n", libraries=(("toy", "0.2"), ("new", "0.2"))))
        self.assertEqual(code, 0, text)
        self.assertIn("not compared, since their soversions differ: libacs_toy.so.0.1", text)

    def test_a_library_that_kept_its_soversion_is_compared(self):
        self.former = self.make_packages("two", libraries=(("toy", "0.1"), ("c", "1")))
        both = (("toy", "0.2"), ("c", "1"))
        code, text = self.check(self.make_packages("kept", libraries=both))
        self.assertEqual(code, 0, text)
        self.assertIn("not compared, since their soversions differ: libacs_toy.so.0.1", text)
        self.assertIn("has not changed", text)
        code, text = self.check(self.make_packages("broken", field="    int speed;\n", libraries=both))
        self.assertEqual(code, 1, text)
        self.assertIn("not compatible", text)

    def test_a_library_is_missing(self):
        self.former = self.make_packages("two", libraries=(("toy", "0.1"), ("c", "1")))
        code, text = self.check(self.make_packages("one"))
        self.assertEqual(code, 1, text)
        self.assertIn("libraries are missing: libacs_c", text)

    def test_a_package_is_missing(self):
        for package in ("libacs0", "libacs0-dbgsym", "libacs-dev"):
            code, text = self.check(self.make_packages(f"without-{package}", field="    int speed;\n", without=(package,)))
            self.assertEqual(code, 2, text)
            self.assertIn(f"needs exactly one package {package}", text)

    def test_a_wrong_command_line(self):
        for words in ([], [self.former], ["--unknown", self.former, self.former], [self.former, self.folder]):
            done = subprocess.run([CHECK, *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, words)


if __name__ == "__main__":
    if shutil.which("abipkgdiff") is None:
        print("skipped: abipkgdiff is not installed")
        sys.exit(77)
    COMPILER = sys.argv.pop(1)
    unittest.main(verbosity=2)
