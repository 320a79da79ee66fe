"""For studies that look for the cheapest settings below an error: elements by short names, fronts of (core-seconds, error)."""
import resource

ELEMENTS = {
    "Q1, one point": {"Element/Type": "one-point hexahedron", "Element/Degree": 1},
    "Q1, 2x2x2": {"Element/Type": "hexahedron", "Element/Degree": 1},
    "Q2": {"Element/Type": "spectral element", "Element/Degree": 2},
    "Q3": {"Element/Type": "spectral element", "Element/Degree": 3},
    "Q4": {"Element/Type": "spectral element", "Element/Degree": 4},
}


def front(rows):
    """The rows that no cheaper row beats, in ascending time."""
    result = []
    for row in sorted(rows, key=lambda row: row["core_seconds"]):
        if not result or row["error"] < result[-1]["error"]:
            result.append(row)
    return result


def cheapest(rows, error):
    """The cheapest row with at most this error, or None."""
    return min((row for row in rows if row["error"] <= error), key=lambda row: row["core_seconds"], default=None)


class ProcessorTime:
    """User and system time of the programs that were started inside a `with` block: .seconds"""

    @staticmethod
    def clock():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    def __enter__(self):
        self.start = self.clock()
        return self

    def __exit__(self, *_):
        self.seconds = self.clock() - self.start
