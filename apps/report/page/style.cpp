#include "apps/report/page/style.h"

#include <map>

namespace palpa::report {

const char* cssClass(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::guide:
      return "guide";
    case Tone::bad:
      return "bad";
    case Tone::neutral:
      break;
  }
  return "plain";
}

Tone toneOfMoment(const std::string& kind) {
  static const std::map<std::string, Tone> kTones{
      {"vein", Tone::good},     {"flash", Tone::good},  {"success", Tone::good},
      {"good", Tone::good},     {"bone", Tone::guide},  {"clavicle", Tone::guide},
      {"guide", Tone::guide},   {"lung", Tone::bad},    {"pleura", Tone::bad},
      {"artery", Tone::bad},    {"rib", Tone::bad},     {"sternum", Tone::bad},
      {"back_wall", Tone::bad}, {"through", Tone::bad}, {"bad", Tone::bad},
      {"safety", Tone::bad}};
  const auto found = kTones.find(kind);
  return found == kTones.end() ? Tone::neutral : found->second;
}

namespace {

/// Colours by role. On dark screens the two deep hues of the palette give way to their lighter kin.
std::string colours() {
  const auto hue = [](const char* name, std::string_view value) {
    return std::string("--") + name + ':' + std::string(value) + ';';
  };
  const std::string light =
      "--page:#f6f7f5;--card:#ffffff;--ink:#18212b;--muted:#56616e;--line:#dfe3e6;--lane:#eef1f3;"
      "--phase:#c4d3de;--plain:#44505d;--on:#ffffff;--guide-ink:#18212b;" +
      hue("good", palette::kGreen) + hue("bad", palette::kVermillion) +
      hue("guide", palette::kOrange) + hue("blue", palette::kBlue) +
      "--good-ink:#00664b;--bad-ink:#a84800;";
  const std::string dark =
      "--page:#11161b;--card:#1a2027;--ink:#e8ebee;--muted:#a3aebb;--line:#323c46;--lane:#262e37;"
      "--phase:#46586a;--plain:#b3bec9;--on:#11161b;--guide-ink:#11161b;" +
      hue("good", "#2fc79a") + hue("bad", "#f0813a") + hue("guide", palette::kOrange) +
      hue("blue", palette::kSkyBlue) + "--good-ink:#4fd9b0;--bad-ink:#ff9d5c;";
  return ":root{color-scheme:light dark;" + light +
         "}\n@media screen and (prefers-color-scheme: dark){:root{" + dark + "}}\n";
}

constexpr const char* kPage = R"css(
*{box-sizing:border-box}
html{font-size:16px;-webkit-text-size-adjust:100%;scroll-behavior:smooth}
body{margin:0;background:var(--page);color:var(--ink);
  font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif;
  font-variant-numeric:tabular-nums}
main,header,footer{max-width:1040px;margin:0 auto;padding:0 24px}
header{padding-top:40px;padding-bottom:8px}
h1{font-size:1.9rem;line-height:1.2;font-weight:650;letter-spacing:-.015em;margin:0 0 .5rem}
h2{font-size:1.35rem;line-height:1.25;font-weight:650;letter-spacing:-.01em;margin:0 0 1rem}
h3{font-size:1.05rem;font-weight:650;margin:2.2rem 0 .7rem}
h4{font-size:.95rem;font-weight:600;margin:0}
p{margin:0 0 .5rem}
a{color:var(--blue)}
.muted{color:var(--muted)}
.small{font-size:.875rem}
.who{display:flex;flex-wrap:wrap;gap:.2rem 1.6rem;color:var(--muted);margin:0}
.who strong{color:var(--ink);font-weight:600}
.banner{margin:1.1rem 0 0;padding:.7rem 1rem;border:1.5px solid var(--guide);border-radius:8px;
  background:color-mix(in srgb,var(--guide) 13%,var(--card))}
.banner strong{letter-spacing:.08em;margin-inline-end:.6rem}
nav{display:flex;flex-wrap:wrap;gap:.5rem;margin-top:1rem}
nav a{display:inline-block;padding:.3rem .75rem;border:1px solid var(--line);border-radius:999px;
  background:var(--card);color:var(--ink);text-decoration:none;font-size:.9rem}
nav a:hover{border-color:var(--blue)}
.dot::before{content:"";display:inline-block;width:.6em;
  height:.6em;margin-right:.5em;background:var(--plain)}
.dot.good::before{background:var(--good);border-radius:50%}
.dot.plain::before{background:none;border:1.5px solid var(--plain)}
.dot.guide::before{background:var(--guide)}
.dot.bad::before{background:var(--bad);transform:rotate(45deg)}
.card{background:var(--card);border:1px solid var(--line);border-radius:12px;padding:28px;margin:20px 0}
.role{margin-inline-start:.6rem;color:var(--muted);font-size:.95rem;font-weight:400;letter-spacing:0}
.badge{display:inline-block;margin:0 .5rem;padding:.05rem .6rem;border:1px solid currentColor;
  border-radius:999px;font-size:.8rem;font-weight:500;color:var(--muted);vertical-align:.1em}
.badge.bad{color:var(--bad-ink)}
.next{margin:.9rem 0 0}
.remarks{padding:18px 28px}
.remarks h2{font-size:1.05rem;margin-bottom:.5rem}
.remarks ul{margin:0;padding-inline-start:1.2rem}
.appendix>summary{font-size:1.05rem;font-weight:650;cursor:pointer}
.appendix .card{border:0;padding:0;margin:28px 0 0}
footer{padding-top:8px;padding-bottom:48px}
.facts{width:100%;border-collapse:collapse}
.facts th,.facts td{text-align:start;vertical-align:top;padding:.5rem .9rem .5rem 0;
  border-bottom:1px solid var(--line);font-weight:400}
.facts th{color:var(--muted);width:34%}
.facts td.value{font-weight:600;width:26%}
.facts tr:last-child>*{border-bottom:0}
.glossary{display:grid;grid-template-columns:max-content 1fr;gap:.45rem 1.4rem;margin:0 0 1.2rem}
.glossary dt,code{font:600 .8rem/1.7 ui-monospace,"SF Mono",Menlo,"DejaVu Sans Mono",monospace;
  color:var(--muted)}
.glossary dd{margin:0}
.answers{border-collapse:collapse;width:100%;font-size:.9rem}
.answers th,.answers td{text-align:start;padding:.4rem .9rem .4rem 0;
  border-bottom:1px solid var(--line)}
.answers thead th{font-weight:400;color:var(--muted)}
.wrong-word{color:var(--bad-ink);font-weight:600}
)css";

