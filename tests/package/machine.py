"""A Debian 12 machine in a folder: made by mmdebstrap, booted with systemd by systemd-nspawn, without a network."""

import os
import pathlib
import signal
import subprocess
import sys
import time

PATH = "/usr/sbin:/usr/bin:/sbin:/bin"
BOOT_SECONDS = 120


def run(*command, timeout=900, **options):
    """The output of a command on this machine; an error has its last lines."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          text=True, timeout=timeout, check=False, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(str(word) for word in command)} ended with {done.returncode}:\n{done.stdout[-4000:]}")
    return done.stdout


def take_arguments():
    """PACKAGES and WORK of the command line. A test without root or packages is skipped."""
    packages, work = sys.argv.pop(1), sys.argv.pop(1)
    if os.geteuid() != 0:
        print("skipped: a machine in a folder needs root")
        sys.exit(77)
    if not list(pathlib.Path(packages).glob("*.deb")):
        print(f"skipped: {packages} has no packages; scripts/package makes them")
        sys.exit(77)
    os.makedirs(work, exist_ok=True)
    return packages, work


def make_base(archive, packages):
    """The archive of a minimal system with these packages, made once."""
    archive = pathlib.Path(archive)
    wanted = ",".join(sorted(packages))
    note = archive.with_suffix(".packages")
    if archive.exists() and note.exists() and note.read_text(encoding="utf-8") == wanted:
        return
    archive.parent.mkdir(parents=True, exist_ok=True)
    run("mmdebstrap", "--variant=minbase", f"--include={wanted}", "bookworm", archive, timeout=1800)
    note.write_text(wanted, encoding="utf-8")


class Machine:
    def __init__(self, folder, archive):
        self.folder = pathlib.Path(folder)
        self._log = self.folder.parent / "console.log"
        self._name = f"acs-trial-{os.getpid()}"
        self._process = None
        self._leader = None
        self.folder.mkdir()
        run("tar", "-x", "-f", archive, "-C", self.folder, "--exclude=./dev/*")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def run_outside(self, *command):
        """In the folder, before the machine is booted, with the network of this machine."""
        return run("systemd-nspawn", "--quiet", "--register=no", "--keep-unit", f"--machine={self._name}", "--pipe", "-D", self.folder, *command)

    def boot(self):
        with open(self._log, "wb") as log:
            self._process = subprocess.Popen(
                ["systemd-nspawn", "--quiet", "--register=no", "--keep-unit", f"--machine={self._name}", "--private-network", "--boot", "-D",
                 str(self.folder)],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        end = time.monotonic() + BOOT_SECONDS
        while time.monotonic() < end:
            if self._process.poll() is not None:
                raise RuntimeError(f"systemd-nspawn ended with {self._process.returncode}: {self._log.read_text()[-2000:]}")
            children = pathlib.Path(f"/proc/{self._process.pid}/task/{self._process.pid}/children").read_text(encoding="ascii").split()
            if children:
                self._leader = children[0]
                if self.execute("systemctl", "is-system-running", may_fail=True).strip() in ("running", "degraded"):
                    return
            time.sleep(0.5)
        raise RuntimeError(f"the machine has not booted within {BOOT_SECONDS} s: {self._log.read_text()[-2000:]}")

    def execute(self, *command, may_fail=False, timeout=300):
        """The output of a command in the machine."""
        words = ["nsenter", f"--target={self._leader}", "--mount", "--uts", "--ipc", "--net", "--pid", "--root", "--wd", "--", "env",
                 "-i", f"PATH={PATH}", "LC_ALL=C.UTF-8", "DEBIAN_FRONTEND=noninteractive", "HOME=/root", *map(str, command)]
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True,
                              timeout=timeout, check=False)
        if done.returncode != 0 and not may_fail:
            raise RuntimeError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout[-4000:]}")
        return done.stdout

    def get_exit_code(self, unit):
        return self.execute("systemctl", "show", "--value", "-p", "ExecMainStatus", unit).strip()

    def stop(self):
        if self._process is None or self._process.poll() is not None:
            return
        if self._leader is not None:
            # Of the init of a container: power off.
            os.kill(int(self._leader), signal.SIGRTMIN + 4)
        try:
            self._process.wait(30)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
