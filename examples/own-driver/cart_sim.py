#!/usr/bin/env python3
"""The cart. cart_sim.py PORT JOURNAL NODE SECONDS [JOB_SECONDS]: for an edge, for a job. Port 0 selects a free one."""
import asyncio
import os
import sys


class Cart:
    def __init__(self, journal, node, seconds, job_seconds=None):
        self.journal, self.node, self.seconds = open(journal, "ab+", buffering=0), node, float(seconds)
        self.job_seconds = float(job_seconds or seconds)
        self.journal.seek(0)
        lines = self.journal.read()
        self.size = lines.rfind(b"\n") + 1
        self.journal.truncate(self.size)  # a torn line is no executed job
        words = map(str.split, lines[:self.size].decode().split("\n"))
        jobs = [word[0] for word in words if word]  # executed, also before a restart
        self.done, self.last = set(jobs), jobs[-1] if jobs else "-"
        self.next, self.job, self.writer = "-", None, None

    def send(self, *words):
        if self.writer is not None:
            self.writer.write((" ".join(words) + "\n").encode())

    def report(self):
        self.send("state", self.node, self.next, self.last)

    async def serve(self, reader, writer):
        if self.writer is not None:
            self.writer.transport.abort()
        self.writer = writer
        self.report()
        try:
            while words := (await reader.readline()).decode().split():
                if self.writer is not writer:
                    return  # one master at a time: what is left of the old connection is void
                getattr(self, "on_" + words[0])(*words[1:])
        except (AttributeError, TypeError, ValueError, ConnectionError) as error:
            print("connection closed:", repr(error), file=sys.stderr, flush=True)
        finally:
            writer.close()

    def on_go(self, drive, node):
        if node in (self.node, self.next):
            self.report()  # sent twice
        elif self.job or self.next != "-":
            self.send("refused", drive, "busy")
        else:
            self.last, self.next = drive, node
            asyncio.ensure_future(self.drive())

    async def drive(self):
        self.report()
        await asyncio.sleep(self.seconds)
        self.node, self.next = self.next, "-"
        self.report()

    def on_job(self, job, *what):
        if job in self.done or job == self.job:
            self.send("refused", job, "known")
        elif self.job or self.next != "-":
            self.send("refused", job, "busy")
        else:
            self.last = self.job = job
            asyncio.ensure_future(self.work(job, what))

    async def work(self, job, what):
        self.on_ask(job)
        await asyncio.sleep(self.job_seconds)
        line = (" ".join((job, *what)) + "\n").encode()
        try:
            self.write(line)
            self.size += len(line)
            self.done.add(job)
        except OSError:  # for example a full disk
            self.journal.truncate(self.size)  # otherwise the next line would continue this one
        self.job = None
        self.on_ask(job)

    def write(self, line):
        while line:
            line = line[self.journal.write(line):]
        os.fsync(self.journal.fileno())

    def on_ask(self, job):
        self.send("job", job, "done" if job in self.done else "running" if job == self.job else "unknown")


async def main(port, *cart):
    cart = Cart(*cart)
    server = await asyncio.start_server(cart.serve, "127.0.0.1", int(port))
    print("ready: cart=127.0.0.1:%d" % server.sockets[0].getsockname()[1], flush=True)
    while await asyncio.sleep(1, True):
        cart.report()

asyncio.run(main(*sys.argv[1:]))
