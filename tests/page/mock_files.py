"""The files of the live page, as acsd serves them."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "apps" / "acsd" / "page"
LEAFLET = [pathlib.Path(folder) for folder in ("/usr/share/javascript/leaflet", "/usr/share/nodejs/leaflet/dist")]
CONTENT_TYPES = {".html": "text/html; charset=utf-8", ".css": "text/css; charset=utf-8", ".js": "text/javascript; charset=utf-8",
                 ".json": "application/json", ".svg": "image/svg+xml", ".txt": "text/plain; charset=utf-8"}
POLICY = "default-src 'self'; object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"


def find_page_file(name):
    """The file of /page/NAME, as CMake embeds them; None if there is none."""
    if name in ("leaflet.js", "leaflet.css"):
        source = "leaflet.esm.min.js" if name == "leaflet.js" else name
        return next((folder / source for folder in LEAFLET if (folder / source).is_file()), None)
    if name == "leaflet-copyright.txt":
        return pathlib.Path("/usr/share/doc/libjs-leaflet/copyright")
    path = PAGE / name
    return path if re.fullmatch(r"[\w.-]+", name) and path.is_file() else None