constexpr const char* kTrial = R"css(
.verdict{display:flex;gap:18px;align-items:flex-start;padding:20px;border-radius:10px;
  --tone:var(--plain);background:color-mix(in srgb,var(--tone) 9%,var(--card));
  border-inline-start:6px solid var(--tone)}
.verdict.good{--tone:var(--good)}
.verdict.bad{--tone:var(--bad)}
.verdict.guide{--tone:var(--guide)}
.verdict.guide .sign path{stroke:var(--guide-ink)}
.verdict p:last-child{margin:0}
.sign{flex:none;width:44px;height:44px}
.sign circle{fill:var(--tone)}
.sign path{fill:none;stroke:var(--on);stroke-width:4;stroke-linecap:round;stroke-linejoin:round}
.finding{flex:1;min-width:0}
.outcome{font-size:1.3rem;font-weight:650;line-height:1.25}
.total{flex:none;text-align:end;display:flex;flex-direction:column;color:var(--muted);
  font-size:.85rem;line-height:1.35}
.total strong{font-size:2.3rem;line-height:1.05;font-weight:650;letter-spacing:-.02em;color:var(--ink)}
.tiles{list-style:none;display:flex;flex-wrap:wrap;gap:.6rem 2.4rem;margin:1.1rem 0 0;padding:0 2px}
.tiles span{display:block;color:var(--muted);font-size:.85rem}
.tiles strong{font-weight:600}
.score{width:100%;border-collapse:collapse}
.score th{font-size:.85rem;font-weight:400;color:var(--muted);text-align:start;
  padding:0 0 .35rem;border-bottom:1px solid var(--line)}
