#!/usr/bin/env python3
"""Who may include whom: docs/design/architecture.md as a program. Headers in /usr/include need no link line, so only reading
the sources shows a pure library that reaches for a socket or a clock."""

import os
import re
import sys

from source_tree import (CPP_SUFFIXES, IncludeResolver, list_files, list_includes, read_text, run_check,
                         strip_comments_and_strings)

PURE = ("protocol", "vda5050", "openstream", "plan")
IO = {"protocol_beast": "protocol", "vda5050_mosquitto": "vda5050", "openstream_asio": "openstream",
      "plan_postgres": "plan", "plan_sqlite": "plan"}
# Pure, for the tests of users.
KITS = {"adapter_test": "plan"}
# For other languages: pure but for a random source, which their users need not supply.
BINDINGS = {"protocol_c": "protocol"}

# The longest matching folder decides.
FOLDERS = {
    "libacs-core/": "core",
    "libacs-core/json/": "json",
    "libacs-core/net/": "net",
    "libacs-protocol/": "protocol",
    "libacs-protocol/beast/": "protocol_beast",
    "libacs-protocol/c/": "protocol_c",
    "libvda5050/": "vda5050",
    "libvda5050/mosquitto/": "vda5050_mosquitto",
    "libopenstream/": "openstream",
    "libopenstream/asio/": "openstream_asio",
    "libplan/": "plan",
    "libplan/adapter-test/": "adapter_test",
    "libplan/json/": "plan_json",
    "libplan/postgres/": "plan_postgres",
    "libplan/sqlite/": "plan_sqlite",
    "apps/common/": "apps/common",
    "apps/acsd/include/": "drivers",
    "examples/": "examples",
    "tests/support/": "tests/support",
    "tests/": "tests",
}

LIBRARIES = {"core", *PURE, *IO, *KITS, *BINDINGS}
SIMULATORS = ("apps/mcs-sim", "apps/openstream-sim", "apps/vda-sim")
THIRD_PARTY = {
    "core": ("fmt/", "tl/"),
    "json": ("fmt/", "tl/", "rapidjson/"),
    "plan_json": (),
    "net": ("fmt/", "tl/", "boost/asio", "boost/system/"),
    **{layer: ("fmt/", "tl/") for layer in (*PURE, *KITS)},
    **{layer: ("fmt/", "tl/", "acs/c/") for layer in BINDINGS},
    "protocol_beast": ("fmt/", "tl/", "boost/", "openssl/", "linux/sockios.h", "sys/ioctl.h"),
    "vda5050_mosquitto": (
        "fmt/", "tl/", "boost/asio", "boost/system/", "mosquitto.h", "mqtt_protocol.h", "openssl/", "unistd.h"),
    "openstream_asio": (
        "fmt/", "tl/", "boost/asio", "boost/system/", "netinet/", "linux/sockios.h", "pthread.h", "sched.h", "sys/ioctl.h", "sys/mman.h", "sys/prctl.h",
        "sys/socket.h"),
    "plan_postgres": ("fmt/", "tl/", "arpa/inet.h", "libpq-fe.h", "netdb.h", "poll.h"),
    "plan_sqlite": ("fmt/", "tl/", "SQLiteCpp/", "sqlite3.h", "fcntl.h", "sys/file.h", "sys/stat.h", "unistd.h"),
}
PUBLIC_THIRD_PARTY = ("fmt/", "tl/", "boost/asio/any_io_executor.hpp")
DRIVER_LIBRARIES = ("core", "plan", "vda5050", "openstream", "openstream_asio")
THIRD_PARTY["drivers"] = PUBLIC_THIRD_PARTY  # the public headers of acsd
IMPURE_STANDARD = ("thread", "mutex", "shared_mutex", "condition_variable", "future", "semaphore", "latch", "barrier",
                   "stop_token", "filesystem", "fstream", "iostream", "ctime")
RANDOM_SOURCE = re.compile(r"\brandom_device\b")
IMPURE_TOKENS = (
    (re.compile(r"_clock\s*::\s*now\b"), "reads a clock; take Core::Now as an argument"),
    (RANDOM_SOURCE, "draws random numbers; take Core::IRandom& as an argument"),
    (re.compile(r"\bstd\s*::\s*(?:jthread|thread|mutex|async)\b"), "uses threads; a machine runs on its caller's thread"),
    (re.compile(r"\b(?:getenv|system)\s*\("), "reaches for the operating system; take the value as an argument"),
)
SLEEP = re.compile(r"\b(?:sleep_for|sleep_until|usleep|nanosleep)\b")
MAIN_LINES = 60


def get_layer(path):
    folders = [folder for folder in FOLDERS if path.startswith(folder)]
    if folders:
        return FOLDERS[max(folders, key=len)]
    parts = path.split("/")
    if parts[0] == "apps" and len(parts) > 2:
        return "/".join(parts[:2])
    return None


def is_public_header(path, layer):
    return layer in LIBRARIES and "/include/" in path


