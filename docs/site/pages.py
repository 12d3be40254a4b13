"""The pages of the site as they are on GitHub: the index of docs/README.md is the navigation, headings have the same anchors, and
a page and its translation have links to each other."""

import os
import re

from docutils import nodes
from source_tree import read_text
from translations import find_translations, get_language

INDEX = "docs/README.md"
START = "README"
LINK = re.compile(r"\]\(([^)#\s]+)\.md\)")
NAMES = {"en": "English", "ko": "한국어"}


def list_chapters(index):
    """(heading, documents) of each table of the index."""
    for table in re.split(r"\n(?=\| \w+ \| \|\n)", index)[1:]:
        heading = table.split("|")[1].strip()
        pages = [os.path.normpath(os.path.join(os.path.dirname(INDEX), page)) for page in LINK.findall(table)]
        yield heading, [page for page in dict.fromkeys(pages) if get_language(page) == "en"]


def write_tree(caption, pages):
    return "\n".join(["", "```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```", ""]) if pages else ""


def add_navigation(app, document, source):
    """Adds the lists of pages that Sphinx's navigation needs and that GitHub's readers would see."""
    root = str(app.srcdir)
    if document == START:
        for heading, pages in list_chapters(read_text(root, INDEX)):
            source[0] += write_tree(heading, [f"/{page}" for page in pages])
        # Documents outside docs need no entry in its index.
        others = [path[:-3] for path in app.config.include_patterns if not path.startswith("docs/") and get_language(path) == "en"]
        others = sorted((page for page in others if page != START), key=lambda page: ("/" not in page, page))
        source[0] += write_tree("Project", [f"/{page}" for page in (INDEX[:-3], *others)])
        korean = [path[:-3] for path in app.config.include_patterns
                  if get_language(path) == "ko" and ("/runbook/" not in path or path.endswith("README.md"))]
        source[0] += write_tree("한국어", [f"/{page}" for page in sorted(korean, key=lambda page: (page != "README.ko", page))])
    elif document in ("docs/runbook/README", "docs/runbook/ko/README"):
        folder = os.path.dirname(document) + ("/en" if document.endswith("runbook/README") else "")
        pages = [path[:-3] for path in app.config.include_patterns if os.path.dirname(path) == folder]
        source[0] += write_tree(folder, [f"/{page}" for page in sorted(pages) if page != document])
    elif document == "docs/design/architecture":
        pages = [path[:-3] for path in app.config.include_patterns if path.startswith("docs/design/decisions/")]
        source[0] += write_tree("Decisions", [f"/{page}" for page in sorted(pages)])


def add_anchors(_, tree):
    """Headings keep the anchors that links use on GitHub, also those of Hangul, which docutils would number."""
    for section in tree.findall(nodes.section):
        anchor = section.get("myst-anchor", "").rpartition("#")[2]
        if anchor and anchor not in section["ids"]:
            section["ids"].append(anchor)


def link_translation(app, page, _, context, __):
    """The language of the page, for browsers and screen readers, and a link to the same page in the other language."""
    files = app.config.include_patterns
    pairs = {path[:-3]: original[:-3] for path, original in find_translations(files).items() if original in files}
    language = get_language(page)
    context["language"] = language
    other = pairs.get(page) or next((path for path, original in pairs.items() if original == page), None)
    if other is None or "body" not in context:
        return
    code = get_language(other)
    target = app.builder.get_relative_uri(page, other)
    if f'href="{target}"' not in context["body"]:
        context["body"] = (f'<p class="translation"><a href="{target}" hreflang="{code}" lang="{code}">{NAMES[code]}</a></p>'
                           + context["body"])


def setup(app):
    app.connect("source-read", add_navigation)
    app.connect("doctree-read", add_anchors)
    app.connect("html-page-context", link_translation)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
