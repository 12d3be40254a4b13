#!/usr/bin/env python3
"""test_packages.py PACKAGES: the Debian packages of scripts/package: lintian, contents, hashes, SPDX file, binary interface."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from repack import read_field, repack

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
PACKAGES = pathlib.Path()
NAMES = {"acs-doc", "acs-sims", "acsctl", "acsd", "libacs-dev", "libacs0"}


def run(*command):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                          stdin=subprocess.DEVNULL)


def list_debs():
    return [deb for deb in sorted(PACKAGES.glob("*.deb")) if "-dbgsym_" not in deb.name]


class Packages(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-package-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def extract(self):
        for deb in list_debs():
            self.assertEqual(run("dpkg-deb", "--extract", deb, self.folder).returncode, 0)
        return self.folder

    def test_all_packages_are_there_with_one_version(self):
        self.assertEqual({read_field(deb, "Package") for deb in list_debs()}, NAMES)
        self.assertEqual(len({read_field(deb, "Version") for deb in list_debs()}), 1)

    def test_lintian_reports_no_error(self):
        done = run("lintian", "--allow-root", "--fail-on", "error", "--show-overrides", *list_debs())
        print(done.stdout)
        self.assertEqual(done.returncode, 0)

    def test_hashes(self):
        lines = [line.split() for line in (PACKAGES / "SHA256SUMS").read_text(encoding="ascii").splitlines()]
        self.assertGreater(len(lines), len(NAMES))
        for value, name in lines:
            self.assertEqual(hashlib.sha256((PACKAGES / name).read_bytes()).hexdigest(), value, name)

    def test_no_build_path_is_in_the_packages(self):
        place = re.compile(rb"/source/(?:lib|apps/|obj-)|" + re.escape(str(REPOSITORY).encode()))
        for path in self.extract().rglob("*"):
            if path.is_file() and not path.is_symlink():
                match = place.search(path.read_bytes())
                self.assertIsNone(match, f"{path}: {match}")

    def test_every_program_has_a_man_page(self):
        root = self.extract()
        programs = sorted(path.name for path in (root / "usr/bin").iterdir())
        pages = sorted(path.name.split(".")[0] for path in (root / "usr/share/man").glob("man*/*.gz"))
        self.assertEqual(programs, pages)
        self.assertEqual(len(programs), 6)

    def test_configuration_files_are_conffiles(self):
        deb = next(PACKAGES.glob("acsd_*.deb"))
        self.assertEqual(run("dpkg-deb", "-I", deb, "conffiles").stdout.split(), ["/etc/acsd/acsd.toml", "/etc/acsd/site.lif.json"])

    def test_programs_among_the_documents_are_executable(self):
        """Those of the repository, such as deploy/prepare."""
        docs = self.extract() / "usr/share/doc/acs"
        programs = {path.relative_to(REPOSITORY) for folder in ("deploy", "monitoring") for path in (REPOSITORY / folder).rglob("*")
                    if path.is_file() and path.stat().st_mode & 0o111 and "__pycache__" not in path.parts}
        self.assertIn(pathlib.PurePath("deploy/prepare"), programs)
        for name in programs:
            self.assertEqual((docs / name).stat().st_mode & 0o777, 0o755, name)

    def test_links_of_the_documents(self):
        """Every page has its target; sources of the repository are in the site only."""
        docs = (self.extract() / "usr/share/doc/acs").resolve()
        code = re.compile(r"^```.*?^```|`[^`\n]+`", re.DOTALL | re.MULTILINE)
        pages = [path for path in docs.rglob("*.md") if not path.is_relative_to(docs / "html")]
        self.assertGreater(len(pages), 100)
        for path in pages:
            for target in re.findall(r"\]\((?![a-z]+:)([^)#\s]+)", code.sub("", path.read_text(encoding="utf-8"))):
                place = (path.parent / target).resolve()
                name = place.relative_to(docs)
                is_source = (REPOSITORY / name).exists() and name.suffix != ".md" and name.parts[0] not in ("docs", "examples")
                self.assertTrue(place.exists() or is_source, f"{path}: {target}")

    def test_every_link_of_the_site(self):
        site = self.extract() / "usr/share/doc/acs/html"
        # Scripts of Sphinx are links into a package of Debian.
        scripts = [path for path in site.rglob("*") if path.is_symlink()]
        self.assertGreater(len(scripts), 0)
        self.assertIn("libjs-sphinxdoc", read_field(next(PACKAGES.glob("acs-doc_*.deb")), "Depends"))
        for script in scripts:
            self.assertRegex(os.path.normpath(script.parent / os.readlink(script)), r"/usr/share/(javascript|nodejs)/")
            script.unlink()
            script.touch()
        done = run("/usr/bin/python3", "-B", REPOSITORY / "scripts" / "site_links.py", site)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_sbom_lists_every_package_with_its_hash(self):
        document = json.loads(next(PACKAGES.glob("*.spdx.json")).read_text(encoding="utf-8"))
        self.assertEqual(document["spdxVersion"], "SPDX-2.3")
        packages = {package["name"]: package for package in document["packages"]}
        for deb in list_debs():
            package = packages[read_field(deb, "Package")]
            self.assertEqual(package["checksums"][0]["checksumValue"], hashlib.sha256(deb.read_bytes()).hexdigest())
        for name in ("libmosquitto1", "libssl3", "libpq5", "libc6", "libjs-leaflet", "rapidjson-dev"):
            self.assertIn(name, packages)

    def test_the_binary_interface_of_the_same_packages_is_the_same(self):
        done = run(REPOSITORY / "scripts" / "check_abi", PACKAGES, PACKAGES)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("has not changed", done.stdout)

    def test_a_repacked_package_has_its_version_everywhere(self):
        deb = next(PACKAGES.glob("acsd_*.deb"))
        other = repack(deb, "9.9", self.folder)
        self.assertEqual(read_field(other, "Version"), "9.9")
        self.assertIn("libacs0 (= 9.9)", read_field(other, "Depends"))
        self.assertIn('gt "9.9"', run("dpkg-deb", "-I", other, "preinst").stdout)


if __name__ == "__main__":
    PACKAGES = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
