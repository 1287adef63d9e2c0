# What was added to a real thing (another stiffness, friction, texture, weight), computed once more
# from what
#   palpa export out/A/session.palpa --out ticks.csv
# writes of palpation, friction, pulse and squeeze: Jeon, Choi and Harders (2015), (10.4), (10.11)
# to (10.14), (10.21); texture: haptics/materials/texture.h. What is held by two tools is told by
# both sensors' readings alone; else by the normal, the depth and the sliding that the export says.
#   python3 docs/check_touch.py ticks.csv
import bisect, csv, json, math, sys

laws = json.load(open(sys.argv[1].replace(".csv", ".laws.json")))
surface, places = laws["surface"], laws["X_DP"]  # of the object in each device's base
rough, texture = surface.get("wanted_friction"), surface.get("texture")

def turned(q, v):  # by the unit quaternion q = w, x, y, z
    w, (x, y, z) = q[0], q[1:]
    t = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    u = y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]
    return [a + w * b + c for a, b, c in zip(v, t, u)]

def back(q, v):
    return turned([q[0], -q[1], -q[2], -q[3]], v)

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))

def plus(a, b, s=1):  # a + s b
    return [x + s * y for x, y in zip(a, b)]

def times(s, v):
    return [s * x for x in v]

def of(row, name, unit="_N"):
    return [float(row[f"{name}_{axis}{unit}"]) for axis in "xyz"]

def squeezed(rows):  # N, by the two devices, each in its own frame
    turns = [X["q_wxyz"] for X in places]
    p = [back(q, plus(of(r, "p_sensed_D", "_m"), X["p_m"], -1))
         for q, r, X in zip(turns, rows, places)]
    f = [back(q, of(r, "f_sensed_D")) for q, r in zip(turns, rows)]
    between = plus(p[0], p[1], -1)
    l = times(1 / math.hypot(*between), between)
    F = max(0, dot(plus(f[0], f[1], -1), l) / 2)  # (10.12) to (10.14)
    harder, heavier = (float(rows[0]["squeeze_" + what]) - 1 for what in ("stiffness", "weight"))
    sides = l, times(-1, l)
    return [turned(q, plus(times(harder * F, u), plus(force, u, -F), heavier))
            for q, side, force in zip(turns, sides, f) for u in [side]]  # (10.11)

class Rubbing:  # Dahl's friction on the surface that is to be felt
    def __init__(self):
        self.F = [0, 0, 0]

    def drag(self, slid, n, f_n, factor, dt):
        slid = plus(slid, n, -dot(slid, n))
        most, way = rough["mu"] * factor * f_n, math.hypot(*slid)
        if most <= 0:
            self.F = [0, 0, 0]
            return self.F
        along = plus(self.F, n, -dot(self.F, n))
        self.F = times(math.hypot(*self.F) / (math.hypot(*along) or 1), along)
        if way > 0:
            falls = math.exp(-rough["sigma_N_per_m"] * way / most)
            to = times(most / way, slid)
            self.F = plus(to, plus(self.F, to, -1), falls)
        self.F = times(min(1, most / (math.hypot(*self.F) or 1)), self.F)
        return plus(self.F, slid, rough["B_Ns_per_m"] * factor / dt)

def between(row, x):  # which two of a row, and how far from the first
    i = min(max(bisect.bisect_right(row, x) - 1, 0), max(len(row) - 2, 0))
    if len(row) == 1 or x <= row[0]:
        return [(0, 1)]
    share = min((x - row[i]) / (row[i + 1] - row[i]), 1)
    return [(i, 1 - share), (i + 1, share)]

