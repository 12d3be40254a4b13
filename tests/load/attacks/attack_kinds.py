"""The attacks. Each begins, shows that it takes effect, and ends; the line is then as it was before."""

import abc
import contextlib
import json
import os
import pathlib
import select
import socket
import subprocess
import sys
import threading

from attacked_line import HOSTILE, HOSTILE_MAP, HOSTILE_NODE, HOSTILE_PLACE
from plan_samples import make_carrying_plan
from vehicle_samples import make_idle_state, make_vehicle_message

FOLDER = pathlib.Path(__file__).resolve().parent
END_SECONDS = 60
LONG_ARRAY = "[" + "0," * ((4 << 20) // 2 - 2) + "0]"  # 4 MiB, the longest message that acsd accepts from the MCS
ERRORS = 10_000  # of one state
MESSAGES_PER_SECOND = 5
PLANS_PER_SECOND = 20
COMMANDS_PER_SECOND = 20
SOCKETS = 64
SOCKET_PERIOD = 0.1  # closed connections are replaced
FILL_SECONDS = 5
UNREAD_REQUESTS = 500  # of each connection every 100 ms, until acsd reads no more
SMALLEST_BUFFER = 1
PIPE_CHUNK = 4096


class Attack(abc.ABC):
    name = ""
    host = "127.0.0.1"  # of the broker, as acsd knows it
    has_robots = True  # acsd knows the position of LR01 during the attack

    def __init__(self, folder, bin_dir):
        self.folder = pathlib.Path(folder)
        self.bin_dir = bin_dir
        self._ending = threading.Event()
        self._workers = []

    def get_environment(self):
        return {}

    def get_log_descriptor(self):
        return None

    @abc.abstractmethod
    def begin(self, line):
        """Returns when the attack takes place."""

    @abc.abstractmethod
    def find_effect(self, line):
        """What shows that acsd has met the attack, in a few words; empty if nothing does yet."""

    def end(self, line):
        self._ending.set()
        for worker in self._workers:
            worker.join(END_SECONDS)

    def has_recovered(self, line):
        return line.is_alive()

    def summarize(self):
        """What was counted until the end, in a few words."""
        return ""

    def repeat(self, work, rate):
        """Calls work(number) at this rate until the end."""
        def run():
            number = 0
            while not self._ending.wait(1 / rate):
                number += 1
                try:
                    work(number)
                except OSError:
                    return  # the other end has closed

        worker = threading.Thread(target=run, daemon=True)
        worker.start()
        self._workers.append(worker)


class NoAttack(Attack):
    name = "none"

    def begin(self, line):
        pass

    def find_effect(self, line):
        return "none"


class HeldCall(Attack):
    """A call of the system that does not return: a library for LD_PRELOAD that waits while a pipe has no writer."""

    library, variable = "", ""

    def get_environment(self):
        return {"LD_PRELOAD": str(self.bin_dir / self.library), self.variable: str(self.folder / "gate")}

    def hold(self):
        os.mkfifo(self.folder / "gate")

    def release(self):
        gate = os.open(self.folder / "gate", os.O_RDWR)  # a writer, without waiting for a reader
        (self.folder / "gate").unlink()
        os.close(gate)


def find_broker_effect(line):
    return "" if line.read_status()["links"]["mqtt"] is not False else "no broker"


def has_broker(line):
    return line.is_alive() and line.read_status()["links"]["mqtt"] is True


class SilentResolver(HeldCall):
    name = "silent name resolver"
    host = "broker.test"
    library, variable = "libscenario_held_resolver.so", "ACS_HELD_RESOLVER"
    has_robots = False

    def begin(self, line):
        self.hold()
        line.stop_broker()

    def find_effect(self, line):
        return find_broker_effect(line)

    def end(self, line):
        super().end(line)
        line.restart_broker()
        self.release()

    def has_recovered(self, line):
        return has_broker(line)


class FullAcceptQueue(Attack):
    name = "full accept queue of the broker"
    has_robots = False

    def begin(self, line):
        line.stop_broker()
        self._stack = contextlib.ExitStack()
        self._stack.enter_context(socket.create_server(("127.0.0.1", line.broker_port), backlog=0))
        for _ in range(4):
            client = self._stack.enter_context(socket.socket())
            client.setblocking(False)
            client.connect_ex(("127.0.0.1", line.broker_port))

    def find_effect(self, line):
        return find_broker_effect(line)

    def end(self, line):
        super().end(line)
        self._stack.close()
        line.restart_broker()

    def has_recovered(self, line):
        return has_broker(line)


class UnreadLog(Attack):
    """Standard error is a pipe that is read until the attack begins, and full from then on. Operator commands make acsd log."""

    name = "unread log pipe"

    def get_log_descriptor(self):
        self._reader, self._writer = os.pipe()
        self._reading, self._pausing = threading.Event(), threading.Event()
        self._reading.set()
        self._read = 0
        threading.Thread(target=self._drain, daemon=True).start()
        return self._writer

    def _drain(self):
        while True:
            if not self._reading.is_set():
                self._pausing.set()
                self._reading.wait()
            self._read += len(os.read(self._reader, 1 << 16))

    def begin(self, line):
        self._reading.clear()
        os.write(self._writer, b"\n")  # the thread may wait in read()
        self._pausing.wait()
        # A description of its own: O_NONBLOCK must not apply to acsd.
        filler = os.open(f"/proc/self/fd/{self._writer}", os.O_WRONLY | os.O_NONBLOCK)
        written = 0
        with contextlib.suppress(BlockingIOError):
            while True:
                written += os.write(filler, b"x" * PIPE_CHUNK)
        os.close(filler)
        self._read = -written
        self.repeat(lambda number: line.post(f"/v1/robots/{HOSTILE}/maintenance", {"on": number % 2 == 1}),
                    COMMANDS_PER_SECOND)

    def find_effect(self, line):
        return "" if select.select([], [self._writer], [], 0)[1] else "full pipe"

    def end(self, line):
        self._reading.set()
        super().end(line)

    def has_recovered(self, line):
        return line.is_alive() and self._read > 0

    def summarize(self):
        return f"{self._read} bytes of the log after it"


class UnreadSockets(Attack):
    """Connections that send requests for /metrics without a pause and never read. One that acsd closes is replaced."""

    name = "64 unread HTTP connections"

    def begin(self, line):
        host, port = line.http.rsplit(":", 1)
        self._address = host, int(port)
        self._sockets, self._closed = {}, 0  # the number of bytes of its last request that a connection has sent
        self._request = f"GET /metrics HTTP/1.1\r\nHost: {line.http}\r\n\r\n".encode()
        # Until acsd reads from none of them. If it closes some meanwhile, the attack is not quieter later.
        line.has_become(lambda: self._replace() == 0, FILL_SECONDS)
        self.repeat(self._replace, 1 / SOCKET_PERIOD)

    def _replace(self, _=0):
        """The number of bytes that could be sent."""
        poll = select.poll()
        for connection in self._sockets:
            poll.register(connection, select.POLLRDHUP)
        closed = {number for number, _ in poll.poll(0)}
        for connection in [connection for connection in self._sockets if connection.fileno() in closed]:
            del self._sockets[connection]
            connection.close()
            self._closed += 1
        while len(self._sockets) < SOCKETS:
            connection = socket.socket()
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SMALLEST_BUFFER)
            connection.setblocking(False)
            connection.connect_ex(self._address)
            self._sockets[connection] = 0
        requests = self._request * (UNREAD_REQUESTS + 1)
        total = 0
        for connection, sent in self._sockets.items():
            with contextlib.suppress(OSError):  # acsd reads no more, or it has closed the connection
                count = connection.send(requests[sent:])
                total += count
                self._sockets[connection] = (sent + count) % len(self._request)
        return total

    def find_effect(self, line):
        return f"{self._closed} connections closed by acsd" if self._closed or not line.is_alive() else ""

    def end(self, line):
        super().end(line)
        for connection in self._sockets:
            connection.close()


