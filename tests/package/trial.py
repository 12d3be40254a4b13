#!/usr/bin/env python3
"""trial.py PACKAGES WORK: tries the packages of a folder on a Debian 12 machine with systemd: installation, first start, a plan of the
example site, an upgrade with a plan in progress, a refused downgrade, the watchdog, a reload, purge. Needs root. WORK keeps the base
system for the next time."""

import atexit
import json
import pathlib
import shutil
import tempfile
import time
import unittest

from machine import Machine, make_base, take_arguments
from repack import read_field, repack

# What the packages need is added.
BASE_PACKAGES = ("systemd", "systemd-sysv", "dbus", "mosquitto", "procps")
OLDER = "0.0.1"
TOKEN = "/etc/acsd/operator.token"
DROP_IN = "/etc/systemd/system/acsd.service.d"
# What a system writes by itself, and what keeps the history of packages.
CHANGING = ("/dev", "/proc", "/run", "/sys", "/tmp", "/trial", "/var/cache", "/var/log", "/var/lib/apt", "/var/lib/dpkg", "/var/lib/mosquitto",
            "/var/lib/systemd", "/var/tmp", "/var/backups", "/root", "/etc/ld.so.cache", "/etc/machine-id", "/etc/resolv.conf",
            "/etc/passwd-", "/etc/group-", "/etc/shadow-", "/etc/gshadow-", "/etc/.pwd.lock", "/etc/mosquitto")
PACKAGES, WORK = "", ""


def list_debs(folder):
    """Paths in the machine."""
    return [f"/trial/{folder}/{deb.name}" for deb in sorted(pathlib.Path(machine.folder, "trial", folder).glob("*.deb"))]


machine = None


def setUpModule():
    global machine
    debs = [deb for deb in sorted(pathlib.Path(PACKAGES).glob("*.deb")) if "-dbgsym_" not in deb.name]
    folder = pathlib.Path(tempfile.mkdtemp(prefix="trial-", dir=WORK))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)  # after Ctrl-C unittest cleans nothing up
    make_base(pathlib.Path(WORK, "base.tar"), BASE_PACKAGES)
    machine = Machine(folder / "root", pathlib.Path(WORK, "base.tar"))
    atexit.register(machine.stop)
    for name in ("older", "newer"):
        pathlib.Path(machine.folder, "trial", name).mkdir(parents=True)
    for deb in debs:
        shutil.copy(deb, machine.folder / "trial" / "newer")
        repack(deb, OLDER, machine.folder / "trial" / "older")
    # The dependencies come from Debian before the machine is booted without a network.
    machine.run_outside("apt-get", "-q", "update")
    machine.run_outside("apt-get", "-q", "-y", "--no-install-recommends", "--download-only", "install", *list_debs("older"))
    machine.boot()


