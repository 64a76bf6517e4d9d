"""The site: the repository's own pages where they are, and those of this folder. `make docs` builds it into build/docs.

The top level of the repository is the source folder of Sphinx, so that links and pictures need no changes.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

project = "pounding"
author = "The pounding authors"
copyright = "2026, The pounding authors; BSD-3 licence"
version = release = re.search(r"project\(pounding\s+VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_copybutton", "pages", "lesson_pages", "header_reference"]
root_doc = "python/docs/index"
include_patterns = [
    "python/docs/**",
    "examples/**",
    "elements/pounding/laws/pages/*",
    "elements/pounding/hysteresis/pages/*",
    "tests/verification/**",
    "tests/benchmarks/README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "CHANGELOG.md",
]
exclude_patterns = ["build*", ".venv*", ".git"]
# Some formulas are literal text; pounding.results and pounding.opensees both have a class Link.
suppress_warnings = ["misc.highlighting_failure", "ref.python"]

myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_merge_streams = True

default_role = "code"
smartquotes = False  # d' is a rate
highlight_language = "none"  # indented blocks are formulas and commands
copybutton_prompt_text = "$ "
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
add_module_names = False
maximum_signature_line_length = 100
toc_object_entries_show_parents = "hide"

html_theme = "furo"
html_title = f"pounding {version}"
html_math_renderer = "mathml"
# MathML needs a mathematical font, which some systems lack.
html_static_path = ["_static", "/usr/share/fonts/opentype/stix-word/STIXMath-Regular.otf"]
html_css_files = ["site.css"]
html_search_scorer = str(HERE / "_static/scorer.js")
html_show_sphinx = False
html_copy_source = False
