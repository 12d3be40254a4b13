#!/usr/bin/env python3
"""Writes an SPDX 2.3 document (JSON) of Debian packages: each package with its hash, what it needs at run time with everything that
this needs, and what is compiled into it, with versions and licences as Debian's copyright files state them."""

import argparse
import datetime
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import urllib.parse

# Short names of Debian's copyright files; versions and suffixes are converted by rule.
SPDX_NAMES = {
    "apache-2": "Apache-2.0", "apache-2.0": "Apache-2.0", "artistic": "Artistic-1.0-Perl", "artistic-2.0": "Artistic-2.0",
    "bsd-2-clause": "BSD-2-Clause", "bsd-3-clause": "BSD-3-Clause", "bsd-4-clause": "BSD-4-Clause", "bsl-1.0": "BSL-1.0",
    "boost-1.0": "BSL-1.0", "cc0": "CC0-1.0", "cc0-1.0": "CC0-1.0", "curl": "curl", "epl-1.0": "EPL-1.0", "epl-2.0": "EPL-2.0",
    "expat": "MIT", "isc": "ISC", "mit": "MIT", "mpl-2.0": "MPL-2.0", "openldap-2.8": "OLDAP-2.8", "openssl": "OpenSSL",
    "postgresql": "PostgreSQL", "unlicense": "Unlicense", "zlib": "Zlib"}
GNU_NAME = re.compile(r"(A?GPL|LGPL|GFDL)-?([123])(?:\.([0-9]))?(\+|-or-later|-only)?", re.IGNORECASE)
LICENSE = re.compile(r"^License: *(.*(?:\n[ \t].*)*)", re.MULTILINE)
DEPENDENCY = re.compile(r"^\s*([a-z0-9][a-z0-9+.-]*)")
PRODUCT_COPYRIGHT = pathlib.Path(__file__).resolve().parent.parent / "debian" / "copyright"


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C.UTF-8"}).stdout


def make_id(*parts):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", "-".join(parts))


class Licenses:
    """Licence expressions, and the texts of those that SPDX does not list."""

    def __init__(self):
        self.texts = {}

    def add_text(self, name, text):
        reference = "LicenseRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", name).strip("-")
        self.texts.setdefault(reference, {"name": name, "text": text})
        return reference

    def convert_name(self, name, package, texts):
        plain = name.strip(" ,")
        known = SPDX_NAMES.get(plain.lower())
        if known is not None:
            return known
        gnu = GNU_NAME.fullmatch(plain)
        if gnu:
            kind, major, minor, suffix = gnu.groups()
            return f"{kind.upper()}-{major}.{minor or '0'}-{'or-later' if suffix in ('+', '-or-later') else 'only'}"
        text = texts.get(plain) or f"The copyright file of the Debian package {package} names this licence."
        return self.add_text(f"debian-{package}-{plain}", text)

    def convert(self, expression, package, texts):
        """A Debian expression such as "GPL-2+ or MIT"."""
        words = re.split(r"(,? (?:and|or)(?:/or)? )", expression.strip())
        converted = [self.convert_name(words[0], package, texts)]
        for operator, name in zip(words[1::2], words[2::2]):
            converted += ["AND" if "and" in operator and "/or" not in operator else "OR", self.convert_name(name, package, texts)]
        return "(" + " ".join(converted) + ")" if len(converted) > 1 else converted[0]

    def read(self, package):
        """The expression of an installed package."""
        path = pathlib.Path("/usr/share/doc") / package / "copyright"
        return self.read_text(path.read_text(encoding="utf-8", errors="replace"), package) if path.is_file() else "NOASSERTION"

    def read_text(self, text, package):
        """The expression of a copyright file."""
        if not text.startswith("Format: http"):
            return self.add_text(f"debian-{package}-copyright", text)
        used, texts = [], {}
        for stanza in re.split(r"\n\s*\n(?=\S)", text):
            match = LICENSE.search(stanza)
            if match is None:
                continue
            name, _, body = match.group(1).partition("\n")
            if body.strip():
                texts.setdefault(name.strip(), re.sub(r"^ \.?", "", body, flags=re.MULTILINE).strip())
            files = re.search(r"^Files: *(.+)$", stanza, re.MULTILINE)
            if files and not files.group(1).startswith("debian/") and name.strip() not in used:
                used.append(name.strip())
        expressions = sorted({self.convert(name, package, texts) for name in used if name})
        return " AND ".join(expressions) if expressions else "NOASSERTION"