class Trial(unittest.TestCase):
    """The steps build on each other; unittest runs them by name."""

    def install(self, folder, *options):
        output = machine.execute("apt-get", "-q", "-y", "--no-install-recommends", *options, "install", *list_debs(folder))
        self.assertNotIn("warning", output.lower())
        return output

    def acsctl(self, *words):
        try:
            return machine.execute("acsctl", "--token-file", TOKEN, "--yes", *words)
        except RuntimeError as error:
            self.fail(f"{error}\n{self.get_log()}")

    def get_status(self):
        return json.loads(self.acsctl("status", "--json"))

    def get_states(self):
        return [plan["status"] for plan in json.loads(self.acsctl("plans", "--state", "unfinished", "--json"))["plans"]]

    def wait_for(self, condition, what, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, f"not within {seconds} s: {what}\n{self.get_log()}")
            time.sleep(0.5)

    def get_log(self):
        return machine.execute("journalctl", "-u", "acsd", "-o", "cat", "--no-pager", "-n", "60")

    def start(self, name, *command):
        machine.execute("systemd-run", "--quiet", f"--unit={name}", "--property=Type=exec", "--property=RemainAfterExit=yes", *command)

    def send_plans(self, name, *words):
        self.start(name, "mcs-sim", "--plan", "/usr/share/acs/plans/lr-cassette.json", "--fresh-ids", "--live", "never", "--world",
                   "/trial/world.json", *words)

    def check_plans(self, name, seconds):
        def has_ended():
            return machine.execute("systemctl", "show", "--value", "-p", "SubState", name).strip() != "running"
        self.wait_for(has_ended, f"end of {name}", seconds)
        log = machine.execute("journalctl", "-u", name, "-o", "cat", "--no-pager", "-n", "30")
        self.assertEqual(machine.get_exit_code(name), "0", log)
        self.assertIn("0 failed", log)
        self.assertIn("0 misplaced", log)

    def wait_for_auto(self):
        """After a restart the TSC is reported as Paused until every robot has sent its position."""
        self.wait_for(lambda: self.get_status()["tsc"] == "Auto", "the TSC is Auto")

    def get_main_pid(self):
        return machine.execute("systemctl", "show", "--value", "-p", "MainPID", "acsd").strip()

    def test_1_installation(self):
        type(self).files_before = self.list_files() | self.list_named_files()
        self.install("older")
        self.assertEqual(machine.execute("systemctl", "is-active", "acsd").strip(), "active")
        self.assertEqual(machine.execute("systemctl", "is-enabled", "acsd").strip(), "enabled")
        modes = machine.execute("stat", "-c", "%n %U:%G %a", "/etc/acsd", "/etc/acsd/tokens", TOKEN, "/var/lib/acsd", "/var/lib/acsd/store")
        self.assertEqual(modes.splitlines(), ["/etc/acsd root:acsd 750", "/etc/acsd/tokens root:acsd 640", f"{TOKEN} root:root 600",
                                              "/var/lib/acsd acsd:acsd 700", "/var/lib/acsd/store acsd:acsd 700"])
        self.assertEqual(machine.execute("systemctl", "show", "--value", "-p", "User", "acsd").strip(), "acsd")
        type(self).tokens = machine.execute("cat", "/etc/acsd/tokens", TOKEN)
        print(machine.execute("systemd-analyze", "security", "--no-pager", "acsd.service").strip().splitlines()[-1])

    def test_2_the_first_start_moves_nothing(self):
        self.assertIn("TSC Paused until an operator resumes it", self.get_log())
        machine.execute("cp", "/usr/share/acs/site/world.json", "/trial/world.json")
        self.start("vehicles", "vda-sim", "--broker", "mqtt://127.0.0.1:1883", "--site", "/usr/share/acs/site/site.lif.json", "--vehicle",
                   "LR01,type=LR", "--vehicle", "CR01,type=CR", "--world", "/trial/world.json")
        self.start("arm", "openstream-sim", "--programs", "/usr/share/acs/site/programs.toml", "--robot", "1=CR01", "--world",
                   "/trial/world.json")
        self.send_plans("plan1")
        self.wait_for(lambda: self.get_states() == ["Pending"], "the plan is accepted")
        time.sleep(10)
        self.assertEqual(self.get_states(), ["Pending"])
        self.assertEqual(self.get_status()["tsc"], "Paused")

    def test_3_a_plan_is_completed_after_the_resume(self):
        self.acsctl("tsc", "resume")
        self.check_plans("plan1", 240)

    def use_credential(self):
        """The password of the broker comes from systemd; its file is readable by root only."""
        machine.execute("sh", "-c", f"umask 077; echo secret >/etc/acsd/mqtt; mkdir -m 0755 {DROP_IN}; umask 022; printf "
                        f"'[Service]\\nLoadCredential=mqtt:/etc/acsd/mqtt\\n' >{DROP_IN}/credential.conf")
        machine.execute("sed", "-i", r'/^\[mqtt\]$/a username = "acsd"\npassword_file = "${CREDENTIALS_DIRECTORY}/mqtt"', "/etc/acsd/acsd.toml")
        machine.execute("systemctl", "daemon-reload")
        machine.execute("systemctl", "restart", "acsd")
        self.wait_for_auto()

    def test_4_an_upgrade_continues_a_plan(self):
        self.use_credential()
        self.send_plans("plan2")
        self.wait_for(lambda: self.get_states() == ["InProgress"], "the plan is in progress")
        former = self.get_main_pid()
        # With an invalid configuration a restart would stop the fleet: the former process continues until it is corrected.
        machine.execute("cp", "/etc/acsd/acsd.toml", "/trial/acsd.toml")
        machine.execute("sh", "-c", "echo '[broken' >>/etc/acsd/acsd.toml")
        output = machine.execute("apt-get", "-q", "-y", "--no-install-recommends", "--only-upgrade", "install", *list_debs("newer"), may_fail=True)
        self.assertIn("acsd is not restarted: this version refuses its configuration", output)
        self.assertEqual(self.get_main_pid(), former)
        machine.execute("sh", "-c", "echo '# local change' | cat /trial/acsd.toml - >/etc/acsd/acsd.toml")
        output = machine.execute("dpkg", "--configure", "-a")
        self.assertNotIn("warning", output.lower())
        self.assertNotEqual(self.get_main_pid(), former)
        self.assertNotIn("CREDENTIALS_DIRECTORY", output)
        self.assertEqual(machine.execute("systemctl", "is-active", "acsd").strip(), "active")
        self.assertIn("1 open plan resumed", self.get_log())
        self.wait_for_auto()
        self.check_plans("plan2", 240)
        self.assertIn("# local change", machine.execute("tail", "-n", "1", "/etc/acsd/acsd.toml"))
        self.assertEqual(machine.execute("cat", "/etc/acsd/tokens", TOKEN), self.tokens)

    def test_5_a_downgrade_is_refused(self):
        version = read_field(machine.folder / list_debs("newer")[0].lstrip("/"), "Version")
        output = machine.execute("apt-get", "-q", "-y", "--allow-downgrades", "install", *list_debs("older"), may_fail=True)
        self.assertIn(f"acsd {version} is installed and is not replaced by the older version {OLDER}", output)
        self.assertEqual(machine.execute("dpkg-query", "-W", "-f=${Version} ${db:Status-Abbrev}", "acsd").strip(), f"{version} ii")
        for name in ("libacs0", "libacs-dev", "acsctl", "acs-sims", "acs-doc"):
            self.assertIn(f"{name} {version} is not replaced by the older version {OLDER} while acsd {version} is installed", output)
            self.assertEqual(machine.execute("dpkg-query", "-W", "-f=${Version} ${db:Status-Abbrev}", name).strip(), f"{version} ii")
        machine.execute("apt-get", "check")
        self.wait_for(lambda: machine.execute("systemctl", "is-active", "acsd", may_fail=True).strip() == "active", "acsd is active")
        self.wait_for_auto()

    def test_6_reload_and_watchdog(self):
        former = self.get_main_pid()
        machine.execute("systemctl", "reload", "acsd")
        self.assertEqual(self.get_main_pid(), former)
        machine.execute("kill", "-STOP", former)
        self.wait_for(lambda: self.get_main_pid() not in (former, "0"), "the watchdog restarts acsd", 60)
        self.wait_for(lambda: machine.execute("systemctl", "is-active", "acsd", may_fail=True).strip() == "active", "acsd is active")
        self.wait_for_auto()

    def test_7_a_removal_keeps_configuration_and_store(self):
        machine.execute("systemctl", "stop", "vehicles", "arm")
        machine.execute("rm", "-r", DROP_IN)
        machine.execute("apt-get", "-q", "-y", "remove", "acsd")
        machine.execute("test", "-f", "/var/lib/acsd/store/acsd.db")
        machine.execute("test", "-f", "/etc/acsd/tokens")
        self.assertEqual(machine.execute("pgrep", "-x", "acsd", may_fail=True), "")

    @staticmethod
    def purge():
        names = [read_field(deb, "Package") for deb in pathlib.Path(machine.folder, "trial", "newer").glob("*.deb")]
        machine.execute("apt-get", "-q", "-y", "purge", *names)
        machine.execute("apt-get", "-q", "-y", "autoremove", "--purge")

    def test_8_a_purge_leaves_nothing(self):
        self.purge()
        self.assertEqual(machine.execute("getent", "passwd", "acsd", may_fail=True), "")
        self.assertEqual(machine.execute("getent", "group", "acsd", may_fail=True), "")
        self.assertEqual(sorted((self.list_files() | self.list_named_files()) - self.files_before), [])

    def test_9_what_was_there_before_the_installation_stays(self):
        machine.execute("useradd", "--home-dir", "/trial/acsd", "--create-home", "acsd")
        machine.execute("ln", "-s", "/srv", "/var/lib/acsd")
        output = machine.execute("apt-get", "-q", "-y", "--no-install-recommends", "install", *list_debs("newer"), may_fail=True)
        self.assertIn("/var/lib/acsd must not be a symbolic link", output)
        machine.execute("rm", "/var/lib/acsd")
        machine.execute("mkdir", "/var/lib/acsd")
        machine.execute("mount", "-t", "tmpfs", "tmpfs", "/var/lib/acsd")
        machine.execute("dpkg", "--configure", "-a")
        self.assertEqual(machine.execute("systemctl", "is-active", "acsd").strip(), "active")
        self.purge()
        self.assertEqual(machine.execute("ls", "-A", "/var/lib/acsd"), "")
        self.assertIn("/trial/acsd", machine.execute("getent", "passwd", "acsd"))

    @staticmethod
    def list_named_files():
        """Everywhere, such as the state of units in /var/lib/systemd."""
        return set(machine.execute("find", "/", "-xdev", "-path", "/trial", "-prune", "-o", "-name", "*acs*", "-print").splitlines())

    @staticmethod
    def list_files():
        words = ["find", "/", "-xdev"]
        for place in CHANGING:
            words += ["-path", place, "-prune", "-o"]
        return set(machine.execute(*words, "-print").splitlines())


if __name__ == "__main__":
    PACKAGES, WORK = take_arguments()
    unittest.main(verbosity=2, failfast=True)
