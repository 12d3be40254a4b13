"""Starts and stops the programs of a whole line: broker, simulators and acsd, each on a free port, in a temporary folder.

Used by scripts/demo.py and by the tests that need real processes. Every child is ended when the line is left, however
that happens; should this process be killed, the kernel ends the children (PR_SET_PDEATHSIG).
"""

import contextlib
import ctypes
import os
import pathlib
import queue
import shutil
import signal
import socket
import subprocess
import tempfile
import threading
import time

READY_SECONDS = 30.0
STOP_SECONDS = 10.0
BROKER_TRIES = 5
PR_SET_PDEATHSIG = 1
INTERRUPTIONS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class LineError(Exception):
    """Something that the user should read: one sentence, and the end of the log of the program that failed."""

    def __init__(self, sentence, program=None):
        super().__init__(sentence)
        self.program = program


def _prepare_child():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, INTERRUPTIONS)


@contextlib.contextmanager
def _interruptions_held():
    """An interruption inside takes effect after it."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, INTERRUPTIONS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Program:
    """A child process whose output goes to a log file, or its standard error to log_descriptor; its standard output is
    watched for the ready line too."""

    def __init__(self, name, argv, folder, on_output=None, stdin=subprocess.DEVNULL, environment=None, bufsize=-1,
                 log_descriptor=None):
        self.name = name
        self.log = pathlib.Path(folder) / f"{name}.log"
        self.addresses = {}
        self._on_output = on_output
        self._ready = queue.Queue()
        self._log_file = open(self.log, "ab", buffering=0)
        try:
            self.process = subprocess.Popen(
                argv, cwd=folder, env=environment, stdin=stdin, stdout=subprocess.PIPE, stderr=self._log_file if log_descriptor is None else log_descriptor,
                bufsize=bufsize, start_new_session=True, preexec_fn=_prepare_child)
        except OSError as error:
            raise LineError(f"{name} cannot be started: {error.strerror}: {argv[0]}") from error
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        pending = b""
        while chunk := os.read(self.process.stdout.fileno(), 65536):
            if self._on_output is not None:
                self._on_output(chunk)
            self._log_file.write(chunk)
            if self.addresses:
                continue
            pending += chunk
            *lines, pending = pending.split(b"\n")
            for line in lines:
                if line.startswith(b"ready:"):
                    self.addresses = dict(part.split("=", 1) for part in line.decode().split()[1:])
                    self._ready.put(True)
        self._ready.put(False)

    def wait_ready(self, timeout=READY_SECONDS):
        try:
            ready = self._ready.get(timeout=timeout)
        except queue.Empty:
            raise LineError(f"{self.name} is not ready after {timeout:.0f} s", self) from None
        if not ready:
            raise LineError(f"{self.name} ended with exit code {self.process.wait()} before it was ready", self)
        return self.addresses

    def is_running(self):
        return self.process.poll() is None

    def wait(self, timeout=None):
        """Exit code; all output has been read then."""
        code = self.process.wait(timeout)
        self._reader.join()
        return code

    def send_signal(self, number):
        if self.is_running():
            self.process.send_signal(number)

    def stop(self, timeout=STOP_SECONDS):
        """SIGTERM, then SIGKILL. Returns the exit code."""
        self.send_signal(signal.SIGTERM)
        try:
            code = self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            self.process.kill()
            code = self.process.wait()
        self._reader.join(timeout)
        if not self._reader.is_alive():
            self.process.stdout.close()
        self._log_file.close()
        return code

    def tail(self, lines=20):
        return self.log.read_text(errors="replace").splitlines()[-lines:]


def find_free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Line:
    """A temporary folder and the programs that run in it; use it in a `with` statement."""

    def __init__(self, bin_dir, site_dir, keep_folder=False):
        self.bin_dir = pathlib.Path(bin_dir).resolve()
        self.site_dir = pathlib.Path(site_dir).resolve()
        self._keep_folder = keep_folder
        self.folder = None
        self.programs = []
        self.broker = None
        self.broker_port = None
        self.world = None

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-line-"))
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        """Ends all programs, the youngest first, and removes the folder. May be called twice."""
        while self.programs:
            self.programs.pop().stop()
        if self.folder is not None and not self._keep_folder:
            shutil.rmtree(self.folder, ignore_errors=True)
        self.folder = None

    def start(self, name, *arguments, binary=None, **options):
        with _interruptions_held():  # else one between the two would leave the process behind
            program = Program(name, [str(binary or self.bin_dir / name), *map(str, arguments)], self.folder, **options)
            self.programs.append(program)
        return program

    def forget(self, program):
        """For a program that a test ends itself."""
        self.programs.remove(program)

    def start_broker(self, port=None, access=("allow_anonymous true",)):
        """mosquitto with a private configuration. It cannot select a free port itself: pick one and retry."""
        binary = shutil.which("mosquitto") or shutil.which("mosquitto", path="/usr/sbin:/sbin:/usr/local/sbin")
        if binary is None:
            raise LineError("mosquitto is not installed; run scripts/setup")
        for _ in range(BROKER_TRIES):
            chosen = port or find_free_port()
            config = self.folder / "mosquitto.conf"
            lines = [f"listener {chosen} 127.0.0.1", *access, "persistence false"]
            if os.geteuid() == 0:
                lines.append("user root")  # else it becomes user mosquitto, who cannot read in this folder
            config.write_text("\n".join(lines) + "\n")
            broker = self.start("mosquitto", "-c", config, binary=binary)
            if self._wait_for_port(broker, chosen):
                self.broker, self.broker_port = broker, chosen
                return chosen
            self.programs.remove(broker)
            broker.stop()
        raise LineError("mosquitto does not start", broker)

    @staticmethod
    def _wait_for_port(program, port):
        deadline = time.monotonic() + READY_SECONDS
        while program.is_running() and time.monotonic() < deadline:
            try:
                with socket.create_connection(("127.0.0.1", port), timeout=1):
                    return program.is_running()
            except OSError:
                try:
                    program.process.wait(0.02)
                except subprocess.TimeoutExpired:
                    pass
        return False

    def share_world(self):
        """Lets the simulators that are started from now on share one floor: the site's world file and its journal."""
        self.world = pathlib.Path(shutil.copy(self.site_dir / "world.json", self.folder))

    def _world_options(self):
        return () if self.world is None else ("--world", self.world)

    def start_vehicles(self, time_scale, vehicles=("LR01,type=LR", "CR01,type=CR"), port=None, faults=(), options=()):
        options = [*options, *[part for vehicle in vehicles for part in ("--vehicle", vehicle)]]
        options += [part for fault in faults for part in ("--fault", fault)]
        return self.start("vda-sim", "--broker", f"mqtt://127.0.0.1:{port or self.broker_port}", "--site",
                          self.site_dir / "site.lif.json", "--time-scale", time_scale, *options, *self._world_options())

    def start_arm(self, time_scale, *options, programs=None):
        return self.start("openstream-sim", "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0",
                          "--programs", programs or self.site_dir / "programs.toml", "--robot", "1=CR01",
                          "--time-scale", time_scale, *options, *self._world_options())

    def start_mcs(self, plans, *arguments, port=0, **options):
        return self.start("mcs-sim", "--listen", f"127.0.0.1:{port}", *self._world_options(), *arguments,
                          *[part for plan in plans for part in ("--plan", plan)], **options)

    def start_acsd(self, mcs_address, arm_addresses, *overrides, config=None, arguments=(), **options):
        settings = {
            "mcs.url": f"ws://{mcs_address}/acs/",
            **({} if any(part.startswith("mqtt.urls=") for part in overrides) else
               {"mqtt.url": f"mqtt://127.0.0.1:{self.broker_port}"}),
            "store.directory": str(self.folder / "store"),
            "http.listen": "127.0.0.1:0",
            "operator.listen": "127.0.0.1:0",
            "robots.CR01.arm.url": f"tcp://{arm_addresses['stream']}",
        }
        if any(override.startswith("store.url=") for override in overrides):
            del settings["store.directory"]
        sets = [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]
        sets += [part for override in overrides for part in ("--set", override)]
        return self.start("acsd", "--config", config or self.site_dir / "acsd.toml", *sets, *arguments, **options)
