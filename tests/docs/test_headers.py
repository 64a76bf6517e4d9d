"""The installed headers: few, listed on the page of the guide, and without includes of private ones."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/docs"))
from declarations import bundled_headers, public_headers, source_of  # noqa: E402

PAGE = ROOT / "python/docs/guide/headers.md"


class Headers(unittest.TestCase):
    def test_AreListedOnTheirPage(self):
        listed = re.findall(r"(?m)^\| `(pounding[\w/.]*)` \| .", PAGE.read_text())
        bundles, headers = public_headers()
        self.assertEqual(sorted(listed), sorted([*bundles, *headers, "pounding.h"]))

    def test_AreFew(self):
        bundles, headers = public_headers()
        self.assertLessEqual(len(bundles) + len(headers) + len(["pounding.h"]), 60)

    def test_IncludeNoPrivateHeader(self):
        bundles, headers = public_headers()
        public = {*bundles, *headers} | bundled_headers()
        private = [
            f"{header} includes {included}"
            for header in headers
            for included in re.findall(r"(?m)^#include <(pounding/[^>]*)>", source_of(header).read_text())
            if included not in public
        ]
        self.assertEqual(private, [])

    def test_UmbrellasIncludeAllOthers(self):
        """pounding/lib.hpp is enough; version.hpp is for those who print it."""
        bundles, headers = public_headers()
        found, pending = set(), ["pounding/lib.hpp"]
        while pending:
            if (header := pending.pop()) not in found:
                found.add(header)
                pending += re.findall(r"(?m)^#include <(pounding/[^>]*)>", source_of(header).read_text())
        self.assertEqual(sorted({*bundles, *headers} - found), ["pounding/core/version.hpp"])


if __name__ == "__main__":
    unittest.main()
