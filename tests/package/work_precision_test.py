"""Work and precision in tests/bench: the command in a short form, whether README.md still shows what the
command runs, and the agreement of `event` with solvers that share no code with it."""

import csv
import sys
import unittest

from product import BUILD, SOURCE

sys.path.insert(0, str(SOURCE / "tests/bench"))
import numpy as np  # noqa: E402
import work_precision  # noqa: E402
from exponential_gauss import lagrange  # noqa: E402


class WorkPrecision(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.short = work_precision.SHORT
        cls.measured = work_precision.measure(BUILD / "bin/rotorub", **cls.short)

    def test_event_agrees_with_the_reference_of_another_solver(self):
        for name in self.short["names"]:
            self.assertLess(self.measured[name, "difference"], 1e-11, name)

    def test_each_method_needs_more_work_for_less_error(self):
        for name in self.short["names"]:
            for method in ("`event`", *self.short["methods"]):
                (_, _, work, error), (_, _, more, less) = self.measured[name, method]
                self.assertLess(work, more, f"{name}: {method}")
                self.assertLess(less, error, f"{name}: {method}")
            self.assertLess(self.measured[name, "DOP853"][-1][-1], 1e-7, name)

    def test_the_readme_shows_each_problem_and_method(self):
        lines = (SOURCE / "tests/bench/README.md").read_text().splitlines()
        at = lines.index(f"| | {' | '.join(work_precision.METHODS)} | `event` off the reference |")
        shown = [line.split(" | ")[0].removeprefix("| ") for line in lines[at + 2:at + 2 + len(work_precision.PROBLEMS)]]
        self.assertEqual(shown, list(work_precision.PROBLEMS))
        with open(SOURCE / "tests/bench/work_precision.csv", newline="") as file:
            kept = {(row["problem"], row["method"]) for row in csv.DictReader(file)}
        methods = ("event", *work_precision.METHODS)
        asked = {(problem, method) for problem in work_precision.PROBLEMS for method in methods}
        self.assertEqual(asked - kept, {("compliant_ring, 1000 times as stiff", "exponential, fixed J")})

    def test_the_work_for_an_error_lies_between_the_rows(self):
        rows = [(1e-6, 10, 100, 1e-6), (1e-8, 20, 400, 1e-8)]
        self.assertAlmostEqual(work_precision.work_for(rows, 1e-7), 200.0)
        self.assertIsNone(work_precision.work_for(rows, 1e-9))

    def test_lagrange_polynomials_are_one_at_their_node(self):
        nodes = np.array([0.1, 0.4, 0.9])
        self.assertTrue(np.allclose(lagrange(nodes, nodes), np.eye(3)))
        self.assertTrue(np.allclose(lagrange(nodes, 0.7) @ nodes**2, 0.49))

    def test_calls_of_a_function_are_added_up(self):
        text = "fn=(1) main\ncfn=(2) a::f(int)\ncalls=3 0\n1 2\ncfn=(3) a::g()\ncalls=5 0\ncfn=(2)\ncalls=4 0\n"
        self.assertEqual(work_precision.calls(text, "a::f"), 7)


if __name__ == "__main__":
    unittest.main()