.score td{padding:.65rem 0;border-bottom:1px solid var(--line);vertical-align:top}
.score .sum{text-align:end;white-space:nowrap;padding-inline-start:1.4rem;color:var(--muted)}
.score .points{text-align:end;width:150px;padding-inline-start:1.4rem}
.score .reason p{margin:.1rem 0 0}
.score code{margin-inline-start:.6rem}
.score .clear{color:var(--muted)}
.score .clear td{padding:.35rem 0}
.score .clear .sum,.score .clear .points{padding-inline-start:1.4rem}
.score .clear strong{font-weight:500}
.score tfoot td{border-bottom:0;font-weight:600}
.score tfoot strong{font-size:1.15rem}
.bar{display:block;width:100%;height:6px;margin-top:.45rem;border-radius:3px}
.misses{display:grid;grid-template-columns:repeat(auto-fit,minmax(260px,1fr));gap:14px 40px}
.miss p{margin:.1rem 0 .3rem}
.miss p strong{font-size:1.3rem;font-weight:650}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(260px,1fr));gap:18px}
.picture img{display:block;width:100%;height:auto;border-radius:8px;border:1px solid var(--line)}
.picture figcaption{margin-top:.4rem}
.missing{padding:2rem 1rem;border:1px dashed var(--line);border-radius:8px;color:var(--muted);margin:0}
.time{display:inline-block;margin-inline-end:.6rem;font-weight:600}
.moments{margin:.8rem 0 0;padding:0;columns:2 20rem;column-gap:2rem}
.moments li{margin-inline-start:1.9rem;break-inside:avoid}
.moments li{padding-inline-start:.2rem}
.moments .time{min-width:4.2rem}
.scroll{overflow-x:auto}
.all{border-collapse:collapse;font-size:.85rem;margin:1rem 0 .6rem;width:100%}
.all th,.all td{text-align:end;padding:.4rem .35rem;border-bottom:1px solid var(--line);
  white-space:nowrap}
.all thead th{font-weight:400;color:var(--muted);vertical-align:bottom;line-height:1.25}
.all thead th[colspan]{text-align:center;border-bottom:0;padding-bottom:0}
.all thead th:nth-child(2)[rowspan]{text-align:start}
.all .words{text-align:start;white-space:normal;min-width:7rem}
)css";

constexpr const char* kChart = R"css(
figure{margin:0}
figcaption{color:var(--muted);font-size:.875rem;margin-top:.4rem}
.chart{display:block;width:100%;height:auto}
svg{direction:ltr}
svg.narrow,.moments.narrow{display:none}
svg text{fill:var(--ink);font-size:13px}
svg.narrow text{font-size:12px}
svg text.tick,svg text.legend{fill:var(--muted)}
svg text.strong{font-weight:650}
svg text.mid{text-anchor:middle}
svg text.end{text-anchor:end}
svg text.inside{font-size:12px}
svg text.words{paint-order:stroke;stroke:var(--card);stroke-width:5px;stroke-linejoin:round}
svg text.number{fill:var(--on);font-size:12px;font-weight:650}
svg text.number.guide{fill:var(--guide-ink)}
svg .grid{stroke:var(--line)}
svg .zero,svg .axis{stroke:var(--muted)}
svg .lane{fill:var(--lane)}
svg .span.plain{fill:var(--phase);stroke:var(--card)}
svg .span.good,svg .mark.good{fill:var(--good)}
svg .span.guide,svg .mark.guide{fill:var(--guide)}
svg .span.bad,svg .mark.bad{fill:var(--bad)}
svg .mark.plain{fill:var(--plain)}
svg .mark{stroke:var(--card);stroke-width:1.5}
svg .mark.hollow{fill:var(--card);stroke-width:2.5}
svg .mark.hollow.good{stroke:var(--good)}
svg .mark.hollow.bad{stroke:var(--bad)}
svg .mark.hollow.guide{stroke:var(--guide)}
svg .moment{stroke:var(--plain);stroke-opacity:.65;stroke-dasharray:2 3}
svg .moment.good{stroke:var(--good)}
svg .moment.guide{stroke:var(--guide)}
svg .moment.bad{stroke:var(--bad)}
svg .curve{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}
svg .curve.computed,svg .curve.totals{stroke:var(--blue)}
svg .curve.rendered{stroke:var(--ink);stroke-dasharray:5 4;stroke-width:1.3}
svg .curve.depth{stroke:var(--blue)}
svg .area{stroke:none;fill:var(--blue);fill-opacity:.12}
svg .inside-organ{fill:var(--bad);fill-opacity:.3}
svg .wall{stroke:var(--ink);stroke-width:2}
.scale{display:block;width:100%;max-width:320px;height:auto}
.standing{display:block;width:100%;height:36px;border-radius:4px}
.standing .group{fill:var(--phase)}
.standing .group.first{fill:var(--blue);fill-opacity:.45}
.standing .middle{fill:var(--card)}
.standing .here{fill:var(--ink)}
.standing-row p{margin:.9rem 0 .3rem}
.standing-row p.muted{margin:.3rem 0 0}
.standing-key{list-style:none;margin:1.2rem 0 0;padding:0;font-size:.875rem;color:var(--muted)}
.swatch{display:inline-block;width:1.1rem;height:.7rem;margin-inline-end:.5rem;border-radius:2px;
  background:var(--phase)}
