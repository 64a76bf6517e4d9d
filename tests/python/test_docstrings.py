"""Docstrings of public names follow numpydoc, and their examples run."""

import doctest
import inspect
import os
import re
import tempfile
import unittest
from functools import cached_property
from importlib import import_module
from pathlib import Path

import pounding

ROOT = Path(os.environ["POUNDING_EXAMPLES"]).parent
SECTIONS = ("Parameters", "Attributes", "Returns", "Yields", "Raises", "Warns", "Examples")
HEADING = re.compile(r"(?m)^(\w[\w ]*)\n(-+)$")
MODULES = ("pounding", *(f"pounding.{name}" for name in pounding._PUBLIC_MODULES), "pounding._studies.fragility")


def public_objects():
    """{name: object} of all public classes and functions, and of the public members of classes."""
    found = {}
    for module in map(import_module, MODULES):
        for name in getattr(module, "__all__", ["fit"]):
            one = getattr(module, name)
            if inspect.isclass(one) and one.__module__.startswith("pounding"):
                found[f"{module.__name__}.{name}"] = one
                for base in one.__mro__:
                    if base.__module__.startswith("pounding"):
                        found |= {
                            f"{module.__name__}.{base.__name__}.{key}": value
                            for key, value in vars(base).items()
                            if not key.startswith("_")
                            if inspect.isroutine(value) or isinstance(value, (property, cached_property))
                        }
            elif inspect.isroutine(one):
                found[f"{module.__name__}.{name}"] = one
    return found


def sections_of(text):
    """{title: text} of the sections of a docstring."""
    parts = HEADING.split(inspect.cleandoc(text))
    return {parts[i]: parts[i + 2] for i in range(1, len(parts), 3)}


def faults_of(one):
    """What a docstring lacks."""
    text = inspect.cleandoc(one.__doc__ or "")
    sections = sections_of(text)
    if not text:
        yield "no docstring"
    for title, under in HEADING.findall(text):
        if title not in SECTIONS or len(title) != len(under):
            yield f"unknown section, or underline of another length: {title}"
    if list(sections) != sorted(sections, key=SECTIONS.index):
        yield f"order of the sections: {', '.join(sections)}"
    if re.search(r"\b[Rr]aises\b", text[: text.find("\nRaises\n---")] if "Raises" in sections else text):
        yield "errors outside of the section Raises"
    function = getattr(one, "__func__", one)
    if isinstance(one, (property, cached_property)) or not inspect.isroutine(function):
        return
    signature = inspect.signature(function)
    names = [
        {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**"}.get(each.kind, "") + each.name
        for each in signature.parameters.values()
    ]
    described = [
        name.strip()
        for line in re.findall(r"(?m)^(\*{0,2}\w[\w, ]*)(?: :.*)?$", sections.get("Parameters", ""))
        for name in line.split(",")
    ]
    if described != [name for name in names if name not in ("self", "cls")]:
        yield f"parameters {names}, and {described} are described"
    returns = signature.return_annotation
    if (returns not in (None, "None")) != bool({"Returns", "Yields"} & set(sections)):
        yield f"returns {returns}, and the sections are {', '.join(sections)}"


class Docstrings(unittest.TestCase):
    def test_follow_numpydoc(self):
        objects = public_objects()
        self.assertGreater(len(objects), 150)
        wrong = [f"{name}: {fault}" for name, one in objects.items() for fault in faults_of(one)]
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_functions_of_the_package_have_examples(self):
        missing = [
            name
            for name in pounding.__all__
            if inspect.isfunction(one := getattr(pounding, name)) and "Examples" not in sections_of(one.__doc__)
        ]
        self.assertEqual(missing, [])

    def test_faults_are_found(self):
        def good(a, *, b=1):
            """Adds.

            Parameters
            ----------
            a, b : int
                Numbers.

            Returns
            -------
            int
                The sum.
            """

        def bad(a):
            """Adds. Raises InputError.

            Returns
            -------
            int
                The sum.

            Parameters
            ---------
            b : int
                A number.
            """

        good.__annotations__["return"] = bad.__annotations__["return"] = int
        self.assertEqual(list(faults_of(good)), [])
        self.assertEqual(len(list(faults_of(bad))), 4)


class Examples(unittest.TestCase):
    def test_run(self):
        model = pounding.Model.from_file(ROOT / "examples/02_two_oscillators/model.yaml")
        model.analysis["duration"] = "1.5 s"
        names = {"pounding": pounding, "model": model, "results": pounding.run(model)}
        names["law"] = pounding.laws["hertz"](stiffness=1e9)
        self.addCleanup(os.chdir, os.getcwd())
        finder, runner = doctest.DocTestFinder(recurse=False), doctest.DocTestRunner(verbose=False)
        os.chdir(ROOT)
        with tempfile.TemporaryFile("w+") as said:
            for name, one in public_objects().items():
                one = getattr(one, "__func__", getattr(one, "func", one))
                for test in finder.find(one, name, module=False, globs=dict(names)):
                    runner.run(test, out=said.write)
            said.seek(0)
            self.assertEqual(runner.summarize(verbose=False).failed, 0, said.read())
        self.assertGreater(runner.tries, 30)


if __name__ == "__main__":
    unittest.main()
