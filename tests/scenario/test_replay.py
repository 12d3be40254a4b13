#!/usr/bin/env python3
"""acsd replay repeats recorded runs of the whole line: with faults, with the first difference, and without a beginning."""

import json
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
        lines[place] = lines[place].replace("Completed", "Cancelled")
        changed = self.line.folder / "changed.ndjson"
        changed.write_text("\n".join(lines) + "\n")
        replayed = self.replay(changed)
        self.assertEqual(replayed.returncode, 1, replayed.stdout + replayed.stderr)
        self.assertIn(f"(changed.ndjson:{place + 1})", replayed.stdout)
        self.assertRegex(replayed.stdout, r"expected: .*Cancelled.*\n  actual: .*Completed")

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
        for path in (empty, self.line.folder / "missing", damaged):
            self.assertEqual(self.replay(path).returncode, 2, path)


if __name__ == "__main__":
    main()
