#!/usr/bin/env python3
"""SIGHUP: acsd reads its configuration again, as in docs/reference/configuration.md."""

import os
import signal

from mcs_stub import McsStub
from plan_samples import make_carrying_plan
from scenario_case import SITE, ScenarioCase, main


class Reload(ScenarioCase):
    def write_config(self, *changes):
        text = (SITE / "acsd.toml").read_text().replace('map = "site.lif.json"', f'map = "{SITE / "site.lif.json"}"')
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        path = self.line.folder / "acsd.toml"
        path.write_text(text)
        return path

    def submit(self, stub, plan_id):
        return stub.ask("ExecutionPlan", make_carrying_plan(plan_id))

    def test_sighup_applies_what_may_change_and_reports_the_rest(self):
        stub = McsStub()
        self.addCleanup(stub.close)
        acsd = self.line.start_acsd(
            stub.address, self.start_robots(), config=self.write_config(), arguments=("--log-level", "info")
        )
        acsd.wait_ready()
        self.wait_for_log(acsd, "registered with the MCS")

        self.write_config(
            ('grace = "10s"', 'grace = "9s"'),
            ('ack_timeout = "5s"', 'ack_timeout = "6s"'),
            ('level = "info"', 'level = "error"'),
        )
        acsd.send_signal(signal.SIGHUP)
        self.wait_for_log(acsd, "applied key=comm.grace")
        self.wait_for_log(acsd, "needs a restart of acsd key=mcs.ack_timeout")
        self.assertNotIn("key=log.level", acsd.log.read_text())  # --log-level overrides it

        self.write_config(('grace = "10s"', 'grace = "soon"'), ("max_plans = 100", "max_plans = 0"))
        acsd.send_signal(signal.SIGHUP)
        self.wait_for_log(acsd, "the previous one stays in effect")
        log = acsd.log.read_text()
        for key in ("comm.grace", "queue.max_plans"):
            self.assertRegex(log, rf"configuration not reloaded error=.*acsd\.toml:\d+: {key}: ")
        self.assertTrue(acsd.is_running())
        self.assertEqual(self.submit(stub, "P1")["result"], "Success")

        # A pipe without a writer must not block acsd.
        file = self.line.folder / "acsd.toml"
        file.unlink()
        os.mkfifo(file)
        acsd.send_signal(signal.SIGHUP)
        self.wait_for_log(acsd, "it is a pipe; only regular files are read")
        self.assertEqual(self.submit(stub, "P2")["result"], "Success")

    def test_sighup_reports_warnings_and_files_that_need_a_restart(self):
        tokens, site = self.line.folder / "tokens", self.line.folder / "site.lif.json"
        tokens.touch(mode=0o600)
        tokens.write_text(f"viewer anna {'0' * 64}\n")
        site.write_text((SITE / "site.lif.json").read_text())
        self.line.start_broker()
        acsd = self.line.start_acsd("127.0.0.1:1", {"stream": "127.0.0.1:1"}, f"operator.tokens_file={tokens}", f"site.map={site}")
        acsd.wait_ready()
        tokens.write_text("")
        site.write_text(site.read_text() + "\n")
        acsd.send_signal(signal.SIGHUP)
        self.wait_for_log(acsd, "has no token, so every token is refused")
        self.wait_for_log(acsd, "needs a restart of acsd key=site.map")
        self.assertTrue(acsd.is_running())

    def test_sighup_during_the_start_is_answered_after_it(self):
        library = self.line.bin_dir / "libscenario_held_disk.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        gate = self.line.folder / "held"
        os.mkfifo(gate)
        self.line.start_broker()
        acsd = self.line.start_acsd(
            "127.0.0.1:1", {"stream": "127.0.0.1:1"}, arguments=("--log-level", "info"),
            environment=os.environ | {"LD_PRELOAD": str(library), "ACS_HELD_DISK": str(gate)})
        writer = os.open(gate, os.O_WRONLY)  # waits until acsd creates its store
        acsd.send_signal(signal.SIGHUP)
        gate.unlink()
        os.close(writer)
        acsd.wait_ready()
        self.wait_for_log(acsd, "configuration reloaded without changes")


if __name__ == "__main__":
    main()
