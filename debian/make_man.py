#!/usr/bin/env python3
"""make_man.py TEMPLATE PROGRAM VERSION DATE: prints a man page. The template is a page; what it names between @ comes from the
--help of the program, so that no option is missing:
  @VERSION@, @DATE@   the arguments
  @OPTIONS@           the options
  @COMMANDS@          the commands, each with its options
  @COMMAND NAME@      one command that --help does not list
  @FOOTER@            what follows the options, as it is"""

import pathlib
import re
import subprocess
import sys

COLUMN = 30  # of the descriptions in --help
SECTION = re.compile(r"^(Options|Subcommands|Positionals):$")
# Upper case that is no model or version such as HA006B-01.
PLACEHOLDER = re.compile(r"(?<![0-9A-Z.-])[A-Z]{2,}(?![0-9A-Z.-])")
RANGE = re.compile(r"UINT in \[(\S+) - (\S+)\]")
# The documents are installed elsewhere, and the example site by acs-sims.
INSTALLED = ((re.compile(r"\bdocs/(?=reference/|guide/)"), "/usr/share/doc/acs/docs/"),
             (re.compile(r"\bexamples/site/(?!\S+ of the sources)"), "/usr/share/acs/site/"))


def run_help(program, words):
    command = [program, *words, "--help"]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return done.stdout


def read_help(text):
    """(description, usage, {section: [(name, description)]}, footer)"""
    lines = text.rstrip("\n").split("\n")
    usage = next(number for number, line in enumerate(lines) if line.startswith("Usage: "))
    sections, current, footer = {}, None, []
    for number, line in enumerate(lines[usage + 1:], usage + 1):
        match = SECTION.match(line)
        if match:
            current = sections.setdefault(match.group(1), [])
        elif not line:
            continue
        elif current is not None and line.startswith("  ") and not line.startswith(" " * COLUMN):
            name, _, description = line[2:].partition("  ") if len(line) > COLUMN and line[COLUMN - 1] == " " else (line[2:], "", "")
            current.append((name.strip(), description.strip()))
        elif current is not None and line.startswith(" " * COLUMN):
            name, description = current[-1]
            current[-1] = (name, f"{description} {line.strip()}".strip())
        else:
            footer = lines[number:]
            break
    return " ".join(lines[:usage]), lines[usage][len("Usage: "):], sections, footer


def escape(text):
    for pattern, place in INSTALLED:
        text = pattern.sub(place, text)
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga").replace("~", "\\(ti")
    return text.replace("^", "\\(ha")


def format_option(name, description):
    """An entry of --help such as "--repeat UINT:UINT in [1 - 10000]=1"."""
    notes = []
    for mark, note in (("Needs", "only with"), ("Excludes", "not with")):
        for other in re.findall(rf" {mark}: (\S+)", name):
            notes.append(f"{note} {other}")
        name = re.sub(rf" {mark}: \S+", "", name)
    if name.endswith(" REQUIRED"):
        name = name[:-len(" REQUIRED")]
        notes.append("required")
    limits = RANGE.search(name)
    name = re.sub(r"\b([A-Z]+):UINT in \[\S+ - \S+\]", r"N" if " UINT:" in name else r"\1", name)
    name = re.sub(r":\{([^}]*)\}", "", name)
    if limits and f"{limits.group(1)} to " not in description:
        notes.append(f"{limits.group(1)} to {limits.group(2)}")
    # KEY=VALUE is a value of two parts, MODE=auto one with its default.
    default = re.match(r"^(\S+ [^=\s]+)=(\S+)$", name)
    if default and (default.group(1).endswith(" TEXT") or not PLACEHOLDER.search(default.group(2))):
        name = default.group(1)
        notes.append(f"default {default.group(2)}")
    description = description + (f" ({', '.join(notes)})" if notes else "")
    flags, _, value = name.partition(" ")
    if flags.startswith("-"):
        flags = ", ".join(f"\\fB{escape(flag)}\\fR" for flag in flags.split(","))
        head = f"{flags} \\fI{escape(value)}\\fR" if value else flags
    else:
        head = f"\\fI{escape(name)}\\fR"
    return f".TP\n{head}\n{guard(escape(description))}\n"


def guard(text):
    """A line that begins with a dot is a request."""
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.MULTILINE)


def format_options(sections, without_help=False):
    # A positional is required unless its usage has brackets.
    return "".join(f".TP\n\\fI{escape(name.split(' ')[0])}\\fR\n{guard(escape(description))}\n"
                   for name, description in sections.get("Positionals", [])) + "".join(
        format_option(name, description) for name, description in sections.get("Options", [])
        if not (without_help and name == "-h,--help"))


def format_command(program, words):
    description, usage, sections, footer = read_help(run_help(program, words))
    usage = usage.partition(" ")[2]
    if len(sections["Options"]) == 1:  # --help
        usage = usage.replace(" [OPTIONS]", "")
    page = ""
    if "Subcommands" not in sections:
        page += f".SS {escape(usage)}\n{guard(escape(description))}\n{format_options(sections, True)}"
    for name, _ in sections.get("Subcommands", []):
        page += format_command(program, [*words, name])
    for line in footer:
        paragraph = f".PP\n{guard(escape(line))}\n"
        # Commands inherit that of the command around them.
        page = page.replace(paragraph, "") + paragraph if line else page
    return page


def make_page(template, program, version, date):
    _, _, sections, footer = read_help(run_help(program, []))
    page = []
    for line in template.splitlines():
        if line == "@OPTIONS@":
            page.append(format_options(sections).rstrip("\n"))
        elif line == "@COMMANDS@":
            page += [format_command(program, [name]).rstrip("\n") for name, _ in sections["Subcommands"]]
        elif line.startswith("@COMMAND "):
            page.append(format_command(program, [line[len("@COMMAND "):-1]]).rstrip("\n"))
        elif line == "@FOOTER@":
            page += [".nf", guard(escape("\n".join(footer))), ".fi"]
        else:
            page.append(line.replace("@VERSION@", version).replace("@DATE@", date))
    return "\n".join(page) + "\n"


def main():
    template, program, version, date = sys.argv[1:]
    sys.stdout.write(make_page(pathlib.Path(template).read_text(encoding="utf-8"), program, version, date))


if __name__ == "__main__":
    main()
