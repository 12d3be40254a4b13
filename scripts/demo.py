#!/usr/bin/env python3
"""Runs a whole line on this machine: an MCS, acsd, a logistics robot and a control robot with an arm."""

import argparse
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from production_line import Line, LineError  # noqa: E402

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
PLANS = [REPOSITORY / "examples" / "plans" / name for name in ("lr-cassette.json", "cr-tray.json")]


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="demo", description="Sends example plans from a simulated MCS through acsd to simulated robots: real "
        "WebSocket, real MQTT broker, real Open Stream. Exit code 0 when every plan was completed, every report was right "
        "and every carrier is where its plan had it brought, else 1.")
    parser.add_argument("--plans", type=int, default=1, metavar="N", help="send N of each example plan (default 1)")
    parser.add_argument("--keep", action="store_true",
                        help="print the addresses, send the plans when Enter is pressed (at once without a terminal), "
                        "and leave everything running until Ctrl-C")
    parser.add_argument("--time-scale", type=float, default=8.0, metavar="X",
                        help="how many times faster than life the robots move (default 8)")
    parser.add_argument("--logs", metavar="FOLDER", help="copy the programs' logs there at the end")
    parser.add_argument("--bin", default=REPOSITORY / "build" / "release" / "bin", type=pathlib.Path,
                        help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.plans < 1:
        parser.error("--plans must be 1 or more")
    if not 0.01 <= arguments.time_scale <= 1000:
        parser.error("--time-scale must be from 0.01 to 1000")
    if arguments.logs:
        try:
            make_writable_folder(arguments.logs)
        except OSError as error:
            parser.error(f"--logs: {arguments.logs}: {error.strerror}")
    return arguments


def make_writable_folder(folder):
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryFile(dir=folder):
        pass


def terminal_environment():
    """mcs-sim writes to our pipe: its environment has the size of the terminal."""
    size = shutil.get_terminal_size()
    return {**os.environ, "COLUMNS": str(size.columns), "LINES": str(size.lines)}


def open_missing_streams():
    """A stream that the caller has closed (`>&-`) is /dev/null, so that no file of ours takes its number."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            stream = open(os.devnull, "w" if number else "r")
            if stream.fileno() != number:
                os.dup2(stream.fileno(), number)
            setattr(sys, name, stream)


def is_live_terminal():
    """One that can draw in place: no pipe, no file, and not a terminal that only prints."""
    return sys.stdout.isatty() and os.environ.get("TERM", "dumb") != "dumb"


class Output:
    """Copies the output of mcs-sim to our own; ends when our output is closed."""

    def __init__(self):
        self.error = None

    def forward(self, chunk):
        if self.error is not None:
            return
        try:
            sys.stdout.buffer.write(chunk)
            sys.stdout.buffer.flush()
        except OSError as error:
            self.error = error
            # Else Python tries once more to write what is left, when it ends.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())

    def check(self):
        if self.error is not None:
            raise LineError(f"the output cannot be written: {self.error.strerror}")


def start_line(line, arguments, output):
    """The order is that of a plant: first what others connect to. All programs retry, so it does not matter."""
    line.share_world()
    line.start_broker()
    vehicles = line.start_vehicles(arguments.time_scale)
    arm = line.start_arm(arguments.time_scale)
    live = is_live_terminal()
    wait = arguments.keep and sys.stdin.isatty()
    mcs = line.start_mcs(
        PLANS, "--repeat", arguments.plans, "--fresh-ids", "--live", "always" if live else "never",
        *(["--keep"] if arguments.keep else []), *(["--wait-for-enter"] if wait else []),
        environment=terminal_environment(), on_output=output.forward,
        stdin=subprocess.PIPE if wait else subprocess.DEVNULL)
    mcs_address = mcs.wait_ready()["ws"]
    acsd = line.start_acsd(mcs_address, arm.wait_ready())
    acsd.wait_ready()
    vehicles.wait_ready()
    output.check()
    if arguments.keep:
        print(f"broker      mqtt://127.0.0.1:{line.broker_port}\n"
              f"MCS         ws://{mcs_address}/acs/\n"
              f"Open Stream tcp://{arm.addresses['stream']}\n"
              f"Open API    http://{arm.addresses['http']}\n"
              f"acsd        http://{acsd.addresses['operator']}/\n"
              f"world       {line.world}.journal\n"
              f"logs        {line.folder}", flush=True)
    if wait:
        input("Press Enter to send the plans, Ctrl-C to end everything. ")
        mcs.process.stdin.write(b"\n")
        mcs.process.stdin.flush()
    return mcs


def watch(line, mcs, output):
    """Until mcs-sim ends; a program that dies under it is a failure at once."""
    while mcs.is_running():
        output.check()
        for program in line.programs:
            if program is not mcs and not program.is_running():
                raise LineError(f"{program.name} ended with exit code {program.wait()} while plans were running",
                                program)
        try:
            mcs.process.wait(0.2)
        except subprocess.TimeoutExpired:
            pass
    code = mcs.wait()
    output.check()
    return code


def save_logs(line, folder):
    try:
        for program in line.programs:
            shutil.copy(program.log, folder)
    except OSError as error:
        raise LineError(f"the logs cannot be copied to {folder}: {error.strerror}") from error


def report(error):
    try:
        sys.stdout.flush()
    except OSError:
        pass  # this may be what is reported
    print(f"demo: {error}", file=sys.stderr)
    if getattr(error, "program", None) is not None:
        print(f"--- the end of {error.program.name}'s log ---", file=sys.stderr)
        print("\n".join(error.program.tail()), file=sys.stderr)


class Interruption:
    """Turns the first SIGINT, SIGTERM or SIGHUP into KeyboardInterrupt, but only while that is expected: a second
    Ctrl-C must not cut the clean-up short, one before the line exists must not be lost."""

    def __init__(self):
        self._armed = False
        self._pending = False
        numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
        for number in numbers:
            signal.signal(number, self._handle)
        # scripts/demo has them blocked while the interpreter starts, which answers a Ctrl-C with a traceback.
        signal.pthread_sigmask(signal.SIG_UNBLOCK, numbers)

    def _handle(self, *_):
        if self._armed:
            self._armed = False
            raise KeyboardInterrupt
        self._pending = True

    def arm(self):
        self._armed = True
        if self._pending:
            self._armed = False
            raise KeyboardInterrupt

    def disarm(self):
        self._armed = False


def main():
    open_missing_streams()
    arguments = parse_arguments()
    interruption = Interruption()
    output = Output()
    mcs = None
    with Line(arguments.bin, REPOSITORY / "examples" / "site") as line:
        try:
            interruption.arm()
            mcs = start_line(line, arguments, output)
            code = watch(line, mcs, output)
        except (KeyboardInterrupt, EOFError):
            # mcs-sim knows what came of the plans: its exit code is ours.
            code = mcs.stop() if mcs is not None else 1
        except (LineError, OSError) as error:
            report(error)
            code = 1
        finally:
            interruption.disarm()
            if arguments.logs:
                try:
                    save_logs(line, arguments.logs)
                except LineError as error:
                    report(error)
                    code = 1
    return 0 if code == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
