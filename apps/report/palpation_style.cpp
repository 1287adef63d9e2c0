#include "apps/report/palpation_style.h"

namespace palpa::report {
namespace {

/// Levels: one hue in four steps, and pips to count. Rings and crosses stand on a halo, so that
/// they are seen on every step.
constexpr std::string_view kPalpationStyle = R"css(
.force-note{margin:1.1rem 0 0;padding:.7rem 1rem;border-left:6px solid var(--blue);border-radius:8px;background:var(--card)}
.force-note strong{margin-right:.6rem}
.advice{margin:0;padding-left:1.5rem}
.advice li{margin:0 0 .5rem;padding-left:.2rem}
.lumps{border-collapse:collapse;width:100%;font-size:.9rem;margin:0 0 1rem}
.lumps th,.lumps td{text-align:left;vertical-align:top;padding:.45rem .9rem .45rem 0;border-bottom:1px solid var(--line)}
.lumps th{font-weight:600}
.lumps td:nth-child(3){white-space:nowrap}
.lumps thead th{font-weight:400;color:var(--muted)}
.missed-word{color:var(--bad-ink);font-weight:600}
svg .cell{stroke:var(--line);stroke-width:1}
svg .cell.level-0{fill:var(--card)}
svg .cell.level-1{fill:color-mix(in srgb,var(--blue) 18%,var(--card))}
svg .cell.level-2{fill:color-mix(in srgb,var(--blue) 42%,var(--card))}
svg .cell.level-3{fill:color-mix(in srgb,var(--blue) 78%,var(--card))}
svg .pips{fill:none;stroke:var(--ink);stroke-width:3;stroke-linecap:round}
svg .pips.level-3{stroke:var(--on)}
svg .edge{fill:none;stroke:var(--muted);stroke-width:1.5}
svg .halo{fill:none;stroke:var(--card);stroke-width:7;stroke-linecap:round}
svg .normal{fill:none;stroke:var(--muted);stroke-opacity:.55;stroke-linecap:round;stroke-linejoin:round}
svg .normal-line{fill:none;stroke:var(--ink);stroke-width:1.5;stroke-dasharray:2 5;stroke-linecap:round}
svg .ring{fill:none;stroke-width:3.5}
svg .ring.found{stroke:var(--good-ink)}
svg .ring.missed{stroke:var(--bad-ink);stroke-dasharray:8 6}
svg .cross{fill:none;stroke:var(--ink);stroke-width:3;stroke-linecap:round}
svg .cross.alarm{stroke:var(--bad-ink);stroke-linejoin:round}
svg .bar-10mm{fill:none;stroke:var(--ink);stroke-width:3}
svg .curve.pressing{stroke:var(--blue)}
svg .area.pressing{fill:var(--blue)}
svg .threshold{stroke:var(--ink);stroke-width:1.2;stroke-opacity:.75}
svg .threshold.level-1{stroke-dasharray:1 4}
svg .threshold.level-2{stroke-dasharray:4 4}
svg .threshold.level-3{stroke-dasharray:10 4}
svg .threshold.hard{stroke:var(--bad-ink);stroke-width:1.8;stroke-opacity:1}
)css";

}  // namespace

std::string_view palpationStyle() { return kPalpationStyle; }

}  // namespace palpa::report
