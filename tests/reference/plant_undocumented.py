#!/usr/bin/env python3
"""Runs scripts/reference on small trees: one with what needs no comment of its own passes, and each symbol that lacks a comment
is reported with its file and line. Also: the reference covers each folder of public headers."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INDEX = "build/reference/html/index.html"
INTERNAL = ("libacs-core/json/include", "libacs-core/net/include", "libplan/json/include")
COPIED = ("scripts/reference", "scripts/reference_filter.py", "scripts/lib.sh", "docs/reference/api/Doxyfile")

RIGHT = {
    "docs/reference/api/namespaces.dox": "/**\n@namespace ACS\nThe SDK.\n@namespace ACS::Core\nThe base.\n*/\n",
    "libacs-core/include/acs/core/Version.hpp": """#pragma once
namespace ACS::Core
{
/// The version.
constexpr const char* SDK_VERSION = "1.2.3";
}
""",
    "libacs-core/include/acs/core/Right.hpp": """#pragma once
namespace ACS::Core
{

/// A message (section 6.1).
struct ACS_API Message
{
    std::string text;
    int count = 0; ///< At least 1.
    /// A comment after one with another mark.
    int size = 0;

    bool operator==(const Message&) const = default;
};

/// A status (section 6.2).
enum class EStatus : std::uint8_t
{
    One,
    Two, ///< The second.
};

/// A colour, for which no enumerator needs a comment.
enum class EColour : std::uint8_t
{
    Red,
    Green,
};

/// Moves.
class ACS_API IMover
{
public:
    IMover() = default;
    IMover(const IMover&) = delete;
    IMover& operator=(const IMover&) = delete;
    virtual ~IMover() = default;

    /// Moves by this number of metres.
    virtual void Move(double distance) = 0;
};

/// A motor.
class ACS_API Motor final : public IMover
{
    class ACS_HIDDEN Impl;

    std::unique_ptr<Impl> _impl;

public:
    Motor(Motor&&) noexcept;
    Motor& operator=(Motor&&) noexcept;
    ~Motor() override;

    void Move(double distance) override;

private:
    void Start();
};

} // namespace ACS::Core

template <>
struct std::hash<ACS::Core::Motor>
{
    std::size_t operator()(const ACS::Core::Motor& motor) const noexcept;
};
""",
    "libacs-protocol/c/include/acs/c/right.h": """/* The interface.
 */
