"""Every public name is documented, in the installed headers in C and C++, and in the Python package."""

import ast
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/docs"))
from declarations import declarations, installed_headers  # noqa: E402

EXPLAINED = {"struct", "class", "union", "enum", "concept", "type", "function"}


#: Members of every contact or hysteretic law, by the folder whose law.hpp documents them once.
LAWS = {
    "laws": ("check", "damping_for", "contact", "respond", "corner", "keep"),
    "hysteresis": (
        "check",
        "stiffness",
        "yield_deformation",
        "respond",
        "advance",
        "stored",
        "work",
        "corner",
        "excess",
        "lost",
        "stored_excess",
    ),
}


def law_contract():
    """Members of laws that are documented in law.hpp."""
    docs = {folder: declarations(ROOT / f"elements/pounding/{folder}/law.hpp")[0] for folder in LAWS}
    return {(folder, name) for folder, names in LAWS.items() for name in names if f" {name}(" in docs[folder]}


def unexplained(items, contract=frozenset()):
    for item in items:
        parts = item.name.split("::")
        is_law = len(parts) == 4 and parts[0] == "pounding" and (parts[1], parts[3]) in contract
        if item.kind in EXPLAINED and not item.is_documented and not is_law:
            yield item
        yield from unexplained(item.members, contract)


def without_docstring(tree, around=""):
    """Public classes, functions, methods and properties of a module; an override may leave its documentation to the
    base."""
    for node in tree.body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)) or node.name.startswith("_"):
            continue
        if not ast.get_docstring(node):
            yield node.lineno, around + node.name
        if isinstance(node, ast.ClassDef):
            yield from without_docstring(node, f"{around}{node.name}.")


class Names(unittest.TestCase):
    def test_EveryInstalledHeaderExplainsWhatItDeclares(self):
        contract = law_contract()
        self.assertEqual(len(contract), sum(map(len, LAWS.values())))
        silent = [
            f"{path.relative_to(ROOT)}:{item.line}: {item.name}"
            for path in installed_headers()
            for item in unexplained(declarations(path)[1], contract)
        ]
        self.assertEqual(silent, [], "\n" + "\n".join(silent))

    def test_EveryPublicPythonNameHasADocstring(self):
        silent = []
        for path in sorted((ROOT / "python/pounding").rglob("*.py")):
            tree = ast.parse(path.read_text())
            if not ast.get_docstring(tree):
                silent.append(f"{path.relative_to(ROOT)}:1: the module")
            silent += [f"{path.relative_to(ROOT)}:{line}: {name}" for line, name in without_docstring(tree)]
        self.assertEqual(silent, [], "\n" + "\n".join(silent))

    def test_TestsKeepTheirNamesInANamespaceOfTheirFile(self):
        """Tests are compiled in batches, where no two files may use one name for different entities."""
        unnamed = [
            str(path.relative_to(ROOT))
            for path in sorted((ROOT / "tests").rglob("*_test.cpp"))
            if "gtest/gtest.h" in (text := path.read_text()) and f"\nnamespace {path.stem} {{\n" not in text
        ]
        self.assertEqual(unnamed, [])

    def test_TheReaderFindsWhatTheHeadersDeclare(self):
        found = {item.name for path in installed_headers() for item in declarations(path)[1]}
        for name in (
            "pnd_respond",
            "pnd_law",
            "pnd_status",
            "pounding::GapLink",
            "pounding::run",
            "pounding::laws::touch",
            "pounding::laws::Jankowski",
            "pounding::ContactPhase",
            "pounding::petsc::Environment",
        ):
            self.assertIn(name, found)


class Reader(unittest.TestCase):
    """Checks that this test finds declarations and their comments."""

    def read(self, text, suffix=".hpp"):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"sample{suffix}"
            path.write_text(text)
            return declarations(path)

    def silent(self, text, suffix=".hpp"):
        return [item.name for item in unexplained(self.read(text, suffix)[1])]

    def test_SeesWhatHasNoComment(self):
        self.assertEqual(
            self.silent(
                "/// The file.\n\nnamespace a {\n/// One.\nstruct S {\n  int f() const { return 1; }\n};\n\n"
                "int g(double x = h(1));\n\nenum class E { one, two };\n\nusing T = int;\n}"
            ),
            ["a::S::f", "a::g", "a::E", "a::T"],
        )
        self.assertEqual(self.silent("/* One. */\nint f(void);\n\nint g(void);\n", ".h"), ["g"])

    def test_ACommentHoldsForTheLinesBelowIt(self):
        self.assertEqual(self.silent("/// Both.\nint f();\nint g();\n\nint h();\n"), ["h"])
        self.assertEqual(self.silent("int f();  ///< Its own.\nint g();\n"), ["g"])

    def test_PrivatePartsAreNobodysBusiness(self):
        _, (item,) = self.read(
            "/// One.\nclass C {\n public:\n  /// Two.\n  C(int a) : a_{a}, b_(a) { go(); }\n private:\n  int f();\n  int a_;\n};"
        )
        self.assertEqual([member.name for member in item.members], ["C::C"])
        self.assertEqual(item.members[0].text, "C(int a)")

    def test_TakesCommentsBehindMembers(self):
        _, (item,) = self.read(
            "/// One.\nstruct S {\n  double mass = 0;  ///< of the floor [kg]\n  std::function<void(int)> f;\n  double a = 1, b{};\n};"
        )
        self.assertEqual(
            [(member.kind, member.name, member.doc) for member in item.members],
            [("member", "S::mass", "of the floor [kg]"), ("member", "S::f", ""), ("member", "S::a", "")],
        )


if __name__ == "__main__":
    unittest.main()
