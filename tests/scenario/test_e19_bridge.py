#!/usr/bin/env python3
"""e19_bridge: a master's order over a real broker becomes commands of a vehicle with another interface, and its progress
becomes VDA5050 states."""

import json
import queue
import shutil
import socket
import subprocess
import threading
import time
import unittest

from scenario_case import FINISH_SECONDS, STATUS_SECONDS, ScenarioCase, main

TOPIC = "uagv/v2/Example/V1"
PLACES = {"N1": (0.0, 0.0), "N2": (2.0, 0.0), "N3": (2.0, 3.0)}


class MakerVehicle:
    """The vehicle: a TCP server. It executes its commands unless it is held, and records them with numbers from 1."""

    def __init__(self):
        self.first = None  # The number of the first command.
        self.commands = []  # as received
        self.executed = []  # each number once
        self.place = (0.0, 0.0)
        self.held = threading.Event()  # While it is set, nothing is executed.
        self.away = threading.Event()  # While it is set, each connection is closed at once.
        self.received = queue.Queue()
        self._server = socket.create_server(("127.0.0.1", 0))
        self.port = self._server.getsockname()[1]
        self._connection = None
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while True:
            try:
                self._connection, _ = self._server.accept()
            except OSError:
                return
            if self.away.is_set():
                self._connection.close()
                continue
            self.send_pose()
            with self._connection.makefile("r") as lines:
                try:
                    for line in lines:
                        self._execute(line.rstrip("\n"))
                except OSError:
                    pass
            self._connection.close()

    def send(self, line):
        self._connection.sendall(f"{line}\n".encode())

    def send_pose(self):
        self.send(f"pose {self.place[0]} {self.place[1]} 0.5 77")

    def _execute(self, command):
        verb, *words = command.split(" ")
        if verb == "stop":
            self._record(command)
            self.send("moving 0")
            return
        self.first = self.first or int(words[0])
        number = int(words[0]) - self.first + 1
        self._record(" ".join((verb, str(number), *words[1:])))
        if not self.held.is_set() and number not in self.executed:
            self.executed.append(number)
            if verb == "goto":
                self.send("moving 1")
                self.place = (float(words[1]), float(words[2]))
                self.send_pose()
            else:
                self.send(f"started {words[0]}")
            self.send(f"done {words[0]}")

    def _record(self, command):
        self.commands.append(command)
        self.received.put(command)

    def disconnect(self):
        self._connection.shutdown(socket.SHUT_RDWR)

    def close(self):
        self._server.close()
        if self._connection is not None:
            self._connection.close()


