# Adds up all forces of every tick, and computes cues and limiter again, of any session, after
#   palpa export out/A/session.palpa --out ticks.csv           python3 docs/check_ticks.py ticks.csv
import csv, json, math, sys
laws = json.load(open(sys.argv[1].replace(".csv", ".laws.json")))
adds, off, last, state = laws["adds_up"], {}, {}, {}
bound, (most, slew) = laws["cues_largest_N"], map(laws["limits"].get, ("force_N", "slew_N_per_s"))
def of(r, name, unit="_N"): return [float(r[f"{name}_{axis}{unit}"]) for axis in "xyz"]
def times(s, v): return [s * x for x in v]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def total(*vectors): return [sum(x) for x in zip([0, 0, 0], *vectors)]
def bounded(f, size): return times(min(1, size / (math.hypot(*f) or 1)), f)
def note(what, f, g): off[what] = max(off.get(what, 0), 1000 * math.dist(f, g))
def cue(r, i, a, dt):  # N, of one augmentation, before all are bounded together
    on, step = "part" not in a or int(r["parts"]) >> a["part"] & 1, dt / (a["blend_s"] or dt)
    w, since = state.get((r["trial"], i), (0, 9))  # weight, blended in and out; s since its trigger
    w = min(max(w + (step if on else -step), 0), 1) if r["augmented"] == "1" else 0
    since = 0 if int(r["cues_begun"]) >> i & 1 else since + dt
    state[r["trial"], i], A, reach = (w, since), a["amplitude"], a["reach_m"]
    if a["kind"] == "attraction":  # Edmunds and Pai (2012), 4; no steeper than the device holds
        d, R = of(r, "to_valley_D", "_m"), float(r["valley_radius_U"])
        A, far = min(A, laws["cues_steepest_N_per_m"] * reach * R / math.tau), math.hypot(*d)
        A *= 2 * w * math.sin(math.pi * far / reach) ** 2
        return times(A / R / far if 0 < far <= reach else 0, d)
    if a["way"] == "up" and a["kind"] in ("pulse", "relief"):
        share = since < a["width_s"] if a["kind"] == "pulse" else w * float(r["footprint"])
        return times(A * share, of(r, "up_D", ""))
    return of(r, a["column"])  # the other kinds are only added up
for ticks, r in enumerate(filter(lambda x: x["rendered"], csv.DictReader(open(sys.argv[1]))), 1):
    (then, before), f = last.get(r["tool"], (0, [0, 0, 0])), bounded(of(r, "f_wanted_D"), most)
    dt, command = min((int(r["t_ns"]) - then) * 1e-9, 0.005), of(r, "f_command_D")
    made = total(*(of(r, part) for part in adds["f_contact_D"] + adds["f_augmentation_D"]))
    rest = (of(r, part) for part in adds["f_wanted_D"] + adds["f_command_D"])
    note("sum", total(times(float(r["rendered"]), made), *rest), command)
    cues = bounded(total(*(cue(r, i, a, dt or 1e-3) for i, a in enumerate(laws["cues"]))), bound)
    note("cues", cues, total(*(of(r, a["column"]) for a in laws["cues"])))
    if r["safety"] in ("none", "clamp", "slew"):  # falls are free, rises are bounded
        base = times(min(max(dot(f, before) / (dot(before, before) or 1), 0), 1), before)
        note("limiter", total(base, bounded(total(f, times(-1, base)), slew * dt)), command)
    last[r["tool"]] = int(r["t_ns"]), command
print(f"{ticks} ticks, at most {max(off.values()):.6f} mN off:", off)