#define ACS_OK 0 /* Success. */
/* A text. */
typedef struct acs_text
{
    const char* data; /* Never null. */
} acs_text;
/* Returns a result. */
ACS_C_EXPORT int acs_write(acs_text text);
""",
    "apps/acsd/include/acs/acsd/Config.hpp":
        "/// Drivers.\nnamespace ACS::Acsd\n{\n/// A robot.\nstruct RobotConfig\n{\n    std::string robotID;\n};\n}\n",
}

# file, content, the line that must be reported, what the report names
PLANTED = (
    ("libacs-core/include/acs/core/A.hpp", "namespace ACS::Core\n{\nACS_API int Count(int a);\n}\n", 3, "Count"),
    ("libacs-core/include/acs/core/B.hpp",
     "namespace ACS::Core\n{\n\nclass ACS_API Bare\n{\npublic:\n    int a = 0; ///< A number.\n};\n}\n", 4, "Bare"),
    ("libacs-core/include/acs/core/C.hpp",
     "namespace ACS::Core\n{\n/// A class.\nclass Open\n{\npublic:\n    void Close();\n};\n}\n", 7, "Close"),
    ("libacs-core/include/acs/core/D.hpp",
     "namespace ACS::Core\n{\n/// Not of a message.\nstruct Options\n{\n    int limit = 0;\n};\n}\n", 6, "limit"),
    ("libacs-core/include/acs/core/E.hpp", "namespace ACS::Core\n{\nenum class EKind\n{\n    One,\n};\n}\n", 3, "EKind"),
    ("libacs-core/include/acs/core/F.hpp", "namespace ACS::Core\n{\nusing Numbers = std::vector<int>;\n}\n", 3, "Numbers"),
    ("libacs-core/include/acs/core/G.hpp", "namespace ACS::Core\n{\ninline constexpr int MOST = 3;\n}\n", 3, "MOST"),
    ("libacs-core/include/acs/core/I.hpp",
     "namespace ACS::Core\n{\n/// A kind.\nenum class EPart\n{\n    One, ///< The first.\n    Two,\n};\n}\n", 7,
     "enumerator_without_comment"),
    ("libacs-core/include/acs/core/H.hpp", "namespace ACS::Core\n{\n/// See #Missing.\nint Find();\n}\n", 3, "Missing"),
    ("libacs-protocol/c/include/acs/c/more.h", "/* More.\n */\n/* Does. */\nint acs_do(void);\nint acs_undo(void);\n", 5, "acs_undo"),
)


def list_public_folders():
    found = []
    for folder, folders, _ in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in ("build", ".git", "tests", "examples")]
        if os.path.basename(folder) == "include":
            found.append(os.path.relpath(folder, ROOT))
            folders[:] = []
    return sorted(set(found) - set(INTERNAL))


def list_inputs():
    with open(os.path.join(ROOT, "docs/reference/api/Doxyfile"), encoding="utf-8") as file:
        value = re.search(r"^INPUT +=((?:.*\\\n)*.*)$", file.read(), re.MULTILINE).group(1)
    return value.replace("\\", " ").split()


def write_files(root, files):
    for path, text in files.items():
        os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
        with open(os.path.join(root, path), "w", encoding="utf-8") as file:
            file.write(text)


def make_tree(root, files):
    for folder in list_inputs():
        os.makedirs(os.path.join(root, folder))
    os.makedirs(os.path.join(root, "scripts"))
    for path in COPIED:
        shutil.copy(os.path.join(ROOT, path), os.path.join(root, path))
    write_files(root, files)


def build(root):
    ran = subprocess.run([os.path.join(root, "scripts/reference")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                         text=True)
    if ran.returncode == 0 and not os.path.exists(os.path.join(root, INDEX)):
        return 1, "no page was written"
    return ran.returncode, ran.stderr


def run(files):
    """The exit code and the errors of scripts/reference on a tree with these files."""
    with tempfile.TemporaryDirectory() as root:
        make_tree(root, files)
        return build(root)


def check_replaced():
    """A failed run leaves the reference that was there; the next one replaces it."""
    with tempfile.TemporaryDirectory() as root:
        make_tree(root, RIGHT)
        found = []
        path, text, _, _ = PLANTED[0]
        for files in ({}, {path: text}, {path: "#pragma once\n"}):
            write_files(root, files)
            found.append((build(root)[0], os.path.exists(os.path.join(root, INDEX)),
                          sorted(os.listdir(os.path.join(root, "build/reference")))))
        return found


def check_foreign():
    """Folders named html that are not of this script: with pages of another program, and of Doxygen for another project."""
    found = []
    for files in ({"index.html": "ACS SDK"}, {"index.html": "Other", "doxygen.css": ""}):
        with tempfile.TemporaryDirectory() as root:
            make_tree(root, RIGHT)
            write_files(os.path.join(root, os.path.dirname(INDEX)), files)
            found.append((build(root)[0], sorted(os.listdir(os.path.join(root, os.path.dirname(INDEX)))) == sorted(files)))
    return found


def main():
    faults = []
    if list_public_folders() != sorted(set(list_inputs()) - {"docs/reference/api"}):
        faults.append(f"INPUT of docs/reference/api/Doxyfile must have {' '.join(list_public_folders())}")
    code, errors = run(RIGHT)
    if code != 0:
        faults.append(f"a tree without violations fails:\n{errors}")
    code, errors = run(RIGHT | {path: text for path, text, _, _ in PLANTED})
    if code != 1:
        faults.append(f"the exit code is {code} for a tree with violations, not 1")
    for path, _, line, name in PLANTED:
        if not re.search(rf"^{re.escape(path)}:{line}: error: .*\b{name}\b", errors, re.MULTILINE):
            faults.append(f"{path}:{line}: {name} is not reported")
    reported = len(re.findall(r"^[^\s:]+:\d+: error: ", errors, re.MULTILINE))
    if reported != len(PLANTED):
        faults.append(f"{reported} errors are reported instead of {len(PLANTED)}")
    files = ["doxygen.log", "html"]
    if (found := check_replaced()) != [(0, True, files), (1, True, files), (0, True, files)]:
        faults.append(f"exit codes, index and files of a run, a failed one and the next: {found}")
    if (found := check_foreign()) != [(2, True), (2, True)]:
        faults.append(f"exit codes for folders of other programs, and whether their files are left: {found}")
    if faults:
        print("\n".join(faults) + f"\nscripts/reference has printed:\n{errors}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
