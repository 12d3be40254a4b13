#!/usr/bin/env python3
"""deploy/kubernetes without a cluster: the manifests are YAML, each reference has its target, and the files that the README puts into
ConfigMaps and Secrets exist and have the names that the pods need."""

import copy
import pathlib
import re
import shlex
import shutil
import sys
import tempfile
import unittest

import yaml

from deploy_files import check_promtool, copy_tree, lay_out

NAMESPACE = "acs"


def read_manifests(folder):
    return [manifest for path in sorted((folder / "deploy/kubernetes").glob("*.yaml")) for manifest in yaml.safe_load_all(path.read_text())
            if manifest is not None]


def read_created(folder):
    """{(kind, name): {key: file}} of the commands in the README."""
    created = {}
    for line in (folder / "deploy/kubernetes/README.md").read_text().splitlines():
        found = re.match(r"kubectl -n (\S+) create (configmap|secret generic) (\S+) (.*)$", line)
        if found is None:
            continue
        if found.group(1) != NAMESPACE:
            raise AssertionError(f"another namespace: {line}")
        files = {}
        for option in shlex.split(found.group(4)):
            name, _, path = option.removeprefix("--from-file=").rpartition("=")
            place = folder / path
            if place.is_dir():
                files.update({file.name: file for file in place.iterdir()})
            else:
                files[name or place.name] = place
        created["ConfigMap" if found.group(2) == "configmap" else "Secret", found.group(3)] = files
    return created


def list_files(pod, created, container):
    """{path in the container: file} of ConfigMaps and Secrets; yields nothing for those that are missing."""
    volumes = {volume["name"]: volume for volume in pod.get("volumes", ())}
    files = {}
    for mount in container.get("volumeMounts", ()):
        for source, items in list_sources(volumes.get(mount["name"], {})):
            for key, path in (items or {key: key for key in created.get(source, ())}).items():
                if key in created.get(source, ()):
                    files[f"{mount['mountPath']}/{path}"] = created[source][key]
    return files


def list_sources(volume):
    """((kind, name), {key: path} or None for all keys) of a volume."""
    parts = [*volume.get("projected", {}).get("sources", ()), volume]
    for part in parts:
        for kind, member, name in (("ConfigMap", "configMap", "name"), ("Secret", "secret", "name"), ("Secret", "secret", "secretName")):
            if name in part.get(member, {}):
                items = part[member].get("items")
                yield (kind, part[member][name]), None if items is None else {item["key"]: item["path"] for item in items}


def check_manifests(manifests, created):
    """What refers to something that does not exist, and containers that are not confined."""
    for manifest in manifests:
        if manifest["metadata"].get("namespace") != NAMESPACE:
            yield f"{manifest['kind']} {manifest['metadata']['name']} is not in the namespace {NAMESPACE}"
    for (kind, name), files in created.items():
        for key, file in files.items():
            if not file.exists():
                yield f"{kind} {name}: {file.name} for {key} does not exist"
    sets = {manifest["metadata"]["name"]: manifest for manifest in manifests if manifest["kind"] == "StatefulSet"}
    services = {manifest["metadata"]["name"]: manifest for manifest in manifests if manifest["kind"] == "Service"}
    for name, manifest in sets.items():
        yield from check_set(name, manifest, services, created)
    for manifest in manifests:
        if manifest["kind"] in ("Service", "NetworkPolicy"):
            yield from check_selection(manifest, sets)


def check_set(name, manifest, services, created):
    spec = manifest["spec"]
    pod = spec["template"]["spec"]
    if spec["serviceName"] not in services:
        yield f"{name}: there is no service {spec['serviceName']}"
    if spec["selector"]["matchLabels"] != spec["template"]["metadata"]["labels"]:
        yield f"{name}: its selector does not match its pods"
    for key in ("runAsNonRoot", "runAsUser", "fsGroup"):
        if not pod["securityContext"].get(key):
            yield f"{name}: no {key}"
    volumes = {claim["metadata"]["name"] for claim in spec.get("volumeClaimTemplates", ())}
    volumes |= {volume["name"] for volume in pod.get("volumes", ())}
    mounted = {mount["name"] for container in pod["containers"] for mount in container.get("volumeMounts", ())}
    for volume in sorted(volumes ^ mounted):
        yield f"{name}: the volume {volume} is not both defined and mounted"
    for volume in pod.get("volumes", ()):
        if "persistentVolumeClaim" in volume:
            yield f"{name}: the volume {volume['name']} has a claim that no manifest defines"
        for source, items in list_sources(volume):
            if source not in created:
                yield f"{name}: there is no {source[0]} {source[1]}"
            for key in sorted((items or {}).keys() - created.get(source, items or {}).keys()):
                yield f"{name}: {source[0]} {source[1]} has no {key}"
    for container in pod["containers"]:
        yield from check_container(name, container)


def check_container(name, container):
    security = container.get("securityContext", {})
    if not (security.get("readOnlyRootFilesystem") and security.get("allowPrivilegeEscalation") is False
            and security.get("capabilities") == {"drop": ["ALL"]}):
        yield f"{name}: the container {container['name']} is not confined"
    if not {"cpu", "memory"} <= container.get("resources", {}).get("limits", {}).keys():
        yield f"{name}: the container {container['name']} has no limits"
    ports = {port["name"] for port in container.get("ports", ())}
    for probe in ("livenessProbe", "readinessProbe"):
        if probe not in container:
            yield f"{name}: the container {container['name']} has no {probe}"
        for action in ("httpGet", "tcpSocket"):
            port = container.get(probe, {}).get(action, {}).get("port")
            if port is not None and port not in ports:
                yield f"{name}: {probe} has the port {port}, which the container {container['name']} does not have"


