#!/usr/bin/env python3
"""Two acsd with one store in PostgreSQL: whatever happens to the one that leads, the other one takes over, nothing is lost and
nothing is done twice. Judged as in test_kill.py.

--kills N   number of kills in each test (5)
--seed N    seed of the moments; printed on failure
--long      more of them
"""

import json
import os
import re
import shutil
import signal
import sys
import threading
import time
import urllib.error
import urllib.request

from kill_case import FINISH_SECONDS, SETTINGS, KillCase, run_kill_tests
from link_proxy import LinkProxy
from postgres_server import PostgresServer
from scenario_case import SITE

LEASE_SECONDS = 3
TAKEOVER_SECONDS = 30  # far more than it takes: scripts/bench measures it
PERMILLE_95 = 0.95


def get(url):
    """Status and body."""
    try:
        with urllib.request.urlopen(url, timeout=5) as response:
            return response.status, response.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()
    except OSError as error:
        return 0, str(error)


class Member:
    """One of the processes, with networks of its own to the store and to the broker, which a test can cut."""

    def __init__(self, case, name, settings=(), url=None, environment=None):
        self.name = name
        self._environment = environment
        self._settings = settings
        self._case = case
        self.store_link = case.make_proxy(case.server.port)
        self.broker_link = case.make_proxy(case.line.broker_port)
        self._url = url or case.server.get_url(port=self.store_link.port)
        self.start()

    def start(self):
        case = self._case
        self.program = case.line.start_acsd(
            case.mcs_address, case.arm, "robot.taken_port=load", f"mqtt.url=mqtt://127.0.0.1:{self.broker_link.port}",
            f"store.url={self._url}", f"store.lease={LEASE_SECONDS}s",
            f"store.instance={self.name}", f"operator.audit.directory={case.line.folder / self.name}", *self._settings,
            config=case.config, environment=self._environment)
        self.addresses = self.program.wait_ready()
        self.is_killed = False

    def read_ready(self):
        return get(f"http://{self.addresses['http']}/readyz")

    def is_ready(self):
        return self.read_ready()[0] == 200

    def is_leading(self):
        return "standby" not in (ready := self.read_ready())[1] and ready[0] != 0

    def kill(self):
        self.is_killed = True
        self._case.line.forget(self.program)
        self.program.process.kill()
        self.program.stop()

    def restart(self):
        self.kill()
        self.start()


class LivenessProbe:
    """Asks a process without a pause whether it is alive; what it answered but yes is kept."""

    def __init__(self, member):
        self.refusals = []
        self.answers = 0
        self._url = f"http://{member.addresses['http']}/livez"
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._ask)
        self._thread.start()

    def _ask(self):
        while not self._ended.is_set():
            answer = get(self._url)
            self.answers += 1
            if answer != (200, "alive\n"):
                self.refusals.append(answer)

    def end(self):
        self._ended.set()
        self._thread.join()


