#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/station/station_file.h"
#include "apps/twin/tracking_model.h"

/// The tracking model and the pictures that it stands for: measured there, and judged beside them
/// on other seeds.
namespace palpa::bench {

/// Called with the share that is done.
using ShareDone = std::function<void(double)>;

struct TrackingFit {
  /// m: dense where the shipped benches have their camera, and on both sides of where the virtual
  /// camera changes its texture (0.633 and 0.895 m, VirtualCamera)
  /// and where the picture's edge begins to cut tags (nearer than 0.48 m)
  std::vector<double> distances{0.45, 0.46,  0.465, 0.47, 0.475, 0.48, 0.5, 0.53,
                                0.62, 0.645, 0.75,  0.88, 0.91,  0.95, 1.0};
  double most_aside = 0.12, aside_step = 0.02;  ///< share of the distance
  int views = 16;                               ///< of each place, each with a lens of its own
  /// when pictures of a view are taken, as the camera sways
  std::vector<double> seconds{0, 1 / 15.0, 2 / 15.0, 3 / 15.0, 8 / 15.0, 9 / 15.0, 1, 2};
  std::size_t repeated = 2;   ///< of these, taken a second time
  std::uint64_t seed = 5001;  ///< of the first lens
};

/// Of the station's camera and board, from pictures of the virtual camera.
twin::TrackingFigures fitTracking(const station::Station& station, const TrackingFit& fit,
                                  const ShareDone& done = {});

/// How wide a tag was in a picture, at its narrowest, px; whether it was found there.
struct TagChance {
  double width = 0;
  bool found = false;
};

/// Where tags cease to be found: the normal distribution of largest likelihood. Where none was
/// missed, every width is enough.
struct TagWidths {
  double least = 0, spread = 1;  ///< mean and standard deviation of the width that it takes, px
};
TagWidths fitTagWidths(const std::vector<TagChance>& tags);
/// The mean with which as many of these tags would be found as were; `otherwise`: where all were,
/// or none.
double leastWidthOf(const std::vector<TagChance>& tags, double spread, double otherwise);
/// Which share of the variance two pictures of one pose have in common, by how often they disagree
/// about a tag.
double lastingShareOf(const std::vector<std::array<TagChance, 2>>& tags, const TagWidths& widths);

/// `palpa bench tracking --fit FILE`: the figures of the station's camera and board, one JSON
/// object a line, and all of them as a file. Throws Error.
struct TrackingFitOptions {
  std::string station, file;  ///< station file (empty: the virtual bench); where the figures go
  bool quick = false;         ///< few views, to try it out: such figures are good for nothing else
  ShareDone done;
};
void fitTrackingModel(const TrackingFitOptions& options);

/// `palpa bench tracking --model`: pose errors by the model beside those of pictures, on other
/// seeds than the figures are from. One JSON object a line.
struct TrackingModelOptions {
  std::string station;
  int sessions = 800, pictures = 45;
  std::uint64_t seed = 80001;
  ShareDone done;
};
void benchTrackingModel(const TrackingModelOptions& options);

}  // namespace palpa::bench
