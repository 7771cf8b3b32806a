"""What the user can mend."""


class Problem(Exception):
    """What is wrong, and what to do about it, a line each."""

    def __init__(self, what, *advice):
        super().__init__(what)
        self.advice = advice

    def __str__(self):
        return "\n".join([self.args[0], *("  " + line for line in self.advice)])


class Problems(Exception):
    """Several at once, so that the user need not find them one by one."""

    def __init__(self, problems):
        super().__init__("\n".join(str(problem) for problem in problems))


def raise_any(problems):
    """Raises Problems if there are any."""
    problems = list(problems)
    if problems:
        raise Problems(problems)
