#!/usr/bin/env python3
"""test_package_files.py PROGRAMS: the files of the Debian packages, with the programs of a build: unit, configuration, tokens, man
pages, version, SPDX file, and the first start."""

import hashlib
import importlib.util
import json
import os
import pathlib
import re
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
DEBIAN = REPOSITORY / "debian"
PROGRAMS = pathlib.Path()
MAXIMUM_EXPOSURE = 3.0
START_SECONDS = 30


def load(name, path):
    specification = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


make_config = load("make_config", DEBIAN / "make_config.py")
make_man = load("make_man", DEBIAN / "make_man.py")
make_sbom = load("make_sbom", REPOSITORY / "scripts" / "make_sbom.py")
package_changelog = load("package_changelog", REPOSITORY / "scripts" / "package_changelog.py")


def run(*command, **options):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                          stdin=subprocess.DEVNULL, **options)


def find_free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class PackageCase(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-package-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def make_etc(self):
        """/etc/acsd as the package installs it."""
        etc = self.folder / "etc"
        etc.mkdir()
        make_config.make_config_folder(REPOSITORY / "examples" / "site", etc)
        self.make_tokens(etc)
        return etc

    def make_tokens(self, etc):
        group = str(os.getgid())
        done = run(DEBIAN / "make-tokens", etc, group, env={**os.environ, "ACSD": str(PROGRAMS / "acsd")})
        self.assertEqual((done.returncode, done.stdout), (0, ""))


class Unit(PackageCase):
    def setUp(self):
        super().setUp()
        if shutil.which("systemd-analyze") is None:
            self.skipTest("systemd-analyze is not installed")
        self.unit = self.folder / "acsd.service"
        text = (DEBIAN / "acsd.service").read_text(encoding="utf-8")
        self.assertIn("ExecStart=/usr/bin/acsd ", text)
        self.unit.write_text(text.replace("/usr/bin/acsd ", f"{PROGRAMS / 'acsd'} "), encoding="utf-8")

    def test_the_unit_is_valid(self):
        done = run("systemd-analyze", "verify", "--man=no", self.unit)
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_the_sandbox(self):
        done = run("systemd-analyze", "security", "--offline=true", "--no-pager", self.unit)
        exposure = re.search(r"Overall exposure level for acsd.service: ([0-9.]+)", done.stdout)
        self.assertIsNotNone(exposure, done.stdout)
        self.assertLessEqual(float(exposure.group(1)), MAXIMUM_EXPOSURE)


class Configuration(PackageCase):
    def test_it_is_valid(self):
        etc = self.make_etc()
        done = run(PROGRAMS / "acsd", "--config", etc / "acsd.toml", "--check-config", "--set", f"store.directory={self.folder}/store")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("warning", done.stdout)

    def test_the_state_is_in_the_state_directory_of_the_unit(self):
        text = (self.make_etc() / "acsd.toml").read_text(encoding="utf-8")
        self.assertIn('\ndirectory = "/var/lib/acsd/store"', text)
        self.assertIn("\nStateDirectory=acsd\n", (DEBIAN / "acsd.service").read_text(encoding="utf-8"))

    def test_the_first_start_is_paused_until_an_operator_resumes_it(self):
        etc = self.make_etc()
        self.start(etc)
        self.assertEqual(self.get_tsc(etc), "Paused")
        self.restart(etc)
        self.assertEqual(self.get_tsc(etc), "Paused")
        self.acsctl(etc, "--yes", "tsc", "resume")
        self.assertEqual(self.get_tsc(etc), "Auto")
        self.restart(etc)
        self.assertEqual(self.get_tsc(etc), "Auto")

    def start(self, etc):
        closed = find_free_port()
        self.acsd = subprocess.Popen(
            [PROGRAMS / "acsd", "--config", etc / "acsd.toml", "--set", f"store.directory={self.folder}/store", "--set", "http.listen=127.0.0.1:0",
             "--set", "operator.listen=127.0.0.1:0", "--set", f"mcs.url=ws://127.0.0.1:{closed}/acs/", "--set",
             f"mqtt.url=mqtt://127.0.0.1:{closed}", "--set", f"robots.CR01.arm.url=tcp://127.0.0.1:{closed}"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(self.stop, self.acsd)
        ready = self.acsd.stdout.readline()
        self.address = re.search(r"operator=(\S+)", ready).group(1)

    @staticmethod
    def stop(acsd):
        acsd.terminate()
        acsd.wait(START_SECONDS)
        acsd.stdout.close()

    def restart(self, etc):
        self.acsd.terminate()
        self.acsd.wait(START_SECONDS)
        self.start(etc)

    def acsctl(self, etc, *words):
        done = run(PROGRAMS / "acsctl", "--url", f"http://{self.address}", "--token-file", etc / "operator.token", *words)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def get_tsc(self, etc):
        return json.loads(self.acsctl(etc, "status", "--json"))["tsc"]


class ConfigurationCheck(PackageCase):
    """debian/check-config, which the package calls before it restarts acsd: with the credentials of the process that runs."""

    def setUp(self):
        super().setUp()
        self.etc = self.make_etc()
        self.configure("/var/lib/acsd/store", f"{self.folder}/store")
        self.credentials = self.folder / "credentials"
        self.credentials.mkdir(mode=0o700)
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        self.write_program("runuser", '[ "$1 $2 $3" = "-u acsd --" ] && shift 3 && exec "$@"')

    def write_program(self, name, text):
        path = self.bin / name
        path.write_text(f"#!/bin/sh\n{text}\n", encoding="ascii")
        path.chmod(0o755)

    def configure(self, old, new):
        path = self.etc / "acsd.toml"
        path.write_text(path.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")

    def use_credential(self):
        self.configure("\n[mqtt]\n", '\n[mqtt]\nusername = "acsd"\npassword_file = "${CREDENTIALS_DIRECTORY}/mqtt"\n')

    def check(self, environment=None, acsd=None):
        """While a process with this environment is the one of the unit."""
        with subprocess.Popen(["sh", "-c", "echo; read line"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              env={"PATH": os.environ["PATH"], **(environment or {})}) as process:
            process.stdout.readline()
            self.write_program("systemctl", f'[ "$*" = "show --value -p MainPID acsd" ] && echo {process.pid}')
            return run(DEBIAN / "check-config", self.etc / "acsd.toml",
                       env={"PATH": f"{self.bin}:{os.environ['PATH']}", "ACSD": str(acsd or PROGRAMS / "acsd")})

    def test_the_credentials_are_those_of_the_running_process(self):
        self.use_credential()
        environment = {"CREDENTIALS_DIRECTORY": str(self.credentials)}
        done = self.check(environment)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"{self.credentials}/mqtt", done.stdout)
        (self.credentials / "mqtt").write_text("secret\n", encoding="ascii")
        (self.credentials / "mqtt").chmod(0o600)
        done = self.check(environment)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("CREDENTIALS_DIRECTORY", done.stdout)

    def test_unknown_credentials_are_reported_in_one_line_and_refuse_nothing(self):
        self.use_credential()
        for environment in ({}, {"CREDENTIALS_DIRECTORY": str(self.folder / "missing")}):
            done = self.check(environment)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual(len(done.stdout.splitlines()), 1, done.stdout)
            self.assertIn("${CREDENTIALS_DIRECTORY}", done.stdout)

    def test_another_error_is_refused(self):
        done = self.check()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.use_credential()
        self.configure("\n[mqtt]\n", "\n[mqtt]\nunknown_key = 7\n")
        done = self.check()
        self.assertEqual(done.returncode, 1)
        self.assertIn("unknown_key", done.stdout)

    def test_an_acsd_that_prints_nothing_is_refused(self):
        self.write_program("acsd", "exit 1")
        done = self.check(acsd=self.bin / "acsd")
        self.assertEqual((done.returncode, done.stdout), (1, ""))

    def test_the_package_calls_it(self):
        self.assertIn("/usr/lib/acsd/check-config /etc/acsd/acsd.toml", (DEBIAN / "acsd.postinst").read_text(encoding="utf-8"))
        self.assertIn("debian/check-config usr/lib/acsd\n", (DEBIAN / "acsd.install").read_text(encoding="utf-8"))


class Tokens(PackageCase):
    def test_the_token_is_random_and_has_its_modes(self):
        tokens = []
        for name in ("a", "b"):
            etc = self.folder / name
            etc.mkdir()
            self.make_tokens(etc)
            self.assertEqual(stat.S_IMODE((etc / "tokens").stat().st_mode), 0o640)
            self.assertEqual(stat.S_IMODE((etc / "operator.token").stat().st_mode), 0o600)
            self.assertEqual(sorted(path.name for path in etc.iterdir()), ["operator.token", "tokens"])
            token = (etc / "operator.token").read_text(encoding="ascii").strip()
            line = f"operator local {hashlib.sha256(token.encode('ascii')).hexdigest()}\n"
            self.assertEqual((etc / "tokens").read_text(encoding="ascii"), line)
            tokens.append(token)
        self.assertNotEqual(*tokens)

    def test_a_file_that_exists_is_never_changed(self):
        for content in ("", "operator kim 12\n"):
            etc = self.folder / str(len(content))
            etc.mkdir()
            (etc / "tokens").write_text(content, encoding="ascii")
            self.make_tokens(etc)
            self.assertEqual((etc / "tokens").read_text(encoding="ascii"), content)
            self.assertEqual([path.name for path in etc.iterdir()], ["tokens"])

    def test_a_broken_acsd_leaves_no_file(self):
        done = run(DEBIAN / "make-tokens", self.folder, str(os.getgid()), env={**os.environ, "ACSD": "true"})
        self.assertEqual(done.returncode, 1)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_signal_leaves_no_file(self):
        acsd = self.folder / "acsd"
        acsd.write_text("#!/bin/sh\nkill -TERM $PPID\n", encoding="ascii")
        acsd.chmod(0o755)
        etc = self.folder / "etc"
        etc.mkdir()
        done = run(DEBIAN / "make-tokens", etc, str(os.getgid()), env={**os.environ, "ACSD": str(acsd)})
        self.assertEqual(done.returncode, 143)
        self.assertEqual(list(etc.iterdir()), [])


class ManPages(PackageCase):
    def list_programs(self):
        found = []
        for file in DEBIAN.glob("*.install"):
            found += re.findall(r"^usr/bin/(\S+)$", file.read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(len(found), 6)
        return sorted(found)

    def make_page(self, program):
        templates = list((DEBIAN / "man").glob(f"{program}.[0-9].in"))
        self.assertEqual(len(templates), 1, f"{program} has no page in debian/man")
        text = make_man.make_page(templates[0].read_text(encoding="utf-8"), PROGRAMS / program, "0.1.0", "2026-01-01")
        path = self.folder / templates[0].stem
        path.write_text(text, encoding="utf-8")
        return path

    def list_options(self, program, words=()):
        """The options and commands of --help, read without the parser of the pages."""
        text = run(PROGRAMS / program, *words, "--help").stdout
        options = {name for names in re.findall(r"^  (-\S+)", text, re.MULTILINE) for name in names.split(",")}
        commands = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
        for command in re.findall(r"^  (\S+)", commands.group(1), re.MULTILINE) if commands else ():
            options |= {" ".join([*words, command])} | self.list_options(program, [*words, command])
        return options

    def test_every_program_has_a_page_without_warnings(self):
        for program in self.list_programs():
            with self.subTest(program=program):
                self.assertEqual(self.list_warnings(self.make_page(program)), "")
        broken = self.folder / "broken.1"
        broken.write_text(".TH BROKEN 1\n.SH NAME\n.unknown\n", encoding="utf-8")
        self.assertIn("warning", self.list_warnings(broken))

    @staticmethod
    def list_warnings(page):
        command = ["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", str(page)]
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=True,
                              env={**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8"}).stderr

    def test_every_option_is_in_the_page(self):
        for program in self.list_programs():
            with self.subTest(program=program):
                done = run("man", "-l", self.make_page(program), env={**os.environ, "MANWIDTH": "200", "LC_ALL": "C.UTF-8",
                                                                      "MAN_KEEP_FORMATTING": ""})
                page = " ".join(done.stdout.split())
                options = self.list_options(program)
                if program == "acsd":
                    options |= {"token", "store check", "store accept", "store backup", "store restore", "replay"}
                self.assertGreater(len(options), 5)
                missing = [option for option in options if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", page)]
                self.assertEqual(missing, [])

    @staticmethod
    def is_installed(path, package):
        """Whether the package of the program has the file, or its installation makes it, or acs-doc has it."""
        documents, examples = "/usr/share/doc/acs", "/usr/share/acs/"
        if path.startswith(documents):
            return (REPOSITORY / path.removeprefix(documents).lstrip("/")).exists()
        if path.startswith(examples):
            return package == "acs-sims" and (REPOSITORY / "examples" / path.removeprefix(examples)).exists()
        return path.startswith("/etc/acsd/")

    def test_each_file_that_a_page_names_is_in_its_package(self):
        packages = {program: file.stem for file in DEBIAN.glob("*.install")
                    for program in re.findall(r"^usr/bin/(\S+)$", file.read_text(encoding="utf-8"), re.MULTILINE)}
        for program in self.list_programs():
            text = self.make_page(program).read_text(encoding="utf-8").replace("\\-", "-")
            for path in re.findall(r"(?:/usr/share|/etc)/[\w./-]*\w", text):
                with self.subTest(program=program, path=path):
                    self.assertTrue(self.is_installed(path, packages[program]))


class Completions(PackageCase):
    def complete(self, *words):
        """What bash offers for the last word, in the order of the file."""
        script = self.folder / words[0]
        shutil.copy(REPOSITORY / "apps" / "common" / "completion" / "program.bash", script)
        text = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _acs_program "$1" "${@: -1}"; printf "%s\\n" "${COMPREPLY[@]}"')
        done = run("bash", "--norc", "-c", text, "bash", script, *words, env={**os.environ, "PATH": f"{PROGRAMS}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout.split()

    def test_options_and_commands(self):
        self.assertEqual(self.complete("acsd", "--check"), ["--check-config"])
        self.assertEqual(sorted(self.complete("acsd", "")), ["replay", "store", "token"])
        self.assertEqual(sorted(self.complete("acsd", "store", "")), ["accept", "backup", "check", "restore"])
        self.assertEqual(self.complete("acsd", "--config", "x"), [])
        for program in ("acs-sim", "mcs-sim", "openstream-sim", "vda-sim"):
            self.assertIn("--version", self.complete(program, "--"))
            self.assertEqual(self.complete(program, ""), [])
        self.assertEqual(self.complete("vda-sim", "--vehicle", "LR01", "--bro"), ["--broker"])

    def test_every_installed_program_has_completions(self):
        installed = "".join(path.read_text(encoding="utf-8") for path in DEBIAN.glob("*.install"))
        programs = re.findall(r"^usr/bin/(\S+)$", installed, re.MULTILINE)
        self.assertEqual(len(programs), 6)
        for program in programs:
            self.assertIn(f"usr/share/bash-completion/completions/{program}\n", installed)
            self.assertIn(f"usr/share/zsh/site-functions/_{program} usr/share/zsh/vendor-completions\n", installed)


class Version(PackageCase):
    def test_the_changelog_has_the_version_of_the_project(self):
        project = package_changelog.read_project_version((REPOSITORY / "CMakeLists.txt").read_text(encoding="utf-8"))
        done = run(PROGRAMS / "acsd", "--version")
        self.assertEqual(done.stdout, f"acsd {project}\n")
        if run("git", "-C", REPOSITORY, "cat-file", "-e", "HEAD:debian/control").returncode != 0:
            self.skipTest("no commit with debian/control")
        text = package_changelog.make_changelog(str(REPOSITORY), "HEAD")
        (self.folder / "changelog").write_text(text, encoding="utf-8")
        done = run("dpkg-parsechangelog", "-l", self.folder / "changelog", "-S", "Version")
        self.assertEqual(done.stdout.strip().split("~")[0], project)
        self.assertEqual(text, package_changelog.make_changelog(str(REPOSITORY), "HEAD"))

    def test_versions_are_ordered(self):
        make = package_changelog.make_version
        early, late = (package_changelog.datetime.datetime(2026, 1, day, tzinfo=package_changelog.datetime.timezone.utc) for day in (1, 2))
        versions = [make("0.1.0", [], early, "f" * 40), make("0.1.0", ["v0.0.9"], late, "0" * 40), make("0.1.0", ["v0.1.0"], early, "a" * 40),
                    make("0.2.0", [], early, "a" * 40)]
        self.assertEqual(versions[2], "0.1.0")
        for former, latter in zip(versions, versions[1:]):
            self.assertEqual(run("dpkg", "--compare-versions", former, "lt", latter).returncode, 0, (former, latter))


class Sbom(PackageCase):
    def make_deb(self, architecture="all"):
        control = self.folder / "deb" / "DEBIAN" / "control"
        control.parent.mkdir(parents=True, mode=0o755)
        control.write_text(f"Package: acsd\nVersion: 1.0\nArchitecture: {architecture}\nMaintainer: X <x@x.org>\nDepends: libc6, libssl3\n"
                           "Description: x\n", encoding="utf-8")
        path = self.folder / f"acsd_1.0_{architecture}.deb"
        self.assertEqual(run("dpkg-deb", "--build", "--root-owner-group", self.folder / "deb", path).returncode, 0)
        return path

    def test_required_fields(self):
        deb = self.make_deb()
        documents = [make_sbom.make_document([deb], ["rapidjson-dev"], "1.0", "0" * 40, 1_700_000_000) for _ in range(2)]
        self.assertEqual(*documents)
        document = documents[0]
        self.assertEqual(list(make_sbom.check_document(document)), [])
        packages = {package["name"]: package for package in document["packages"]}
        self.assertEqual(packages["acsd"]["checksums"][0]["checksumValue"], hashlib.sha256(deb.read_bytes()).hexdigest())
        self.assertIn("libgcc-s1", packages)  # of libc6
        self.assertIn("MIT", packages["rapidjson-dev"]["licenseDeclared"])
        self.assertEqual(document["creationInfo"]["created"], "2023-11-14T22:13:20Z")

    def test_a_package_links_what_is_compiled_into_it(self):
        document = make_sbom.make_document([self.make_deb("amd64")], ["rapidjson-dev"], "1.0", "0" * 40, 0)
        links = [(relation["spdxElementId"], relation["relatedSpdxElement"]) for relation in document["relationships"]
                 if relation["relationshipType"] == "STATIC_LINK"]
        self.assertEqual(links, [("SPDXRef-Package-acsd", "SPDXRef-Package-rapidjson-dev")])

    def test_the_licence_is_that_of_the_copyright_file(self):
        document = make_sbom.make_document([self.make_deb()], [], "1.0", "0" * 40, 0)
        declared = {package["name"]: package["licenseDeclared"] for package in document["packages"]}["acsd"]
        text = (DEBIAN / "copyright").read_text(encoding="utf-8")
        self.assertEqual(declared, make_sbom.Licenses().read_text(text, "acs"))
        self.assertEqual(make_sbom.Licenses().read_text(text.replace("License: not-chosen", "License: Apache-2.0"), "acs"), "Apache-2.0")

    def test_a_missing_field_is_an_error(self):
        text = json.dumps(make_sbom.make_document([self.make_deb()], ["rapidjson-dev"], "1.0", "0" * 40, 0))
        for key in ("spdxVersion", "dataLicense", "documentNamespace", "creationInfo", "packages"):
            document = json.loads(text)
            del document[key]
            self.assertNotEqual(list(make_sbom.check_document(document)), [], key)
        for key in ("SPDXID", "versionInfo", "downloadLocation", "licenseDeclared"):
            document = json.loads(text)
            del document["packages"][-1][key]
            self.assertNotEqual(list(make_sbom.check_document(document)), [], key)
        document = json.loads(text)
        document["hasExtractedLicensingInfos"] = []
        self.assertNotEqual(list(make_sbom.check_document(document)), [])

    def test_expressions(self):
        licenses = make_sbom.Licenses()
        for debian, spdx in (("Expat", "MIT"), ("GPL-2+ or MIT", "(GPL-2.0-or-later OR MIT)"), ("LGPL-2.1+", "LGPL-2.1-or-later"),
                             ("GPL-3", "GPL-3.0-only"), ("BSL-1.0 and CC0-1.0", "(BSL-1.0 AND CC0-1.0)")):
            self.assertEqual(licenses.convert(debian, "x", {}), spdx)
        self.assertEqual(licenses.convert("odd words", "x", {"odd words": "text"}), "LicenseRef-debian-x-odd-words")
        self.assertEqual(licenses.texts["LicenseRef-debian-x-odd-words"]["text"], "text")


class Scripts(PackageCase):
    def test_the_command_line_of_scripts_package(self):
        done = run(REPOSITORY / "scripts" / "package", "--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("--commit REF", done.stdout)
        for words in (["--jobs", "x"], ["--unknown"], ["--commit"]):
            self.assertEqual(run(REPOSITORY / "scripts" / "package", *words).returncode, 2, words)

    def test_shell_scripts_are_valid(self):
        for path in (DEBIAN / "check-config", DEBIAN / "make-tokens", *DEBIAN.glob("*.p*inst"), *DEBIAN.glob("*.p*rm")):
            self.assertEqual(run("sh", "-n", path).stdout, "", path)


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
