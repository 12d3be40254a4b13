"""Three nodes of nats-server as an MQTT broker cluster with JetStream, each on free ports and in its own folder."""

import os
import shutil
import signal
import subprocess
import time
import urllib.error
import urllib.request

import scenario_case  # noqa: F401  it makes the next module known
from production_line import READY_SECONDS, LineError, find_free_port

NODES = 3
PROBE_SECONDS = 10
USABLE_SECONDS = 90


class NatsCluster:
    def __init__(self, line, users=()):
        """users: (name, password) of each node; none: everyone may connect."""
        self._line = line
        self._users = list(users)
        self._binary = shutil.which("nats-server") or shutil.which("nats-server", path="/usr/sbin:/sbin:/usr/local/sbin")
        if self._binary is None:
            raise LineError("nats-server is not installed; run scripts/setup")
        self._nodes = [None] * NODES
        self._starts = [0] * NODES
        self._http = [find_free_port() for _ in range(NODES)]
        self._routes = [find_free_port() for _ in range(NODES)]
        self.ports = [find_free_port() for _ in range(NODES)]
        self.urls = [f"mqtt://127.0.0.1:{port}" for port in self.ports]
        for index in range(NODES):
            self._write_config(index)

    def _write_config(self, index):
        routes = ", ".join(f'"nats://127.0.0.1:{port}"' for port in self._routes)
        lines = [f"server_name: node{index}", f"listen: 127.0.0.1:{find_free_port()}", f"http: 127.0.0.1:{self._http[index]}",
                 f'jetstream {{ store_dir: "{self._line.folder}/node{index}" }}',
                 f"mqtt {{ listen: 127.0.0.1:{self.ports[index]} }}",
                 f"cluster {{ name: site, listen: 127.0.0.1:{self._routes[index]}, routes: [{routes}] }}"]
        if self._users:
            name, password = self._users[index]
            lines.append(f'authorization {{ user: "{name}", password: "{password}" }}')
        (self._line.folder / f"node{index}.conf").write_text("\n".join(lines) + "\n")

    def start(self, *indices):
        """Starts these nodes, all without indices, and waits until each of them stores messages in the cluster."""
        chosen = indices or range(NODES)
        for index in chosen:
            self._starts[index] += 1
            self._nodes[index] = self._line.start(f"node{index}-{self._starts[index]}", "-c",
                                                  self._line.folder / f"node{index}.conf", binary=self._binary)
        for index in chosen:
            self._wait_until_healthy(index)
        for index in chosen:
            self._wait_until_usable(index)

    def _wait_until_healthy(self, index):
        """Of the server only: a consumer of nats-server 2.9.10 may be "not current" for long after a restart."""
        node, reason = self._nodes[index], "it has ended"
        deadline = time.monotonic() + READY_SECONDS
        while node.is_running() and time.monotonic() < deadline:
            try:
                with urllib.request.urlopen(f"http://127.0.0.1:{self._http[index]}/healthz?js-server-only=true", timeout=1):
                    return
            except urllib.error.HTTPError as error:
                with error:
                    reason = error.read().decode()
            except OSError as error:
                reason = str(error)
            time.sleep(0.1)
        raise LineError(f"nats-server {index} does not start: {reason}", node)

    def _wait_until_usable(self, index):
        """The first MQTT client of a cluster waits until its streams exist; the tests are not about that."""
        binary = shutil.which("mosquitto_pub")
        if binary is None:
            raise LineError("mosquitto_pub is missing; run scripts/setup")
        login = ("-u", self._users[index][0], "-P", self._users[index][1]) if self._users else ()
        command = [binary, "-h", "127.0.0.1", "-p", str(self.ports[index]), "-q", "1", "-t", "start", "-m", "x", *login]
        deadline = time.monotonic() + USABLE_SECONDS
        while time.monotonic() < deadline:
            try:
                if subprocess.run(command, capture_output=True, timeout=PROBE_SECONDS, check=False).returncode == 0:
                    return
            except subprocess.TimeoutExpired:
                pass
            time.sleep(0.2)
        raise LineError(f"nats-server {index} accepts no message", self._nodes[index])

    def kill(self, *indices):
        """SIGKILL: clients get no message, nothing is stored."""
        for index in indices or range(NODES):
            node, self._nodes[index] = self._nodes[index], None
            os.kill(node.process.pid, signal.SIGKILL)
            self._line.forget(node)
            node.stop()

    def find(self, url):
        return self.urls.index(url)

    def list_from(self, first):
        """The URLs, beginning with that of the node."""
        return self.urls[first:] + self.urls[:first]
