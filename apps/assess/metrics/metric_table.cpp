#include "apps/assess/metrics/metric_table.h"

namespace palpa::metrics {
namespace {

constexpr char kNeverInserted[] = "the needle was never inserted";
constexpr char kNoContact[] = "nothing was touched";
constexpr char kNoPath[] = "the task has no expert path";

using enum Better;

// name, title, unit, better, tasks, definition, does not apply when
constexpr MetricDefinition kMetrics[] = {
    // Of any task
    {"success", "Success", "1", higher, "all", "1 when the task's goal was reached, else 0", ""},
    {"time_s", "Time", "s", lower, "all", "from the start to success, else to the end", ""},
    {"path_length_mm", "Length of the tip's path", "mm", lower, "needle, search",
     "sum of the tip's steps of 20 ms", ""},
    {"path_inefficiency_pct", "Path longer than a straight line", "%", lower, "needle",
     "100 x (path length / distance from first to last point - 1)",
     "both ends are less than 10 mm apart"},
    {"mean_speed_mm_s", "Mean speed", "mm/s", neither, "needle, search", "path length over time",
     "nothing moved in time"},
    {"bounding_box_mm3", "Room taken", "mm3", lower, "needle",
     "volume of the box around the tip's path, along the patient's axes", ""},
    {"translational_actions", "Movements", "1", lower, "needle",
     "times the tip's speed rises above 50 mm/s for more than 0.2 s", ""},
    {"rotational_actions", "Turns", "1", lower, "needle",
     "times the tool turns faster than 50 degrees/s for more than 0.2 s", ""},
    {"rotation_total_deg", "Rotation", "deg", lower, "needle",
     "sum of the axis' turns; turns about itself are not counted", ""},
    {"smoothness_sparc", "Smoothness", "1", higher, "needle",
     "spectral arc length of the speed (Balasubramanian 2015); one ideal movement has -1.4",
     "nothing moved"},
    {"integrated_jerk", "Jerk", "m/s^2.5", lower, "needle",
     "root of the integral of the squared third derivative of the tip's position; grows with a "
     "station's noise",
     "the trial is shorter than 80 ms"},
    {"peak_force_N", "Largest force", "N", lower,
     "needle, palpation, search, squeeze, friction, pulse",
     "largest computed force of contact, means of 20 ms", ""},
    {"mean_force_N", "Mean force", "N", neither, "needle, palpation, search",
     "mean computed force while it is 0.05 N or more", kNoContact},
    {"force_jerk_N_s", "Unsteadiness of the force", "N/s", lower, "needle",
     "root mean square of the force's rate while it is 0.05 N or more", kNoContact},
    // Palpation
    {"sensitivity_pct", "Lumps found", "%", higher, "palpation", "found of all lumps",
     "there was no lump"},
    {"specificity_pct", "Clear quarters left alone", "%", higher, "palpation",
     "quarters of the area without a lump in which none was marked", "no quarter is clear"},
    {"false_alarms", "False alarms", "1", lower, "palpation", "marks that are no lump's", ""},
    {"coverage_light_pct", "Felt lightly", "%", higher, "palpation",
     "share of the area felt with light pressure or more", ""},
    {"coverage_medium_pct", "Felt with medium pressure", "%", higher, "palpation",
     "share of the area felt with medium pressure or more", ""},
    {"coverage_deep_pct", "Felt deep", "%", higher, "palpation",
     "share of the area felt with deep pressure", ""},
    {"felt_twice_pct", "Felt again", "%", neither, "palpation",
     "share of the area felt more than once", ""},
    {"presses", "Presses", "1", neither, "palpation", "times the probe was pressed in", ""},
    {"closer_force_ratio", "Force when looking closer", "1", neither, "palpation",
     "mean peak of presses that palpate over that of presses that search; experts: about 1.15",
     "one of the two kinds is missing"},
    {"too_light_pct", "Too light", "%", lower, "palpation",
     "share of the time of touching below the least useful force", kNoContact},
    {"too_hard_pct", "Too hard", "%", lower, "palpation",
     "share of the time of touching above the largest sensible force", kNoContact},
    // Search and comparison
    {"chosen", "An element was chosen", "1", higher, "search",
     "1 when the probe stayed in a pit before the time was over, else 0", ""},
    {"difference_pct", "Difference of the two things", "%", neither, "squeeze, friction",
     "how much more the one has than the other", "more than two were put in order"},
    {"grips", "Grips", "1", lower, "squeeze", "how often the two were held", ""},
    {"touches", "Touches", "1", lower, "friction", "how often the surfaces were touched", ""},
    {"order_tau", "Order told", "1", higher, "friction",
     "Kendall's tau of the order that was said and the true one: 1 the same, -1 reversed",
     "two things were compared"},
    // Pulse
    {"pulse_found", "Pulse found", "1", higher, "pulse",
     "1 when it was marked near enough to the artery's line, else 0", ""},
    {"pulse_off_mm", "Marked beside the artery", "mm", lower, "pulse",
     "distance of the last mark from the artery's line", "nothing was marked"},
    {"pulse_find_s", "Time to find it", "s", lower, "pulse", "from the start to the last mark",
     "nothing was marked"},
    {"count_error_per_min", "Error of the count", "1/min", lower, "pulse",
     "beats a minute between what was said and what was delivered in the counted time",
     "it was not counted"},
    {"rhythm_told", "Rhythm told", "1", higher, "pulse", "1 when it was named right, else 0", ""},
    {"pressed_shut_pct", "Artery pressed shut", "%", lower, "pulse",
     "share of the counted time in which it was pressed too hard for any pulse",
     "it was not counted"},
    // Needle
    {"total", "Total penalty", "1", lower, "needle",
     "sum of weight x value of the nine values of the score (Tzafestas 2008)", kNoPath},
    {"col_lung", "Lung touched", "1", lower, "needle",
     "scoring samples (20 Hz) with the tip in the lung or pressing on the pleura", kNoPath},
    {"col_rib", "Rib or bone struck", "1", lower, "needle",
     "contacts with rib, sternum, or clavicle above the guiding force, each counted again for "
     "every full second; scored as published, scoring samples of 20 Hz",
     kNoPath},
    {"col_artery", "Artery touched", "1", lower, "needle",
     "scoring samples with the tip in an artery or pressing on its wall", kNoPath},
    {"col_vein", "Vein touched without success", "1", lower, "needle",
     "scoring samples at the vein outside the final, successful stay; its back wall always",
     kNoPath},
    {"phase_1_mm", "Error of entry and depth", "mm", lower, "needle",
     "distance of the puncture from the taught entry plus error of depth", kNoPath},
    {"phase_2", "Error of direction", "1", lower, "needle",
     "1000 x angle to the taught direction / acceptable angle, when the advance begins", kNoPath},
    {"econ_mean_mm", "Mean distance from the taught line", "mm", lower, "needle",
     "of tip and of the shaft 70 mm behind it, during the advance", kNoPath},
    {"econ_var_mm2", "Variance of the same", "mm2", lower, "needle",
     "population variance over all samples of the advance", kNoPath},
    {"skin_punctures", "Skin punctures", "1", lower, "needle", "times the skin was punctured", ""},
    {"redirections", "Redirections", "1", lower, "needle",
     "drawn back by more than 3 mm and advanced again more than 3 degrees apart, without leaving "
     "the skin",
     ""},
    {"needle_passes", "Needle passes", "1", lower, "needle",
     "skin punctures plus redirections: every advance of the needle", ""},
    {"first_pass_success", "Success at the first pass", "1", higher, "needle",
     "1 when the goal was reached in the first needle pass, else 0", ""},
    {"bevel_off_deg", "Bevel turned from up", "deg", lower, "needle",
     "angle of the bevel's opening from the front of the patient, about the needle, as the advance "
     "begins",
     "phase 2 was not reached"},
    {"aspirate_told", "What was aspirated, told", "1", higher, "needle",
     "1 when vein, artery or neither was told right each time that it was asked, else 0",
     "nobody asked"},
    {"aspirations", "Aspirations", "1", neither, "needle",
     "times the plunger was drawn while the needle was in", ""},
    {"back_wall_punctures", "Back wall punctured", "1", lower, "needle",
     "times the tip went out of the vein through its far wall", ""},
    {"entry_along_mm", "Puncture along the clavicle", "mm", neither, "needle",
     "from the taught entry toward the breastbone (negative: toward the shoulder), scored pass",
     "the skin was never punctured, or the task has no expert path"},
    {"entry_across_mm", "Puncture across the clavicle", "mm", neither, "needle",
     "from the taught entry toward the clavicle (negative: away from it), scored pass",
     "the skin was never punctured, or the task has no expert path"},
    {"aim_steeper_deg", "Aim toward the back", "deg", neither, "needle",
     "steeper (positive) or flatter than taught, when the advance begins", "there was no advance"},
    {"aim_cephalad_deg", "Aim toward the head", "deg", neither, "needle",
     "more toward the head (positive) or the feet than taught, when the advance begins; 0 for a "
     "needle steeper than 65 degrees",
     "there was no advance"},
    {"aspirated_advance_pct", "Advanced under suction", "%", higher, "needle",
     "share of the way of all advances before the vein on which the plunger was drawn",
     "there was no advance"},
    {"withdrawal_turn_deg", "Turned while drawn back", "deg", lower, "needle",
     "largest turn of the needle while it was drawn back by more than 3 mm in an advance, from "
     "its direction at the deepest point",
     "it was not drawn back"},
    {"pleural_punctures", "Pleura punctured", "1", lower, "needle",
     "times the tip went into the lung", kNoPath},
    {"pleural_contacts", "Pleura touched", "1", lower, "needle",
     "times the tip pressed on the pleura or went through it", kNoPath},
    {"arterial_punctures", "Artery punctured", "1", lower, "needle",
     "times the tip went into an artery", kNoPath},
    {"arterial_contacts", "Artery touched", "1", lower, "needle",
     "times the tip pressed on the wall of an artery or went through it", kNoPath},
    {"rib_contacts", "Rib or breastbone struck", "1", lower, "needle",
     "times the tip met a bone other than the clavicle", kNoPath},
    {"error_site", "Error: wrong site relative to the clavicle", "1", lower, "needle",
     "1 when it was made, else 0; the six errors as apps/assess/competence defines them", kNoPath},
    {"error_landmarks", "Error: landmarks not identified", "1", lower, "needle",
     "1 when it was made, else 0", kNoPath},
    {"error_periosteum", "Error: through the periosteum", "1", lower, "needle",
     "1 when it was made, else 0", kNoPath},
    {"error_shallow", "Error: too flat", "1", lower, "needle", "1 when it was made, else 0",
     kNoPath},
    {"error_cephalad", "Error: too cephalad", "1", lower, "needle", "1 when it was made, else 0",
     kNoPath},
    {"error_left_vein", "Error: needle left the vein", "1", lower, "needle",
     "1 when it was made, else 0", kNoPath},
    {"tissue_time_s", "Time in tissue", "s", lower, "needle", "time with the needle in", ""},
    {"tissue_path_mm", "Path in tissue", "mm", lower, "needle", "the tip's path while in", ""},
    {"tissue_damage_mm2", "Tissue swept", "mm2", lower, "needle",
     "area that the inserted part of the needle sweeps", ""},
    {"closest_pleura_mm", "Closest to the pleura", "mm", higher, "needle",
     "smallest distance of the inserted tip from the lung, 20 times a second; negative: inside",
     kNeverInserted},
    {"closest_pleura_at_s", "When it was closest to the pleura", "s", neither, "needle",
     "since the trial's start", kNeverInserted},
    {"closest_artery_mm", "Closest to an artery", "mm", higher, "needle",
     "smallest distance of the inserted tip from an artery; negative: inside", kNeverInserted},
    {"closest_artery_at_s", "When it was closest to an artery", "s", neither, "needle",
     "since the trial's start", kNeverInserted},
    {"bone_force_peak_N", "Largest force on bone", "N", lower, "needle",
     "largest computed force of bone on the needle", ""},
    {"over_force_s", "Bone pressed too hard", "s", lower, "needle",
     "time with more force on bone than guides the needle (3 N unless the task says otherwise)",
     ""},
    {"speed_at_vein_mm_s", "Speed at the vein", "mm/s", lower, "needle",
     "mean speed of the tip in the 0.2 s before it entered the vein for the last time",
     "it never did"},
    {"frechet_mm", "Largest distance along the taught line", "mm", lower, "needle",
     "Frechet distance of the advance from the taught line, from beside its start to the end",
     "there was no advance"},
    {"hausdorff_mm", "Farthest from the taught line", "mm", lower, "needle",
     "Hausdorff distance of the advance from the taught line, from beside its start to the end",
     "there was no advance"},
    {"warped_mm", "Mean distance along the taught line", "mm", lower, "needle",
     "mean distance of the advance from that line after dynamic time warping",
     "there was no advance"},
};

}  // namespace

std::span<const MetricDefinition> metricTable() { return kMetrics; }

bool belongsTo(const MetricDefinition& definition, std::string_view engine) {
  const std::string_view tasks = definition.tasks;
  return tasks == "all" || tasks.find(engine) != std::string_view::npos;
}

const MetricDefinition* metricNamed(std::string_view name) {
  for (const MetricDefinition& definition : metricTable())
    if (name == definition.name) return &definition;
  return nullptr;
}

std::string metricsAsMarkdown() {
  std::string text =
      "| name | what | unit | better | task | definition | does not apply when |\n| --- | --- | "
      "--- | --- | --- | --- | --- |\n";
  for (const MetricDefinition& d : metricTable()) {
    const char* better = d.better == Better::lower    ? "lower"
                         : d.better == Better::higher ? "higher"
                                                      : "neither";
    for (const char* cell : {d.name, d.title, d.unit, better, d.tasks, d.definition, d.valid})
      text += std::string("| ") + cell + ' ';
    text += "|\n";
  }
  return text;
}

}  // namespace palpa::metrics
