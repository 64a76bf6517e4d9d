#!/usr/bin/env python3
"""Random rows of bodies, oscillators, yielding shear buildings and frames with hinges, all laws: every run ends,
balances its energy and prevents overlap.

    python3 tests/program/stress/stress.py build/pounding --seed 1 --count 100000 --jobs 2 --log seed1.jsonl --keep faults
    python3 tests/program/stress/stress.py build/pounding --seed 1 --family yielding --count 1000
    python3 tests/program/stress/stress.py build/python --seed 1 --count 100000 --jobs 2 --log seed1.jsonl --keep faults
    python3 tests/program/stress/stress.py build/pounding --seed 1 --print 494 > case.yaml
    python3 tests/program/stress/stress.py build/pounding --seed 1 --against-independent 200
    python3 tests/program/stress/stress.py build/pounding --seed 1 --against-other-integrator 200

Mass ratios from 1e-3 to 1e3, stiffness over six decades, restitutions 0.05 to 1, gaps from zero to wide, and the
contacts that are hard to integrate: bodies that graze, rest, or touch at (nearly) the same instant. A case is
identified by its seed and number. Failed cases are printed as input files, and the exit code is 1. With --log every
finished case is recorded, and the same command resumes after the recorded cases.

If the folder of the Python package is given instead of the program, cases run inside Python, which is cheaper than one
process per case.

A body pressed against another one by a rigid contact with restitution 1 bounces ever faster, and a run follows every
bounce. If such a case exceeds its time limit, it is checked up to its first few thousand impacts.

--against-independent compares impacts with the integrator of independent.py, which needs scipy;
--against-other-integrator compares those of esdirk4 and generalized_alpha.
"""

import argparse
import itertools
import json
import math
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # independent.py, judging.py
from stress_cases import BEYOND_INDEPENDENT, FAMILIES, SPREAD, bounces_of, case_of, input_file  # noqa: E402
from stress_checks import Run, faults_of, touches_in  # noqa: E402
from stress_in_memory import in_processes, package_run  # noqa: E402

#: Time limit of a run, and for its end after SIGTERM [s].
SECONDS, TO_END = 60, 30

#: Tolerance of these comparisons, and time limit of the independent integrator [s].
FINE, LONGEST = 1e-6, 10
#: Tolerance at which the integrators are compared.
COARSE = 1e-4


