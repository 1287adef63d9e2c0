#include <nlohmann/json.hpp>
#include <tuple>

#include "anatomy/base/whole_file.h"
#include "apps/bench/pictures/tracking_fit.h"
#include "apps/bench/pictures/tracking_scene.h"
#include "apps/bench/timing.h"
#include "apps/station/assets.h"

/// What `bench tracking` does about the tracking model: its figures as lines and as a file; the
/// model beside pictures.
namespace palpa::bench {

using twin::TrackingFigures;

namespace {

void printFigures(const TrackingFigures& figures, const std::string& station) {
  const nlohmann::json all = twin::jsonOf(figures);
  for (const nlohmann::json& distance : all.at("distances")) {
    nlohmann::json params = distance;
    params.erase("corner_sigma_px");
    params["data"] = "simulated";
    print("tracking_model.corner_sigma", distance.at("corner_sigma_px"), "px", params);
  }
  nlohmann::json params = all.at("found");
  params.erase("width_spread_px");
  params.update({{"data", "simulated"}, {"station", station}});
  print("tracking_model.width_spread", figures.width_spread, "px", params);
}

TrackingFit quickFit() {
  TrackingFit fit;
  fit.distances = {0.45, 1.0};
  fit.most_aside = fit.aside_step = 0.12;
  fit.views = 2;
  fit.seconds = {0, 0.2};
  fit.repeated = 1;
  return fit;
}

}  // namespace

void fitTrackingModel(const TrackingFitOptions& options) {
  const station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/virtual_bench.json")
                              : std::filesystem::path(options.station));
  WholeFile written(options.file);
  const TrackingFigures figures =
      fitTracking(station, options.quick ? quickFit() : TrackingFit{}, options.done);
  printFigures(figures, station.title);
  nlohmann::json file = twin::jsonOf(figures);
  file["about"] = "Errors of poses from simulated pictures, for sessions with --tracking model.";
  file["source"] = "palpa bench tracking --fit, on pictures of the virtual camera (" +
                   station.title + "), lenses of the seeds from " +
                   std::to_string(TrackingFit{}.seed) + " on";
  if (options.quick)
    file["source"] = "palpa bench tracking --fit --quick: few views, to try it out";
  twin::trackingFiguresIn(JsonFile(file, options.file));  // refuses what no session would take
  written.write(file.dump(1) + "\n");
  written.finish();
}

namespace {

double ratioOf(double model, double pictures) { return pictures > 0 ? model / pictures : 1; }

void printComparison(const PathFigures& pictures, const PathFigures& model,
                     const nlohmann::json& params) {
  const std::tuple<const char*, double PathFigures::*, const char*> all[]{
      {"shift_rms", &PathFigures::shift_mm, "mm"},
      {"turn_rms", &PathFigures::turn_mrad, "mrad"},
      {"filtered_shift_rms", &PathFigures::filtered_shift_mm, "mm"},
      {"filtered_turn_rms", &PathFigures::filtered_turn_mrad, "mrad"},
      {"tags_missed", &PathFigures::tags_missed, "1"},
      {"poses_missed", &PathFigures::poses_missed, "1"}};
  for (const auto& [name, figure, unit] : all) {
    nlohmann::json both = params;
    both.update({{"model", model.*figure}, {"pictures", pictures.*figure}, {"of", unit}});
    print(std::string("tracking_model.") + name, ratioOf(model.*figure, pictures.*figure), "1",
          both);
  }
  for (std::size_t l = 0; l < kTrackingLags.size(); ++l) {
    nlohmann::json both = params;
    both.update({{"model", model.autocorrelation[l]},
                 {"pictures", pictures.autocorrelation[l]},
                 {"lag_pictures", kTrackingLags[l]}});
    print("tracking_model.autocorrelation_difference",
          model.autocorrelation[l] - pictures.autocorrelation[l], "1", both);
  }
}

}  // namespace

void benchTrackingModel(const TrackingModelOptions& options) {
  const station::Station station = station::readStation(
      options.station.empty() ? station::assetFile("stations/virtual_bench.json")
                              : std::filesystem::path(options.station));
  const TrackingFigures figures = twin::trackingFiguresOf(station);
  std::vector<TrackedSession> pictures, model;
  for (int i = 0; i < options.sessions; ++i) {
    const std::uint64_t seed = options.seed + std::uint64_t(i);
    pictures.push_back(
        trackedSession(station, seed, options.pictures, TrackedBy::pictures, figures));
    model.push_back(trackedSession(station, seed, options.pictures, TrackedBy::model, figures));
    if (options.done) options.done((i + 1.0) / options.sessions);
  }
  printComparison(figuresOf(pictures), figuresOf(model),
                  {{"sessions", options.sessions},
                   {"pictures_each", options.pictures},
                   {"seed", options.seed},
                   {"data", "simulated"}});
}

}  // namespace palpa::bench
