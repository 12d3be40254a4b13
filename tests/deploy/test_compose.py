#!/usr/bin/env python3
"""deploy/compose without containers: Compose accepts it, and each service accepts the files where its container has them."""

import argparse
import copy
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

import yaml

from deploy_files import REPOSITORY, check_promtool, copy_tree, find_program, lay_out, run

sys.path[:0] = [str(REPOSITORY / "scripts"), str(REPOSITORY / "tests" / "scenario")]
from postgres_server import _as_server, _find  # noqa: E402
from production_line import Line, find_free_port  # noqa: E402

ACSD = ("acs1", "acs2")
SECONDS = 30
BIN = None


def read_compose(folder):
    """The services as Compose resolves them."""
    text = run(find_program("docker-compose"), "-f", folder / "deploy/compose/compose.yaml", "config",
               env={**os.environ, "ACSD_IMAGE": "registry.test/acsd:1"}).stdout
    return yaml.safe_load(text)


def list_mounts(config, name):
    """{path in the container: path here} of the files and folders that a service mounts."""
    service = config["services"][name]
    mounts = {}
    for volume in service.get("volumes", ()):
        source, target, *_ = (volume["source"], volume["target"]) if isinstance(volume, dict) else volume.split(":")
        if source.startswith("/"):
            mounts[target] = source
    for secret in service.get("secrets", ()):
        mounts[secret["target"]] = config.get("secrets", {}).get(secret["source"], {}).get("file", f"/undefined/{secret['source']}")
    return mounts


def check_services(config):
    """What each service of a site must have."""
    for name, service in config["services"].items():
        user = str(service.get("user", "0")).split(":")[0]
        if not user.isdecimal() or user == "0":
            yield f"{name} does not run as a user with a number, other than root"
            continue
        for key, value in (("read_only", True), ("cap_drop", ["ALL"]), ("security_opt", ["no-new-privileges:true"])):
            if service.get(key) != value:
                yield f"{name} has not {key}: {value}"
        for key in ("healthcheck", "mem_limit", "cpus", "pids_limit", "restart", "stop_grace_period"):
            if not service.get(key):
                yield f"{name} has no {key}"
        for network in service["networks"]:
            if network not in config["networks"]:
                yield f"{name} has the network {network}, which is not defined"
        for target, source in list_mounts(config, name).items():
            if not pathlib.Path(source).exists():
                yield f"{name} mounts {source} at {target}, which does not exist"
            elif "secrets" in source and not source.endswith(".pem"):
                status = os.stat(source)
                if status.st_mode & 0o077:
                    yield f"{source} can be read by others"
                if os.geteuid() == 0 and status.st_uid != int(user):
                    yield f"{source} does not belong to the user of {name}"
        for key, value in service.get("environment", {}).items():
            if "PASSWORD" in key and not key.endswith("_FILE"):
                yield f"{name} has a password in {key}: {value}"
    for name in ACSD:
        service = config["services"][name]
        if service["image"] != "registry.test/acsd:1":
            yield f"{name} does not use ACSD_IMAGE"
        if "/livez" not in str(service["healthcheck"]["test"]):
            yield f"{name} is not checked by /livez: a standby would be unhealthy"


def check_hosts(config, acsd_text, prometheus_text):
    """Host names in the configurations are services."""
    for host in re.findall(r"^url = \"(?:mqtts|postgresql)://(?:\w+@)?([\w.-]+)", acsd_text, re.MULTILINE):
        if host not in config["services"]:
            yield f"acsd.toml names the host {host}, which is no service"
    hosts = re.search(r"^hosts = \[(.*)\]  # names that Prometheus", acsd_text, re.MULTILINE).group(1)
    for host in re.findall(r"'([\w.-]+):8080'", prometheus_text):
        if host not in config["services"]:
            yield f"Prometheus scrapes {host}, which is no service"
        if f'"{host}"' not in hosts:
            yield f"http.hosts does not have {host}"


class ComposeCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-deploy-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.folder.chmod(0o755)
        cls.output = copy_tree(cls.folder)
        cls.config = read_compose(cls.folder)

    def setUp(self):
        self.line = Line(BIN, REPOSITORY / "examples" / "site")
        self.line.__enter__()
        self.line.folder.chmod(0o755)
        self.addCleanup(self.line.stop)

    def lay_out(self, name):
        """The folder that has the files of the container of a service."""
        root = self.line.folder / name
        lay_out({target: source for target, source in list_mounts(self.config, name).items() if pathlib.Path(source).is_file()},
                root)
        return root

    def wait_until(self, is_reached, otherwise):
        deadline = time.monotonic() + SECONDS
        while not is_reached():
            self.assertLess(time.monotonic(), deadline, otherwise)
            time.sleep(0.05)


class Files(ComposeCase):
    def test_compose_accepts_the_file_and_each_service_is_confined(self):
        self.assertEqual(list(check_services(self.config)), [])

    def test_host_names_are_services(self):
        acsd = (self.folder / "deploy/acsd.toml").read_text()
        prometheus = (self.folder / "deploy/prometheus/compose.yml").read_text()
        self.assertEqual(list(check_hosts(self.config, acsd, prometheus)), [])
        self.assertEqual(list(check_hosts(self.config, acsd.replace("@postgres", "@db"), prometheus)),
                         ["acsd.toml names the host db, which is no service"])
        self.assertEqual(len(list(check_hosts(self.config, acsd, prometheus.replace("acs2:", "acs3:")))), 2)

    def test_the_check_of_the_services_finds_planted_violations(self):
        def plant(change):
            config = copy.deepcopy(self.config)
            change(config["services"])
            return list(check_services(config))

        self.assertEqual(plant(lambda services: services["acs1"].pop("user")),
                         ["acs1 does not run as a user with a number, other than root"])
        self.assertEqual(plant(lambda services: services["broker"]["secrets"][0].update(source="absent")),
                         ["broker mounts /undefined/absent at /etc/mosquitto/acs.passwords, which does not exist"])
        self.assertEqual(plant(lambda services: services["broker"].update(read_only=False)), ["broker has not read_only: True"])
        self.assertEqual(plant(lambda services: services["broker"].update(networks={"absent": None})),
                         ["broker has the network absent, which is not defined"])
        self.assertEqual(plant(lambda services: services["postgres"].pop("healthcheck")), ["postgres has no healthcheck"])
        self.assertEqual(plant(lambda services: services["postgres"]["environment"].update(POSTGRES_PASSWORD="x")),
                         ["postgres has a password in POSTGRES_PASSWORD: x"])
        self.assertEqual(plant(lambda services: services["acs2"]["healthcheck"].update(test=["CMD", "curl", "/readyz"])),
                         ["acs2 is not checked by /livez: a standby would be unhealthy"])
        self.assertEqual(plant(lambda services: services["prometheus"]["volumes"].append("/absent:/etc/absent:ro")),
                         ["prometheus mounts /absent at /etc/absent, which does not exist"])

    def test_an_error_of_the_file_is_found(self):
        file = self.folder / "deploy/compose/bad.yaml"
        text = (self.folder / "deploy/compose/compose.yaml").read_text()
        for before, after in (("mem_limit: 256m", "mem_limits: 256m"), ("stop_grace_period: 10s", "stop_grace_period: [10s]")):
            self.assertIn(before, text)
            file.write_text(text.replace(before, after))
            self.assertNotEqual(run(find_program("docker-compose"), "-f", file, "config", "-q", check=False).returncode, 0, after)

    def test_prometheus_accepts_its_configuration_and_the_rules(self):
        root = self.lay_out("prometheus")
        self.assertEqual(list(check_promtool(root)), [])
        (root / "etc/prometheus/acsd.rules.yml").unlink()
        self.assertNotEqual(list(check_promtool(root)), [])

    def test_prepare_changes_no_file_that_exists(self):
        secrets = self.folder / "deploy/secrets"
        before = {path: path.read_bytes() for path in secrets.rglob("*") if path.is_file()}
        self.assertGreater(len(before), 12)
        self.assertNotIn("token", run(self.folder / "deploy/prepare").stdout)
        self.assertEqual({path: path.read_bytes() for path in secrets.rglob("*") if path.is_file()}, before)


