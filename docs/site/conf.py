"""Settings of the documentation site, which scripts/site builds with Sphinx. The documents are read where they are in the tree."""

import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.join(ROOT, "scripts")]
sys.dont_write_bytecode = True
from source_tree import list_files, read_text  # noqa: E402

project = "ACS SDK"
version = release = re.search(r'SDK_VERSION = "([^"]+)"', read_text(ROOT, "libacs-core/include/acs/core/Version.hpp")).group(1)
html_title = f"{project} {version}"
html_theme = "furo"
html_theme_options = {"top_of_page_button": None}
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
html_show_sphinx = False
templates_path = []

extensions = ["myst_parser", "pages", "korean_search"]
root_doc = "README"
# Pages are the Markdown files that git lists, except those of tests.
include_patterns = [path for path in list_files(ROOT) if path.endswith(".md") and not path.startswith("tests/")]
exclude_patterns = ["build", ".git", "tests"]
myst_heading_anchors = 6  # links to headings as on GitHub
language = "en"
html_search_language = "en-ko"

# Every link must have a target, and every name of a code block a language.
nitpicky = True
highlight_language = "none"
# Examples leave out what is marked with an ellipsis, so that not every one is valid code.
suppress_warnings = ["misc.highlighting_failure"]
