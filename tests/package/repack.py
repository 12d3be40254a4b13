"""The same Debian packages with another version, to try an upgrade without a second build."""

import pathlib
import subprocess
import tempfile


def read_field(deb, name):
    return subprocess.run(["dpkg-deb", "-f", str(deb), name], check=True, capture_output=True, text=True).stdout.strip()


def repack(deb, version, output):
    """Writes the package with this version to the folder; also where it names its former version."""
    former = read_field(deb, "Version")
    with tempfile.TemporaryDirectory() as work:
        subprocess.run(["dpkg-deb", "--raw-extract", str(deb), work + "/package"], check=True)
        for file in pathlib.Path(work, "package", "DEBIAN").iterdir():
            text = file.read_text(encoding="utf-8")
            if former in text:
                file.write_text(text.replace(former, version), encoding="utf-8")
        name = f"{read_field(deb, 'Package')}_{version}_{read_field(deb, 'Architecture')}.deb"
        subprocess.run(["dpkg-deb", "--build", "--root-owner-group", work + "/package", f"{output}/{name}"], check=True,
                       capture_output=True)
    return pathlib.Path(output, name)
