#!/usr/bin/env python3
"""The whole line with real processes: lost links, and the order of writes to the disk."""

import json
import sqlite3
import subprocess
import threading
import time
import unittest

from link_proxy import LinkProxy
from scenario_case import FINISH_SECONDS, PLANS, ScenarioCase, main


class WholeLine(ScenarioCase):
    def run_through(self, proxy_hook):
        """Both example plans through a proxy; returns mcs-sim after it has ended, and the proxy."""
        arm = self.start_robots()
        mcs = self.line.start_mcs(PLANS, "--fresh-ids")
        port = int(mcs.wait_ready()["ws"].rsplit(":", 1)[1])
        proxy = LinkProxy(port, proxy_hook)
        self.addCleanup(proxy.close)
        self.line.start_acsd(f"127.0.0.1:{proxy.port}", arm).wait_ready()
        self.exit_code = mcs.wait(FINISH_SECONDS)
        return mcs, proxy

    def test_a_plan_is_in_the_store_before_its_ack_leaves(self):
        seen = []

        def look_into_store(text):
            message = json.loads(text)
            if message["command"] == "ExecutionPlanAck":
                plan_id = message["payload"]["planId"]
                store = sqlite3.connect(f"file:{self.line.folder}/store/acsd.db?mode=ro", uri=True)
                dump = "\n".join(store.iterdump())
                store.close()
                seen.append((message["result"], plan_id in dump))

        mcs, _ = self.run_through(look_into_store)
        self.assertEqual(seen, [("Success", True), ("Success", True)])
        self.assertEqual(self.exit_code, 0)
        self.assert_last_line(mcs, "2 plans completed, 0 failed")

    def test_acsd_starts_again_on_what_it_has_stored(self):
        arm = self.start_robots()
        mcs = self.line.start_mcs(PLANS[:1], "--fresh-ids")
        acsd = self.line.start_acsd(mcs.wait_ready()["ws"], arm)
        acsd.wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.line.forget(acsd)
        self.assertEqual(acsd.stop(), 0)
        again = self.line.start_mcs(PLANS[:1])  # under its own ids: the store knows none of them
        self.line.start_acsd(again.wait_ready()["ws"], arm).wait_ready()
        self.assertEqual(again.wait(FINISH_SECONDS), 0)
        self.assert_last_line(again, "1 plans completed, 0 failed")

    def test_a_plan_goes_over_wss(self):
        """With a certificate of its own CA; the same certificate without that CA is rejected with the reason."""
        key, certificate = self.line.folder / "mcs.key", self.line.folder / "mcs.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-keyout", key, "-out", certificate, "-days", "2", "-subj", "/CN=mcs",
                        "-addext", "subjectAltName=IP:127.0.0.1"], check=True, capture_output=True)
        arm = self.start_robots()
        mcs = self.line.start_mcs(PLANS[:1], "--tls-certificate", certificate, "--tls-key", key)
        url = f"mcs.url=wss://{next(iter(mcs.wait_ready().values()))}/acs/"
        stranger = self.line.start_acsd("127.0.0.1:1", arm, url, f"store.directory={self.line.folder / 'stranger'}")
        stranger.wait_ready()
        self.wait_for_line(stranger, "cannot reach the MCS")
        self.assertIn("self-signed", stranger.log.read_text())
        self.line.forget(stranger)
        stranger.stop()
        self.line.start_acsd("127.0.0.1:1", arm, url, f"mcs.tls.ca={certificate}").wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assert_last_line(mcs, "1 plans completed, 0 failed")

    def wait_for_line(self, program, text):
        deadline = time.monotonic() + FINISH_SECONDS
        while text not in program.log.read_text() and time.monotonic() < deadline:
            try:
                program.process.wait(0.05)
            except subprocess.TimeoutExpired:
                pass
        self.assertIn(text, program.log.read_text())

    def test_a_lost_link_of_three_seconds_in_mid_plan_loses_nothing(self):
        reports = []
        cut_once = threading.Event()
        proxies = []

        def cut_at_first_job(text):
            message = json.loads(text)
            if message["command"].endswith("Report"):
                reports.append((message["command"], message["transactionId"], message["timestamp"],
                                json.dumps(message["payload"], sort_keys=True)))
            if message["command"] == "JobReport" and not cut_once.is_set():
                cut_once.set()
                # On a thread of its own: the pump that calls this is one of those that are cut.
                threading.Thread(target=self.cut_for_three_seconds, args=(proxies[0],), daemon=True).start()

        arm = self.start_robots()
        mcs = self.line.start_mcs(PLANS, "--fresh-ids")
        port = int(mcs.wait_ready()["ws"].rsplit(":", 1)[1])
        proxies.append(LinkProxy(port, cut_at_first_job))
        self.addCleanup(proxies[0].close)
        self.line.start_acsd(f"127.0.0.1:{proxies[0].port}", arm).wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assert_last_line(mcs, "2 plans completed, 0 failed")
        self.assertTrue(cut_once.is_set())
        self.assertGreaterEqual(proxies[0].connections, 2)
        contents = {}
        for _, transaction_id, *content in reports:
            self.assertEqual(contents.setdefault(transaction_id, content), content,
                             "a report that is sent again keeps its transactionId, timestamp and payload")
        self.assertEqual(len({content[1] for content in contents.values()}), len(contents),
                         "nothing is reported under two transactionIds")

    @staticmethod
    def cut_for_three_seconds(proxy):
        proxy.cut()
        threading.Event().wait(3.0)  # the length of the cut is the subject of the test
        proxy.mend()


if __name__ == "__main__":
    main()
