# Adds up all forces of every tick, and computes cues and limiter again, of any session, after
#   palpa export out/A/session.palpa --out ticks.csv           python3 docs/check_ticks.py ticks.csv
import csv, json, math, sys
laws = json.load(open(sys.argv[1].replace(".csv", ".laws.json")))
parts, off, last, state, ticks = sum(laws["adds_up"].values(), []), {}, {}, {}, 0
bound, (most, slew) = laws["cues_largest_N"], map(laws["limits"].get, ("force_N", "slew_N_per_s"))
def of(r, name, unit="_N"): return [float(r[f"{name}_{axis}{unit}"]) for axis in "xyz"]
def times(s, v): return [s * x for x in v]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def total(*vectors): return [sum(x) for x in zip([0, 0, 0], *vectors)]
def bounded(f, size): return times(min(1, size / (math.hypot(*f) or 1)), f)
def note(what, f, g): off[what] = max(off.get(what, 0), 1000 * math.dist(f, g))
def cue(r, i, a, dt):  # N, of one augmentation, before all are bounded together
    on, step = "part" not in a or int(r["parts"]) >> a["part"] & 1, dt / (a["blend_s"] or dt)
    weight, since = state.get((r["trial"], i), (0, 9))  # blended in and out; s since its trigger
    weight = min(max(weight + (step if on else -step), 0), 1) if r["augmented"] == "1" else 0
    since = 0 if int(r["cues_begun"]) >> i & 1 else since + dt
    state[r["trial"], i], A, reach = (weight, since), a["amplitude"], a["reach_m"]
    if a["kind"] == "attraction":  # Edmunds and Pai (2012), 4; no steeper than the device holds
        d, R = of(r, "to_valley_D", "_m"), float(r["valley_radius_U"])
        A, far = min(A, laws["cues_steepest_N_per_m"] * reach * R / math.tau), math.hypot(*d)
        wave = 1 - math.cos(math.tau * far / reach)
        return times(weight * A * wave / R / far if 0 < far <= reach else 0, d)
    if a["way"] == "up" and a["kind"] in ("pulse", "relief"):
        share = since < a["width_s"] if a["kind"] == "pulse" else weight * float(r["footprint"])
        return times(A * share, of(r, "up_D", ""))
    return of(r, f"f_cue_{i + 1}_D")  # the other kinds are only added up
for r in filter(lambda row: row["rendered"], csv.DictReader(open(sys.argv[1]))):
    (then, before), now, ticks = last.get(r["tool"], (0, [0, 0, 0])), int(r["t_ns"]), ticks + 1
    dt, command, f = min((now - then) * 1e-9, 0.005), of(r, "f_command_D"), of(r, "f_wanted_D")
    made = times(float(r["rendered"]), total(*(of(r, part) for part in parts)))
    note("sum", total(made, *(of(r, f"f_{w}_D") for w in ("held", "damping", "limiter"))), command)
    cues = total(*(cue(r, i, a, dt or 1e-3) for i, a in enumerate(laws["cues"])))
    note("cues", total(bounded(cues, bound), of(r, "f_pulse_D")), of(r, "f_augmentation_D"))
    if r["safety"] in ("none", "clamp", "slew"):  # falls are free, rises are bounded
        f, share = bounded(f, most), dot(bounded(f, most), before) / (dot(before, before) or 1)
        base = times(min(max(share, 0), 1), before)
        note("limiter", total(base, bounded(total(f, times(-1, base)), slew * dt)), command)
    last[r["tool"]] = now, command
print(f"{ticks} ticks, at most {max(off.values()):.6f} mN off:", off)
