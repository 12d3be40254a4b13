"""What the tests of deploy/ share: a copy of the tree with secrets, and the configuration files of a service where its container has
them."""

import pathlib
import shutil
import subprocess

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("deploy", "examples/site", "monitoring/prometheus")


def find_program(name):
    found = shutil.which(name) or shutil.which(name, path="/usr/sbin:/usr/bin:/sbin:/bin")
    if found is None:
        raise FileNotFoundError(f"{name} is not installed; run scripts/setup --for test")
    return found


def run(*command, check=True, **options):
    """The process that has ended; its output is in one text."""
    result = subprocess.run([str(part) for part in command], check=False, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, **options)
    if check and result.returncode != 0:
        raise AssertionError(f"{command[0]} has failed:\n{result.stdout}")
    return result


def copy_tree(folder):
    """A copy of what a deployment needs, with the secrets of deploy/prepare. Returns the output of prepare."""
    for name in FOLDERS:
        shutil.copytree(REPOSITORY / name, folder / name, ignore=shutil.ignore_patterns("secrets", "data"))
    return run(folder / "deploy" / "prepare", "--broker-host", "broker.test", "--operator-host", "acs.test").stdout


def lay_out(files, root):
    """Copies {path in the container: source} below root, so that programs of this machine find them as in the container."""
    for target, source in files.items():
        place = root / target.lstrip("/")
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, place)


def check_promtool(root):
    """The problems of the configuration of Prometheus and its rules."""
    result = run(find_program("promtool"), "check", "config", root / "etc/prometheus/prometheus.yml", check=False)
    if result.returncode != 0:
        yield f"promtool refuses the configuration: {result.stdout}"
    elif "acsd.rules.yml" not in result.stdout or "rules found" not in result.stdout:
        yield f"the alert rules are not loaded: {result.stdout}"
