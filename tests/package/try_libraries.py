#!/usr/bin/env python3
"""try_libraries.py PACKAGES WORK: compiles, links and runs a program of each component against the packages libacs0 and libacs-dev,
on a Debian 12 machine that has nothing else but a compiler and CMake. Needs root. WORK keeps the base system for the next time."""

import atexit
import pathlib
import re
import shutil
import tempfile
import unittest

from machine import Machine, make_base, take_arguments

INSTALL_TESTS = pathlib.Path(__file__).resolve().parent.parent / "install"
BASE_PACKAGES = ("cmake", "g++", "ninja-build", "pkg-config")
PACKAGES, WORK = "", ""
machine = None


def setUpModule():
    global machine
    debs = [deb for name in ("libacs0", "libacs-dev") for deb in pathlib.Path(PACKAGES).glob(f"{name}_*.deb")]
    folder = pathlib.Path(tempfile.mkdtemp(prefix="libraries-", dir=WORK))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)  # after Ctrl-C unittest cleans nothing up
    make_base(pathlib.Path(WORK, "libraries.tar"), BASE_PACKAGES)
    machine = Machine(folder / "root", pathlib.Path(WORK, "libraries.tar"))
    shutil.copytree(INSTALL_TESTS, machine.folder / "trial" / "install")
    for deb in debs:
        shutil.copy(deb, machine.folder / "trial")
    machine.run_outside("apt-get", "-q", "update")
    machine.run_outside("apt-get", "-q", "-y", "--no-install-recommends", "install", *(f"/trial/{deb.name}" for deb in debs))


class Libraries(unittest.TestCase):
    def test_a_program_of_each_component(self):
        sources = sorted(INSTALL_TESTS.glob("consumer_*.c*"))
        self.assertGreater(len(sources), 10)
        for source in sources:
            component = source.stem.removeprefix("consumer_")
            with self.subTest(component=component):
                build = f"/trial/{component}"
                machine.run_outside("cmake", "-G", "Ninja", "-S", "/trial/install/consumer", "-B", build, f"-DCOMPONENT={component}",
                                    f"-DSOURCE=/trial/install/{source.name}", *(["-DLANGUAGE=C"] if source.suffix == ".c" else []))
                machine.run_outside("cmake", "--build", build)
                machine.run_outside(f"{build}/consumer")
                self.assertRegex(machine.run_outside("ldd", f"{build}/consumer"), r"libacs_\w+\.so\.[0-9.]+ => /(usr/)?lib/")

    def test_every_module_of_pkg_config_is_complete(self):
        modules = sorted(path.stem for path in machine.folder.glob("usr/lib/*/pkgconfig/acs-*.pc"))
        self.assertGreater(len(modules), 5)
        for module in modules:
            with self.subTest(module=module):
                libraries = machine.run_outside("pkg-config", "--libs", module)
                self.assertIsNotNone(re.search(r"-lacs_\w+", libraries), libraries)
                (machine.folder / "trial" / "main.cpp").write_text("int main() {}\n", encoding="utf-8")
                machine.run_outside("sh", "-c", f"g++ -std=c++20 /trial/main.cpp -Wl,--no-as-needed $(pkg-config --cflags --libs {module}) -o /trial/main "
                                                "&& /trial/main")


if __name__ == "__main__":
    PACKAGES, WORK = take_arguments()
    unittest.main(verbosity=2)
