#!/usr/bin/env python3
"""The hardening of the release build: what readelf shows of a program, and the flags of each of our sources."""

import json
import pathlib
import re
import subprocess
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = REPOSITORY / "build" / "release"
PROGRAM = BUILD / "bin" / "openstream-sim"
FLAGS = ("-fstack-protector-strong", "-fstack-clash-protection", "-fcf-protection", "-ftrivial-auto-var-init=zero",
         "-D_FORTIFY_SOURCE=3", "-D_GLIBCXX_ASSERTIONS", "-UNDEBUG")


def read_elf(option):
    return subprocess.run(["readelf", "-W", option, PROGRAM], check=True, capture_output=True, text=True).stdout


class Hardening(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        script = ". scripts/lib.sh; configure release; build release openstream-sim"
        subprocess.run(["bash", "-c", script, "scripts/test"], cwd=REPOSITORY, check=True, stdin=subprocess.DEVNULL)

    def test_the_addresses_of_the_program_are_random(self):
        self.assertRegex(read_elf("--file-header"), r"Type:\s+DYN")
        self.assertRegex(read_elf("--dynamic"), r"FLAGS_1\).*\bPIE\b")

    def test_the_tables_of_the_linker_are_read_only(self):
        self.assertIn("GNU_RELRO", read_elf("--segments"))
        self.assertRegex(read_elf("--dynamic"), r"FLAGS\).*\bBIND_NOW\b")

    def test_no_memory_is_writable_and_executable(self):
        flags = re.findall(r"^ +(?:LOAD|GNU_STACK) .* ([R ][W ][E ]) 0x", read_elf("--segments"), re.MULTILINE)
        self.assertGreater(len(flags), 1)
        self.assertNotIn("RWE", flags)

    def test_stack_canaries_and_checked_functions_are_used(self):
        symbols = read_elf("--dyn-syms")
        self.assertIn("__stack_chk_fail", symbols)
        self.assertRegex(symbols, r"\b__mem(cpy|move|set)_chk\b")

    def test_each_source_is_compiled_with_all_flags(self):
        commands = [command for command in json.loads((BUILD / "compile_commands.json").read_text())
                    if "verify_interface_header_sets" not in command["file"]]  # compiled alone, never linked
        self.assertGreater(len(commands), 20)
        for command in commands:
            words = command["command"].split()
            for flag in FLAGS:
                self.assertIn(flag, words, command["file"])
            after_no_assert = words[words.index("-UNDEBUG"):]
            self.assertNotIn("-DNDEBUG", after_no_assert, command["file"])


if __name__ == "__main__":
    unittest.main()
