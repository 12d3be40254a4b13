"""Code blocks of a document that are marked to be run. The mark is a comment on the line before the block, which neither GitHub nor
the documentation site shows:

    <!-- run -->                        the block is a shell script; it must succeed
    <!-- run: services -->              each line is a command in a terminal of its own, which may end with 0 before the page
    <!-- run: file examples/a.toml -->  the block is the content of this file
    <!-- run: output -->                each line is in the output of the scripts above

Several are separated by commas. `only TEXT` runs only the lines that begin with TEXT; `after NAME` waits until the service of that
name has ended.
"""

import re
from dataclasses import dataclass, field

MARKED = re.compile(r"^<!-- run(?:: ?([^\n]*))? -->\n(?:```[^\n]*\n(.*?)^```$)?", re.DOTALL | re.MULTILINE)
KINDS = ("services", "output", "file")


@dataclass
class Block:
    line: int  # of its first command
    text: str
    kind: str = "script"
    path: str = ""  # of a file
    after: list = field(default_factory=list)

    def list_commands(self):
        """(line, command) without comments of their own; lines that end with a backslash are joined."""
        commands, begin, joined = [], 0, ""
        for number, text in enumerate(self.text.splitlines(), self.line):
            begin = begin if joined else number
            if text.endswith("\\"):
                joined += text[:-1]
                continue
            joined += text
            if joined.strip() and not joined.startswith("#"):
                commands.append((begin, joined))
            joined = ""
        return commands


class MarkError(Exception):
    pass


def read_mark(words, block):
    for word in [word.strip() for word in words.split(",") if word.strip()]:
        name, _, value = word.partition(" ")
        if name in KINDS and bool(value) == (name == "file"):
            block.kind, block.path = name, value
        elif name == "only" and value:
            lines = block.text.splitlines()
            if not any(line.startswith(value) for line in lines):
                raise MarkError(f"no command begins with '{value}'")
            block.text = "\n".join(line if line.startswith(value) else "" for line in lines) + "\n"
        elif name == "after" and value:
            block.after.append(value)
        else:
            raise MarkError(f"unknown mark '{word}'")


def find_blocks(text):
    """The marked blocks of a document in their order."""
    blocks = []
    for match in MARKED.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        if match.group(2) is None:
            raise MarkError(f"line {line}: a mark without a code block in the next line")
        block = Block(line + 2, match.group(2))
        try:
            read_mark(match.group(1) or "", block)
        except MarkError as error:
            raise MarkError(f"line {line}: {error}") from None
        blocks.append(block)
    return blocks