@functools.lru_cache(None)
def read_installed(package):
    """(name, version, architecture, source, dependencies) of an installed package, or None."""
    form = "${db:Status-Abbrev}\t${binary:Package}\t${Version}\t${Architecture}\t${source:Package}\t${Pre-Depends}, ${Depends}\n"
    done = subprocess.run(["dpkg-query", "-W", f"-f={form}", package], capture_output=True, text=True, check=False)
    if done.returncode != 0 or not done.stdout.startswith("ii"):
        return None
    _, name, version, architecture, source, depends = done.stdout.splitlines()[0].split("\t")
    return name.split(":")[0], version, architecture, source, depends


def list_dependencies(text):
    """The first installed alternative of each."""
    found = []
    for clause in text.split(","):
        names = [match.group(1) for match in map(DEPENDENCY.match, clause.split("|")) if match]
        installed = [name for name in names if read_installed(name) is not None]
        found += installed[:1]
    return found


def make_package(name, version, architecture, license_text, source=None):
    purl = (f"pkg:deb/debian/{urllib.parse.quote(name)}@{urllib.parse.quote(version, safe='')}"
            f"?arch={architecture}&distro=debian-12")
    package = {"SPDXID": make_id("Package", name), "name": name, "versionInfo": version, "supplier": "Organization: Debian",
               "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": "NOASSERTION",
               "licenseDeclared": license_text, "copyrightText": "NOASSERTION",
               "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}]}
    if source and source != name:
        package["sourceInfo"] = f"built from the Debian source package {source}"
    return package


def relate(element, kind, other):
    return {"spdxElementId": element, "relationshipType": kind, "relatedSpdxElement": other}


def read_deb(path):
    fields = dict.fromkeys(("Package", "Version", "Architecture", "Pre-Depends", "Depends"), "")
    for name in fields:
        fields[name] = run("dpkg-deb", "-f", str(path), name).strip()
    return fields


def make_document(debs, compiled, version, commit, epoch):
    licenses, packages, relations = Licenses(), {}, []
    product_license = licenses.read_text(PRODUCT_COPYRIGHT.read_text(encoding="utf-8"), "acs")
    products = {}
    for path in sorted(debs):
        fields = read_deb(path)
        package = make_package(fields["Package"], fields["Version"], fields["Architecture"], product_license)
        package.update({"supplier": "Organization: ACS SDK maintainers", "packageFileName": path.name,
                        "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(path.read_bytes()).hexdigest()}],
                        "sourceInfo": f"commit {commit}"})
        del package["externalRefs"]
        products[fields["Package"]] = (package, fields)
    waiting = []
    for package, fields in products.values():
        relations.append(relate("SPDXRef-DOCUMENT", "DESCRIBES", package["SPDXID"]))
        clauses = f"{fields['Pre-Depends']}, {fields['Depends']}"
        own = [match.group(1) for match in map(DEPENDENCY.match, clauses.split(",")) if match and match.group(1) in products]
        foreign = [name for name in list_dependencies(clauses) if name not in products]
        for name in sorted(set(own) | set(foreign)):
            relations.append(relate(package["SPDXID"], "DEPENDS_ON", make_id("Package", name)))
        waiting += foreign
        if fields["Architecture"] != "all" and fields["Package"] != "libacs-dev":
            for name in compiled:
                relations.append(relate(package["SPDXID"], "STATIC_LINK", make_id("Package", name)))
    for name in compiled:
        # Headers and archives: what the binaries need of their packages is among the dependencies of the binaries.
        installed = read_installed(name) or sys.exit(f"make_sbom: {name} is not installed")
        packages[name] = make_package(*installed[:3], licenses.read(name), installed[3])
    while waiting:
        name = waiting.pop()
        if name in packages and name not in compiled or name in products:
            continue
        found, installed_version, architecture, source, depends = read_installed(name)
        packages[name] = make_package(found, installed_version, architecture, licenses.read(name), source)
        for other in sorted(set(list_dependencies(depends))):
            relation = relate(make_id("Package", name), "DEPENDS_ON", make_id("Package", other))
            if relation not in relations:
                relations.append(relation)
            if other not in packages:
                waiting.append(other)
    created = datetime.datetime.fromtimestamp(epoch, datetime.timezone.utc)
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"acs-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/acs-{urllib.parse.quote(version)}-{commit}",
        "creationInfo": {"created": f"{created:%Y-%m-%dT%H:%M:%SZ}",
                         "creators": ["Tool: acs-scripts-make_sbom", "Organization: ACS SDK maintainers"]},
        "packages": [package for package, _ in products.values()] + [packages[name] for name in sorted(packages)],
        "hasExtractedLicensingInfos": [{"licenseId": reference, "name": info["name"], "extractedText": info["text"]}
                                       for reference, info in sorted(licenses.texts.items())],
        "relationships": sorted(relations, key=lambda relation: sorted(relation.items()))}


