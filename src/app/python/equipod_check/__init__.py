"""The program `equipod-check`, apart from the package `equipod`: it imports nothing of it, and none of its native code."""
