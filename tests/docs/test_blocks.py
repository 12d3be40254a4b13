#!/usr/bin/env python3
"""What run_blocks.py must refuse: commands and services that fail, output that differs, marks without a meaning."""

import contextlib
import io
import pathlib
import sys
import tempfile

from blocks import MarkError, find_blocks
from run_blocks import Failure, run_page

RIGHT = """# A page

<!-- run: services -->
```
sleep 1
sleep 100
```

Text.

<!-- run: file examples/one.toml -->
```toml
one = 1
```

<!-- run: after sleep-once -->
```sh
# a comment
for name in a b; do
    echo "$name   one"
done
cat examples/one.toml && test -x build/release/bin/tool && tool
```

<!-- run: output -->
```
b one
one = 1
```

<!-- run: only true -->
```
false
true   # only this
```

```
false
```
""".replace("sleep 1\n", "sleep-once\n")

# page, what the failure contains
FAILING = (
    ("<!-- run -->\n```\ntrue\n\nfalse\ntrue\n```\n", "page.md:5: the command ended with 1"),
    ("<!-- run -->\n```\nfalse | true\n```\n", "page.md:3: the command ended with 1"),
    ("<!-- run -->\n```\nno-such-program\n```\n", "ended with 127"),
    ("\n<!-- run: services -->\n```\nsleep 100\nfalse\n```\n\n<!-- run -->\n```\nsleep 1\n```\n",
     "page.md:5: 'false' ended with 1"),
    ("<!-- run -->\n```\necho one\n```\n\n<!-- run: output -->\n```\none two\n```\n", "page.md:8: 'one two' is not in the output"),
    ("<!-- run: after nothing -->\n```\ntrue\n```\n", "no service 'nothing'"),
)
REFUSED = (
    ("<!-- run -->\nText.\n", "line 1: a mark without a code block"),
    ("# A\n\n<!-- run -->\n\n```\ntrue\n```\n", "line 3: a mark without a code block"),
    ("<!-- run: often -->\n```\ntrue\n```\n", "unknown mark 'often'"),
    ("<!-- run: file -->\n```\ntrue\n```\n", "unknown mark 'file'"),
    ("<!-- run: only false -->\n```\ntrue\n```\n", "no command begins with 'false'"),
)


def make_programs(folder):
    for name, text in (("tool", "#!/bin/sh\n"), ("sleep-once", "#!/bin/sh\nsleep 0.2\n")):
        program = folder / name
        program.write_text(text, encoding="utf-8")
        program.chmod(0o755)


def main():
    faults = []
    with tempfile.TemporaryDirectory() as name, contextlib.redirect_stdout(io.StringIO()):
        programs = pathlib.Path(name)
        make_programs(programs)
        try:
            if run_page("page.md", RIGHT, programs) != 5:
                faults.append("not all marked blocks of a right page are run")
        except (Failure, MarkError) as failure:
            faults.append(f"a right page fails: {failure}")
        for page, reason in FAILING:
            try:
                run_page("page.md", page, programs)
                faults.append(f"accepted:\n{page}")
            except Failure as failure:
                if reason not in str(failure):
                    faults.append(f"'{reason}' is not in '{failure}' of:\n{page}")
    for page, reason in REFUSED:
        try:
            find_blocks(page)
            faults.append(f"accepted:\n{page}")
        except MarkError as error:
            if reason not in str(error):
                faults.append(f"'{reason}' is not in '{error}' of:\n{page}")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
