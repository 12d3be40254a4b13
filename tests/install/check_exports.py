#!/usr/bin/env python3
"""check_exports.py PREFIX SOVERSION FORBIDDEN_FOLDER...: names, exports and needs of the shared libraries and programs that are
installed in PREFIX. Each exported symbol must belong to a class or a function that an installed header marks with ACS_API, and each
marked function must be exported; libraries that use Boost.Asio share what it remembers for each thread. No file may have a run path in a
forbidden folder."""

import pathlib
import re
import subprocess
import sys

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
MARKED_TYPE = re.compile(r"\b(?:class|struct)\s+ACS_API\s+(\w+)")
MARKED_FUNCTION = re.compile(r"(?<!class )(?<!struct )\bACS_API(?=\s)[^;{}(]*?[\s*&](\w+)\s*\(")
NAMESPACE = re.compile(r"^namespace (ACS::\w+)", re.MULTILINE)
# "vtable for ACS::Core::Logger", "ACS::Core::Result<...> ACS::VDA5050::Vda5050Codec::Decode<...>(...)"
OF_SYMBOL = re.compile(r"^(?:vtable for |VTT for |typeinfo for |typeinfo name for |non-virtual thunk to |virtual thunk to )?(.*)$")
C_LIBRARY = "libacs_protocol_c.so"
ASIO_LIBRARIES = ("libacs_acsd.so", "libacs_openstream_asio.so", "libacs_protocol_beast.so", "libacs_vda5050_mosquitto.so")
# Of each thread that runs an io_context, and of each that runs a strand.
ASIO_THREAD = "boost::asio::detail::keyword_tss_ptr<boost::asio::detail::call_stack<boost::asio::detail::"
PRIVATE = re.compile(r"libacs_(?:json|apps_common|net|world)\b")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def strip_nested(text, opening, closing):
    kept, depth = [], 0
    for letter in text:
        depth += letter == opening
        if depth == 0:
            kept.append(letter)
        depth -= letter == closing
    return "".join(kept)


def read_marked(include):
    """(namespace, name) of the types and of the functions that the headers mark."""
    types, functions = set(), set()
    for header in include.rglob("*.hpp"):
        text = COMMENT.sub("", header.read_text(encoding="utf-8"))
        spaces = NAMESPACE.findall(text)
        for space in spaces:
            types.update((space, name) for name in MARKED_TYPE.findall(text))
            functions.update((space, name) for name in MARKED_FUNCTION.findall(text))
    return types, functions


def get_owner(symbol):
    """(namespace, name) of the class or the function that a demangled symbol belongs to."""
    plain = OF_SYMBOL.match(symbol.replace("(anonymous namespace)", "{}")).group(1)
    plain = strip_nested(re.sub(r"operator(?:<=>|<<|>>|<=|>=|<|>|->)", "operator", plain), "<", ">")
    plain = re.sub(r"\[abi:\w+\]", "", plain).split("(")[0].strip().split(" ")[-1]
    parts = plain.split("::")
    return ("::".join(parts[:2]), parts[2] if len(parts) > 2 else "")


def check_exports(library, types, functions, used):
    symbols = [line.split(" ", 2)[2] for line in run("nm", "-DC", "--defined-only", str(library)).splitlines()]
    symbols = [symbol.split("@")[0] for symbol in symbols if not symbol.startswith("ACS_") and " A " not in symbol]
    if library.name.startswith(C_LIBRARY):
        yield from (f"exports {symbol}" for symbol in symbols if not symbol.startswith("acs_"))
        return
    if library.name.startswith(ASIO_LIBRARIES) and not any(symbol.startswith(f"{ASIO_THREAD}thread_context,") for symbol in symbols):
        yield "has a thread variable of Boost.Asio of its own: an io_context that another library runs crashes in it"
    symbols = [symbol for symbol in symbols if not symbol.startswith(ASIO_THREAD)]
    if not symbols:
        yield "exports nothing"
    for symbol in symbols:
        owner = get_owner(symbol)
        if owner in functions:
            used.add(owner)
        elif owner not in types or "::Impl" in symbol.split("(")[0]:
            yield f"exports {symbol}, which no installed header marks with ACS_API"


def check_dynamic(path, forbidden):
    entries = re.findall(r"\((\w+)\)\s+(?:Shared library|Library r(?:un)?path): \[(.*)\]", run("readelf", "-dW", str(path)))
    for kind, value in ((kind, part) for kind, value in entries for part in value.split(":")):
        if kind in ("RPATH", "RUNPATH") and value.startswith(tuple(forbidden)):
            yield f"has the run path {value}"
        elif kind == "NEEDED" and PRIVATE.search(value):
            yield f"needs {value}, which is internal"


def get_soname(path):
    return re.search(r"\(SONAME\).*\[(.*)\]", run("readelf", "-dW", str(path))).group(1)


def check_prefix(prefix, soversion, forbidden):
    libraries = sorted(path for path in prefix.glob("lib/**/libacs_*.so*") if not path.is_symlink())
    programs = sorted(path for path in prefix.glob("bin/*") if path.is_file())
    types, functions = read_marked(prefix / "include")
    used = set()
    if not libraries:
        yield "no shared library is installed"
    for archive in prefix.glob("lib/**/*.a"):
        yield f"{archive.name} is installed"
    for library in libraries:
        base = library.name[:library.name.index(".so") + len(".so")]
        if base != C_LIBRARY and get_soname(library) != f"{base}.{soversion}":
            yield f"{library.name} has the soname {get_soname(library)}"
        for link in (base, get_soname(library)):
            if (library.parent / link).resolve() != library.resolve():
                yield f"{link} is not a link to {library.name}"
        yield from (f"{library.name} {text}" for text in check_exports(library, types, functions, used))
    for path in (*libraries, *programs):
        yield from (f"{path.name} {text}" for text in check_dynamic(path, forbidden))
    yield from (f"{'::'.join(name)} is marked with ACS_API and not exported" for name in sorted(functions - used))
    print(f"{len(libraries)} libraries, {len(programs)} programs, {len(types)} exported types, {len(functions)} exported functions")


def main():
    findings = list(check_prefix(pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:]))
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
