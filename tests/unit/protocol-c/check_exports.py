#!/usr/bin/env python3
"""check_exports.py NM LIBRARY HEADER: the library exports exactly the functions that its header declares."""

import re
import subprocess
import sys


def main():
    nm, library, header = sys.argv[1:]
    output = subprocess.run([nm, "-D", "--defined-only", library], stdout=subprocess.PIPE, text=True, check=True).stdout
    exported = {line.split()[-1] for line in output.splitlines()}
    with open(header, encoding="utf-8") as file:
        declared = set(re.findall(r"^ACS_C_EXPORT \w+ (acs_\w+)\(", file.read(), re.MULTILINE))
    for name in sorted(exported - declared):
        print(f"{name} is exported, but not declared in the header")
    for name in sorted(declared - exported):
        print(f"{name} is declared in the header, but not exported")
    print(f"{len(declared)} functions")
    return 0 if declared and exported == declared else 1


if __name__ == "__main__":
    sys.exit(main())
