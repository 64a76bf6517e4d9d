"""Imports between modules of the package: no cycle, and results import no plotting."""

import ast
import unittest
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "python/pounding"


def names_of(package):
    """{module: file} of a package's folder, such as {"pounding.opensees": .../opensees/__init__.py}; for the compiled
    module its stub file."""
    files = {}
    for file in sorted([*package.rglob("*.py"), *package.glob("*.pyi")]):
        words = [package.name, *file.relative_to(package).with_suffix("").parts]
        files[".".join(words[:-1] if words[-1] == "__init__" else words)] = file
    return files


def imported(text, modules):
    """The modules among `modules` that a text imports anywhere: at its top, inside functions, for types, or by name, as
    in importlib.import_module("pounding._plots")."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "a relative import"
            inner = {f"{node.module}.{alias.name}" for alias in node.names}
            # `from pounding import _records` imports the module pounding._records, `from pounding.results import Link`
            # imports pounding.results.
            found |= inner & modules
            if not inner <= modules:
                found.add(node.module)
        elif isinstance(node, ast.Call):
            found |= {
                word.value for word in node.args if isinstance(word, ast.Constant) and isinstance(word.value, str)
            }
    return found & modules


def imports_of(package):
    """{module: imported modules of the package}."""
    files = names_of(package)
    return {name: imported(file.read_text(), set(files)) for name, file in files.items()}


def reached_from(module, imports):
    """Every module loaded with this one, including itself only in a cycle."""
    found, queue = set(), [module]
    while queue:
        for other in imports[queue.pop()] - found:
            found.add(other)
            queue.append(other)
    return found


def in_circles(imports):
    return {module for module in imports if module in reached_from(module, imports)}


#: Modules that users import; the names that start with an underscore are private.
PUBLIC = {"animation", "contact", "errors", "models", "opensees", "plan", "results", "studies", "view"}


class Imports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.imports = imports_of(PACKAGE)

    def test_there_is_no_circle(self):
        self.assertEqual(in_circles(self.imports), set())

    def test_public_modules_are_few_and_list_their_public_names(self):
        """At most ten, with the package and `pounding.studies.fragility`."""
        files = names_of(PACKAGE)
        public = {name for name in files if not any(part.startswith("_") for part in name.split("."))}
        self.assertEqual(public, {"pounding", *(f"pounding.{name}" for name in PUBLIC)})
        for name in public:
            found = [
                ast.literal_eval(node.value)
                for node in ast.parse(files[name].read_text()).body
                if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
            ]
            self.assertEqual(len(found), 1, name)
            self.assertEqual(found[0], sorted(found[0]), name)

    def test_results_know_no_picture(self):
        self.assertEqual(
            reached_from("pounding.results", self.imports),
            {
                "pounding._arguments",
                "pounding._checked_file",
                "pounding._comparison",
                "pounding._data",
                "pounding._envelopes",
                "pounding.errors",
                "pounding._outputs",
                "pounding._pictures.html",
                "pounding._springs",
                "pounding._structures",
                "pounding._texts",
                "pounding._printing",
            },
        )

    def test_a_table_for_a_notebook_needs_no_picture_and_no_file(self):
        self.assertEqual(reached_from("pounding._pictures.html", self.imports), set())

    def test_pictures_take_results_not_runs(self):
        for module in self.imports:
            if module.startswith("pounding._pictures") or module in (
                "pounding._plots",
                "pounding.animation",
                "pounding._export",
            ):
                self.assertFalse({"pounding._runs", "pounding._native"} & reached_from(module, self.imports), module)

    def test_every_import_is_seen(self):
        self.assertLessEqual(
            {"pounding.results", "pounding._tables", "pounding.animation", "pounding._pictures.figures"},
            self.imports["pounding._runs"],
        )
        self.assertIn("pounding.opensees", self.imports["pounding._opensees.from_model"])
        self.assertIn("pounding._mode_shapes", self.imports["pounding._modes"])


class Reader(unittest.TestCase):
    """Checks of the import reader of this test."""

    MODULES = {"p", "p.a", "p.b", "p.b.c"}

    def test_sees_imports_wherever_they_stand(self):
        for text in (
            "import p.a",
            "from p import a",
            "from p.a import x",
            "def f():\n    from p.a import x",
            "if TYPE_CHECKING:\n    from p.a import x",
            "load('numpy', 'p.a')",
        ):
            self.assertEqual(imported(text, self.MODULES), {"p.a"}, text)
        self.assertEqual(imported("from p.b import c, x\nimport numpy", self.MODULES), {"p.b", "p.b.c"})

    def test_sees_circles(self):
        self.assertEqual(in_circles({"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"a"}}), {"b", "c"})
        self.assertEqual(in_circles({"a": {"b", "c"}, "b": {"c"}, "c": set()}), set())


if __name__ == "__main__":
    unittest.main()