def explain_refusal(path, layer, used):
    """Why a file of this layer must not include one of the layer `used`; None where it may."""
    if used in (layer, None):
        return None
    if used.startswith("tests"):
        return None if layer.startswith("tests") else "belongs to the tests; only tests/ may include it"
    if layer == "tests":
        return None
    if used == "drivers":
        if layer in ("apps/acsd", "examples"):
            return None
        return "is for programs with robot drivers; only apps/acsd and examples/ may include it"
    if layer == "drivers":
        if used in DRIVER_LIBRARIES:
            return None
        return f"is hidden from robot drivers: they see acs/{', acs/'.join(DRIVER_LIBRARIES)} only"
    if used == "plan_json":
        if layer in ("plan", "apps/acsd") and path.endswith(".cpp"):
            return None
        return "is internal; only .cpp files of libplan and apps/acsd may include acs/plan_json"
    if used.startswith("apps/"):
        if layer.startswith("apps/") and used == "apps/common":
            return None
        if layer in SIMULATORS and used == "apps/world":
            return None
        return "belongs to a program; nothing outside it includes it: move what both need to a library or apps/common"
    if layer.startswith("apps/"):
        return None
    if used == "examples":
        return "is an example; no other file may include it"
    if used == "json":
        if layer == "plan_json" or layer in PURE and (path.endswith(".cpp") or "/src/codec/" in path):
            return None
        return "is internal; only .cpp files and src/codec/ of the pure libraries may include acs/json"
    if layer == "plan_json":
        return None if used in ("core", "json", "plan") else "lies above libplan: it sees acs/core, acs/json and acs/plan only"
    if used == "net":
        if layer in IO and "/src/" in path:
            return None
        return "is internal; only src/ of the I/O libraries and apps/ may include acs/net"
    if layer == "examples":
        return None
    if layer in ("core", "json", "net"):
        return None if used == "core" else "lies above the base libraries; turn the dependency round"
    if layer in PURE:
        if used == "core":
            return None
        return "is another library; the pure libraries see only acs/core: join them in apps/acsd"
    if layer in KITS:
        if used in ("core", KITS[layer]):
            return None
        return f"is out of reach of a test kit: it sees acs/core and acs/{KITS[layer]} only"
    if layer in BINDINGS:
        if used in ("core", BINDINGS[layer]):
            return None
        return f"is out of reach of a C interface: it sees acs/core and acs/{BINDINGS[layer]} only"
    if layer in IO:
        if used in ("core", IO[layer]):
            return None
        return f"is out of reach of an I/O library: it sees acs/core and acs/{IO[layer]} only"
    if layer == "tests/support":
        return None if used == "core" or used in PURE else "is above tests/support, which sees the pure libraries only"
    return None


def explain_foreign(path, layer, name):
    """Why a header that is not of this tree must not be included here; None where it may."""
    bStandard = "/" not in name and "." not in name
    if layer in ("core", "json", "plan_json", *PURE, *KITS, *BINDINGS) and (name in IMPURE_STANDARD or name in ("time.h", "pthread.h")):
        return "is not for a pure library: no threads, files or clocks below the I/O libraries"
    if bStandard or layer not in THIRD_PARTY:
        return None
    if name.startswith(THIRD_PARTY[layer]):
        if is_public_header(path, layer) and not name.startswith(PUBLIC_THIRD_PARTY):
            return "must not be seen by users of a public header; hide it in src/ behind a pointer to an implementation"
        return None
    return f"is not among what layer '{layer}' may use ({', '.join(THIRD_PARTY[layer])})"


def check_cpp(root, path, layer, resolver):
    text = read_text(root, path)
    code = strip_comments_and_strings(text)
    for line, quoted, name in list_includes(text):
        target = resolver.find(path, quoted, name)
        if target is not None:
            reason = explain_refusal(path, layer, get_layer(target))
        else:
            reason = explain_foreign(path, layer, name)
        if reason is not None:
            yield line, f"<{name}> {reason}"
    pure = layer in ("core", "json", "plan_json", *PURE, *KITS, *BINDINGS)
    for line, content in enumerate(code.splitlines(), 1):
        if SLEEP.search(content):
            yield line, "sleeps; wait for the event with a timer or a bounded wait"
        for pattern, reason in IMPURE_TOKENS if pure else ():
            if pattern.search(content) and not (layer in BINDINGS and pattern is RANDOM_SOURCE):
                yield line, reason
    if path.startswith("apps/") and os.path.basename(path) == "main.cpp":
        count = text.count("\n")
        if count > MAIN_LINES:
            yield MAIN_LINES + 1, f"main.cpp has {count} lines, more than {MAIN_LINES}; move code to the program's library"


def check_cmake(root, path):
    for line, content in enumerate(read_text(root, path).splitlines(), 1):
        if "acs_test_support" in content.split("#")[0]:
            yield line, "links the tests' support library; only tests/ may"


def check_tree(root):
    files = list_files(root)
    resolver = IncludeResolver([path for path in files if path.endswith(CPP_SUFFIXES)])
    for path in files:
        layer = get_layer(path)
        if layer is None or path.startswith("tests/style/bad/"):
            continue
        if path.endswith(CPP_SUFFIXES):
            found = check_cpp(root, path, layer, resolver)
        elif path.endswith("CMakeLists.txt") and not layer.startswith("tests"):
            found = check_cmake(root, path)
        else:
            continue
        for line, reason in found:
            yield f"{path}:{line}: {reason}"


if __name__ == "__main__":
    sys.exit(run_check("Checks which layer includes which", check_tree))
