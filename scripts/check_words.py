#!/usr/bin/env python3
"""Words of documents, comments and messages: rejects those that have a better name in the field (docs/GLOSSARY.md)."""

import os
import re
import sys

from source_tree import COMMENT_OR_STRING, list_files, read_text, run_check

# Not covered.
EXCEPTIONS = (
    re.compile(r"^scripts/check_words\.py$"),  # lists them
    re.compile(r"^tests/style/(?:bad/|plant_violations\.py$)"),  # violate rules on purpose
)

# (path, literal with its quotes): names that existing files on disk have, so that they cannot be changed.
STORED_NAMES = (
    ("libplan/json/include/acs/plan_json/PlanFields.hpp", '"doubtful"'),  # key of RobotWorkChanged::bUnresolved in acsd.db
)

# What is rejected, and what to write in its place.
WORDS = (
    (r"tells?(?!\()|told|telling", "report, publish, send, log, return or state"),
    (r"says?|said|saying", "report, state or answer"),
    (r"hears?|heard", "receive"),
    (r"for ever", "indefinitely"),
    (r"somebody|someone else|nobody|anybody|everybody|whoever", "the operator, the MCS, any client, no client"),
    (r"homecom\w+|(?:ways?|come|comes|get|gets) home", "safe state, parking position"),
    (r"berths?|homeless", "parking position"),
    (r"thinned", "rate-limited"),
    (r"(?:that|which|who) (?:is|are) none|(?:a|the) \w+ that is none", "invalid ..."),
    (r"(?:is|are|was|were|as|be) no UTF-8", "not valid UTF-8"),
    (r"(?:give|gives|gave|given|giving) (?:it |them |that )?up", "cancel, abandon or drop"),
    (r"(?:get|gets|got|getting) on", "make progress, continue"),
    (r"(?:go|goes|went|going|gone) on", "continue"),
    (r"(?:take|takes|took|taken|taking) up", "accept, resume"),
    (r"(?:look|looks|looked|looking) (?:around|at|into|whether|again)|glances?", "check, probe, poll or verify"),
    (r"mistakes?(?! \w+ \w+ for\b)", "error"),
    (r"objections?|hindrances?", "rejection reason, unavailability"),
    (r"as long as", "while"),
    (r"so (?:many|long|often|much)", "number of, duration of, at most N"),
    (r"stands?(?! for\b| in for\b)|stood", "is stationary, is stopped, is listed"),
    (r"put together|parted", "composed, resolved, grouped"),
    (r"behind (?:it|that|them)", "after"),
    (r"without leave|for the sake of|at will", "without a reservation, for, optionally"),
    (r"wish(?:es)?|courtesy|caretakers?", "planned route, yield, model"),
    (r"doubtful|uncertain", "unresolved"),
    (r"figures", "metrics, measured values"),
    (r"habits?", "behaviour, profile"),
    (r"patience|patient", "time limit"),
    (r"news", "event, evidence"),
    (r"begin anew|begun anew|anew", "again"),
)
# A phrase may go over the end of a line.
PATTERN = re.compile("|".join(rf"(?P<w{i}>(?<![\w-])(?:{words})(?![\w-]))" for i, (words, _) in enumerate(WORDS))
                     .replace(" ", r"\s+"), re.IGNORECASE)

_COMMENT_MARK = re.compile(r"^[ \t]*(?://[/!]?<?|#+)", re.MULTILINE)
_CODE = re.compile(r"^(?P<fence>```).*?^```|`[^`\n]+`|\]\([^)\n]*\)|(?<=\n\n)(?: {4}[^\n]*\n)+", re.DOTALL | re.MULTILINE)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def keep_prose(path, text):
    """The words for a reader, everything else blank, lines and columns as they were: of a document all but code and the
    targets of links; of a C++ source its comments and literals; of anything else everything."""
    if path.endswith(".md"):
        return _CODE.sub(lambda match: _blank(match.group(0)), text)
    if not path.endswith((".hpp", ".cpp")):
        return text
    kept, end = "", 0
    for match in COMMENT_OR_STRING.finditer(text):
        kept += _blank(text[end:match.start()]) + match.group(0)
        end = match.end()
    return kept + _blank(text[end:])


def is_covered(path):
    return not any(exception.search(path) for exception in EXCEPTIONS)


def check_text(path, text):
    for stored_path, name in STORED_NAMES:
        if path == stored_path:
            text = text.replace(name, _blank(name))
    prose = _COMMENT_MARK.sub(lambda match: _blank(match.group(0)), keep_prose(path, text))
    for match in PATTERN.finditer(prose):
        better = next(WORDS[i][1] for i in range(len(WORDS)) if match.group(f"w{i}"))
        yield text.count("\n", 0, match.start()) + 1, f"'{' '.join(match.group(0).split())}': write {better}"


def check_tree(root):
    for path in list_files(root):
        if is_covered(path):
            for line, reason in check_text(path, read_text(root, path)):
                yield f"{path}:{line}: {reason}"


if __name__ == "__main__":
    sys.exit(run_check("Rejects words that have a better name", check_tree))
