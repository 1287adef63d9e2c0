#include "kinds.h"

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/sha256.h"
#include "anatomy/import/import_map.h"
#include "anatomy/parametric/population.h"
#include "anatomy/volume/seed_file.h"
#include "apps/assess/competence/form.h"
#include "apps/evidence/expert_ranges.h"
#include "apps/presentation/presentation.h"
#include "apps/station/assets.h"
#include "apps/station/material_files.h"
#include "apps/station/station_file.h"
#include "apps/study/analysis/study_design.h"
#include "apps/study/campaign.h"
#include "apps/study/learning.h"
#include "apps/study/protocol.h"
#include "apps/study/questionnaire.h"
#include "apps/task_comparison/comparison_file.h"
#include "apps/task_needle/task_file.h"
#include "apps/task_palpation/palpation_file.h"
#include "apps/task_pulse/pulse_file.h"
#include "apps/task_search/search_file.h"
#include "apps/twin/bench_faults.h"
#include "apps/twin/bench_truth.h"
#include "apps/twin/feeling_hands.h"
#include "apps/twin/lump_search.h"
#include "apps/twin/operator.h"
#include "apps/twin/phantom/layered_phantom.h"
#include "apps/twin/phantom/opposed_phantom.h"
#include "apps/twin/phantom/phantom_file.h"
#include "apps/twin/phantom/rough_surface.h"
#include "apps/twin/tracking_model.h"
#include "ar/boards/board.h"
#include "calibration/camera_model.h"
#include "calibration/expert_path.h"
#include "calibration/parts/interactive_procedures.h"
#include "tests/support/files.h"