def program_run(program, case, folder, *options):
    """(run, message): the run is None if the program fails, with the reason."""
    model, results = Path(folder) / "model.yaml", Path(folder) / "results.h5"
    model.write_text(input_file(case))
    with subprocess.Popen(
        [program, "run", model, "-o", results, "--json", *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as running:
        try:
            told, errors = running.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            running.terminate()
            try:
                running.communicate(timeout=TO_END)
            except subprocess.TimeoutExpired:
                running.kill()
                return None, f"it took more than {SECONDS} s, and SIGTERM did not end it"
            shorter = bounces_of(case, touches_in(results))
            return (
                program_run(program, shorter, folder, *options) if shorter else (None, f"it took more than {SECONDS} s")
            )
    if running.returncode != 0:
        return None, f"exit code {running.returncode}: {errors}"
    return Run(case, results, json.loads(told)), None


def examine(task):
    """One case: its faults and its cost."""
    program, seed, number, family = task
    case, begin = case_of(seed, number, family), time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        run, message = (
            package_run(program, case, folder, SECONDS)
            if Path(program).is_dir()
            else program_run(program, case, folder)
        )
        outcome = {
            "number": number,
            "family": case["family"],
            "seconds": time.perf_counter() - begin,
            "text": input_file(case),
        }
        if message:
            return outcome | {"faults": [message]}
        if run.case["duration"] < case["duration"]:
            outcome |= {"judged_until": run.case["duration"]}
        return outcome | {
            "faults": list(faults_of(run)),
            "impacts": run.impacts,
            "steps": run.steps,
            "imbalance": run.imbalance / case["tolerance"],
        }


def progress(text):
    if sys.stderr.isatty():
        print(f"\r{text}", end="", file=sys.stderr)


def report(outcome, kept):
    print(f"case {outcome['number']} ({outcome['family']}):")
    for fault in outcome["faults"][:5]:
        print(f"  {fault.strip()}")
    print(outcome["text"], flush=True)
    if kept:
        kept.mkdir(parents=True, exist_ok=True)
        lines = "".join(f"# {line}\n" for fault in outcome["faults"] for line in fault.strip().splitlines())
        (kept / f"case{outcome['number']}.yaml").write_text(lines + outcome["text"])


def logged(path):
    """Outcomes in a log, by case number; truncated lines are ignored."""
    outcomes = {}
    if path and path.exists():
        for line in path.read_text().splitlines():
            try:
                outcome = json.loads(line)
            except json.JSONDecodeError:
                continue
            outcomes[outcome["number"]] = outcome
    return outcomes


def examined(chosen, numbers):
    """Outcomes of cases as they finish, each recorded in the log."""
    tasks = [(chosen.program, chosen.seed, number, chosen.family) for number in numbers]
    with open(chosen.log or os.devnull, "a", encoding="utf-8") as log:
        for outcome in in_processes(examine, tasks, chosen.jobs):
            log.write(json.dumps(outcome if outcome["faults"] else outcome | {"text": ""}) + "\n")
            log.flush()
            yield outcome


def stress(chosen):
    wanted = range(chosen.first, chosen.first + chosen.count)
    earlier = {number: outcome for number, outcome in logged(chosen.log).items() if number in wanted}
    impacts = steps = faults = done = bouncing = 0
    slowest, worst, families = (0.0, -1), (0.0, -1), Counter()
    begin = time.perf_counter()
    new = examined(chosen, [number for number in wanted if number not in earlier])
    for outcome in itertools.chain(earlier.values(), new):
        done += 1
        families[outcome["family"]] += 1
        impacts += outcome.get("impacts", 0)
        steps += outcome.get("steps", 0)
        bouncing += "judged_until" in outcome
        slowest = max(slowest, (outcome["seconds"], outcome["number"]))
        worst = max(worst, (outcome.get("imbalance", 0.0), outcome["number"]))
        if outcome["faults"]:
            faults += 1
            report(outcome, chosen.keep)
        progress(f"{done} of {chosen.count}, {faults} faults")
    progress("\n")
    print(
        f"{chosen.count} cases ({', '.join(f'{n} {name}' for name, n in families.items())}), {impacts} impacts, {steps} steps, "
        f"{time.perf_counter() - begin:.0f} s, {len(earlier)} cases from the log"
    )
    print(f"slowest case {slowest[1]}: {slowest[0]:.2f} s; worst imbalance, case {worst[1]}: {worst[0]:.3g} tolerances")
    if bouncing:
        print(f"{bouncing} cases bounce endlessly without loss: checked up to a few thousand impacts")
    print(f"{faults} faults")
    return faults


def first_impacts(run):
    """(start, link, peak force or impulse, separation speed) of all impacts, in order of time."""
    found = []
    for index, rows in enumerate(run.rows):
        for row in rows:
            peak = row["impulse"] if run.case["links"][index]["law"] == "stereomechanical" else row["peak_force"]
            found.append((row["t_start"], index, peak, row["v_separation"]))
    return sorted(found)


def differences(run, other):
    """Differences of the peak and the separation of each impact in two runs, in tolerances; infinite if the impacts do
    not match."""
    mine, theirs = first_impacts(run), first_impacts(other)
    peaks = [max((peak for _, index, peak, _ in mine if index == k), default=0.0) for k in range(len(run.rows))]
    for (start, index, peak, speed), (there, where, found, speed_there) in itertools.zip_longest(
        mine, theirs, fillvalue=(math.inf, -1, 0.0, 0.0)
    ):
        if index != where or abs(start - there) > 1e-3 * run.case["duration"]:
            yield math.inf
            return
        if math.isnan(speed) or math.isnan(speed_there):
            return  # pressed until the end
        yield (
            max(abs(peak - found) / peaks[index] if peaks[index] else 0.0, abs(speed - speed_there) / run.speed)
            / run.tolerance
        )


def integrate_one(task):
    """One case by both integrators: (number, impacts compared, text, message). Differences from esdirk4 at a tenth of
    the tolerance are amplified by the motion and are ignored."""
    program, seed, number = task
    case = case_of(seed, number) | {"tolerance": COARSE}
    case["duration"] = min(case["duration"], 1.0)
    text = input_file(case)
    runs = []
    for tolerance, *options in (
        (COARSE,),
        (COARSE / 10,),
        (COARSE, "-pounding_ts_pounding_scheme", "generalized_alpha"),
    ):
        with tempfile.TemporaryDirectory() as folder:
            run, message = program_run(program, case | {"tolerance": tolerance}, folder, *options)
        if message:
            return number, 0, text, f"{' '.join(map(str, (tolerance, *options)))}: {message}"
        runs.append(run)
    compared = 0
    for amplified, off in zip(differences(runs[0], runs[1]), differences(runs[0], runs[2])):
        if amplified > 1:
            break
        compared += 1
        if off > SPREAD:
            return number, compared, text, f"impact {compared}: the integrators differ by {off:.3g} tolerances"
    return number, compared, text, None


def compare_integrators(chosen):
    """Runs cases by both integrators and returns the number of faults."""
    faults = compared = 0
    tasks = [
        (chosen.program, chosen.seed, number)
        for number in range(chosen.first, chosen.first + chosen.against_other_integrator)
    ]
    with multiprocessing.Pool(chosen.jobs) as pool:
        for number, impacts, text, message in pool.imap_unordered(integrate_one, tasks):
            compared += impacts
            if message:
                faults += 1
                report({"number": number, "family": "both integrators", "faults": [message], "text": text}, chosen.keep)
    print(f"{len(tasks)} cases at tolerance {COARSE} by both integrators, {compared} impacts compared\n{faults} faults")
    return faults


def compare_one(task):
    """One case against independent.py: (number, verdict, text, message)."""
    from independent import TooLong
    from judging import judge

    program, seed, number = task
    case = case_of(seed, number) | {"tolerance": FINE}
    if case["family"] in BEYOND_INDEPENDENT:
        return number, None, "", None
    text = input_file(case)
    with tempfile.TemporaryDirectory() as folder:
        run, message = program_run(program, case, folder)
    if message:
        return number, None, text, message
    try:
        return number, judge(case, run.rows, LONGEST), text, None
    except TooLong:
        return number, None, text, None


def compare(chosen):
    """One case against independent.py: (number, verdict, text, message)."""
    wanted, verdicts, faults, skipped = chosen.against_independent, Counter(), 0, 0
    compared, present = Counter(), Counter()
    tasks = ((chosen.program, chosen.seed, number) for number in range(chosen.first, chosen.first + 100 * wanted))
    with multiprocessing.Pool(chosen.jobs) as pool:
        for number, verdict, text, message in pool.imap(compare_one, tasks):
            if verdict is None and message is None:
                skipped += 1
                continue
            agreed = verdict.agreed if verdict else "no results"
            verdicts[agreed] += 1
            if verdict:
                compared[agreed] += verdict.compared
                present[agreed] += verdict.impacts
            if agreed in ("no", "no results"):
                faults += 1
                report(
                    {
                        "number": number,
                        "family": "against independent",
                        "faults": [message or verdict.why],
                        "text": text,
                    },
                    chosen.keep,
                )
            progress(f"{verdicts.total()} of {wanted}, {faults} faults")
            if verdicts.total() == wanted:
                pool.terminate()
                break
    progress("\n")
    print(
        f"{wanted} cases at tolerance {FINE} against the independent integrator; {skipped} more took it over {LONGEST} s"
    )
    for agreed, count in verdicts.most_common():
        print(f"  {agreed}: {count} cases, {compared[agreed]} of {present[agreed]} impacts compared")
    print(f"{faults} faults")
    return faults


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("program", help="the program, or the folder of the Python package")
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--count", type=int, default=10000)
    words.add_argument("--first", type=int, default=0, help="number of the first case")
    words.add_argument("--family", choices=[family.__name__ for family in FAMILIES], help="only cases of this family")
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--keep", type=Path, metavar="FOLDER", help="folder for the input files of failed cases")
    words.add_argument(
        "--log", type=Path, metavar="FILE", help="record finished cases in this file, and skip those already recorded"
    )
    words.add_argument("--print", type=int, metavar="NUMBER", help="print this case as an input file and exit")
    words.add_argument(
        "--against-other-integrator", type=int, metavar="COUNT", help="run this number of cases by both integrators"
    )
    words.add_argument(
        "--against-independent", type=int, metavar="COUNT", help="compare this number of cases with independent.py"
    )
    chosen = words.parse_args()
    if chosen.print is not None:
        print(input_file(case_of(chosen.seed, chosen.print, chosen.family)), end="")
        return
    task = (
        compare_integrators
        if chosen.against_other_integrator is not None
        else stress
        if chosen.against_independent is None
        else compare
    )
    sys.exit(1 if task(chosen) else 0)


if __name__ == "__main__":
    main()
