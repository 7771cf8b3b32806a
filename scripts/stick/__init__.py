"""Builds, writes and checks a memory stick for the robot. Problems are errors that the user can correct."""


class Problem(Exception):
    """What is wrong, then what to do about it, one line each. `setting` is the name of a wrong setting in a file."""

    def __init__(self, what, *advice, setting=None):
        super().__init__(what)
        self.advice = advice
        self.setting = setting

    def __str__(self):
        return "\n".join([self.args[0], *("  " + line for line in self.advice)])


class Problems(Exception):
    """Several problems, reported together."""

    def __init__(self, problems):
        super().__init__("\n".join(str(problem) for problem in problems))


def raise_any(problems):
    problems = list(problems)
    if problems:
        raise Problems(problems)