class HostileVehicle(Attack):
    name = "hostile vehicle, 10,000 distinct errors per state"
    metric = f'acsd_robot_states_received_total{{robot="{HOSTILE}"'

    def begin(self, line):
        self._before = line.read_metric(self.metric)
        publisher = line.start_publisher("state")
        errors = [(f"fault-@-{number}", f"fault {number} of the attack") for number in range(ERRORS)]
        template = make_idle_state(HOSTILE, 0, errors, node=HOSTILE_NODE, place=HOSTILE_PLACE, map_id=HOSTILE_MAP)
        rest = template.split(",", 2)[2]  # without headerId and timestamp

        def send(number):
            head = make_vehicle_message(HOSTILE, number + 1).split(",", 2)[:2]
            publisher.stdin.write((",".join([*head, rest.replace("@", str(number))]) + "\n").encode())
            publisher.stdin.flush()

        self.repeat(send, MESSAGES_PER_SECOND)

    def find_effect(self, line):
        received = (line.read_metric(self.metric) or 0) - (self._before or 0)
        codes = [alarm["errorCode"] for alarm in line.read_status()["alarms"] if alarm["robotId"] == HOSTILE]
        return f"{received} states, {len(codes)} alarms" if received and codes else ""


class OperatorCommands(Attack):
    name = "16,000 operator commands at a time"

    def begin(self, line):
        self._commits = line.read_metric("acsd_store_commit_seconds_count")
        self._flood = subprocess.Popen([sys.executable, "-B", FOLDER / "command_flood.py", line.operator, HOSTILE],
                                       stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self._counts = {}

    def find_effect(self, line):
        commits = (line.read_metric("acsd_store_commit_seconds_count") or 0) - (self._commits or 0)
        return f"{commits} commits" if commits else ""

    def end(self, line):
        super().end(line)
        output, _ = self._flood.communicate(timeout=END_SECONDS)
        self._counts = json.loads(output)

    def summarize(self):
        return ", ".join(f"{count} answered with {status}" for status, count in sorted(self._counts.items()))


class HangingDisk(HeldCall):
    """The MCS repeats its requests meanwhile."""

    name = "disk that hangs"
    library, variable = "libscenario_held_disk.so", "ACS_HELD_DISK"

    def begin(self, line):
        self.hold()
        self.repeat(lambda number: line.stub.send_request("ExecutionPlan", make_carrying_plan(f"Q{number}")),
                    PLANS_PER_SECOND)

    def find_effect(self, line):
        return "the store does not answer" if "the store does not answer" in line.read_status()["notReadyReasons"] else ""

    def end(self, line):
        super().end(line)
        self.release()

    def has_recovered(self, line):
        return line.is_alive() and line.read(line.http, "/readyz")[0] == 200


class ArrayFromBroker(Attack):
    name = "4 MiB array from the broker"
    metric = f'acsd_robot_oddities_total{{kind="unreadable_message",robot="{HOSTILE}"'

    def begin(self, line):
        publisher = line.start_publisher("state")

        def send(_):
            publisher.stdin.write((LONG_ARRAY + "\n").encode())
            publisher.stdin.flush()

        self.repeat(send, MESSAGES_PER_SECOND)

    def find_effect(self, line):
        unreadable = line.read_metric(self.metric)
        return f"{unreadable} unreadable messages" if unreadable else ""


class ArrayFromMcs(Attack):
    name = "4 MiB array from the MCS"

    def begin(self, line):
        self._before = self._count(line) or 0
        self.repeat(lambda _: line.stub.send_text(LONG_ARRAY), MESSAGES_PER_SECOND)

    @staticmethod
    def _count(line):
        return line.read_metric("acsd_mcs_notes_total")

    def find_effect(self, line):
        notes = (self._count(line) or 0) - self._before
        return f"{notes} unreadable messages" if notes else ""


ATTACKS = (NoAttack, SilentResolver, FullAcceptQueue, UnreadLog, UnreadSockets, HostileVehicle, OperatorCommands, HangingDisk,
           ArrayFromBroker, ArrayFromMcs)
