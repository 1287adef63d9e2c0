# Every force that was added to an object between two tools, computed once more from what
#   palpa export out/A/session.palpa --out ticks.csv
# writes of a session of palpa squeeze: Jeon, Choi and Harders (2015), (10.11) to (10.14).
#   python3 docs/check_ticks.py ticks.csv
import csv, json, sys

laws = json.load(open(sys.argv[1].replace(".csv", ".laws.json")))
places = laws["X_DP"]  # of the object in each device's base

def turned(q, v):  # by the unit quaternion q = w, x, y, z
    w, (x, y, z) = q[0], q[1:]
    t = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    u = y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]
    return [a + w * b + c for a, b, c in zip(v, t, u)]

def back(q, v):
    return turned([q[0], -q[1], -q[2], -q[3]], v)

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))

def minus(a, b):
    return [x - y for x, y in zip(a, b)]

def of(row, name, unit):
    return [float(row[f"{name}_{axis}_{unit}"]) for axis in "xyz"]

def added(rows):  # N, by the two devices, each in its own frame
    turns = [X["q_wxyz"] for X in places]
    p = [back(q, minus(of(r, "p_sensed_D", "m"), X["p_m"])) for q, r, X in zip(turns, rows, places)]
    f = [back(q, of(r, "f_sensed_D", "N")) for q, r in zip(turns, rows)]
    between = minus(*p)
    l = [x / dot(between, between) ** 0.5 for x in between]
    F = max(0, dot(minus(*f), l) / 2)  # (10.12) to (10.14)
    harder, heavier = (float(rows[0]["squeeze_" + what]) - 1 for what in ("stiffness", "weight"))
    sides = l, [-x for x in l]
    return [turned(q, [harder * F * u + heavier * (x - F * u) for u, x in zip(side, force)])
            for q, side, force in zip(turns, sides, f)]  # (10.11)

worst, ticks, first = 0, 0, None
for row in csv.DictReader(open(sys.argv[1])):
    pair, first = (first, row), row
    if row["tool"] == "0" or row["armed"] == "0":
        continue
    touching = [dot(*2 * [of(r, "f_sensed_D", "N")]) ** 0.5 for r in pair]
    if min(touching) < laws["squeeze"]["least_contact_N"]:
        continue
    ticks += 1
    for r, f in zip(pair, added(pair)):
        off = minus(f, of(r, "f_contact_D", "N"))
        worst = max(worst, dot(off, off) ** 0.5)
print(f"{ticks} ticks, at most {1000 * worst:.6f} mN off")
