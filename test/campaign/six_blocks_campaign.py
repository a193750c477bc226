#!/usr/bin/python3
"""Random starts of the six-block scene, simulated and judged by the checker.

    six_blocks_campaign.py --simulate build/simulate --checker build/checker [--starts 20] [--jobs 2] [--gravity 3]

Six blocks of 1 x 3 m and 1 kg in a box of 12 x 12 m, at random places that do not overlap, with random
velocities: for every gravity and elasticity, 20 s each. A run is stuck when it has not reached its end within
the limit of CPU time or was not exact throughout. The same options give the same starts on every machine.
Exit status: 0 nothing wrong, 1 something, 2 cannot run.
"""
import argparse
import concurrent.futures
import math
import os
import random
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

GRAVITIES = [0.0, 3.0, 9.8]
ELASTICITIES = [0.0, 0.2, 0.5, 0.8, 0.95, 0.99, 1.0]
WALL = 6.0
HALF = (0.5, 1.5)
# Starts keep this much apart, so that no run begins with a contact by chance.
GAP = 0.05


def corners(pose, grow=0.0):
    x, y, angle = pose
    c, s = math.cos(angle), math.sin(angle)
    w, h = HALF[0] + grow, HALF[1] + grow
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in ((-w, -h), (w, -h), (w, h), (-w, h))]


def apart(p, q):
    """Separating axes of two rectangles, the first one grown by the gap."""
    a, b = corners(p, GAP), corners(q)
    for angle in (p[2], q[2]):
        for turn in (0.0, math.pi / 2):
            nx, ny = math.cos(angle + turn), math.sin(angle + turn)
            along_a = [nx * x + ny * y for x, y in a]
            along_b = [nx * x + ny * y for x, y in b]
            if min(along_a) > max(along_b) or min(along_b) > max(along_a):
                return True
    return False


def random_poses(dice):
    poses = []
    while len(poses) < 6:
        pose = (dice.uniform(-WALL, WALL), dice.uniform(-WALL, WALL), dice.uniform(-math.pi, math.pi))
        inside = all(abs(value) < WALL for corner in corners(pose, GAP) for value in corner)
        if inside and all(apart(pose, other) for other in poses):
            poses.append(pose)
    return poses


def scene(gravity, elasticity, start):
    """The text of one start; the start's number alone decides the poses and velocities."""
    dice = random.Random(start)
    lines = [f"gravity: {gravity!r}", f"elasticity: {elasticity!r}",
             f"walls: {{left: {-WALL}, right: {WALL}, bottom: {-WALL}, top: {WALL}}}", "blocks:"]
    for number, pose in enumerate(random_poses(dice), 1):
        speed, heading, spin = dice.uniform(0.0, 1.0), dice.uniform(-math.pi, math.pi), dice.uniform(-0.5, 0.5)
        velocity = (speed * math.cos(heading), speed * math.sin(heading), spin)
        lines.append(f"  - {{name: block{number}, size: [1.0, 3.0], pose: {list(pose)}, velocity: {list(velocity)}}}")
    return "\n".join(lines) + "\n"


def limit_cpu(seconds):
    def apply():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
    return apply


def run_one(options, gravity, elasticity, start):
    """Simulates and judges one start. Returns a dictionary of what the table needs."""
    result = dict(gravity=gravity, elasticity=elasticity, start=start, stuck=None, failed=[], cpu_ms=None, events=None,
                  overlap=None, drift=None, unjudged=None)
    folder = tempfile.mkdtemp(prefix="campaign_", dir=options.work)
    path = lambda name: os.path.join(folder, name)
    with open(path("scene.yaml"), "w") as file:
        file.write(scene(gravity, elasticity, start))
    files = ["--states", path("states.csv"), "--energy", path("energy.csv"), "--contacts", path("contacts.csv")]
    result["command"] = [options.simulate, path("scene.yaml"), "--duration", str(options.duration), "--sample", "0.001"]
    result["command"] += files
    with open(path("log"), "w") as log:
        done = subprocess.run(result["command"], stdout=subprocess.DEVNULL, stderr=log,
                              preexec_fn=limit_cpu(options.cpu))
    read_summary(path("log"), done.returncode, options, result)
    if result["stuck"] is None:
        judge(options, path, files, result)
    for name in ("states.csv", "energy.csv", "contacts.csv"):
        if os.path.exists(path(name)):
            os.remove(path(name))
    if result["stuck"] is None and not result["failed"]:
        shutil.rmtree(folder)
    return result


