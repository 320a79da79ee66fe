"""Numbers of a reference module against numbers that were found in another way; needs the standard library alone.

    if __name__ == "__main__":
        checks.compare([("shock velocity [m/s]", shock.speed, 2220, 1e-12), ...])      # name, computed, stated, relative tolerance

prints one line per number and ends with code 1 if one is off. Zero is compared absolutely.
"""
import sys


def compare(rows):
    wrong = 0
    for name, computed, stated, tolerance in rows:
        off = abs(computed - stated) / (abs(stated) or 1.)
        good = off <= tolerance  # false for NaN
        wrong += not good
        print(f"{'ok' if good else 'NO':3} {name}: {computed:.10g}, stated {stated:.10g}, off by {off:.1e} of {tolerance:.0e}")
    print(f"{len(rows) - wrong} of {len(rows)} agree")
    sys.exit(bool(wrong))


def digits(stated, n):
    """Tolerance of a number that was given with n significant digits: one unit of the last."""
    from math import floor, log10
    return 10. ** (floor(log10(abs(stated))) - n + 1) / abs(stated)
