"""A reconstruction, for the scripts that make tables of many."""

import json
import os
import subprocess


def reconstruct(umbrella, points, report, extra, timeout):
    """Writes the report to a file.

    The report, None after the timeout or a failure; and seconds of processor
    time.
    """
    report.unlink(missing_ok=True)
    command = [umbrella, "reconstruct", str(points), "--quiet", "--report",
               str(report), *extra]
    before = os.times()
    try:
        subprocess.run(command, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        pass
    after = os.times()
    seconds = (after.children_user - before.children_user +
               after.children_system - before.children_system)
    found = json.loads(report.read_text()) if report.exists() else None
    return found, seconds