class Bridge(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.vehicle = MakerVehicle()
        self.addCleanup(self.vehicle.close)
        self.port = self.line.start_broker()
        self.recorder = self.line.start("states", "-p", self.port, "-t", f"{TOPIC}/state", "-F", "%p",
                                        binary=shutil.which("mosquitto_sub"))
        self.start_bridge()

    def start_bridge(self):
        self.bridge = self.line.start("e19_bridge", "127.0.0.1", self.port, "V1", "127.0.0.1", self.vehicle.port)
        # A state from before the vehicle has reported has no position, and a position alone causes no state: ask for the next one.
        # The states of a bridge that ran before have its order.
        self.wait_for(lambda state: not state["errors"] and not state["orderId"]
                      and state.get("agvPosition", {}).get("positionInitialized"),
                      is_next_asked_for=True)

    def read_states(self):
        return [json.loads(line) for line in self.recorder.log.read_text().splitlines() if line.endswith("}")]

    def wait_for(self, is_reached, is_next_asked_for=False):
        deadline = time.monotonic() + STATUS_SECONDS
        count = 0
        while not any(map(is_reached, self.read_states()[-1:])):
            self.assertLess(time.monotonic(), deadline, self.read_states()[-1:])
            time.sleep(0.02)
            seen, count = count, len(self.read_states())
            if count == 0 or is_next_asked_for and count > seen:
                self.ask_state()
        return self.read_states()[-1]

    def ask_state(self):
        self.publish("instantActions", actions=[{"actionType": "stateRequest", "actionId": f"s{time.monotonic_ns()}",
                                                 "blockingType": "NONE"}])

    def publish(self, topic, **members):
        message = {"headerId": 0, "timestamp": "2025-11-21T00:00:00.000Z", "version": "2.0.0", "manufacturer": "Example",
                   "serialNumber": "V1", **members}
        subprocess.run(["mosquitto_pub", "-p", str(self.port), "-t", f"{TOPIC}/{topic}", "-q", "1", "-s"],
                       input=json.dumps(message).encode(), check=True, timeout=STATUS_SECONDS)

    def send_order(self, action_id="beep-1", order_id="order-1", places=PLACES):
        beep = {"actionType": "beep", "actionId": action_id, "blockingType": "HARD", "actionParameters": []}
        nodes = [{"nodeId": name, "sequenceId": 2 * i, "released": True, "actions": [beep] if name == "N2" else []}
                 for i, name in enumerate(places)]
        for node, place in zip(nodes, places.values()):
            if place is not None:
                node["nodePosition"] = {"x": place[0], "y": place[1], "mapId": "floor"}
        names = list(places)
        edges = [{"edgeId": f"E{i}", "sequenceId": 2 * i + 1, "released": True, "startNodeId": start, "endNodeId": end,
                  "actions": []} for i, (start, end) in enumerate(zip(names, names[1:]))]
        self.publish("order", orderId=order_id, orderUpdateId=0, nodes=nodes, edges=edges)

    @staticmethod
    def is_done(state):
        return state["orderId"] == "order-1" and state["lastNodeId"] == "N3" and not state["nodeStates"]

    def test_an_order_is_driven_and_its_action_done_on_the_way(self):
        self.send_order()
        state = self.wait_for(self.is_done)
        self.assertEqual(self.vehicle.commands, ["goto 1 2.000 0.000", "do 2 beep", "goto 3 2.000 3.000"])
        self.assertEqual(self.vehicle.place, PLACES["N3"])
        self.assertEqual((state["agvPosition"]["x"], state["agvPosition"]["y"]), PLACES["N3"])
        self.assertEqual(state["batteryState"]["batteryCharge"], 77)
        self.assertEqual([(action["actionId"], action["actionStatus"]) for action in state["actionStates"]
                          if action["actionType"] == "beep"], [("beep-1", "FINISHED")])
        self.assertFalse(state["driving"])

    def test_an_id_with_a_line_end_does_not_reach_the_vehicle(self):
        self.send_order(action_id="beep\ngoto 99 50 50")
        self.wait_for(self.is_done)
        self.assertEqual(self.vehicle.commands, ["goto 1 2.000 0.000", "do 2 beep", "goto 3 2.000 3.000"])

    def test_a_lost_vehicle_is_reported_and_its_drive_repeated(self):
        self.vehicle.held.set()
        self.send_order()
        self.assertEqual(self.vehicle.received.get(timeout=STATUS_SECONDS), "goto 1 2.000 0.000")
        self.vehicle.held.clear()
        self.vehicle.disconnect()
        state = self.wait_for(self.is_done)
        self.assertEqual(self.vehicle.commands[:2], ["goto 1 2.000 0.000"] * 2)
        self.assertEqual(self.vehicle.executed, [1, 2, 3])
        self.assertEqual(state["errors"], [])
        errors = [error for past in self.read_states() for error in past["errors"] if past["orderId"] == "order-1"]
        self.assertEqual({(error["errorType"], error["errorLevel"]) for error in errors}, {("vehicleUnreachable", "FATAL")})

    def test_the_numbers_of_a_restarted_bridge_are_new(self):
        self.send_order()
        self.wait_for(self.is_done)
        self.line.forget(self.bridge)
        self.assertEqual(self.bridge.stop(), 0)
        self.start_bridge()
        places = {"N3": PLACES["N3"], "N2": PLACES["N2"], "N4": (7.0, 8.0)}
        self.send_order(action_id="beep-2", order_id="order-2", places=places)
        self.wait_for(lambda state: state["orderId"] == "order-2" and state["lastNodeId"] == "N4" and not state["nodeStates"])
        self.assertEqual(self.vehicle.place, places["N4"])
        self.assertEqual(len(self.vehicle.executed), 6)

    def test_a_cancelled_order_stops_the_vehicle(self):
        self.vehicle.held.set()
        self.send_order()
        self.assertEqual(self.vehicle.received.get(timeout=STATUS_SECONDS), "goto 1 2.000 0.000")
        self.vehicle.send("moving 1")
        self.wait_for(lambda state: state["driving"])
        self.publish("instantActions", actions=[{"actionType": "cancelOrder", "actionId": "c1", "blockingType": "HARD"}])
        state = self.wait_for(lambda state: any(action["actionId"] == "c1" and action["actionStatus"] == "FINISHED"
                                                for action in state["actionStates"]))
        self.assertEqual(self.vehicle.commands, ["goto 1 2.000 0.000", "stop"])
        self.assertEqual((state["nodeStates"], state["driving"]), ([], False))

    def test_a_vehicle_that_was_lost_during_a_cancel_is_stopped_when_it_is_back(self):
        self.vehicle.held.set()
        self.send_order()
        self.assertEqual(self.vehicle.received.get(timeout=STATUS_SECONDS), "goto 1 2.000 0.000")
        self.vehicle.send("moving 1")
        self.wait_for(lambda state: state["driving"])
        self.vehicle.away.set()
        self.vehicle.disconnect()
        self.wait_for(lambda state: state["errors"])
        self.publish("instantActions", actions=[{"actionType": "cancelOrder", "actionId": "c1", "blockingType": "HARD"}])
        self.wait_for(lambda state: any(action["actionId"] == "c1" for action in state["actionStates"]))
        self.vehicle.away.clear()
        self.wait_for(lambda state: any(action["actionId"] == "c1" and action["actionStatus"] == "FINISHED"
                                        for action in state["actionStates"]))
        self.assertEqual(self.vehicle.commands, ["goto 1 2.000 0.000", "stop"])

    def test_an_order_without_positions_is_refused(self):
        self.send_order(places={**PLACES, "N3": None})
        state = self.wait_for(lambda state: state["errors"])
        self.assertEqual([error["errorType"] for error in state["errors"]], ["noRouteError"])
        self.assertEqual(self.vehicle.commands, [])

    def test_a_serial_number_that_has_no_place_in_a_topic_is_refused(self):
        for serial in ("", "a/b", "+", "#", "$V1", "V\n1"):
            done = subprocess.run([self.bin_dir / "e19_bridge", "127.0.0.1", str(self.port), serial, "127.0.0.1", str(self.vehicle.port)],
                                  stdout=subprocess.PIPE, text=True, timeout=FINISH_SECONDS, check=False)
            self.assertEqual((done.returncode, done.stdout.split(" ")[0]), (2, "Usage:"), serial)

    def test_the_end_is_announced(self):
        self.assertEqual(self.bridge.stop(), 0)
        self.line.forget(self.bridge)
        connection = subprocess.run(["mosquitto_sub", "-p", str(self.port), "-t", f"{TOPIC}/connection", "-C", "1"],
                                    stdout=subprocess.PIPE, check=True, timeout=FINISH_SECONDS)
        self.assertEqual(json.loads(connection.stdout)["connectionState"], "OFFLINE")


if __name__ == "__main__":
    main()