namespace palpa::schemas {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What the virtual bench reads of a station once a session begins.
void readTwin(const station::Station& station) {
  if (!station.simulated) return;
  constexpr std::uint64_t kSeed = 1;
  twin::drawWorld(station, kSeed);
  twin::trueCamera(station, kSeed);
  twin::trueDevice(station, kSeed);
  twin::cameraOnBoom(station, kSeed);
  twin::readBoardMoves(station);
  twin::readCameraFaults(station.file);
  twin::readSensorFaults(station.file);
  if (station.sample) twin::trueSample(station, kSeed);
  if (station.force_sensor && station.force_sensor->driver == station::ForceSensorDriver::bench)
    twin::trueSensor(station, kSeed);
}

const json kPose{{"position_mm", {1, 2, 3}}, {"rotation_vector_deg", {0, 0, 90}}};

/// Boards, real things and faults on the virtual bench.
json crowdedBench() {
  return {{"boards",
           {{{"name", "phantom"},
             {"columns", 2},
             {"rows", 1},
             {"tag_size_mm", 20},
             {"spacing_mm", 5},
             {"first_id", 200},
             {"X_WB", kPose},
             {"tolerance_mm", 3}}}},
          {"real_things", {{{"mesh", "hand.stl"}, {"unit", "mm"}, {"on", "table"}, {"X", kPose}}}},
          {"safety", {{"deadman_button", 0}}},
          {"coupling", {{"velocity_tau_ms", 1}}},
          {"twin",
           {{"board_moves", {{{"board", "phantom"}, {"from_s", 1}, {"by_mm", {1, 0, 0}}}}},
            {"camera_faults", {{{"kind", "black"}, {"from_s", 1}, {"to_s", 2}}}},
            {"device", {{"position_error_mm", 0.1}}},
            {"tracking_figures", "tracking.json"}}}};
}

json faultySensor() {
  return {{"twin",
           {{"sensor_faults",
             {{{"kind", "drifting"}, {"from_s", 1}, {"to_s", 2}, {"rate_N_per_s", 0.1}},
              {{"kind", "wrong_scale"}, {"from_s", 3}, {"to_s", 4}, {"factor", 2}}}}}}};
}

/// A station on which nothing is simulated.
json realStation() {
  return {{"device", {{"driver", "replay"}, {"recording", "session.palpa"}}},
          {"camera",
           {{"driver", "webcam"},
            {"device", "/dev/video0"},
            {"exposure_ms", 10},
            {"gain", 1},
            {"focus", 2}}},
          {"force_sensor",
           {{"driver", "net_ft"},
            {"address", "192.168.1.1"},
            {"port", 49152},
            {"start_code", 2},
            {"counts_per_N", 1e6},
            {"counts_per_Nm", 1e6}}},
          {"tracker",
           {{"driver", "plus"},
            {"transform", "ReferenceToCamera"},
            {"host", "localhost"},
            {"port", 18944},
            {"X_CK", kPose},
            {"X_RW", kPose},
            {"latency_ms", 10},
            {"stale_ms", 100},
            {"sigma_mm", 0.3},
            {"sigma_deg", 0.1},
            {"ask_tdata_ms", 10}}},
          {"twin", nullptr}};
}

/// Of the experts' ranges those of two tasks: the others are of the same form.
json aTaskOfEach() {
  const fs::path file = station::assetFile("tasks/expert_ranges.json");
  json others = json::object();
  for (const auto& [id, group] : evidence::readExpertRanges(file))
    if (id != "bone_pin" && id != "pulse") others[id] = nullptr;
  return {{"tasks", others}};
}

Kind stationKind() {
  return {
      .name = "station",
      .samples = {{"stations/virtual_bench.json", crowdedBench()},
                  {"stations/palpation_bench.json", faultySensor()},
                  {"stations/search_bench.json", json::object()},
                  {"stations/falcon.json", {{"device", {{"firmware", "falcon.bin"}}}}},
                  {"stations/palpation_bench.json", realStation()}},
      .read = [](const fs::path& file) { readTwin(station::readStation(file)); },
      // What a driver may be told is its own: the program knows. Force and stiffness of the device
      // bound those of the station; a virtual camera's picture is there before the next; tags and
      // names of boards are unlike; a fault ends later than it begins; one transform's name has one
      // "To".
      .stricter = {"/device/.*", "/device with an unknown field", "/safety/max_force_N.*",
                   "/coupling/stiffness_N_per_m.*", "/camera/latency_ms.*", "/camera/rate_Hz.*",
                   "/(board|marker)/.*", " without boards", "/boards.*", "/real_things/0/on.*",
                   "/twin/board_moves/0/board.*", "/twin/(camera|sensor)_faults/./(from|to)_s.*"},
      .forgiving = {},
      .elsewhere = {
          "/twin/(samples|objects|landmark_spread_mm|X_EM|camera_sway_mm|tracking_figures).*",
          "/twin without camera_sway_mm"}};
}

std::vector<Kind> taskKinds() {
  return {{.name = "task_needle",
           .samples = {{"tasks/bone_pin.json",
                        {{"end", {{"most_passes", {{"assessed", 3}, {"practice", 0}}}}}}},
                       {"tasks/paracentesis.json", json::object()},
                       {"tasks/paracentesis_guided.json", json::object()}},
           .read = [](const fs::path& file) { task_needle::readTask(file); },
           // Parts and organs are asked for by name; what is kept out of stands beside a cue that
           // keeps out; a band ends above where it begins.
           .stricter = {"/goal/part.*", "/subtasks.*", "/augmentations/./subtask.*",
                        "/augmentations/./(from|to)_Hz.*", "/augmentations as .*", "/keep_out.*",
                        " without (augmentations|keep_out)"},
           .forgiving = {"/words as .*", "/words/(tissues|organs) as (null|\\[\\])"},
           .elsewhere = {}},
          {.name = "task_palpation",
           .samples = {{"tasks/palpation_breast.json", json::object()},
                       {"tasks/palpation_abdomen.json", json::object()},
                       {"tasks/palpation_taken.json", json::object()}},
           .read = [](const fs::path& file) { task_palpation::readPalpation(file); },
           // Parts and lumps are asked for by name; lumps lie inside the area, this inside the
           // phantom; pressures rise; probabilities add up to 1.
           .stricter = {"/lumps.*", "/subtasks.*", "/augmentations/./subtask.*", "/area/.*",
                        "/phantom/.*", "/cases/.*", "/pressure/.*", "/anatomy/.*", "/real_lump/.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "task_search",
           .samples = {{"tasks/search.json", json::object()}},
           .read = [](const fs::path& file) { task_search::readSearch(file); },
           // Elements, grooves and pits leave each other room.
           .stricter = {"/stimulus/.*", "/subtasks.*", "/augmentations/./subtask.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "task_squeeze",
           .samples = {{"tasks/squeeze.json", json::object()}},
           .read = [](const fs::path& file) { task_comparison::readSqueeze(file); },
           .stricter = {"/lumps.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "task_friction",
           .samples = {{"tasks/friction.json", json::object()}},
           .read = [](const fs::path& file) { task_comparison::readFriction(file); },
           // Surfaces differ by more than rounding, and there are enough of them.
           .stricter = {"/lumps.*", "/sort/(friction|surfaces).*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "task_pulse",
           .samples = {{"tasks/pulse.json", json::object()}},
           .read = [](const fs::path& file) { task_pulse::readPulse(file); },
           // Least below most, milliseconds that rise, shares that add up to 1.
           .stricter = {"/lumps.*", "/arteries/.*/(least|most)_depth_mm.*",
                        "/arteries/.*/(ejection|reflection|valve).*", "/rhythms/.*",
                        "/heart/(fewest|most)_between.*", "/patients/.*"},
           .forgiving = {},
           .elsewhere = {}}};
}

void sealCalibration(json* file) {
  if (!file->is_object() || !file->contains("sha256")) return;
  file->erase("sha256");
  (*file)["sha256"] = sha256(file->dump());
}

std::vector<Kind> materialKinds() {
  return {{.name = "needle_material",
           .samples = {{"materials/needle.json", json::object()},
                       {"materials/bone_pin.json", json::object()}},
           .read = [](const fs::path& file) { station::readNeedleFile(file); },
           .stricter = {"/skin/puncture_(low|high)_N.*"},  // the least is not above the most
           .forgiving = {},
           .elsewhere = {}},
          {.name = "lumps",
           .samples = {{"materials/lumps.json", json::object()}},
           .read = [](const fs::path& file) { station::readLumps(file); },
           // files that must exist
           .stricter = {"/surface.*", "/friction.*", "/kinds/./identified.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "surfaces",
           .samples = {{"materials/surfaces.json", json::object()}},
           .read =
               [](const fs::path& file) {
                 twin::readSoftSurfaces(file);
                 for (const std::string& name : station::surfacesIn(file))
                   station::withSurface({}, file, name);
               },
           // files that must exist
           .stricter = {"/surfaces/./(material|friction).*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "calibration",
           .samples = {{"materials/lumps/large.json", json::object()},
                       {"materials/lumps/material.json",
                        {{"rests_on", {{{"kind", "friction"}, {"sha256", "0"}}}},
                         {"data", {{"files", {{{"name", "samples.csv"}, {"sha256", "0"}}}}}}}}},
           .read = [](const fs::path& file) { station::readCalibration(file); },
           // A covariance is as large as its coordinates, and symmetric; no more samples are used
           // than there were.
           .stricter = {"/covariance.*", "/data/(samples|used).*"},
           .forgiving = {"/covariance/coordinates as (null|\\{\\})"},
           .elsewhere = {"/sha256.*"},  // renewed after each change
           .free = {"/parameters/.*"},  // each routine has its own
           .seal = sealCalibration}};
}

std::vector<Kind> phantomKinds() {
  return {{.name = "phantoms",
           .samples = {{"phantoms/mockups.json", json::object()}},
           .read = [](const fs::path& file) { twin::readPhantoms(file); },
           // Tools stay on the block and apart, lumps in it.
           .stricter = {"/tool_radius_mm.*", "/block/.*", "/table/.*", "/pairs/.*",
                        "/phantoms/./lump/.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "rough_surfaces",
           .samples = {{"phantoms/textures/surfaces.json", json::object()}},
           .read = [](const fs::path& file) { twin::readRoughBench(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "phantom_tables",
           .samples = {{"phantoms/mockups.tables.json", json::object()}},
           .read =
               [](const fs::path& file) {
                 twin::readSolved(file.parent_path() / "mockups.json", file);
               },
           // Of the phantoms as they are, with as many cells as these ask for.
           .stricter = {"/made_of.*", "/tables.*", "/pairs.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "layered_phantoms",
           .samples = {{"phantoms/layered.json", json::object()}},
           .read = [](const fs::path& file) { twin::readLayered(file); },
           // The tool stays on the block.
           .stricter = {"/tool_radius_mm.*", "/block/.*", "/table/.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "layered_tables",
           .samples = {{"phantoms/layered.tables.json", json::object()}},
           .read =
               [](const fs::path& file) {
                 twin::readSolvedLayered(file.parent_path() / "layered.json", file);
               },
           .stricter = {"/made_of.*", "/tables.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "opposed_phantoms",
           .samples = {{"phantoms/opposed.json", json::object()}},
           .read = [](const fs::path& file) { twin::readOpposed(file); },
           // The tools stay off the frame and leave something between them; so do the lumps.
           .stricter = {"/tool_radius_mm.*", "/block/.*", "/table/.*",
                        "/phantoms/./lump/diameter_mm.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "opposed_tables",
           .samples = {{"phantoms/opposed.tables.json", json::object()}},
           .read =
               [](const fs::path& file) {
                 twin::readSolvedOpposed(file.parent_path() / "opposed.json", file);
               },
           .stricter = {"/made_of.*", "/tables.*", "/under.*"},
           .forgiving = {},
           .elsewhere = {}}};
}

std::vector<Kind> patientKinds() {
  const json point{{"at", {0, 0, 0}}, {"unit", "mm"}, {"axes", "RAS"}, {"why", "a test"}};
  return {
      {.name = "population",
       .samples = {{"patients/reference.json", json::object()}},
       .read = [](const fs::path& file) { anatomy::readPopulation(file.string()); },
       .stricter = {"/[a-z_]+/(mean|sd|range).*"},  // the mean lies in the range
       .forgiving = {},
       .elsewhere = {}},
      {.name = "patient_map",
       .samples = {{"patients/bodyparts3d_hra.json",
                    {{"landmarks", {{"entry_point", point}}}, {"origin", point}}},
                   {"patients/bodyparts3d_hra_skin.json", json::object()}},
       .read = [](const fs::path& file) { anatomy::readImportMap(file); },
       .stricter = {" without (unit|axes)"},  // entries that state neither need these
       .forgiving = {},
       .elsewhere = {}},
      {.name = "board",
       .samples = {{"boards/table.json", json::object()}},
       .read = [](const fs::path& file) { ar::readTagGrid(file); },
       // Enough white round a tag, no tag beyond the family.
       .stricter = {"/(columns|rows|tag_size_m|spacing_m|first_id) .*"},
       .forgiving = {},
       .elsewhere = {}},
      {.name = "camera",
       .samples = {{"own/camera.json",
                    {{"type", "camera_model"},
                     {"version", 1},
                     {"unit", "px"},
                     {"width", 640},
                     {"height", 480},
                     {"fx", 602.5},
                     {"fy", 601.5},
                     {"cx", 322.5},
                     {"cy", 237.5},
                     {"distortion", {-0.21, 0.09, 0.0006, -0.0004, 0.0}},
                     {"rms_px", 0.2}}}},
       .read = [](const fs::path& file) { calibration::readCameraModel(file); },
       // Sizes fit each other, and the lens does not fold the picture.
       .stricter = {"/(width|height|fx|fy|cx|cy|distortion).*"},
       .forgiving = {},
       .elsewhere = {}},
      {.name = "expert_path",
       .samples = {{"tasks/paracentesis_expert_path.json", json::object()},
                   {"tasks/paracentesis_published_expert_path.json", json::object()}},
       .read = [](const fs::path& file) { calibration::readExpertPath(file); },
       .stricter = {"/direction(_L)?/.*"},  // a unit vector
       .forgiving = {},
       .elsewhere = {}},
      {.name = "expert_ranges",
       .samples = {{"tasks/expert_ranges.json", aTaskOfEach()}},
       .read = [](const fs::path& file) { evidence::readExpertRanges(file); },
       // Names of figures are the program's; low, middle and high are in their order.
       .stricter = {"/tasks/[^/]*/figures.*"},
       .forgiving = {},
       .elsewhere = {},
       .free = {"/tasks/[^/]*"}},
      {.name = "interactive_procedures",
       .samples = {{"interactions/procedures.json", json::object()}},
       .read = [](const fs::path& file) { calibration::readProcedures(file); },
       // Procedures are asked for by name, each once; of two figures the second is the larger; the
       // mean duration is not below the least.
       .stricter = {"/procedures as .*", "/procedures/.*/(name|least_ms|mean_ms|profiles).*",
                    "/labels/.*/procedure.*", "/any/.*"},
       .forgiving = {},
       .elsewhere = {}},
      {.name = "seeds",
       .samples = {{"own/seeds.json",
                    {{"format", "palpa-seeds"},
                     {"unit", "mm"},
                     {"frame", "the volume's"},
                     {"points", {{"vein_svc", {149.1, -201.1, -80.5}}, {"midline", {0, 0, 0}}}}}}},
       .read = [](const fs::path& file) { anatomy::readSeeds(file); },
       .stricter = {},
       .forgiving = {},
       .elsewhere = {}}};
}

/// With the kind of analysis, which is read when a study is analysed.
void readWholeProtocol(const fs::path& path) {
  study::readProtocol(path);
  const JsonFile file(path);
  if (file.has("analysis"))
    study_analysis::studyKindNamed(file.text("analysis"), path.string() + ", field \"analysis\"");
}

void readLearnersOf(const fs::path& file, const char* protocol) {
  study::readLearners(file, study::readProtocol(file.parent_path().parent_path() / protocol));
}

std::vector<Kind> studyKinds() {
  const json learners_about = {{"about", "a test"}};
  return {{.name = "protocol",
           .samples = {{"protocols/search_study.json",
                        {{"always", {{"guide", false}, {"mode", "real"}}}, {"excluded", {"T001"}}}},
                       {"protocols/paracentesis_pilot.json", json::object()}},
           .read = readWholeProtocol,
           // Conditions are asked for by name, none in vain; tasks and questionnaires must exist; a
           // rest has a length; blocks of an allocation can be balanced.
           // Presentations are asked for by name, too.
           .stricter = {"/conditions.*", " without allocation", "/allocation/.*", "/sessions.*",
                        "/always/presentation.*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "presentation",
           .samples = {{"presentations/pilot.json", json::object()},
                       {"presentations/practice.json", json::object()}},
           .read = [](const fs::path& file) { presentation::readPresentation(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "questionnaire",
           .samples = {{"protocols/questionnaires/search_study.json", json::object()},
                       {"protocols/questionnaires/paracentesis_pilot.json", json::object()}},
           .read = [](const fs::path& file) { study::readQuestionnaire(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "learners",
           .samples = {{"protocols/learners/search_learners.json", learners_about},
                       {"protocols/learners/paracentesis_learners.json", learners_about}},
           .read =
               [](const fs::path& file) {
                 const bool search = file.filename().string().starts_with("search");
                 readLearnersOf(file, search ? "search_study.json" : "paracentesis_pilot.json");
               },
           .stricter = {"/(groups|conditions)/./name.*"},  // those of the protocol
           .forgiving = {},
           .elsewhere = {}},
          {.name = "checklist",
           .samples = {{"checklists/subclavian.json", json::object()}},
           .read =
               [](const fs::path& file) {
                 competence::parseChecklist(test::slurp(file), file.string());
               },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "global_rating",
           .samples = {{"checklists/global_rating.json", json::object()}},
           .read =
               [](const fs::path& file) {
                 competence::parseGlobalRating(test::slurp(file), file.string());
               },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}}};
}

Kind campaignKind() {
  const json other_patient{
      "../patients/bodyparts3d_hra.json"};  // what it holds is the session's question
  const auto session_of = [](const char* task, const json& setting) {
    return json{{"tasks", {std::string("../tasks/") + task}},
                {"patients", nullptr},
                {"settings", {setting}}};
  };
  return {
      .name = "campaign",
      .samples = {{"campaigns/needle_by_touch.json",
                   {{"station", "../stations/virtual_bench.json"},
                    {"patient_files", other_patient},
                    {"trials", 2},
                    {"settings",
                     {{{"name", "all"},
                       {"force_feedback", true},
                       {"augment", false},
                       {"assess", false},
                       {"knows_patient", true},
                       {"handedness", "left"},
                       {"side", "left"},
                       {"tracking", "model"},
                       {"presentation", "pilot"}}}}}},
                  {"campaigns/needle_by_touch.json",
                   session_of("palpation_breast.json", {{"name", "guided"}, {"guidance", true}})},
                  {"campaigns/needle_by_touch.json",
                   session_of("search.json", {{"name", "all"}, {"mode", "all"}})}},
      .read = [](const fs::path& file) { study::readCampaign(file); },
      // Files must be there, tasks of one engine; not too many in all.
      .stricter = {"/(tasks|station|operators|patient_files).*", "/settings/./presentation.*",
                   "/(patients|seeds)/count.*"},
      .forgiving = {},
      .elsewhere = {}};
}

std::vector<Kind> operatorKinds() {
  return {{.name = "operator_needle",
           .samples = {{"operators/expert.json", json::object()},
                       {"operators/novice.json", json::object()}},
           .read = [](const fs::path& file) { twin::readOperatorSkill(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "operator_palpation",
           .samples = {{"operators/palpation_expert.json", json::object()}},
           .read = [](const fs::path& file) { twin::readPalpatingSkill(file); },
           .stricter = {"/pressures_N/.*"},  // they rise
           .forgiving = {"/pressures_N as 7"},
           .elsewhere = {}},
          {.name = "operator_search",
           .samples = {{"operators/search_expert.json", json::object()}},
           .read = [](const fs::path& file) { twin::readSearchingSkill(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "tracking_model",
           .samples = {{"tracking/virtual_camera.json", {{"about", "a test"}}}},
           .read = [](const fs::path& file) { twin::readTrackingFigures(file); },
           // Places and distances rise; at each place six numbers.
           .stricter = {"/aside.*",
                        "/distances/[0-9]+/(distance_mm|bias_px|strength|least_width_px).*"},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "operator_squeeze",
           .samples = {{"operators/squeeze_expert.json", json::object()}},
           .read = [](const fs::path& file) { twin::readSqueezingSkill(file); },
           .stricter = {"/(hold|squeeze)_N.*"},  // to squeeze takes more than to hold
           .forgiving = {},
           .elsewhere = {}},
          {.name = "operator_friction",
           .samples = {{"operators/friction_expert.json", json::object()}},
           .read = [](const fs::path& file) { twin::readStrokingSkill(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}},
          {.name = "operator_pulse",
           .samples = {{"operators/pulse_expert.json", json::object()}},
           .read = [](const fs::path& file) { twin::readPulseSkill(file); },
           .stricter = {},
           .forgiving = {},
           .elsewhere = {}}};
}

}  // namespace

std::vector<Kind> everyKind() {
  std::vector<Kind> all{stationKind(), campaignKind()};
  for (const std::vector<Kind>& some : {taskKinds(), materialKinds(), phantomKinds(),
                                        patientKinds(), studyKinds(), operatorKinds()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace palpa::schemas