def list_license_references(expression):
    return re.findall(r"LicenseRef-[A-Za-z0-9.-]+", expression)


def check_document(document):
    """Errors against SPDX 2.3: required fields, identifiers, references."""
    for key in ("spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo", "packages", "relationships"):
        if not document.get(key):
            yield f"the document has no {key}"
            return
    if document["spdxVersion"] != "SPDX-2.3" or document["dataLicense"] != "CC0-1.0":
        yield "the document is not of SPDX-2.3 and CC0-1.0"
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", document["creationInfo"].get("created", "")):
        yield "creationInfo.created is not a UTC time"
    if not document["creationInfo"].get("creators"):
        yield "creationInfo has no creators"
    known = {"SPDXRef-DOCUMENT"}
    licenses = {info.get("licenseId") for info in document.get("hasExtractedLicensingInfos", []) if info.get("extractedText")}
    for package in document["packages"]:
        name = package.get("name", "?")
        for key in ("SPDXID", "name", "versionInfo", "downloadLocation", "licenseConcluded", "licenseDeclared", "copyrightText",
                    "supplier"):
            if not package.get(key):
                yield f"package {name} has no {key}"
        if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", package.get("SPDXID", "")):
            yield f"package {name} has an invalid SPDXID"
        if package.get("SPDXID") in known:
            yield f"package {name} is listed twice"
        known.add(package.get("SPDXID"))
        for reference in list_license_references(package.get("licenseDeclared", "")):
            if reference not in licenses:
                yield f"package {name} has licence {reference}, whose text is missing"
    described = 0
    for relation in document["relationships"]:
        described += relation["relationshipType"] == "DESCRIBES"
        for key in ("spdxElementId", "relatedSpdxElement"):
            if relation[key] not in known:
                yield f"a relationship names {relation[key]}, which is not listed"
    if not described:
        yield "the document describes no package"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--compiled", required=True, help="Debian packages that are compiled into the binaries, separated by spaces")
    parser.add_argument("--product-version", required=True)
    parser.add_argument("--commit", required=True)
    parser.add_argument("--epoch", required=True, type=int, help="time of creation, in seconds since 1970")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("debs", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    document = make_document(arguments.debs, arguments.compiled.split(), arguments.product_version, arguments.commit, arguments.epoch)
    errors = list(check_document(document))
    for error in errors:
        print(f"make_sbom: {error}", file=sys.stderr)
    arguments.output.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
