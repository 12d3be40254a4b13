"""The PostgreSQL of Debian with data of its own, on a free port, for stores that several processes share."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import time

from production_line import LineError, find_free_port

START_SECONDS = 60
FOLDER = pathlib.Path("/usr/lib/postgresql")  # Debian does not put the programs of the server into PATH


def _find(name):
    found = sorted(FOLDER.glob(f"*/bin/{name}"))
    if not found:
        raise LineError(f"there is no {name}: run scripts/setup")
    return str(found[-1])


def _as_server(command):
    """The server does not run as root."""
    if os.geteuid() != 0:
        return command
    return ["setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups", "--pdeathsig=SIGKILL", *command]


class PostgresServer:
    """Started at once; the line ends it. With `primary` it is a synchronous replica of that server."""

    def __init__(self, line, primary=None):
        self._line = line
        self._folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-postgres-"))
        if os.geteuid() == 0:
            shutil.chown(self._folder, "postgres", "postgres")
        self._data = self._folder / "data"
        if primary is None:
            self._run("initdb", "-D", self._data, "-U", "acsd", "-A", "trust", "-E", "UTF8", "--locale=C", "--no-sync")
        else:
            self._run("pg_basebackup", "-D", self._data, "-R", "-X", "stream", "-d", f"{primary.get_url()}?application_name=replica")
        self.port = find_free_port()
        self.start()
        if primary is not None:
            primary.execute("ALTER SYSTEM SET synchronous_standby_names = 'replica'")
            primary.execute("SELECT pg_reload_conf()")
            deadline = time.monotonic() + START_SECONDS
            while primary.execute("SELECT count(*) FROM pg_stat_replication WHERE sync_state = 'sync'") != "1":
                if time.monotonic() > deadline:
                    raise LineError("the replica is not synchronous", self.program)
                time.sleep(0.05)

    @staticmethod
    def _run(name, *arguments):
        subprocess.run(_as_server([_find(name), *map(str, arguments)]), check=True, stdout=subprocess.DEVNULL)

    def promote(self):
        """The replica becomes a primary."""
        self._run("pg_ctl", "promote", "-D", self._data, "-w")
        self.execute("ALTER SYSTEM RESET synchronous_standby_names")
        self.execute("SELECT pg_reload_conf()")

    def get_url(self, database="postgres", port=None, user="acsd"):
        return f"postgresql://{user}@127.0.0.1:{port or self.port}/{database}"

    def start(self):
        command = _as_server([_find("postgres"), "-D", str(self._data), "-k", str(self._folder), "-p", str(self.port)])
        self.program = self._line.start("postgres", *command[1:], binary=shutil.which(command[0]))
        deadline = time.monotonic() + START_SECONDS
        while not self._is_ready():
            if not self.program.is_running() or time.monotonic() > deadline:
                raise LineError("PostgreSQL does not start", self.program)
            time.sleep(0.05)

    def kill(self):
        self._line.forget(self.program)
        self.program.process.kill()
        self.program.stop()

    def execute(self, sql, database="postgres"):
        """Statements separated by semicolons. What psql prints, without headers."""
        result = subprocess.run(["psql", "-X", "-q", "-A", "-t", "-v", "ON_ERROR_STOP=1", "-c", sql, self.get_url(database)],
                                check=True, capture_output=True, text=True)
        return result.stdout.strip()

    def remove(self):
        shutil.rmtree(self._folder, ignore_errors=True)

    def _is_ready(self):
        return subprocess.run(["pg_isready", "-q", "-h", "127.0.0.1", "-p", str(self.port)], check=False).returncode == 0
