"""acsd with an MCS, a broker and two robots: LR01, a simulated vehicle that executes plans, and LR02, which the attacks play."""

import json
import os
import pathlib
import re
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request

REPOSITORY = pathlib.Path(__file__).resolve().parents[3]
sys.path += [str(REPOSITORY / "scripts"), str(REPOSITORY / "tests" / "scenario")]
import operator_api  # noqa: E402
from mcs_stub import McsStub  # noqa: E402
from plan_samples import make_carrying_plan  # noqa: E402
from production_line import Line  # noqa: E402
from vehicle_samples import make_idle_state, make_vehicle_message  # noqa: E402

SITE = REPOSITORY / "examples" / "site"
TABLES = re.compile(r"(mcs|mqtt|site|store|stations.*|robots\.LR01|actions\.Cassette.*)$")
HOSTILE = "LR02"
HOSTILE_NODE, HOSTILE_PLACE, HOSTILE_MAP = "N015", (30.5, 4.0), "floor-1"
POSITION_PERIOD = 0.2
PLANS = 20  # more than LR01 completes during a measurement
READY_SECONDS = 60
ANSWER_SECONDS = 5
STOP_SECONDS = 30
POLL_SECONDS = 0.05


def write_config(folder):
    """The example site with two robots without an arm, and with the defaults for every key that an older acsd may lack."""
    tables = re.split(r"(?m)^(?=\[)", (SITE / "acsd.toml").read_text())
    kept = [table for table in tables if TABLES.match(re.match(r"\[?([^\]\n]*)", table).group(1))]
    text = "".join(kept).replace('"site.lif.json"', f'"{SITE / "site.lif.json"}"')
    text += f"""
[robots.{HOSTILE}]
type = "LR"
manufacturer = "ACS"
serial = "{HOSTILE}"
vehicle_type = "lr-base"
start_node = "{HOSTILE_NODE}"
ports = ["CP01"]
"""
    path = folder / "attacked.toml"
    path.write_text(text)
    return path


class AttackedLine:
    """Use it in a `with` statement."""

    def __init__(self, bin_dir, acsd):
        self.line = Line(bin_dir, SITE)
        self.stub = McsStub()
        self._binary = acsd
        self._children = []

    def __enter__(self):
        self.line.__enter__()
        return self

    def __exit__(self, *_):
        for child in self._children:
            child.kill()
            child.wait()
        self.stub.close()
        self.line.stop()

    def start(self, attack):
        """All programs; acsd as the attack needs it. Returns when acsd executes a plan."""
        self.broker_port = self.line.start_broker()
        self.start_vehicle()
        self.publish("connection", make_vehicle_message(HOSTILE, 1, connectionState="ONLINE"), "-r")
        config = write_config(self.line.folder)
        settings = [f"mcs.url=ws://{self.stub.address}/acs/", f"mqtt.url=mqtt://{attack.host}:{self.broker_port}",
                    f"store.directory={self.line.folder / 'store'}", "http.listen=127.0.0.1:0"]
        if self.has_key(config, "operator.listen=127.0.0.1:0"):
            settings.append("operator.listen=127.0.0.1:0")
        self.acsd = self.line.start(
            "acsd", "--config", config, *[part for setting in settings for part in ("--set", setting)], binary=self._binary,
            environment=os.environ | attack.get_environment(), log_descriptor=attack.get_log_descriptor())
        addresses = self.acsd.wait_ready()
        self.http = addresses["http"]
        self.operator = addresses.get("operator", self.http)
        self.wait_for(lambda: self.read_status()["links"]["mqtt"], "acsd is not connected to the broker")
        self.publish("state", make_idle_state(HOSTILE, 0, node=HOSTILE_NODE, place=HOSTILE_PLACE, map_id=HOSTILE_MAP))
        self.wait_for(self.is_visible, "the two robots have no position")
        for number in range(PLANS):
            self.stub.send_request("ExecutionPlan", make_carrying_plan(f"P{number}"))
        self.stub.wait_for("PlanReport", lambda message: message.payload["status"] == "InProgress")

    def start_vehicle(self):
        self.line.start_vehicles(1, ("LR01,type=LR",), port=self.broker_port).wait_ready()

    def has_key(self, config, setting):
        return subprocess.run([self._binary, "--config", config, "--check-config", "--set", setting], check=False,
                              capture_output=True).returncode == 0

    def is_visible(self):
        """In the last message with positions."""
        positions = [message for message in self.stub.get(-50) if message.command == "RobotPositionUpdate"]
        robots = {robot["robotId"] for robot in positions[-1].payload["robots"]} if positions else set()
        return {"LR01", HOSTILE} <= robots

    # The broker.

    def stop_broker(self):
        self.line.forget(self.line.broker)
        self.line.broker.stop()

    def restart_broker(self):
        self.line.start_broker(port=self.broker_port)

    def publish(self, topic, message, *options):
        """One message of the hostile vehicle."""
        self.start_publisher(topic, *options).communicate((message + "\n").encode(), timeout=READY_SECONDS)

    def start_publisher(self, topic, *options):
        """Each line of its standard input is a message of the hostile vehicle."""
        child = subprocess.Popen(["mosquitto_pub", "-p", str(self.broker_port), "-q", "1", "-t",
                                  f"uagv/v2/ACS/{HOSTILE}/{topic}", *options, "-l"], stdin=subprocess.PIPE)
        self._children.append(child)
        return child

    # The program under attack.

    def read(self, address, path):
        """Status and body; of an acsd that does not answer 0."""
        try:
            with urllib.request.urlopen(f"http://{address}{path}", timeout=ANSWER_SECONDS) as response:
                return response.status, response.read().decode()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, error.read().decode()
        except OSError:
            return 0, ""

    def read_status(self):
        status, body = self.read(self.operator, "/v1/snapshot")
        unknown = {"links": {"mqtt": None, "mcs": None}, "notReadyReasons": [], "alarms": []}
        return operator_api.make_state(json.loads(body)) if status == 200 else unknown

    def read_metric(self, name):
        """The sum over all labels; None if acsd has no such metric or does not answer. `name` may end with some labels."""
        _, body = self.read(self.http, "/metrics")
        values = [float(line.rsplit(" ", 1)[1]) for line in body.splitlines() if line.startswith(name)]
        return int(sum(values)) if values else None

    def post(self, path, body=None):
        try:
            return operator_api.post(self.operator, path, body, ANSWER_SECONDS)[0] == 202
        except OSError:
            return False

    def is_alive(self):
        return self.acsd.is_running() and self.read(self.http, "/livez")[0] == 200

    @staticmethod
    def has_become(is_true, seconds):
        deadline = time.monotonic() + seconds
        while not is_true():
            if time.monotonic() > deadline:
                return False
            threading.Event().wait(POLL_SECONDS)
        return True

    def wait_for(self, is_true, what):
        if not self.has_become(is_true, READY_SECONDS):
            raise RuntimeError("\n".join([what, *self.acsd.tail()]))

    def stop_acsd(self):
        """The exit code."""
        self.line.forget(self.acsd)
        return self.acsd.stop(STOP_SECONDS)
