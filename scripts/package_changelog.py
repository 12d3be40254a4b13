#!/usr/bin/env python3
"""Prints debian/changelog for a commit: the version is that of project() in CMakeLists.txt, the time that of the commit."""

import argparse
import datetime
import re
import subprocess
import sys

PROJECT = re.compile(r"^project\(acs VERSION ([0-9]+(?:\.[0-9]+){2}) ", re.MULTILINE)
DEBIAN_VERSION = re.compile(r"[0-9][A-Za-z0-9.+~]*")
MAINTAINER = re.compile(r"^Maintainer: (.+)$", re.MULTILINE)


def git(root, *arguments):
    return subprocess.run(["git", "-C", root, *arguments], check=True, capture_output=True, text=True).stdout.strip()


def read_project_version(text):
    match = PROJECT.search(text)
    if match is None:
        sys.exit("package: CMakeLists.txt has no line project(acs VERSION X.Y.Z …)")
    return match.group(1)


def make_version(project, tags, time, commit):
    """The version of a release is that of the project. Any other commit is before it, ordered by its time."""
    if f"v{project}" in tags:
        return project
    return f"{project}~{time:%Y%m%d%H%M%S}.g{commit[:12]}"


def make_changelog(root, commit, version=None):
    if version is not None and not DEBIAN_VERSION.fullmatch(version):
        sys.exit(f"package: '{version}' is no Debian version, such as 0.1.0 or 0.1.0+site1")
    time = datetime.datetime.fromtimestamp(int(git(root, "show", "-s", "--format=%ct", commit)), datetime.timezone.utc)
    project = read_project_version(git(root, "show", f"{commit}:CMakeLists.txt"))
    maintainer = MAINTAINER.search(git(root, "show", f"{commit}:debian/control")).group(1)
    if version is None:
        version = make_version(project, git(root, "tag", "--points-at", commit).split(), time, commit)
    return (f"acs ({version}) unstable; urgency=medium\n\n  * Commit {commit}.\n"
            "    CHANGELOG.md lists the changes of each version.\n\n"
            f" -- {maintainer}  {time:%a, %d %b %Y %H:%M:%S} +0000\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", help="folder of the clone")
    parser.add_argument("commit")
    parser.add_argument("--version", help="Debian version instead of that of the commit")
    arguments = parser.parse_args()
    sys.stdout.write(make_changelog(arguments.root, arguments.commit, arguments.version))


if __name__ == "__main__":
    main()
