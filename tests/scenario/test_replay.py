#!/usr/bin/env python3
"""acsd replay repeats recorded runs of the whole line: with faults, with the first difference, and without a beginning."""

import json
import os
import subprocess
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, STATUS_SECONDS, main
from traced_line import TracedLineCase

REPLAY_SECONDS = 120


class Replay(TracedLineCase):
    def replay(self, path):
        return subprocess.run([self.bin_dir / "acsd", "replay", path], capture_output=True, text=True, check=False,
                              timeout=REPLAY_SECONDS)

    def record(self):
        """acsd is killed while LR01 drives. The files of the trace, of both runs."""
        self.start_line()
        self.wait_for(lambda: self.read_drives(), "LR01 drives")
        self.kill(self.acsd)
        self.start_acsd()
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        self.line.forget(self.acsd)
        self.assertEqual(self.acsd.stop(), 0)
        return sorted(self.trace.glob("acsd-*.ndjson"))

    def test_runs_with_a_crash_replay_without_a_difference(self):
        files = self.record()
        replayed = self.replay(self.trace)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        self.assertEqual(replayed.stdout.count("no difference: "), 2, replayed.stdout)

        # One report of the recorded run is changed: it is the first difference.
        lines = files[-1].read_text().splitlines()
        place = next(i for i, line in enumerate(lines) if json.loads(line).get("kind") == "report"
                     and "Completed" in line)
        lines[place] = lines[place].replace("Completed", "Cancelled\u202e\u009b")
        changed = self.line.folder / "changed.ndjson"
        changed.write_text("\n".join(lines) + "\n")
        replayed = self.replay(changed)
        self.assertEqual(replayed.returncode, 1, replayed.stdout + replayed.stderr)
        self.assertIn(f"(changed.ndjson:{place + 1})", replayed.stdout)
        self.assertRegex(replayed.stdout, r"expected: .*Cancelled\\xe2\\x80\\xae\\xc2\\x9b.*\n  actual: .*Completed")
        self.assertTrue(replayed.stdout.replace("\n", "").isprintable(), replayed.stdout)

        # A transaction that ends twice.
        lines = files[-1].read_text().splitlines()
        records = [json.loads(line) for line in lines]
        inputs = [i for i, record in enumerate(records)
                  if record["link"] == "core" and record["direction"] == "in" and "depth" not in record]
        # After it the engine has begun no other one.
        stored, following = next(
            (i, j) for i, j in zip(inputs, inputs[1:])
            if records[i]["kind"] == "stored" and "store" not in [record.get("kind") for record in records[i:j]])
        changed.write_text("\n".join([*lines[:following], lines[stored], ""]))
        replayed = self.replay(changed)
        self.assertEqual(replayed.returncode, 2, replayed.stdout + replayed.stderr)
        self.assertIn(f"changed.ndjson:{following + 1}: the end of a transaction that has not begun", replayed.stderr)

        # Written by another program, with blanks.
        spaced = self.line.folder / "spaced.ndjson"
        spaced.write_text("".join(json.dumps(json.loads(line)) + "\n" for line in files[-1].read_text().splitlines()))
        replayed = self.replay(spaced)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        self.assertRegex(replayed.stdout, r"no difference: [1-9]\d* reports, [1-9]\d* commands")

        # The same file without its beginning.
        changed.write_text("\n".join(line for line in lines if '"kind":"begin"' not in line) + "\n")
        replayed = self.replay(changed)
        self.assertEqual(replayed.returncode, 2)
        self.assertIn("the beginning of the run is missing", replayed.stderr)

    def test_the_time_line_of_a_plan_has_all_links_the_engine_and_the_store(self):
        self.start_line()
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        plan_id = json.loads(PLANS[0].read_text())["planId"]
        address = f"http://{self.operator}/v1/trace?limit=1000&plan={plan_id}"
        with urllib.request.urlopen(address, timeout=STATUS_SECONDS) as response:
            lines = [json.loads(line) for line in response.read().splitlines()]
        self.assertEqual({line["link"] for line in lines}, {"mcs", "mqtt", "engine", "store"})
        self.assertEqual({line["plan"] for line in lines}, {plan_id})
        times = [line["mono_us"] for line in lines]
        self.assertEqual(times, sorted(times))
        states = [line["text"] for line in lines if line.get("kind") == "plan"]
        self.assertIn("InProgress -> Completed", states[-1])

    def test_what_is_no_trace_is_refused(self):
        empty = self.line.folder / "empty"
        empty.mkdir()
        damaged = self.line.folder / "damaged.ndjson"
        damaged.write_text('{"time":"2026-01-01T00:00:00.000Z","mono_us":1,"link":"core",\n')
        pipe = self.line.folder / "pipe"
        os.mkfifo(pipe)
        for path, reason in ((empty, "a file of a trace"), (self.line.folder / "missing", "a file of a trace"),
                             (damaged, "not a trace of acsd: damaged.ndjson:1: "), (PLANS[0], "not a trace of acsd: "),
                             (pipe, "a regular file or a folder"), ("/dev/zero", "a regular file or a folder")):
            replayed = self.replay(path)
            self.assertEqual(replayed.returncode, 2, path)
            self.assertIn(reason, replayed.stderr)
            self.assertEqual(replayed.stderr.count("\n"), 1, replayed.stderr)


if __name__ == "__main__":
    main()
