"""Verification book for tests in Python, as tests/support/book.hpp for those in C++: numbers of an independent
source."""

import json
import os
from collections import Counter

#: Books written by a test, by name.
written: Counter[str] = Counter()


class Book:
    """Comparisons of one test with one source; written to the folder POUNDING_BOOK when the test ends."""

    def __init__(self, test, subject, source, reason):
        self.test = test
        module, name, method = test.id().rsplit(".", 2)
        self.entry = {
            "subject": subject,
            "source": source,
            "reason": reason,
            "file": f"tests/program/{module}.py",
            "test": f"{name}.{method}",
        }
        self.rows = {}
        test.addCleanup(self.write)

    def near(self, quantity, obtained, expected, tolerance):
        """A quantity ends with its unit: "peak force [N]". Numbers of the same name are cases of one row."""
        self.rows.setdefault(quantity, []).append((float(expected), float(obtained), float(tolerance)))
        self.test.assertLessEqual(abs(obtained - expected), tolerance, quantity)

    def below(self, quantity, obtained, limit):
        """A difference that must be less than the limit."""
        self.rows.setdefault(quantity, []).append((0.0, float(obtained), float(limit)))
        self.test.assertLess(obtained, limit, quantity)

    def equal(self, quantity, obtained, expected):
        """A count."""
        self.rows.setdefault(quantity, []).append((float(expected), float(obtained), 0.0))
        self.test.assertEqual(obtained, expected, quantity)

    def write(self):
        if "POUNDING_BOOK" in os.environ:
            rows = [{"quantity": quantity, "cases": cases} for quantity, cases in self.rows.items()]
            number = written[self.test.id()]
            written[self.test.id()] += 1
            with open(os.path.join(os.environ["POUNDING_BOOK"], f"{self.test.id()}.{number}.json"), "w") as file:
                json.dump(self.entry | {"order": [self.entry["test"], number], "rows": rows}, file)
