"""The types in __init__.pyi against what is there: names, parameters, defaults, options; and that
everything says what it is."""
import ast
import inspect
import itertools
import os
import unittest

import tetstream
from tetstream import _options, core

STUB = os.path.join(os.path.dirname(tetstream.__file__), "__init__.pyi")


def bare(name):
    """Parameters that are given by their place alone are written with two underscores there."""
    return name.removeprefix("__")


def written(function):
    """Names of the parameters in the stub, and which have a default."""
    a = function.args
    plain = a.posonlyargs + a.args
    optional = {arg.arg for arg in plain[len(plain) - len(a.defaults):]} if a.defaults else set()
    optional |= {arg.arg for arg, default in zip(a.kwonlyargs, a.kw_defaults) if default}
    more = [a.kwarg.arg] if a.kwarg else []
    return ([bare(arg.arg) for arg in plain + a.kwonlyargs] + more,
            {bare(name) for name in optional})


def found(function):
    parameters = list(inspect.signature(function).parameters.values())
    return ([p.name for p in parameters], {p.name for p in parameters if p.default is not p.empty})


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(STUB, encoding="utf-8") as file:
            cls.nodes = {node.name: node for node in ast.parse(file.read()).body
                         if isinstance(node, (ast.ClassDef, ast.FunctionDef))}

    def test_every_name_is_in_both(self):
        public = {name for name in self.nodes if not name.startswith("_")}
        self.assertEqual(public, set(tetstream.__all__))

    def test_parameters_are_those_of_the_functions(self):
        for name, node in self.nodes.items():
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(written(node), found(getattr(tetstream, name)), name)

    def test_methods_are_those_of_the_classes(self):
        for name, node in self.nodes.items():
            if not isinstance(node, ast.ClassDef) or name.startswith("_"):
                continue
            kind = getattr(tetstream, name)
            for method in node.body:
                if not isinstance(method, ast.FunctionDef) or method.name == "__getattr__":
                    continue
                there = vars(kind)[method.name]
                if isinstance(there, property):
                    continue
                if isinstance(there, classmethod):
                    there = there.__func__
                with self.subTest(f"{name}.{method.name}"):
                    if name != "Mesh" or method.name != "simplify":  # which passes everything on
                        self.assertEqual(written(method), found(there))
            bases = {base.id for base in node.bases if isinstance(base, ast.Name)}
            self.assertLessEqual(bases, {base.__name__ for base in kind.__mro__}, name)

    def test_options_are_those_of_the_table(self):
        def members(name):
            return {item.target.id for item in self.nodes[name].body
                    if isinstance(item, ast.AnnAssign)}
        reading = members("_Reading")
        ordering = reading | members("_Ordering")
        simplifying = ordering | members("_Simplifying") | members("_SimplifyingRegions")
        comparing = reading | members("_Comparing")
        for scope, names in ((core.SCOPE_READ, reading), (core.SCOPE_ORDER, ordering),
                             (core.SCOPE_SIMPLIFY, simplifying), (core.SCOPE_COMPARE, comparing)):
            self.assertEqual(names, {name for name, row in _options.ROWS.items()
                                     if row.scope & (scope | core.SCOPE_READ)}, scope)
        self.assertEqual(simplifying | comparing, set(_options.ROWS))
        self.assertEqual(members("Options"), set(_options.ROWS))
        for item in itertools.chain.from_iterable(
                self.nodes[name].body for name in ("_Reading", "_Ordering", "_Simplifying")):
            row = _options.ROWS[item.target.id]
            kinds = (core.OPTION_IS_INT64, core.OPTION_IS_DOUBLE)  # 1e6 is an integer, too
            type_text = ast.unparse(item.annotation)
            if row.type in kinds:
                self.assertEqual(type_text, "float | str", row.name)
            elif type_text != "str":
                if row.name == "step":
                    self.assertEqual(type_text, "str | int")
                    continue
                choices = ", ".join(map(repr, row.choices.split()))
                more = " | bool" if row.choices == "no yes" else ""
                self.assertEqual(type_text, f"Literal[{choices}]{more}", row.name)

    def test_figures_that_have_a_type_are_there(self):
        mesh = tetstream.read(tetstream.Reader.generate("ball", 100))
        result = mesh.simplify(ratio=0.5)
        there = {"Report": result.report, "Diagram": tetstream.diagram(mesh),
                 "Comparison": tetstream.compare(mesh, result), "StreamInfo": tetstream.info(mesh),
                 "LayoutReport": tetstream.layout(mesh, tetstream.Writer.memory("tets")),
                 "Simplified": result, "Mesh": mesh, "Batch": tetstream.Batch()}
        for name, value in there.items():
            told = {item.target.id for item in self.nodes[name].body
                    if isinstance(item, ast.AnnAssign)}
            for member in told:
                self.assertTrue(hasattr(value, member), f"{name}.{member}")
            if isinstance(value, tetstream.Record):
                self.assertEqual(told, {member for member in vars(value) if member[0] != "_"}, name)

    def test_everything_says_what_it_is(self):
        for name in tetstream.__all__:
            thing = getattr(tetstream, name)
            self.assertTrue((thing.__doc__ or "").strip(), name)
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                if not member.startswith("_") and callable(getattr(thing, member)):
                    self.assertTrue(getattr(thing, member).__doc__, f"{name}.{member}")

    def test_it_is_marked_as_typed(self):
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(STUB), "py.typed")))


if __name__ == "__main__":
    unittest.main()