class StandbyCase(KillCase):

    def setUp(self):
        super().setUp()
        self.server = PostgresServer(self.line)
        self.addCleanup(self.server.remove)
        shutil.copytree(SITE, self.line.folder / "site")
        self.config = self.line.folder / "site" / "acsd.toml"
        text, count = re.subn(r"(?m)^directory = .*\n", "", self.config.read_text())
        self.assertEqual(count, 1)
        self.config.write_text(text)
        self.takeovers = []

    def start_acsd(self):
        """The one that leads, and the standby."""
        self.members = [Member(self, "one"), Member(self, "two")]
        self.wait_until_leading()

    def is_running(self):
        """Those that a test has not killed."""
        return all(member.is_killed or member.program.is_running() for member in self.members)

    def find_leader_or_none(self):
        return next((member for member in self.members if member.is_leading()), None)

    def wait_until_leading(self):
        self.wait_until(lambda: any(member.is_ready() for member in self.members), "one of them leads", TAKEOVER_SECONDS)
        return self.find_leader_or_none()

    def get_other(self, member):
        return self.members[1] if member is self.members[0] else self.members[0]

    def measure_takeover(self, other):
        """From now until the other one is ready; plans come meanwhile."""
        start = time.monotonic()
        self.wait_until(lambda: self.supply() or other.is_ready(), "the standby takes over", TAKEOVER_SECONDS)
        self.takeovers.append(time.monotonic() - start)

    def print_takeovers(self):
        ordered = sorted(self.takeovers)
        print(f"{len(ordered)} takeovers, median {ordered[len(ordered) // 2]:.2f} s, 95th percentile "
              f"{ordered[min(len(ordered) - 1, int(len(ordered) * PERMILLE_95))]:.2f} s ...", end=" ", file=sys.stderr)

    def play_here(self, strike, short, share=1):
        """share: of the kills, in a long run."""
        self.play(strike, SETTINGS.kills // share if SETTINGS.long else min(SETTINGS.kills, short))
        self.judge()
        if self.takeovers:
            self.print_takeovers()


class Standby(StandbyCase):
    def test_the_leader_is_killed(self):
        self.start_line()

        def strike():
            leader = self.wait_until_leading()
            other = self.get_other(leader)
            leader.kill()
            self.measure_takeover(other)
            leader.start()

        self.play_here(strike, 3)

    def test_a_leader_that_is_stopped_hands_over_at_once(self):
        self.start_line()
        leader = self.wait_until_leading()
        other = self.get_other(leader)
        self.supply_for(1.0)
        self.line.forget(leader.program)
        leader.is_killed = True
        self.assertEqual(leader.program.stop(), 0)
        self.assertEqual(self.server.execute("SELECT released OR epoch = 2 FROM acsd.lease"), "t")
        self.wait_until(other.is_ready, "the standby takes over", TAKEOVER_SECONDS)
        leader.start()
        self.play(lambda: None, 0)
        self.judge()

    def test_partitions(self):
        """From the store: the other one leads. From the broker: the leader waits. From both: as from the store."""
        self.start_line()
        kinds = ["store", "broker", "both"]

        def strike():
            kind = kinds[self.random.randrange(3)] if SETTINGS.long else kinds.pop(0)
            leader = self.wait_until_leading()
            other = self.get_other(leader)
            links = [link for name, link in (("store", leader.store_link), ("broker", leader.broker_link))
                     if kind in (name, "both")]
            for link in links:
                link.cut()
            if kind == "broker":
                self.wait_until(lambda: leader.read_ready()[0] == 503, "it is not ready")
                self.assertTrue(leader.is_leading())
                self.assertFalse(other.is_leading())
            else:
                self.measure_takeover(other)
                self.wait_until(lambda: "the store cannot be used" in leader.read_ready()[1], "the reason is shown")
            for link in links:
                link.mend()
            if kind != "broker":
                self.wait_until(lambda: f"standby: {other.name} leads" in leader.read_ready()[1], "it is a standby")

        self.play_here(strike, 3, share=5)

    def test_a_leader_that_stalls_sends_nothing_later(self):
        """It is stopped for longer than its lease, and continues when the other one leads."""
        self.start_line()

        def strike():
            leader = self.wait_until_leading()
            other = self.get_other(leader)
            leader.program.send_signal(signal.SIGSTOP)
            self.measure_takeover(other)
            leader.program.send_signal(signal.SIGCONT)
            self.wait_until(lambda: f"standby: {other.name} leads" in leader.read_ready()[1], "it is a standby")
            self.assertTrue(any("does not lead any more" in line for line in leader.program.tail(200)))

        self.play_here(strike, 2, share=5)

    def test_the_server_is_killed(self):
        """Neither leads meanwhile; then one of them continues."""
        self.start_line()

        def strike():
            self.wait_until_leading()
            self.server.kill()
            self.supply_for(self.random.uniform(0.0, 2.0 * LEASE_SECONDS))
            self.server.start()
            self.wait_until_leading()

        self.play_here(strike, 2, share=5)


class Failover(StandbyCase):
    """The database server is lost, and its synchronous replica is promoted: nothing that was acknowledged is lost."""

    def start_acsd(self):
        self.replica = PostgresServer(self.line, self.server)
        self.addCleanup(self.replica.remove)
        hosts = f"127.0.0.1:{self.server.port},127.0.0.1:{self.replica.port}"
        self.members = [Member(self, name, url=f"postgresql://acsd@{hosts}/postgres") for name in ("one", "two")]
        self.wait_until_leading()

    def test_the_primary_is_lost(self):
        self.start_line()
        self.supply_for(3.0)
        self.server.kill()
        self.wait_until(lambda: not any(member.is_leading() for member in self.members), "none leads without a server")
        self.replica.promote()
        self.wait_until_leading()
        self.play(lambda: None, 0)
        self.judge()


class Refusals(StandbyCase):
    """A process that cannot lead: its state and its sentence, while the other one is not disturbed."""

    def start_acsd(self):
        self.members = [Member(self, "one")]
        self.wait_until_leading()

    def expect_standby(self, member, *parts):
        shown = []

        def is_shown():
            shown[:] = member.read_ready()
            return all(part in shown[1] for part in parts)

        self.wait_until(is_shown, f"{parts} is shown")
        status, text = shown
        self.assertEqual(status, 503)
        self.assertEqual(len(text.splitlines()), 1)
        self.assertEqual(get(f"http://{member.addresses['http']}/livez"), (200, "alive\n"))

    def join(self, *settings, url=None):
        member = Member(self, "two", settings, url)
        self.members.append(member)
        return member

    def test_what_a_standby_shows(self):
        self.start_line()
        member = self.join()
        self.expect_standby(member, "standby: one leads")
        self.assertIn("acsd_leader 0", get(f"http://{member.addresses['http']}/metrics")[1])
        self.assertIn("acsd_leader 1", get(f"http://{self.members[0].addresses['http']}/metrics")[1])
        operator = f"http://{member.addresses['operator']}"
        status, text = get(f"{operator}/v1/status")
        self.assertEqual((status, json.loads(text)), (503, {"error": "standby: one leads"}))
        self.assertIn("<html", get(f"{operator}/")[1])
        self.assertEqual(get(f"{operator}/page/main.js")[0], 200)
        self.assertEqual(member.program.stop(), 0)

    def test_another_configuration(self):
        self.start_line()
        member = self.join("outbox.max=5000")
        self.expect_standby(member, "standby that cannot take over", "not those of one, which leads")
        self.members[0].kill()
        self.assertFalse(member.is_leading())
        self.expect_standby(member, "standby that cannot take over")
        self.members[0].start()
        self.wait_until(self.members[0].is_ready, "it leads again")
        self.line.forget(self.members[0].program)
        self.members[0].is_killed = True
        self.assertEqual(self.members[0].program.stop(), 0)
        self.wait_until(member.is_ready, "a leader that was stopped is succeeded by one with another configuration")

    def test_a_store_that_cannot_be_used(self):
        self.start_line()
        self.server.execute("CREATE ROLE guest LOGIN")
        self.server.execute("CREATE ROLE reader LOGIN; ALTER ROLE reader SET default_transaction_read_only TO on")
        member = self.join(url=self.server.get_url(user="guest"))
        self.expect_standby(member, "the store cannot be used", "permission denied")
        member.kill()
        member = self.join(url=self.server.get_url(user="reader"))
        self.expect_standby(member, "the store cannot be used", "a server that accepts writes")
        member.kill()
        member = self.join(url=self.server.get_url(database="absent"))
        self.expect_standby(member, "the store cannot be used", "a database of this name")
        member.kill()
        self.server.execute("UPDATE acsd.settings SET value = '99' WHERE name = 'schema_version'")
        member = self.join()
        self.expect_standby(member, "the store cannot be used", "version 99")
        self.assertTrue(self.members[0].is_ready(), "the leader is not disturbed")

    def test_a_silent_name_server(self):
        library = self.line.bin_dir / "libscenario_held_resolver.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        self.start_line()
        gate = self.line.folder / "resolver"
        os.mkfifo(gate)
        environment = os.environ | {"LD_PRELOAD": str(library), "ACS_HELD_RESOLVER": str(gate)}
        link = self.make_proxy(self.server.port)
        url = f"postgresql://acsd@db.test:{link.port}/postgres?sslmode=disable"
        member = Member(self, "two", (), url, environment)
        self.members.append(member)
        self.expect_standby(member, "the store cannot be used", "an answer of the name server")
        self.line.forget(member.program)
        member.is_killed = True
        self.assertEqual(member.program.stop(timeout=5), 0, "it ends although the name server is silent")
        gate.unlink()  # from then on names are resolved
        member = Member(self, "two", (), url, environment)
        self.members[1:] = [member]
        self.expect_standby(member, "standby: one leads")

        # The leader loses its connections, and cannot find the server again.
        self.members[0].kill()
        self.wait_until(member.is_ready, "the standby takes over", TAKEOVER_SECONDS)
        os.mkfifo(gate)
        link.cut()
        self.expect_standby(member, "the store cannot be used", "an answer of the name server")
        link.mend()
        writer = os.open(gate, os.O_RDWR)  # the name server answers
        gate.unlink()
        os.close(writer)
        self.wait_until(member.is_ready, "it leads again", TAKEOVER_SECONDS)

    def test_a_name_server_that_answers_between_two_attempts(self):
        library = self.line.bin_dir / "libscenario_held_resolver.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        self.start_line()
        delay = LEASE_SECONDS * 1000 // 2 + 20  # an attempt takes half of the lease, and the next one begins a twelfth later
        environment = os.environ | {"LD_PRELOAD": str(library), "ACS_RESOLVER_DELAY": str(delay)}
        url = f"postgresql://acsd@db.test:{self.make_proxy(self.server.port).port}/postgres?sslmode=disable"
        member = Member(self, "two", (), url, environment)
        self.members.append(member)
        self.expect_standby(member, "standby: one leads")
        self.members[0].kill()
        self.wait_until(member.is_ready, "the standby takes over", TAKEOVER_SECONDS)

    def count_leads(self):
        return sum("this process leads" in line for line in self.members[0].program.tail(100000))  # they share a log

    def test_a_store_that_is_damaged_while_it_is_used(self):
        self.start_line()
        member = self.join()
        self.expect_standby(member, "standby: one leads")
        self.server.execute("UPDATE acsd.lease SET duration_ms = 0")
        self.expect_standby(member, "the store cannot be used", "acsd.lease")
        self.assertTrue(self.members[0].is_ready(), "the leader is not disturbed")
        self.server.execute(f"UPDATE acsd.lease SET duration_ms = {LEASE_SECONDS * 1000}")
        self.expect_standby(member, "standby: one leads")

        probes = [LivenessProbe(each) for each in self.members]
        for probe in probes:
            self.addCleanup(probe.end)
        self.server.execute("DROP TABLE acsd.reports")
        before = self.count_leads()
        self.supply_for(1.0)
        for each in self.members:
            self.expect_standby(each, "the store cannot be used", "reports")
        self.stopped.wait(LEASE_SECONDS)
        self.assertLess(self.count_leads(), before + 8, "a store that cannot be used is not taken again at once")
        for probe in probes:
            probe.end()
            self.assertEqual(probe.refusals, [], f"of {probe.answers} answers: it answers while it begins or ceases to lead")

        self.server.execute("DROP SCHEMA acsd CASCADE")
        for each in self.members:
            self.expect_standby(each, "the store cannot be used", "the tables")
        self.stopped.wait(1.0)
        self.assertEqual(self.server.execute("SELECT to_regnamespace('acsd') IS NULL"), "t", "they are not created again")
        for each in self.members:
            self.assertEqual(each.program.stop(), 0)


if __name__ == "__main__":
    run_kill_tests()
