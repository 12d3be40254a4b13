#!/usr/bin/env python3
"""e21_relay between e20_mcs_journal and acsd with simulated robots: relay and MCS are killed and the link of acsd
is cut while plans are executed. At the end the journal of the MCS has each report that acsd has sent, once, and they match what
the robots have moved."""

import json
import random
import signal
import subprocess

from journal_line import FULL, KINDS, JournalCase
from link_proxy import LinkProxy
from scenario_case import FINISH_SECONDS, STATUS_SECONDS, ScenarioCase, main

STRIKES = 9


class Relay(JournalCase):
    def start_relay(self):
        self.relay = self.line.start("e21_relay", self.relay_port, f"ws://127.0.0.1:{self.port}/acs/")
        self.relay_port = int(self.relay.wait_ready()["ws"].rsplit(":", 1)[1])
        return self.relay_port

    def kill(self, program):
        self.line.forget(program)
        program.send_signal(signal.SIGKILL)
        program.stop()

    def start_relay_behind_proxy(self):
        self.proxy = LinkProxy(self.start_relay())
        self.addCleanup(self.proxy.close)
        return self.proxy.port

    def test_the_relay_and_the_mcs_are_killed_and_the_link_of_the_acs_is_cut(self):
        self.relay_port = 0
        self.start_line(find_port=self.start_relay_behind_proxy)
        moments = random.Random(1)
        for number in range(STRIKES):
            count = len(self.journal.reports) + moments.randint(1, 10)
            self.wait_until(lambda: self.supply() or len(self.journal.reports) >= count, "reports pass the relay")
            if number % 3 == 0:
                self.kill(self.relay)
                self.start_relay()
            elif number % 3 == 1:
                self.kill(self.mcs)
                self.start_mcs()
            else:
                self.proxy.cut()
                self.proxy.mend()
        self.wait_for_the_end_of_all_plans()
        self.judge()
        self.assertTrue(all(self.journal.plans[kind] for kind in KINDS))

    def test_a_fail_of_the_mcs_passes_the_relay(self):
        self.relay_port = 0
        self.start_line(find_port=self.start_relay)
        self.write_plan("LR")
        self.wait_until(lambda: self.journal.reports, "a first report is written")
        self.limit_journal(0)
        self.wait_for_status(self.operator, lambda status: status["refusedReports"]["count"] > 0)
        self.assertEqual(self.read_status(self.operator)["refusedReports"]["last"]["message"], FULL)

    def test_without_an_acs_a_request_is_refused(self):
        steps = [{"send": "RequestAcsPlans"}, {"expect": "RequestAcsPlansAck", "result": "Fail", "within": "5s"},
                 {"send": "CancelPlan", "payload": {"planId": "P"}}, {"expect": "CancelPlanAck", "result": "Fail", "within": "5s"}]
        scenario = self.line.folder / "scenario.json"
        scenario.write_text(json.dumps({"name": "no-acs", "about": "A relay without an ACS", "within": "30s", "steps": steps}))
        self.mcs = self.line.start_mcs([], "--scenario", scenario)
        self.port = int(self.mcs.wait_ready()["ws"].rsplit(":", 1)[1])
        self.relay_port = 0
        self.start_relay()
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0, self.mcs.tail(20))

    def test_a_control_that_a_lost_acs_has_not_answered_is_refused(self):
        self.mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", "--console", stdin=subprocess.PIPE, bufsize=0)
        self.addCleanup(self.mcs.process.stdin.close)
        self.port = int(self.mcs.wait_ready()["ws"].rsplit(":", 1)[1])
        self.relay_port = 0
        acs = self.line.start("acs-sim", "--url", f"ws://127.0.0.1:{self.start_relay()}/acs/")
        ScenarioCase.wait_until(self, lambda: "the ACS is registered" in self.relay.tail(100), "the ACS is registered")
        acs.send_signal(signal.SIGSTOP)
        self.mcs.process.stdin.write(b"cancel P\n")
        ScenarioCase.wait_until(self, lambda: "CancelPlan" in self.mcs.log.read_text(), "the control is sent")
        self.kill(acs)
        ScenarioCase.wait_until(self, lambda: "P CancelPlanAck Fail: " in self.mcs.log.read_text(), "the control is refused",
                                STATUS_SECONDS)


if __name__ == "__main__":
    main()
