"""A network of this process alone, so that commands can use the ports that a document prints, whatever else runs on the machine."""

import fcntl
import os
import shutil
import socket
import struct
import subprocess
import sys

INSIDE = "ACS_PRIVATE_NETWORK"
SIOCGIFFLAGS, SIOCSIFFLAGS, IFF_UP = 0x8913, 0x8914, 0x1


def bring_up_loopback():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        request = struct.pack("16sH14s", b"lo", 0, b"")
        flags = struct.unpack("16sH14s", fcntl.ioctl(control, SIOCGIFFLAGS, request))[1]
        fcntl.ioctl(control, SIOCSIFFLAGS, struct.pack("16sH14s", b"lo", flags | IFF_UP, b""))


def enter():
    """Starts this program again in a network of its own. Returns False where the system does not permit that."""
    state = os.environ.get(INSIDE)
    if state == "inside":
        return True
    user, group = os.getuid(), os.getgid()
    if state == "bring-up":
        # Root of the new network only; the commands run as the user who started this.
        bring_up_loopback()
        os.environ[INSIDE] = "inside"
        user, group = (int(number) for number in os.environ["ACS_PRIVATE_NETWORK_USER"].split(":"))
        shell = [] if user == 0 else ["unshare", "--user", f"--map-user={user}", f"--map-group={group}", "--"]
        command = [*shell, sys.executable, "-B", *sys.argv]
        os.execvp(command[0], command)
    options = ["--net"] if user == 0 else ["--map-root-user", "--net"]
    if not shutil.which("unshare"):
        return False
    if subprocess.run(["unshare", *options, "true"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        return False
    os.environ[INSIDE] = "bring-up"
    os.environ["ACS_PRIVATE_NETWORK_USER"] = f"{user}:{group}"
    os.execvp("unshare", ["unshare", *options, "--", sys.executable, "-B", *sys.argv])


def list_busy(ports):
    """Which of the ports another program uses."""
    busy = []
    for port in ports:
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                busy.append(port)
    return busy