def read_summary(log, status, options, result):
    with open(log) as file:
        lines = re.findall(r"^summary: .*$", file.read(), re.MULTILINE)
    fields = dict(re.findall(r"(\w+)=(\S+)", lines[-1])) if lines else {}
    if status != 0 or not fields:
        ended = f"status {status}" if status >= 0 else f"signal {-status}"
        result["stuck"] = f"{ended}, not done within {options.cpu} s of CPU time"
    elif fields.get("mode") != "exact":
        result["stuck"] = "mode " + fields.get("mode", "missing")
    elif float(fields["simulated_s"]) < options.duration:
        result["stuck"] = "stopped at " + fields["simulated_s"]
    if fields:
        result["cpu_ms"], result["events"] = float(fields["engine_cpu_ms"]), int(fields["events"])


def judge(options, path, files, result):
    result["check"] = [options.checker, path("scene.yaml")] + files + ["--summary", path("log")]
    done = subprocess.run(result["check"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                          preexec_fn=limit_cpu(options.cpu))
    with open(path("report"), "w") as file:
        file.write(done.stdout)
    rows = {}
    for line in done.stdout.splitlines():
        columns = line.split(None, 6)
        if len(columns) > 5 and columns[0] in ("ok", "FAILED"):
            rows[columns[1]] = float(columns[4])
            if columns[0] == "FAILED":
                result["failed"].append(columns[1])
    if done.returncode != 0 and not result["failed"]:
        result["failed"].append(f"checker status {done.returncode}")
    result["overlap"] = max(rows.get("overlap.samples", 0.0), rows.get("overlap.impacts", 0.0))
    result["drift"] = rows.get("energy.conserved")
    result["unjudged"] = rows.get("coverage.unjudged")


def print_table(results):
    print("gravity elasticity  runs stuck failed   overlap   |E-E0|/E0  unjudged       cpu ms: median, max       "
          "events: median, max")
    for case in sorted({(r["gravity"], r["elasticity"]) for r in results}):
        rows = [r for r in results if (r["gravity"], r["elasticity"]) == case]
        worst = {key: max(known(rows, key)) for key in ("overlap", "drift", "unjudged", "cpu_ms", "events")}
        middle = {key: statistics.median(known(rows, key)) for key in ("cpu_ms", "events")}
        stuck, failed = sum(r["stuck"] is not None for r in rows), sum(bool(r["failed"]) for r in rows)
        drift = f"{worst['drift']:11.2e}" if case[1] == 1.0 else " " * 10 + "-"
        print(f"{case[0]:7g} {case[1]:10g} {len(rows):5d} {stuck:5d} {failed:6d} {worst['overlap']:9.2e} {drift} "
              f"{worst['unjudged']:9.3f} {middle['cpu_ms']:15.1f} {worst['cpu_ms']:9.1f} "
              f"{middle['events']:14.0f} {worst['events']:9.0f}")


def known(rows, key):
    return [r[key] for r in rows if r[key] is not None] or [float("nan")]


def print_failures(results):
    for r in results:
        if r["stuck"] is None and not r["failed"]:
            continue
        what = "stuck: " + r["stuck"] if r["stuck"] else "failed: " + ", ".join(r["failed"])
        print(f"\ngravity {r['gravity']:g} elasticity {r['elasticity']:g} start {r['start']}: {what}")
        print("  " + " ".join(r["command"]) + "".join(" &&\n  " + " ".join(r[key]) for key in ("check",) if key in r))


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--simulate", required=True, help="the program simulate")
    parser.add_argument("--checker", required=True, help="the program checker")
    parser.add_argument("--starts", type=int, default=20, help="random starts for each gravity and elasticity")
    parser.add_argument("--first", type=int, default=1, help="number of the first start")
    parser.add_argument("--gravity", type=float, nargs="*", default=GRAVITIES)
    parser.add_argument("--elasticity", type=float, nargs="*", default=ELASTICITIES)
    parser.add_argument("--duration", type=float, default=20.0, help="s of simulated time")
    parser.add_argument("--cpu", type=int, default=60, help="limit of CPU time for each run, s")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--work", default=tempfile.gettempdir(), help="where the scenes of failing runs stay")
    return parser.parse_args()


def main():
    options = parse_options()
    for program in (options.simulate, options.checker):
        if not os.access(program, os.X_OK):
            print(f"six_blocks_campaign: {program} is no program", file=sys.stderr)
            return 2
    options.work = os.path.abspath(options.work)
    options.simulate, options.checker = os.path.abspath(options.simulate), os.path.abspath(options.checker)
    jobs = [(gravity, elasticity, start) for gravity in options.gravity for elasticity in options.elasticity
            for start in range(options.first, options.first + options.starts)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda job: run_one(options, *job), jobs))
    print_table(results)
    print_failures(results)
    bad = sum(r["stuck"] is not None or bool(r["failed"]) for r in results)
    print(f"\n{len(results) - bad} runs passed, {bad} failed")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