class Shaking:  # a normalised lattice, driven by a shift register
    def __init__(self):
        self.noise, self.v, self.f_n = 1, [0, 0, 0], 0
        self.back = [0.0] * len(texture["nodes"][0][0]["reflection"])

    def force(self, slid, f_n, dt):
        if f_n <= 0:
            kept = self.noise
            self.__init__()
            self.noise = kept
            return 0
        follows = dt / (0.02 + dt)
        self.v = plus(self.v, plus(times(1 / dt, slid), self.v, -1), follows)
        self.f_n += follows * (f_n - self.f_n)
        speed, still = math.hypot(*self.v), texture["still_m_per_s"]
        if speed <= still:
            return 0
        corners = [(texture["nodes"][i][j], a * b)
                   for i, a in between(texture["ln_force_N"], math.log(self.f_n))
                   for j, b in between(texture["ln_speed_m_per_s"], math.log(speed))]
        one, self.noise = self.noise & 1, self.noise >> 1 ^ (self.noise & 1) * 0x1c80
        forward, y = 1 if one else -1, self.back[0]
        for i in reversed(range(len(self.back))):
            k = sum(share * node["reflection"][i] for node, share in corners)
            c = math.sqrt(1 - k * k)
            if i + 1 < len(self.back):
                self.back[i + 1] = k * forward + c * self.back[i]
            forward = c * forward - k * self.back[i]
        self.back[0] = forward
        rms = math.exp(sum(share * node["ln_rms_N"] for node, share in corners))
        first = math.exp(texture["ln_speed_m_per_s"][0])
        moves = min((speed - still) / (first - still), 1) if first > still else 1
        presses = math.exp(min(math.log(self.f_n) - texture["ln_force_N"][0], 0))
        w = rms * (forward - texture["leak"] * y) * moves * presses
        return min(max(w, -texture["largest_N"]), texture["largest_N"])

worst, ticks, first, then, state = {}, 0, None, {}, {}

def note(what, f, g):
    worst[what] = max(worst.get(what, 0), 1000 * math.dist(f, g))

def pair(rows):
    global ticks
    if min(math.hypot(*of(r, "f_sensed_D")) for r in rows) < laws["squeeze"]["least_contact_N"]:
        return
    ticks += 1
    for r, f in zip(rows, squeezed(rows)):
        note("squeezing", f, of(r, "f_contact_D"))

def pressed(r):
    global ticks
    kept = state.setdefault((r["tool"], r["trial"]), {})
    dt = min(1e-9 * (int(r["t_ns"]) - then.get(r["tool"], 0)), 0.005)
    then[r["tool"]] = int(r["t_ns"])
    n, f_n = of(r, "normal_D", ""), float(r["skin_force_N"])
    slid = of(r, "slid_D", "_m") if rough or texture else [0, 0, 0]
    touching = math.hypot(*n) > 0
    if texture:
        shaking = kept.setdefault("shakes", Shaking())
        note("texture", times(shaking.force(slid, f_n if touching else 0, dt), n),
             of(r, "f_texture_D"))
    if not touching:
        kept.pop("rubs", None)
        return
    ticks += 1
    if "f_taken_D_x_N" not in r or max(map(abs, of(r, "f_taken_D"))) == 0:
        wanted = surface["factor"] * f_n
        if surface["constant_N_per_m"] > 0:
            wanted = surface["constant_N_per_m"] * float(r["indentation_m"])
        note("stiffness", times(wanted - f_n, n), of(r, "f_stiffness_D"))
    if rough:
        f_r, rubs = of(r, "f_sensed_D"), kept.setdefault("rubs", Rubbing())
        wanted = rubs.drag(slid, n, f_n, float(r["friction"]), dt)
        real = plus(f_r, n, -dot(f_r, n))
        note("friction", times(-1, plus(wanted, real)), of(r, "f_friction_D"))

for row in csv.DictReader(open(sys.argv[1])):
    if "squeeze" in laws:
        if row["tool"] == "1" and row["armed"] == "1":
            pair((first, row))
        first = row
    elif row["rendered"]:
        pressed(row)
each = ", ".join(f"{what} {mN:.6f}" for what, mN in worst.items())
print(f"{ticks} ticks, at most {max(worst.values(), default=0):.6f} mN off ({each})")
