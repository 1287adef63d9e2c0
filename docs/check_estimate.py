# Every force of a finger without a force sensor, estimated once more from what
#   palpa export out/A/session.palpa --out ticks.csv
# writes of a session of palpa palpation --tools 2 --second finger.
#   python3 docs/check_estimate.py ticks.csv
import csv, json, math, sys

laws = json.load(open(sys.argv[1].replace(".csv", ".laws.json")))
known, surface = laws["estimated"], laws["surface"]
H, rubs, x0 = surface["H"], surface["friction"], surface["x0_m"]
least, radius, dt = surface["least_contact_N"], laws["tip_radius_m"], laws["period_s"]
opposed = known["face"] == "opposed"

def turned(q, v):  # by the unit quaternion q = w, x, y, z
    w, (x, y, z) = q[0], q[1:]
    t = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    u = y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]
    return [a + w * b + c for a, b, c in zip(v, t, u)]

def inward(X, v):  # from a device's base into P, turned only
    q = X["q_wxyz"]
    return turned([q[0], -q[1], -q[2], -q[3]], v)

def of(row, name, unit):
    return [float(row[f"{name}_{axis}_{unit}"]) for axis in "xyz"]

def force(x):
    return H["k"] * x ** H["m"] if x > 0 else 0

def place(X, p):
    return inward(X, [a - b for a, b in zip(p, X["p_m"])])

def weight(x):  # of one tick's word about where the face lies
    x = max(x - x0, 0)
    rise = max(H["k"] * H["m"] * x ** (H["m"] - 1), 1)
    return 1 / ((known["force_doubt_N"] / rise) ** 2 + (known["depth_doubt"] * x) ** 2)

class Finger:
    def __init__(self):
        self.level, self.precision = 0, 1 / known["placed_within_m"] ** 2
        self.p, self.drag = None, [0, 0]

    def feel(self, p_first, f_first, p):  # N, in P
        share = dt / (known["smooth_s"] + dt) if self.p else 1
        before = self.p or p
        self.p = [a + share * (b - a) for a, b in zip(before, p)]
        lowest, touches = p_first[2] - radius, f_first[2] >= least
        x_first = max(0, x0 + (f_first[2] / H["k"]) ** (1 / H["m"])) if touches else 0
        if opposed:
            x = known["thickness_m"] + self.p[2] + radius - (lowest + x_first if touches else 0)
        else:
            if touches:
                w = weight(x_first)
                self.precision += w
                self.level += (lowest + x_first - self.level) * w / self.precision
            x = self.level - self.p[2] + radius
        f = force(max(x, 0) - x0)
        if f < least:
            self.drag = [0, 0]
            return [0, 0, 0]
        slid = [a - b for a, b in zip(self.p[:2], before[:2])]
        return [-d for d in self.rub(slid, rubs["mu"] * f)] + [-f if opposed else f]

    def rub(self, slid, most):  # Dahl's friction, N
        way = math.hypot(*slid)
        if way > 0:
            falls = math.exp(-rubs["sigma_N_per_m"] * way / most)
            to = [most * s / way for s in slid]
            self.drag = [t + falls * (d - t) for d, t in zip(self.drag, to)]
        size = math.hypot(*self.drag)
        if size > most:
            self.drag = [d * most / size for d in self.drag]
        return [d + rubs["B_Ns_per_m"] * s / dt for d, s in zip(self.drag, slid)]

worst, most, ticks, trial, finger, first = 0, 0, 0, None, Finger(), None
for row in csv.DictReader(open(sys.argv[1])):
    if row["tool"] == "0":
        first = row
        continue
    if row["trial"] != trial or row["sensor"] != "estimated":
        trial, finger = row["trial"], Finger()
    if row["sensor"] != "estimated":
        continue
    X, q = laws["X_DP"], [float(row[f"q_DE_{part}"]) for part in "wxyz"]
    q = [part / math.sqrt(sum(x * x for x in q)) for part in q]
    middle = [a + b for a, b in zip(of(row, "p_DE", "m"), turned(q, known["p_EM_m"]))]
    f = finger.feel(place(X[0], of(first, "p_sensed_D", "m")),
                    inward(X[0], of(first, "f_sensed_D", "N")), place(X[1], middle))
    told = inward(X[1], of(row, "f_sensed_D", "N"))
    ticks += 1
    worst = max(worst, math.dist(f, told))
    most = max(most, f[2] if not opposed else -f[2])
print(f"{ticks} ticks, estimated up to {most:.2f} N, at most {1000 * worst:.6f} mN off")
