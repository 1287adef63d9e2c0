#include <algorithm>

#include "anatomy/import/import_patient.h"

namespace palpa::anatomy {
namespace {

std::string joinedWords(const std::vector<std::string>& parts, const std::string& otherwise) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
  return all.empty() ? otherwise : all;
}

void tellOf(const SurfaceReport& s, std::vector<std::string>* lines) {
  lines->push_back(s.id + ", " + name(s.organ) + ", " + lengthText(s.longest) + " long, from " +
                   s.file + " (in " + s.unit + ")");
  lines->push_back("    found: " + std::to_string(s.before.triangles) + " triangles, " +
                   joinedWords(findings(s.before), "sound"));
  std::vector<std::string> done = words(s.repair, s.metres);
  if (s.left_out > 0)
    done.push_back(std::to_string(s.left_out) + " triangles of smaller pieces left out");
  lines->push_back("    done: " + joinedWords(done, "nothing") +
                   (s.after.sound() ? "; sound now"
                                    : "; NOT CLOSED: " + joinedWords(findings(s.after), "open")));
  if (s.decimation.way != "none")
    lines->push_back("    decimated from " + std::to_string(s.decimation.before) + " to " +
                     std::to_string(s.decimation.after) + " triangles (" + s.decimation.way +
                     "): the original's points lie within " + lengthText(s.decimation.farthest) +
                     " of it, rms " + lengthText(s.decimation.rms));
}

}  // namespace

std::vector<std::string> words(const ImportReport& report) {
  std::vector<std::string> lines;
  std::size_t before = 0, after = 0, open = 0, welded = 0, holes = 0;
  double farthest_weld = 0, farthest = 0;
  for (const SurfaceReport& s : report.surfaces) {
    tellOf(s, &lines);
    before += s.before.triangles;
    after += s.decimation.after;
    open += !s.after.sound();
    welded += s.repair.welded_points;
    holes += s.repair.closed_holes;
    farthest_weld = std::max(farthest_weld, s.metres * s.repair.farthest_weld);
    farthest = std::max(farthest, s.decimation.farthest);
  }
  lines.push_back("Landmarks");
  for (const std::string& sentence : report.landmarks) lines.push_back("    " + sentence);
  lines.push_back("Together: " + std::to_string(report.surfaces.size()) + " surfaces, " +
                  std::to_string(before) + " triangles found, " + std::to_string(after) + " kept");
  lines.push_back("    " + std::to_string(holes) + " holes closed, " + std::to_string(welded) +
                  " points of seams joined" +
                  (welded ? ", none moved by more than " + lengthText(farthest_weld) : ""));
  lines.push_back("    decimation: " + (farthest > 0
                                            ? "no point of an original is farther than " +
                                                  lengthText(farthest) + " from its surface"
                                            : std::string("none")));
  lines.push_back("    " + (open ? std::to_string(open) + " of the surfaces could not be closed"
                                 : std::string("every surface is closed")));
  return lines;
}

}  // namespace palpa::anatomy
