#!/usr/bin/env python3
"""e21_relay between e20_mcs_journal and acsd with simulated robots: relay and MCS are killed and the link of acsd
is cut while plans are executed. At the end the journal of the MCS has each report that acsd has sent, once, and they match what
the robots have moved."""

import random
import signal

from journal_line import FULL, KINDS, JournalCase
from link_proxy import LinkProxy
from scenario_case import main

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


if __name__ == "__main__":
    main()