def check_selection(manifest, sets):
    """The pods and ports that a service or a network policy selects."""
    name = f"{manifest['kind']} {manifest['metadata']['name']}"
    spec = manifest["spec"]
    if manifest["kind"] == "Service":
        yield from check_ports(name, spec["selector"], [port["targetPort"] for port in spec["ports"]], sets)
        return
    labels = spec["podSelector"].get("matchLabels")
    for rule in spec.get("ingress", ()):
        yield from check_ports(name, labels, [port["port"] for port in rule.get("ports", ())], sets)
        for peer in rule.get("from", ()):
            yield from check_ports(name, peer["podSelector"]["matchLabels"], [], sets)


def check_ports(name, labels, ports, sets):
    templates = [manifest["spec"]["template"] for manifest in sets.values()
                 if labels.items() <= manifest["spec"]["template"]["metadata"]["labels"].items()]
    if not templates:
        yield f"{name} selects {labels}, which no pod has"
        return
    names = {port["name"] for template in templates for container in template["spec"]["containers"] for port in container.get("ports", ())}
    for port in ports:
        if port not in names:
            yield f"{name} has the port {port}, which no container has"


def find_set(manifests, name):
    return next(manifest for manifest in manifests if (manifest["kind"], manifest["metadata"]["name"]) == ("StatefulSet", name))


class Kubernetes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="acs-deploy-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        copy_tree(cls.folder)
        cls.manifests = read_manifests(cls.folder)
        cls.created = read_created(cls.folder)

    def test_each_reference_has_its_target(self):
        self.assertEqual(len(self.created), 7)
        self.assertEqual(list(check_manifests(self.manifests, self.created)), [])

    def test_the_check_finds_planted_violations(self):
        def plant(change, name="acsd"):
            manifests, created = copy.deepcopy(self.manifests), dict(self.created)
            change(find_set(manifests, name)["spec"], created)
            return list(check_manifests(manifests, created))

        self.assertEqual(plant(lambda spec, created: created.pop(("ConfigMap", "acsd"))), ["acsd: there is no ConfigMap acsd"])
        self.assertEqual(plant(lambda spec, created: created.update({("Secret", "broker"): {}})),
                         [f"broker: Secret broker has no {key}" for key in ("passwords", "server.key", "server.pem")])
        self.assertEqual(plant(lambda spec, created: spec.update(serviceName="absent")), ["acsd: there is no service absent"])
        self.assertEqual(plant(lambda spec, created: spec["volumeClaimTemplates"].clear()),
                         ["acsd: the volume state is not both defined and mounted"])
        self.assertEqual(plant(lambda spec, created: spec["template"]["spec"]["containers"][0]["ports"][0].update(name="other")),
                         ["acsd: livenessProbe has the port monitoring, which the container acsd does not have",
                          "acsd: readinessProbe has the port monitoring, which the container acsd does not have",
                          "Service acsd-members has the port monitoring, which no container has",
                          "NetworkPolicy acsd has the port monitoring, which no container has"])
        self.assertEqual(plant(lambda spec, created: spec["template"]["spec"]["containers"][0].pop("securityContext"), "postgres"),
                         ["postgres: the container postgres is not confined"])
        with self.assertRaises(yaml.YAMLError):
            yaml.safe_load((self.folder / "deploy/kubernetes/acsd.yaml").read_text().replace("matchLabels: {app: acsd}", "matchLabels: {app"))

    def test_a_standby_is_alive_and_not_ready(self):
        spec = find_set(self.manifests, "acsd")["spec"]
        container = spec["template"]["spec"]["containers"][0]
        self.assertEqual(container["livenessProbe"]["httpGet"]["path"], "/livez")
        self.assertEqual(container["readinessProbe"]["httpGet"]["path"], "/readyz")
        # Else the controller would wait for a standby to become ready.
        self.assertEqual((spec["podManagementPolicy"], spec["updateStrategy"]), ("Parallel", {"type": "OnDelete"}))
        self.assertNotIn("PodDisruptionBudget", {manifest["kind"] for manifest in self.manifests})

    def test_each_file_is_where_the_configurations_expect_it(self):
        """The same places as in the containers of Compose, with which the programs are tested."""
        places = {name: self.list_places(name) for name in ("acsd", "postgres", "broker", "prometheus")}
        self.assertLessEqual({"/etc/acsd/acsd.toml", "/etc/acsd/site.lif.json", "/etc/acsd/secrets/ca.pem", "/etc/acsd/secrets/tokens",
                              "/etc/acsd/secrets/postgres-password", "/etc/acsd/secrets/mqtt-password", "/etc/acsd/secrets/operator.pem",
                              "/etc/acsd/secrets/operator.key"}, places["acsd"].keys())
        self.assertLessEqual({"/etc/postgres/server.pem", "/etc/postgres/server.key", "/etc/postgres/acsd-password",
                              "/etc/postgres/superuser-password", "/docker-entrypoint-initdb.d/create-database.sh"},
                             places["postgres"].keys())
        self.assertEqual({"/etc/mosquitto/mosquitto.conf", "/etc/mosquitto/conf.d/acs.conf", "/etc/mosquitto/acs.acl",
                          "/etc/mosquitto/acs.passwords", "/etc/mosquitto/certs/broker.pem", "/etc/mosquitto/certs/broker.key"},
                         places["broker"].keys())
        root = self.folder / "prometheus"
        lay_out(places["prometheus"], root)
        self.assertEqual(list(check_promtool(root)), [])
        self.assertIn("acsd-members", (root / "etc/prometheus/prometheus.yml").read_text())

    def list_places(self, name):
        pod = find_set(self.manifests, name)["spec"]["template"]["spec"]
        return list_files(pod, self.created, pod["containers"][0])


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main(verbosity=2)