.swatch.first{background:var(--blue);opacity:.45}
.swatch.here{width:.3rem;height:.9rem;margin:0 .9rem 0 .4rem;background:var(--ink);
  vertical-align:-.1rem}
@media (max-width:899px){
  main,header,footer{padding-inline-start:12px;padding-inline-end:12px}
  .answers{display:block;overflow-x:auto}
  .card{padding:20px 16px}
}
@media (max-width:719px){
  main,header,footer{padding-inline-start:12px;padding-inline-end:12px}
  header{padding-top:24px}
  h1{font-size:1.5rem}
  .card{padding:18px 14px;border-radius:10px}
  svg.wide{display:none}
  svg.narrow{display:block;max-width:560px;margin:0 auto}
  .moments.narrow{display:block}
  .verdict{flex-wrap:wrap;padding:16px;gap:12px}
  .sign{width:34px;height:34px}
  .finding{flex-basis:70%}
  .total{width:100%;text-align:start}
  .score thead,.score tfoot .sum{display:none}
  .score tr{display:grid;grid-template-columns:1fr 92px;border-bottom:1px solid var(--line);padding:.5rem 0}
  .score td,.score .clear td{border:0;padding:0}
  .score .reason{grid-row:1;grid-column:1}
  .score .points,.score .clear .points{grid-row:1;grid-column:2;width:auto;padding-inline-start:.8rem}
  .score .sum,.score .clear .sum{grid-row:2;grid-column:1/3;text-align:start;padding:.1rem 0 0;font-size:.875rem}
  .glossary{grid-template-columns:1fr;gap:0}
  .glossary dd{margin-bottom:.6rem}
  .facts tr{display:block;padding:.5rem 0;border-bottom:1px solid var(--line)}
  .facts th,.facts td,.facts td.value{display:block;width:auto;border:0;padding:0}
  .scroll{margin:0 -14px;padding:0 14px}
}
@media print{
  @page{margin:14mm}
  html{font-size:11.5px}
  body{background:#fff;-webkit-print-color-adjust:exact;print-color-adjust:exact}
  main,header,footer{max-width:none;padding-inline-start:0;padding-inline-end:0}
  header{padding-top:0;margin-bottom:6mm}
  footer{padding-bottom:0}
  h3{margin-top:1.4rem}
  .score td,.score .clear td{padding-top:.3rem;padding-bottom:.3rem}
  .score tfoot{display:table-row-group}
  .score .clear .reason p{display:none}
  .pictures{grid-template-columns:repeat(3,1fr);gap:10px}
  nav,.appendix{display:none}
  .card{border:0;border-radius:0;padding:0;margin:0 0 10mm}
  .trial+.trial,#all-trials{break-before:page}
  svg.wide{display:block}
  svg.narrow,.moments.narrow{display:none}
  h2,h3{break-after:avoid}
  .verdict,.course,.picture,.misses,.score tr,.facts tr{break-inside:avoid}
  .scroll{overflow:visible}
  .all{font-size:7pt}
  .all th,.all td{padding:.25rem .2rem;white-space:normal}
}
)css";

}  // namespace

std::string styleSheet() { return colours() + kPage + kTrial + kChart; }

}  // namespace palpa::report
