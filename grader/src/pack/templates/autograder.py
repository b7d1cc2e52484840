"""Classroom 50 runs this in a student's checkout. It lets the installed grader grade and translates the result.

Scores are whole numbers there, so they are hundredths of a point here.
A grader that fails is an error of the infrastructure: this ends with a non-zero code and writes no result.
"""

import datetime
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

GRADER = os.environ.get("GRADER", "grader")
SEED = "@SEED@"


def hundredths(points):
    return round(100 * points)


def grade(submission):
    with tempfile.TemporaryDirectory() as out:
        command = [GRADER, "grade", str(submission), "--out", out, "--seed", SEED]
        subprocess.run(command, check=True)
        return json.loads((Path(out) / "results.json").read_text(encoding="utf-8"))


def result(graded):
    tests = [
        {
            "test-name": test["name"],
            "passed": test["score"] >= test["max_score"],
            "score": hundredths(test["score"]),
            "max-score": hundredths(test["max_score"]),
            "output": test.get("output", ""),
        }
        for test in graded["tests"]
        if test.get("max_score")
    ]
    now = datetime.datetime.now(datetime.timezone.utc)
    return {
        "schema": "classroom50/result/v1",
        "classroom": os.environ["CLASSROOM"],
        "assignment": os.environ["ASSIGNMENT"],
        "submission": os.environ["SUBMISSION_TAG"],
        "commit": os.environ["COMMIT_URL"],
        "release": os.environ["RELEASE_URL"],
        "review": os.environ.get("REVIEW_URL") or os.environ["COMMIT_URL"],
        "datetime": now.strftime("%Y-%m-%dT%H:%M:%SZ"),
        "score": sum(test["score"] for test in tests),
        "max-score": sum(test["max-score"] for test in tests),
        "tests": tests,
    }


def main():
    place = Path("result.json")
    # A submission may hold a file of that name, which must never count.
    place.unlink(missing_ok=True)
    try:
        text = json.dumps(result(grade(Path.cwd())), indent=2)
    except (OSError, subprocess.CalledProcessError, KeyError, TypeError, ValueError) as error:
        print(f"::error::the grader itself failed, this is no grade: {error!r}", file=sys.stderr)
        sys.exit(1)
    place.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
