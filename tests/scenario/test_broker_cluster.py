#!/usr/bin/env python3
"""acsd and vehicles on a cluster of three nodes of nats-server: nodes are killed while plans run, and no plan fails and no job is
done twice. With --long all tests, without it a sample.

--seed N  seed of the kills at random moments; printed on failure
"""

import argparse
import collections
import datetime
import json
import random
import sys
import time
import unittest
import urllib.request

from nats_cluster import NatsCluster
from scenario_case import PLANS, TIME_SCALE, ScenarioCase
from scenario_case import main as run_tests
from kill_case import Trace, make_expected

VEHICLES = {"LR01": "LR01,type=LR,node=D-CHG01", "CR01": "CR01,type=CR,node=D-CHG02"}
VEHICLE_NODES = {"LR01": 1, "CR01": 2}  # acsd begins with node 0
REPEATS = 2
UP_SECONDS = 120
PLANS_SECONDS = 240
REQUESTS = ("factsheetRequest", "stateRequest")
RANDOM_KILLS = 6
RANDOM_REPEATS = 12  # about two plans for each kill
SETTINGS = argparse.Namespace(long=False, seed=1)


class BrokerCluster(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.killed_at = None

    def start_cluster(self, users=()):
        self.cluster = NatsCluster(self.line, users)
        self.cluster.start()

    def start_line(self, urls=None, qos=1, vehicle_options=(), overrides=(), repeats=REPEATS):
        """Each vehicle is a process of its own; all simulators share the floor."""
        self.line.share_world()
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        self.vehicles = {name: self.line.start(
            f"vda-sim-{name}", *[part for url in self.cluster.list_from(VEHICLE_NODES[name]) for part in ("--broker", url)],
            "--max-qos", qos, "--no-control", "--site", self.line.site_dir / "site.lif.json", "--time-scale", TIME_SCALE,
            "--vehicle", spec, "--world", self.line.world, *vehicle_options, binary=self.line.bin_dir / "vda-sim")
            for name, spec in VEHICLES.items()}
        for vehicle in self.vehicles.values():
            vehicle.wait_ready(UP_SECONDS)
        trace_file = self.line.folder / "mcs.ndjson"
        self.trace = Trace(trace_file)
        self.plan_count = repeats * len(PLANS)
        self.mcs = self.line.start_mcs(PLANS, "--repeat", repeats, "--trace", trace_file)
        self.acsd = self.line.start_acsd(
            self.mcs.wait_ready()["ws"], arm, f"mqtt.urls={json.dumps(urls or self.cluster.urls)}", f"mqtt.max_qos={qos}",
            *overrides, config=self.write_cluster_config(), arguments=("--trace", self.line.folder / "trace"))
        self.operator = self.acsd.wait_ready()["operator"]

    def read_broker(self):
        """The URL of the broker that acsd is connected to, or None."""
        with urllib.request.urlopen(f"http://{self.operator}/v1/links", timeout=UP_SECONDS) as response:
            links = {link["name"]: link for link in json.load(response)["links"]}
        self.assertEqual(links["mqtt"]["up"], links["mqtt"]["broker"] is not None)
        return links["mqtt"]["broker"]

    def wait_for_jobs(self, count):
        """Until each robot has begun this number of jobs."""
        def has_begun():
            self.trace.update()
            begun = collections.Counter(self.get_robot(plan) for plan_id, plan in self.trace.plans.items()
                                        for report in self.trace.get_reports(plan_id) if report[-1] == "Instructed")
            return all(begun[robot] >= count for robot in VEHICLES)
        self.wait_until(has_begun, f"each robot begins {count} jobs", UP_SECONDS)

    @staticmethod
    def get_robot(plan):
        return "LR01" if plan["steps"][0]["action"].startswith("Cassette") else "CR01"

    def kill(self, *nodes):
        self.killed_at = time.time()
        self.cluster.kill(*nodes)

    def list_demanded_moves(self, robot):
        moves = []
        for plan in self.trace.plans.values():
            for step in plan["steps"] if self.get_robot(plan) == robot else ():
                carriers = step["carrierIds"] or [None] * len(step["jobs"])
                moves += [(carrier, job["from"].replace("AMR.", f"{robot}."), job["to"].replace("AMR.", f"{robot}."))
                          for carrier, job in zip(carriers, step["jobs"])]
        return moves

    def read_moves(self, robot):
        lines = (self.line.folder / "world.json.journal").read_text(encoding="utf-8").splitlines()
        return [(event.get("carrier"), event["from"], event["to"]) for event in map(json.loads, lines)
                if event["event"] in ("CarrierMoved", "MemoryMoved") and event["robot"] == robot]

    def judge(self):
        """All plans are completed, each report came once, and each job moved its carrier once."""
        self.assertEqual(self.mcs.wait(PLANS_SECONDS), 0)
        self.assert_last_line(self.mcs, f"{self.plan_count} plans completed, 0 failed")
        self.trace.update()
        self.assertEqual(self.trace.faults, [])
        self.assertEqual(len(self.trace.plans), self.plan_count)
        for plan_id, plan in self.trace.plans.items():
            self.assertEqual(self.trace.get_reports(plan_id), make_expected(plan), plan_id)
        for robot in VEHICLES:
            self.assertEqual(self.read_moves(robot), self.list_demanded_moves(robot), "each job is done once")

    def read_requests(self):
        """The instant actions that acsd has sent to each robot since the last kill."""
        sent = {name: set() for name in VEHICLES}
        for path in sorted((self.line.folder / "trace").iterdir()):
            *lines, _ = path.read_text(encoding="utf-8").split("\n")  # without one that is being written
            for entry in map(json.loads, lines):
                if entry.get("link") == "mqtt" and entry["direction"] == "out" and entry["topic"].endswith("/instantActions") \
                        and self.is_later(entry["time"]):
                    sent[entry["robot"]] |= {action["actionType"] for action in json.loads(entry["text"]).get("actions", ())}
        return sent

    def is_later(self, text):
        return datetime.datetime.fromisoformat(text).timestamp() > self.killed_at

    def wait_for_requests(self):
        self.wait_until(lambda: all(sent.issuperset(REQUESTS) for sent in self.read_requests().values()),
                        "acsd requests state and factsheet of each vehicle", UP_SECONDS)

    def run_with_kill_of_acsds_node(self, qos):
        self.start_cluster()
        self.start_line(qos=qos)
        self.wait_for_jobs(1)
        self.wait_until(self.read_broker, "acsd is connected", UP_SECONDS)
        first = self.read_broker()
        self.kill(self.cluster.find(first))
        self.wait_until(lambda: self.read_broker() not in (None, first), "acsd connects to another node", UP_SECONDS)
        self.wait_for_requests()
        left, following = (url.removeprefix("mqtt://") for url in self.cluster.list_from(self.cluster.find(first))[:2])
        self.assertRegex(self.acsd.log.read_text(), f"lost the MQTT broker at {left} .*; trying {following} next\n")
        self.wait_until(lambda: f'acsd_mqtt_broker_connected{{broker="{self.read_broker()}"}} 1\n' in self.read_metrics(),
                        "the metrics name the connected broker", UP_SECONDS)
        self.assertIn(f'acsd_mqtt_broker_connected{{broker="{first}"}} 0\n', self.read_metrics())
        self.judge()

    def read_metrics(self):
        with urllib.request.urlopen(f"http://{self.acsd.addresses['http']}/metrics", timeout=UP_SECONDS) as response:
            return response.read().decode()

    def test_the_node_of_acsd_is_killed(self):
        self.run_with_kill_of_acsds_node(qos=0)

    def test_the_node_of_acsd_is_killed_at_qos_1(self):
        self.skip_unless_long()
        self.run_with_kill_of_acsds_node(qos=1)

    def test_the_nodes_of_the_vehicles_are_killed(self):
        """One after the other; each comes back before the next one is killed, since two of three are needed. acsd may lose its
        connection too: nats-server closes it if the cluster does not store a message of QoS 1 in 4 s."""
        self.skip_unless_long()
        self.start_cluster()
        self.start_line()
        for jobs, (name, node) in enumerate(VEHICLE_NODES.items(), 1):
            self.wait_for_jobs(jobs)
            self.kill(node)
            log, address = self.vehicles[name].log, self.cluster.urls[node].removeprefix("mqtt://")
            self.wait_until(lambda: f"lost the MQTT broker at {address}" in log.read_text()
                            and "connected to the MQTT broker" in log.read_text().split("lost the MQTT broker")[-1],
                            f"{name} connects to another node", UP_SECONDS)
            self.cluster.start(node)
        self.judge()

    def test_all_nodes_are_killed_and_started_again(self):
        self.skip_unless_long()
        self.start_cluster()
        self.start_line()
        self.wait_for_jobs(1)
        self.kill()
        self.wait_until(lambda: self.read_broker() is None, "acsd reports the lost broker", UP_SECONDS)
        self.cluster.start()
        self.wait_until(self.read_broker, "acsd is connected again", UP_SECONDS)
        self.judge()

    def test_nodes_are_killed_at_random_moments(self):
        self.skip_unless_long()
        choices = random.Random(SETTINGS.seed)
        self.start_cluster()
        self.start_line(qos=0, repeats=RANDOM_REPEATS)
        self.wait_for_jobs(1)
        kills = 0
        while self.mcs.is_running() and kills < RANDOM_KILLS:
            time.sleep(choices.uniform(0.0, 3.0))  # the moment is the subject of the test
            node = choices.randrange(len(self.cluster.urls))
            self.kill(node)
            self.cluster.start(node)
            self.wait_until(self.read_broker, f"acsd is connected again, --seed {SETTINGS.seed}", UP_SECONDS)
            kills += 1
        self.assertGreater(kills, RANDOM_KILLS // 2, "too few plans")
        self.judge()

    def test_nodes_that_cannot_be_used_are_reported_and_the_next_one_is_used(self):
        """The host of the first URL has no address, and the node of the second has another password."""
        self.skip_unless_long()
        accounts = [("acs", "other"), ("acs", "secret"), ("acs", "secret")]
        self.start_cluster(accounts)
        password = self.line.folder / "password"
        password.touch(mode=0o600)
        password.write_text("secret\n", encoding="utf-8")
        self.start_line(urls=["mqtt://no-such-host.invalid:1883", *self.cluster.urls],
                        vehicle_options=("--user", "acs", "--password-file", password),
                        overrides=("mqtt.username=acs", f"mqtt.password_file={password}"))
        self.judge()
        self.assertIn(f"connected to the MQTT broker broker={self.cluster.urls[1].removeprefix('mqtt://')}", self.acsd.log.read_text())
        log = self.acsd.log.read_text()
        self.assertIn("cannot reach the MQTT broker at no-such-host.invalid:1883", log)
        self.assertIn("check the name of its host", log)
        self.assertIn(f"cannot reach the MQTT broker at {self.cluster.urls[0].removeprefix('mqtt://')}", log)
        self.assertIn("check user name, password and client id", log)
        self.assertNotIn("secret", log)

    @staticmethod
    def skip_unless_long():
        if not SETTINGS.long:
            raise unittest.SkipTest("with --long")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--seed", type=int, default=SETTINGS.seed)
    SETTINGS, rest = parser.parse_known_args()
    sys.argv[1:] = rest
    run_tests()
