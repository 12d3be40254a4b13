#!/usr/bin/env python3
"""Runs the code blocks of documents that are marked to be run (blocks.py), as a reader would: in a copy of what a clone has, with
the ports that the document names. Two things differ: the programs are those of a build folder, and simulated robots are faster."""

import argparse
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT / "scripts"))

import private_network
from blocks import MarkError, find_blocks
from source_tree import list_files, read_text

PORTS = (1883, 8080, 8081, 8888, 9001, 49000)
TIME_SCALE = "16"
SECONDS = 90  # of one script, and of waiting for a service to end
FASTER = ("vda-sim", "openstream-sim")
# What a reader sees, curl shows to the test: an HTTP error fails. A program that has just been started is given time.
CURL = "fail-with-body\nretry = 30\nretry-delay = 1\nretry-connrefused\n"


class Failure(Exception):
    pass


def write_program(path, text):
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


def make_clone(folder, programs):
    """What the commands of the documents use of a clone that has been built."""
    shutil.copytree(ROOT / "examples", folder / "examples")
    (folder / "scripts").mkdir()
    write_program(folder / "scripts" / "demo",
                  f"#!/bin/sh\nexec python3 -B '{ROOT}/scripts/demo.py' --bin '{programs}' --time-scale {TIME_SCALE} \"$@\"\n")
    binaries = folder / "build" / "release" / "bin"
    binaries.mkdir(parents=True)
    for program in programs.iterdir():
        options = f"--time-scale {TIME_SCALE} " if program.name in FASTER else ""
        if program.is_file() and os.access(program, os.X_OK):
            write_program(binaries / program.name, f"#!/bin/sh\nexec '{program}' {options}\"$@\"\n")
    (folder / ".curlrc").write_text(CURL, encoding="utf-8")
    return binaries


class Page:
    """One document: its services run until it ends."""

    def __init__(self, path, text, folder, binaries):
        self._path = path
        self._blocks = find_blocks(text)
        self._folder = folder
        self._environment = {**os.environ, "PATH": f"{binaries}:/usr/sbin:{os.environ['PATH']}", "CURL_HOME": str(folder),
                             "TERM": "dumb", "NO_COLOR": "1"}
        self._output = ""
        self._services = []  # (name, line, process, log)

    def _fail(self, line, reason, output=""):
        end = "".join(f"\n    {text}" for text in output.splitlines()[-30:])
        raise Failure(f"{self._path}:{line}: {reason}{end}")

    def _start(self, script, log):
        return subprocess.Popen(["bash", "-euo", "pipefail", "-c", script], cwd=self._folder, env=self._environment,
                                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)

    def _end(self, process, number=signal.SIGTERM):
        if process.poll() is None:
            os.killpg(process.pid, number)
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()

    def _run_script(self, block):
        place = self._folder / "failed-line"
        with tempfile.TemporaryFile(mode="w+", errors="replace") as log:
            process = self._start(f"trap 'echo $LINENO >{place}' ERR\n{block.text}", log)
            try:
                code = process.wait(SECONDS)
            except subprocess.TimeoutExpired:
                code = None
            finally:
                self._end(process)
            log.seek(0)
            output = log.read()
        self._output += output
        if code != 0:
            line = block.line + int(place.read_text(encoding="utf-8")) - 2 if place.exists() else block.line
            reason = f"ended with {code}" if code is not None else f"has not ended within {SECONDS} s"
            self._fail(line, f"the command {reason}", output + self._read_services())
        print(f"{self._path}:{block.line}: passed: {' ... '.join(command for _, command in block.list_commands())}", flush=True)
        self._check_services()

    def _read_services(self):
        text = ""
        for name, _, process, log in self._services:
            end = "\n".join(log.read_text(errors="replace").splitlines()[-8:])
            text += f"--- {name}, exit code {process.poll()}\n{end}\n"
        return text

    def _start_services(self, block):
        for line, command in block.list_commands():
            name = command.split()[0]
            log = self._folder / f"{name}-{line}.log"
            with open(log, "w", encoding="utf-8") as output:
                self._services.append((name, line, self._start(command, output), log))

    def _check_services(self):
        for name, line, process, log in self._services:
            if process.poll() not in (None, 0):
                self._fail(line, f"'{name}' ended with {process.returncode}", log.read_text(errors="replace"))

    def _wait_for(self, name, block):
        found = [service for service in self._services if service[0] == name]
        if not found:
            self._fail(block.line, f"no service '{name}' has been started above")
        begin = time.monotonic()
        for _, line, process, log in found:
            while process.poll() is None:
                self._check_services()
                if time.monotonic() - begin > SECONDS:
                    self._fail(line, f"'{name}' has not ended within {SECONDS} s", log.read_text(errors="replace"))
                time.sleep(0.1)
            self._check_services()
            print(f"{self._path}:{line}: passed: {name}", flush=True)

    def _check_output(self, block):
        # Numbers of columns differ, so that blanks count as one.
        seen = [" ".join(line.split()) for line in self._output.splitlines()]
        for line, text in enumerate(block.text.splitlines(), block.line):
            if " ".join(text.split()) not in seen:
                self._fail(line, f"'{text}' is not in the output of the commands above", self._output)
        print(f"{self._path}:{block.line}: passed: output", flush=True)

    def run(self):
        """The number of blocks that were run."""
        try:
            for block in self._blocks:
                for name in block.after:
                    self._wait_for(name, block)
                if block.kind == "file":
                    (self._folder / block.path).write_text(block.text, encoding="utf-8")
                elif block.kind == "services":
                    self._start_services(block)
                elif block.kind == "output":
                    self._check_output(block)
                else:
                    self._run_script(block)
            self._check_services()
        finally:
            for _, _, process, _ in reversed(self._services):
                self._end(process)
        return len(self._blocks)


def run_page(path, text, programs):
    with tempfile.TemporaryDirectory(prefix="acs-docs-") as name:
        folder = pathlib.Path(name)
        # The copy belongs to the reader: mosquitto and others may read it.
        folder.chmod(0o755)
        return Page(path, text, folder, make_clone(folder, programs)).run()


def count_marks(text):
    return len(re.findall(r"^<!-- run\b", text, re.MULTILINE))


def list_pages():
    """The documents that have marked blocks, except those of the tests."""
    pages = [path for path in list_files(str(ROOT)) if path.endswith(".md") and not path.startswith("tests/")]
    return [path for path in pages if count_marks(read_text(str(ROOT), path)) > 0]


def main():
    parser = argparse.ArgumentParser(description="Runs the code blocks of documents that are marked to be run.")
    parser.add_argument("--bin", required=True, type=pathlib.Path, help="folder of the built programs")
    parser.add_argument("pages", nargs="*", help="documents, relative to the tree (default: all that have marked blocks)")
    arguments = parser.parse_args()
    if not private_network.enter():
        busy = private_network.list_busy(PORTS)
        if busy:
            print(f"skipped: this system permits no private network, and other programs use the ports {busy}")
            return 77
    failures = 0
    for page in arguments.pages or list_pages():
        text = (ROOT / page).read_text(encoding="utf-8")
        try:
            if run_page(page, text, arguments.bin.resolve()) == 0 or count_marks(text) == 0:
                raise Failure(f"{page}:1: has no code block that is marked to be run")
        except (Failure, MarkError) as failure:
            print(failure if isinstance(failure, Failure) else f"{page}: {failure}")
            failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
