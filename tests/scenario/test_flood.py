#!/usr/bin/env python3
"""A vehicle that floods acsd with errors: acsd answers, and what it stores is limited."""

import shutil
import sqlite3
import subprocess
import time
import urllib.request

from scenario_case import FINISH_SECONDS, ScenarioCase, main
import operator_api  # which scenario_case makes known
from vehicle_samples import make_idle_state, make_vehicle_message

ERRORS = 10_000  # of one state
STATES = 20
LAST_CHARGE = 42.0
ANSWER_SECONDS = 1
REQUEST_PERIOD = 0.02
MOST_ALARMS = 21  # of one robot about its errors: 20 of their own, and the one that has the number of the others
MOST_REPORTS = 150  # in the first minute: 60 errors set and cleared, the one above, and those of the lost connections


def make_state(number):
    """Each with errors that no other state has."""
    errors = [(f"fault-{number}-{i}", f"fault {i} of the test") for i in range(ERRORS)]
    return make_idle_state("LR01", number, errors, LAST_CHARGE if number == STATES - 1 else LAST_CHARGE + 1)


class Flood(ScenarioCase):
    def publish(self, topic, messages, *options):
        binary = shutil.which("mosquitto_pub")
        self.assertIsNotNone(binary, "mosquitto_pub is missing; run scripts/setup")
        subprocess.run([binary, "-p", str(self.line.broker_port), "-q", "1", "-t", f"uagv/v2/ACS/LR01/{topic}", *options, "-l"],
                       input="".join(message + "\n" for message in messages), text=True, check=True, timeout=FINISH_SECONDS)

    def measure_live(self, address):
        """Seconds until the answer."""
        begin = time.monotonic()
        with urllib.request.urlopen(f"http://{address}/livez", timeout=FINISH_SECONDS) as response:
            self.assertEqual(response.status, 200)
        return time.monotonic() - begin

    def test_19_5_a_vehicle_with_10000_other_errors_in_each_state(self):
        self.line.start_broker()
        acsd = self.line.start_acsd("127.0.0.1:1", {"stream": "127.0.0.1:1"})  # no MCS takes the reports
        addresses = acsd.wait_ready()
        address = addresses["operator"]
        self.wait_for_status(address, lambda status: status["links"]["mqtt"])
        self.publish("connection", [make_vehicle_message("LR01", 1, connectionState="ONLINE")], "-r")
        self.publish("state", map(make_state, range(STATES)))

        def is_last_state_read(status):
            return any(robot["robotId"] == "LR01" and robot["battery"] == LAST_CHARGE for robot in status["robots"])

        waits = []
        deadline = time.monotonic() + FINISH_SECONDS
        # Sanitized and on a busy machine, acsd needs about a second for each state.
        while not is_last_state_read(operator_api.read_state(address, FINISH_SECONDS)):
            self.assertLess(time.monotonic(), deadline, f"not all states were read; /livez took {waits} s")
            waits.append(self.measure_live(addresses["http"]))
            time.sleep(REQUEST_PERIOD)
        self.assertLess(max(waits, default=0), ANSWER_SECONDS)
        status = self.read_status(address)
        self.assertLessEqual(status["outbox"]["reports"], MOST_REPORTS)
        codes = [alarm["errorCode"] for alarm in status["alarms"] if alarm["robotId"] == "LR01"]
        self.assertIn("ACS-1014", codes)
        self.assertLessEqual(sum(code.startswith("AGV-") or code == "ACS-1014" for code in codes), MOST_ALARMS)

        self.line.forget(acsd)
        self.assertEqual(acsd.stop(), 0)
        with sqlite3.connect(f"file:{self.line.folder}/store/acsd.db?mode=ro", uri=True) as store:
            (reports,), = store.execute("SELECT count(*) FROM reports")
        store.close()
        self.assertLessEqual(reports, MOST_REPORTS)


if __name__ == "__main__":
    main()