class Prepare(unittest.TestCase):
    """deploy/prepare, run again."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-prepare-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        copy_tree(self.folder)
        self.secrets = self.folder / "deploy" / "secrets"
        self.assertTrue((self.secrets / "vehicles" / "LR01").exists())

    def prepare(self, *arguments, check=True):
        return run(self.folder / "deploy" / "prepare", *arguments, check=check)

    def read_names(self, certificate):
        text = run("openssl", "x509", "-in", certificate, "-noout", "-ext", "subjectAltName").stdout
        return re.findall(r"DNS:([\w.-]+)", text)

    def test_a_renewed_certificate_has_the_host_names_of_the_first_run(self):
        for path, names in (("acsd/operator", ["acs.test", "acs1", "acs2"]), ("broker/server", ["broker", "broker.test"])):
            certificate, key = self.secrets / f"{path}.pem", self.secrets / f"{path}.key"
            self.assertEqual(self.read_names(certificate), names)
            certificate.unlink()
            key.unlink()
            self.prepare()
            self.assertEqual(self.read_names(certificate), names)
        (self.secrets / "acsd/operator.pem").unlink()
        self.prepare("--operator-host", "other.test")
        self.assertEqual(self.read_names(self.secrets / "acsd/operator.pem")[0], "other.test")
        (self.secrets / "acsd/operator.pem").unlink()
        self.prepare()
        self.assertEqual(self.read_names(self.secrets / "acsd/operator.pem")[0], "other.test")
        self.assertEqual(self.read_names(self.secrets / "broker/server.pem"), ["broker", "broker.test"])

    def test_the_ca_stays_while_its_key_is_on_another_machine(self):
        key, ca, elsewhere = self.secrets / "ca/ca.key", self.secrets / "ca.pem", self.folder / "elsewhere.key"
        before = ca.read_bytes()
        shutil.move(key, elsewhere)
        self.prepare()
        key.parent.rmdir()
        self.prepare()
        self.assertFalse(key.exists())

        (self.secrets / "broker/server.pem").unlink()
        result = self.prepare(check=False)
        self.assertEqual((result.returncode, result.stdout.count("\n")), (1, 1), result.stdout)
        self.assertIn("put ca.key back to make a certificate", result.stdout)
        self.assertEqual(ca.read_bytes(), before)
        key.parent.mkdir(exist_ok=True)
        shutil.move(elsewhere, key)
        self.prepare()
        run("openssl", "verify", "-CAfile", ca, self.secrets / "broker/server.pem")
        self.assertEqual(ca.read_bytes(), before)

        ca.unlink()
        result = self.prepare(check=False)
        self.assertEqual((result.returncode, result.stdout.count("\n")), (1, 1), result.stdout)
        self.assertIn("ca.pem is missing", result.stdout)

    def list_accounts(self):
        return [line.partition(":")[0] for line in (self.secrets / "broker/passwords").read_text().splitlines()]

    def test_each_vehicle_with_a_password_has_an_account_of_the_broker(self):
        first = (self.secrets / "broker/passwords").read_text()
        output = self.prepare("--vehicle", "AR07", "--vehicle", "AR08").stdout
        self.assertRegex(output, "broker must be restarted.*: AR07, AR08")
        self.assertTrue((self.secrets / "broker/passwords").read_text().startswith(first))
        self.assertEqual(self.list_accounts(), ["acsd", "LR01", "AR07", "AR08"])
        self.assertEqual({path.name for path in (self.secrets / "vehicles").iterdir()}, {"LR01", "AR07", "AR08"})
        self.assertEqual((self.secrets / "broker/passwords").stat().st_mode & 0o777, 0o400)
        self.assertNotIn("AR07", self.prepare("--vehicle", "AR07").stdout)

        # A password that only the vehicle has stays valid.
        (self.secrets / "vehicles/AR07").unlink()
        self.assertIn("AR07", self.prepare("--vehicle", "AR07").stdout)
        self.assertFalse((self.secrets / "vehicles/AR07").exists())
        self.assertEqual(self.list_accounts(), ["acsd", "LR01", "AR07", "AR08"])

    def test_a_run_without_vehicles_adds_none(self):
        shutil.rmtree(self.secrets)
        self.prepare("--vehicle", "AR07")
        self.prepare()
        self.assertEqual(self.list_accounts(), ["acsd", "AR07"])
        self.assertFalse((self.secrets / "vehicles/LR01").exists())


class Programs(ComposeCase):
    """The services of this machine with the files of the containers."""

    def start_postgres(self):
        """With the certificate, the settings and the script of the service. Returns the URL of acsd for this machine."""
        root = self.lay_out("postgres")
        data = self.line.folder / "postgres-data"
        data.mkdir()
        if os.geteuid() == 0:
            for path in (data, *root.rglob("*")):
                shutil.chown(path, "postgres", "postgres")
        secrets = root / "etc/postgres"
        run(*_as_server([_find("initdb"), "-D", str(data), "-U", "postgres", "--auth-local=trust", "--auth-host=scram-sha-256",
                         "--no-sync", "--pwfile", str(secrets / "superuser-password")]))
        port = find_free_port()
        settings = self.config["services"]["postgres"]["command"][1:]
        settings = [part.replace("/etc/postgres", str(secrets)) for part in settings]
        command = _as_server([_find("postgres"), "-D", str(data), "-k", str(data), "-p", str(port), *settings])
        self.line.start("postgres", *command[1:], binary=shutil.which(command[0]))
        # The probe of the container, but for the port.
        probe = [find_program("pg_isready"), *self.config["services"]["postgres"]["healthcheck"]["test"][2:], f"--port={port}"]
        self.wait_until(lambda: subprocess.run(probe, check=False).returncode == 0, "PostgreSQL does not start")
        run(root / "docker-entrypoint-initdb.d/create-database.sh",
            env={**os.environ, "PGHOST": str(data), "PGPORT": str(port), "ACSD_PASSWORD_FILE": str(secrets / "acsd-password")})
        ca = self.folder / "deploy/secrets/ca.pem"
        # hostaddr: the name of the service has no address here, but the certificate must have it.
        return f"postgresql://acsd@postgres:{port}/acs?hostaddr=127.0.0.1&sslmode=verify-full&sslrootcert={ca}"

    def start_broker(self):
        root = self.lay_out("broker") / "etc/mosquitto"
        for path in (root / "mosquitto.conf", root / "conf.d/acs.conf"):
            path.write_text(path.read_text().replace("/etc/mosquitto", str(root)).replace("/mosquitto/data/", f"{self.line.folder}/"))
        port = find_free_port()
        main = root / "mosquitto.conf"
        if os.geteuid() == 0:
            main.write_text(main.read_text() + "user root\n")
        listener = root / "conf.d/acs.conf"
        self.assertIn("listener 8883", listener.read_text())
        listener.write_text(listener.read_text().replace("listener 8883", f"listener {port} 127.0.0.1"))
        return self.line.start("mosquitto", "-c", main, binary=find_program("mosquitto")), port

    def subscribe(self, port, *options):
        """Whether the broker accepts a subscription."""
        ca = self.folder / "deploy/secrets/ca.pem"
        command = [find_program("mosquitto_sub"), "-h", "127.0.0.1", "-p", str(port), "--cafile", str(ca), "--insecure", "-E", "-t",
                   "uagv/v2/ACS/LR01/state", "-W", "5", *options]
        return subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0

    def test_the_broker_has_the_accounts_of_prepare(self):
        broker, port = self.start_broker()
        secrets = self.folder / "deploy/secrets"
        acsd = ("-u", "acsd", "-P", (secrets / "acsd/mqtt-password").read_text())
        self.wait_until(lambda: self.subscribe(port, *acsd), f"mosquitto refuses acsd: {broker.tail()}")
        self.assertTrue(self.subscribe(port, "-u", "LR01", "-P", (secrets / "vehicles/LR01").read_text()))
        self.assertFalse(self.subscribe(port, "-u", "LR01", "-P", "wrong"))
        self.assertFalse(self.subscribe(port), "a client without an account")

    def list_overrides(self, name, root, url):
        return [f"store.url={url}", f"operator.audit.directory={root}", f"store.instance={name}", "http.listen=127.0.0.1:0",
                "operator.listen=127.0.0.1:0"]

    def check_config(self, root, overrides):
        sets = [part for override in overrides for part in ("--set", override)]
        return run(BIN / "acsd", "--config", root / "etc/acsd/acsd.toml", *sets, "--check-config", check=False)

    def test_acsd_accepts_its_configuration_and_one_of_two_leads(self):
        url = self.start_postgres()
        roots = {name: self.lay_out(name) for name in ACSD}
        overrides = {name: self.list_overrides(name, root, url) for name, root in roots.items()}
        for name, root in roots.items():
            result = self.check_config(root, overrides[name])
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertNotIn("warning", result.stdout)

        programs = {}
        for name, root in roots.items():
            sets = [part for override in overrides[name] for part in ("--set", override)]
            programs[name] = self.line.start("acsd", "--config", root / "etc/acsd/acsd.toml", *sets)
            programs[name].wait_ready()
        self.wait_until(lambda: sorted(self.read_leader(program) for program in programs.values()) == ["0", "1"], "one of them leads")
        for name, program in programs.items():
            self.assertEqual(self.probe(name, program), 0, "the health check of leader and standby succeeds")
        programs["acs1"].stop()
        self.assertNotEqual(self.probe("acs1", programs["acs1"]), 0, "a process that has ended is unhealthy")

    @staticmethod
    def read_leader(program):
        with urllib.request.urlopen(f"http://{program.addresses['http']}/metrics", timeout=5) as response:
            return re.search(r"^acsd_leader (\d)", response.read().decode(), re.MULTILINE).group(1)

    def probe(self, name, program):
        """The exit code of the health check of the container, but for the port."""
        test = self.config["services"][name]["healthcheck"]["test"]
        self.assertEqual(test[:3], ["CMD", "bash", "-c"])
        port = program.addresses["http"].rsplit(":", 1)[1]
        script = test[3].replace("$$", "$").replace("8080", port)
        return subprocess.run(["bash", "-c", script], check=False, stderr=subprocess.DEVNULL).returncode

    def test_errors_of_the_configuration_are_found(self):
        url = self.start_postgres()
        root = self.lay_out("acs1")
        overrides = self.list_overrides("acs1", root, url)
        secret = root / "etc/acsd/secrets/mqtt-password"
        secret.chmod(0o644)
        self.assertIn("every user of this machine can read", self.check_config(root, overrides).stdout)
        secret.unlink()
        self.assertIn("mqtt.password_file", self.check_config(root, overrides).stdout)
        wrong = [override.replace("@postgres:", "@other:") for override in overrides]
        result = self.check_config(root, wrong)
        self.assertEqual(result.returncode, 2)
        self.assertIn("certificate", result.stdout)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    options, rest = parser.parse_known_args()
    BIN = options.bin
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
