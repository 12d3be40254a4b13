#!/usr/bin/env python3
"""scripts/bench without a build: what a filter runs, and that each filter in the documents names a program."""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
# Of Google Benchmark: one name in each line, or those that match.
BENCH = '''#!/bin/bash
filter=.
list=
for word; do
    case "$word" in
        --benchmark_filter=*) filter="${word#*=}" ;;
        --benchmark_list_tests) list=1 ;;
    esac
done
names="$(printf '%s\\n' DecodeOrder EncodeOrder/8 | grep -E "$filter")" || { echo "Failed to match any benchmarks" >&2; exit 0; }
[ -n "$list" ] && echo "$names" || echo "ran $names"
'''
LOAD = '#!/bin/bash\necho "ran $(basename "$0")"\n'


class BenchScript(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "scripts").mkdir()
        shutil.copy(REPOSITORY / "scripts" / "bench", self.root / "scripts")
        library = (REPOSITORY / "scripts" / "lib.sh").read_text(encoding="utf-8")
        self.write("scripts/lib.sh", library + "setup() { :; }\nconfigure() { :; }\nbuild() { :; }\n")
        self.write("build/bench/bin/codec_bench", BENCH)
        self.write("build/bench/bin/fleet_load", LOAD)
        self.write("tests/load/attacks/attacks.py", 'print("ran attacks")\n')

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)

    def run_bench(self, *words):
        done = subprocess.run([self.root / "scripts" / "bench", *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)
        return done.returncode, done.stdout.split(), done.stderr

    def test_without_a_filter_everything_runs(self):
        code, ran, _ = self.run_bench()
        self.assertEqual((code, ran), (0, ["ran", "DecodeOrder", "EncodeOrder/8", "ran", "fleet_load", "ran", "attacks"]))

    def test_a_filter_runs_what_it_matches(self):
        for words, expected in ((["Decode"], "DecodeOrder"), (["fleet"], "fleet_load"), (["attacks"], "attacks"),
                                (["^Encode", "--", "--benchmark_repetitions=2"], "EncodeOrder/8")):
            code, ran, errors = self.run_bench(*words)
            self.assertEqual((code, ran), (0, ["ran", expected]), errors)
            self.assertNotIn("Failed to match", errors)

    def test_a_filter_that_matches_nothing_fails_with_the_names(self):
        code, ran, errors = self.run_bench("nothing")
        self.assertEqual((code, ran), (2, []))
        self.assertIn("'nothing' matches none of: DecodeOrder EncodeOrder/8 fleet_load attacks", errors)

    def test_errors_of_the_command_line(self):
        for words in (["--unknown"], ["one", "two"]):
            self.assertEqual(self.run_bench(*words)[:2], (2, []))
        self.assertEqual(self.run_bench("--help")[0], 0)

    def test_each_filter_in_the_documents_matches_a_program(self):
        lists = [path.read_text(encoding="utf-8") for path in (REPOSITORY / "tests" / "load").rglob("CMakeLists.txt")]
        programs = {name for text in lists for name in re.findall(r"add_(?:executable|fleet_load)\((\w+_load)\b", text)}
        self.assertGreater(len(programs), 4)
        pages = [page for page in REPOSITORY.rglob("*.md") if not page.is_relative_to(REPOSITORY / "build")]
        filters = [(page, word) for page in pages for word in re.findall(r"scripts/bench ([\w-]+)", page.read_text(encoding="utf-8"))]
        self.assertGreater(len(filters), 3)
        for page, word in filters:
            found = [name for name in programs if re.search(word, name)]
            self.assertEqual(len(found), 1, f"{page}: scripts/bench {word} runs {found}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
