#!/usr/bin/env python3
"""Whatever is killed at any moment: no acknowledged plan is lost, each has exactly one final report, reports come in causal
order, and no job is done twice. Checked with mcs-sim's trace, the states that the vehicles publish and the counters of the
arm's controller; when acsd is killed before a program starts, also with the floor of the simulators.

--kills N   number of kills in each test (5)
--seed N    seed of the moments; printed on failure
--long      kills the broker, the vehicles, their link and that to the MCS as well, each a tenth as often
"""

import json
import re
import signal
import sys
import threading
import time

from kill_case import FINISH_SECONDS, SETTINGS, KillCase, run_kill_tests
from link_proxy import LineProxy
from scenario_case import PLANS, TIME_SCALE

INPUT_URL = '"/project/plc/set_relay_value"'
NUMBER_INPUT = re.compile(r'"name":"ml105","value":(\d+)')
ANOTHER_JOB = 0.8  # else the same one, once more
START_URL = '"/project/robot/start"'
SHORT_KILLS = 3  # after each, acsd waits 10 s for a start that may be on its way
MOST_LINES = 12  # from the first input of a program to its start, and some more


class InputChecker:
    """Reads what acsd sends to an arm, and kills acsd between the first input of a program and its start."""

    def __init__(self, kill):
        self._kill = kill
        self._most_lines = None  # from the first input on, that are passed; None: nothing is killed
        self._lines = 0
        self._job = None
        self.killed = threading.Event()
        self.starts = 0  # that were passed on
        self.jobs = set()  # numbers of those before whose start acsd was killed

    def arm(self, most_lines):
        self._most_lines = most_lines

    def on_line(self, line):
        """Whether the line is passed on."""
        is_start = START_URL in line
        if self._most_lines is not None and self._lines > 0 and (is_start or self._lines >= self._most_lines):
            self.jobs.add(self._job)
            self._most_lines, self._lines = None, 0
            self._kill()
            self.killed.set()
            return False
        if is_start:
            self.starts += 1
            self._lines = 0
        elif INPUT_URL in line or self._lines > 0:
            self._lines += 1
        if number := NUMBER_INPUT.search(line):
            self._job = number[1]
        return True


class Kill(KillCase):
    def test_acsd_is_killed(self):
        self.start_line()
        self.play(self.kill_acsd, SETTINGS.kills)
        self.judge()

    def test_acsd_is_killed_between_the_inputs_and_the_start_of_a_program(self):
        """Whatever inputs are left in the relays: each job is done once, and moves what its plan demands."""
        self.line.share_world()
        self.plan_files = PLANS[1:]

        def kill():
            self.acsd.process.kill()
            self.acsd.process.wait()

        checker = InputChecker(kill)

        def make_port(port):
            proxy = LineProxy(port, checker.on_line)
            self.addCleanup(proxy.close)
            return proxy.port

        def strike():
            if self.random.random() < ANOTHER_JOB:
                starts = checker.starts
                self.wait_until(lambda: self.supply() or checker.starts > starts, "acsd starts a program")
            checker.arm(self.random.choice((MOST_LINES, self.random.randrange(1, MOST_LINES))))
            end = time.monotonic() + FINISH_SECONDS
            while not checker.killed.wait(0.02):
                self.assertLess(time.monotonic(), end, "acsd starts another program")
                self.supply()
            checker.killed.clear()
            self.line.forget(self.acsd)
            self.acsd.stop()
            self.start_acsd()

        self.start_line(make_arm_port=make_port)
        kills = SETTINGS.kills if SETTINGS.long else min(SETTINGS.kills, SHORT_KILLS)
        self.play(strike, kills)
        self.judge()
        moves = self.list_demanded_moves()
        self.assertEqual(self.read_moves(), moves, "each job moved what its plan demands, once")
        self.assertEqual(self.read_counter("ml100") - 1, len(moves))
        self.assertEqual(checker.starts, len(moves))
        self.assertGreaterEqual(len(checker.jobs), kills // 2, "it was killed before different jobs")
        print(f"{kills} kills before {len(checker.jobs)} jobs ...", end=" ", file=sys.stderr)

    def list_demanded_moves(self):
        moves = []
        for plan in self.trace.plans.values():
            for step in plan["steps"]:
                carriers = step["carrierIds"] or [None] * len(step["jobs"])
                moves += [(carrier, job["from"].replace("AMR.", "CR01."), job["to"].replace("AMR.", "CR01."))
                          for carrier, job in zip(carriers, step["jobs"])]
        return moves

    def read_moves(self):
        """What the robots have moved, memories without a name."""
        lines = (self.line.folder / "world.json.journal").read_text().splitlines()
        return [(event.get("carrier"), event["from"], event["to"]) for event in map(json.loads, lines)
                if event["event"] in ("CarrierMoved", "MemoryMoved")]

    def test_the_broker_is_killed(self):
        self.skip_unless_long()
        self.start_line()

        def strike():
            self.line.forget(self.line.broker)
            self.line.broker.send_signal(signal.SIGKILL)
            self.line.broker.stop()
            self.supply_for(self.random.uniform(0.0, 3.0))
            self.line.start_broker(self.line.broker_port)

        self.play_long(strike)
        self.judge()

    def cut_and_mend(self, proxy):
        proxy.cut()
        self.supply_for(self.random.uniform(0.0, 3.0))
        proxy.mend()

    def test_the_link_to_the_mcs_is_cut(self):
        self.skip_unless_long()
        proxies = []

        def make_port(port):
            proxies.append(self.make_proxy(port))
            return proxies[0].port

        self.start_line(make_mcs_port=make_port)
        self.play_long(lambda: self.cut_and_mend(proxies[0]))
        self.judge()

    def test_the_link_of_the_vehicles_is_cut(self):
        self.skip_unless_long()
        proxies = []

        def make_port(port):
            proxies.append(self.make_proxy(port))
            return proxies[0].port

        self.start_line(make_vehicle_port=make_port)
        self.play_long(lambda: self.cut_and_mend(proxies[0]))
        self.judge()

    def test_the_vehicles_are_killed(self):
        """They lose their orders: what was under way fails once, and everything else continues."""
        self.skip_unless_long()
        self.start_line()

        def strike():
            self.line.forget(self.vehicles)
            self.vehicles.send_signal(signal.SIGKILL)
            self.vehicles.stop()
            self.vehicles = self.line.start_vehicles(TIME_SCALE)
            self.vehicles.wait_ready()

        self.play_long(strike)
        self.judge(all_completed=False)


if __name__ == "__main__":
    run_kill_tests()
