"""Classroom 50 runs this in a student's checkout. It lets the installed grader grade, and hands on the grader's result.json.

A grader that fails is an error of the infrastructure: this ends with a non-zero code and leaves no result.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

GRADER = os.environ.get("GRADER", "grader")
SEED = "@SEED@"
RESULT = Path("result.json")


def grade(submission):
    """The text of result.json. The grader reads from the environment whose submission this is."""
    # A runner on which submissions could reach files or the network grades nothing.
    subprocess.run([GRADER, "sandbox"], check=True)
    with tempfile.TemporaryDirectory() as out:
        command = [GRADER, "grade", str(submission), "--out", out, "--seed", SEED]
        subprocess.run(command, check=True)
        return (Path(out) / RESULT).read_text(encoding="utf-8")


def remove(place):
    """A submission may hold something of that name, which must never count."""
    if place.is_dir() and not place.is_symlink():
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)


def main():
    try:
        remove(RESULT)
        text = grade(Path.cwd())
    except FileNotFoundError as error:
        fail(f"{error}; is the grader there, and does CLASSROOM, ASSIGNMENT, … say whose submission this is?")
    except (OSError, subprocess.CalledProcessError, ValueError) as error:
        fail(repr(error))
    RESULT.write_text(text, encoding="utf-8")


def fail(reason):
    print(f"::error::the grader itself failed, this is no grade: {reason}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    main()
