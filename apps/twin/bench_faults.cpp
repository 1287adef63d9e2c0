#include "apps/twin/bench_faults.h"

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/units.h"
#include "anatomy/geometry/pose.h"

namespace palpa::twin {
namespace {

constexpr double kLongest_s = 86'400;

}  // namespace

std::vector<BoardMove> readBoardMoves(const station::Station& station) {
  std::vector<BoardMove> moves;
  const JsonFile& file = station.file;
  if (!file.has("twin/board_moves")) return moves;
  const nlohmann::json& list = file.json().at("twin").at("board_moves");
  if (!list.is_array()) file.refuse("twin/board_moves", "must be a list");
  for (const nlohmann::json& item : list) {
    const JsonFile entry(item, file.name() + ", \"twin/board_moves\"");
    const std::string name = entry.text("board");
    BoardMove move;
    while (move.board < station.boards.size() && station.boards[move.board].name != name)
      ++move.board;
    if (move.board == station.boards.size() || !station.boards[move.board].X_WB)
      entry.refuse("board", "is \"" + name + "\", which is not a board with an X_WB");
    move.from = entry.number("from_s", 0, kLongest_s);
    move.by = kMm * unpack(entry.triple("by_mm"));
    moves.push_back(move);
  }
  return moves;
}

std::vector<std::pair<std::size_t, Pose>> boardsAt(const station::Station& station,
                                                   const std::vector<BoardMove>& moves, double t) {
  std::vector<std::pair<std::size_t, Pose>> boards;
  for (std::size_t i = 0; i < station.boards.size(); ++i) {
    if (!station.boards[i].X_WB) continue;
    Pose X_WB = *station.boards[i].X_WB;
    for (const BoardMove& move : moves)
      if (move.board == i && t >= move.from) X_WB.translation() += move.by;
    boards.emplace_back(i, X_WB);
  }
  return boards;
}

namespace {

constexpr int kCloth = 110, kDark = 30;  // a gray level; by what a covered lens divides the light

constexpr std::pair<const char*, CameraFaultKind> kCameraFaults[] = {
    {"hidden", CameraFaultKind::hidden}, {"black", CameraFaultKind::black},
    {"frozen", CameraFaultKind::frozen}, {"wrong_size", CameraFaultKind::wrong_size},
    {"gone", CameraFaultKind::gone},     {"ended", CameraFaultKind::ended}};

}  // namespace

std::vector<CameraFault> readCameraFaults(const JsonFile& file) {
  return readFaults<CameraFault>(
      file, "camera_faults", [](const JsonFile& entry, double from, double to) {
        return CameraFault{faultKind<CameraFaultKind>(entry, kCameraFaults), from, to};
      });
}

const CameraFault* faultAt(const std::vector<CameraFault>& faults, double t) {
  for (const CameraFault& fault : faults)
    if (t >= fault.from && (t < fault.to || fault.kind == CameraFaultKind::ended)) return &fault;
  return nullptr;
}

std::optional<ar::Frame> spoilt(ar::Frame frame, const CameraFault& fault) {
  switch (fault.kind) {
    case CameraFaultKind::hidden:
      frame.image.setTo(kCloth);
      return frame;
    case CameraFaultKind::black:
      frame.image /= kDark;
      return frame;
    case CameraFaultKind::wrong_size:
      cv::resize(frame.image, frame.image, frame.image.size() / 2);
      return frame;
    case CameraFaultKind::gone:
      throw Error("no picture within a second", frame.source, "Look at its cable");
    case CameraFaultKind::ended:
      return std::nullopt;
    case CameraFaultKind::frozen:
      break;  // the caller shows the same moment again
  }
  return frame;
}

namespace {

constexpr std::pair<const char*, SensorFaultKind> kSensorFaults[] = {
    {"unplugged", SensorFaultKind::unplugged},
    {"saturated", SensorFaultKind::saturated},
    {"drifting", SensorFaultKind::drifting},
    {"reversed", SensorFaultKind::reversed},
    {"wrong_scale", SensorFaultKind::wrong_scale}};

void scale(double factor, const haptics::Wrench& zero, haptics::WrenchSample* sample) {
  for (std::size_t i = 0; i < 3; ++i) {
    sample->f_S[i] = zero.f_S[i] + factor * (sample->f_S[i] - zero.f_S[i]);
    sample->tau_S[i] = zero.tau_S[i] + factor * (sample->tau_S[i] - zero.tau_S[i]);
  }
}

}  // namespace

std::vector<SensorFault> readSensorFaults(const JsonFile& file) {
  return readFaults<SensorFault>(
      file, "sensor_faults", [](const JsonFile& entry, double from, double to) {
        SensorFault fault{faultKind<SensorFaultKind>(entry, kSensorFaults), from, to, 0};
        if (fault.kind == SensorFaultKind::drifting)
          fault.amount = entry.number("rate_N_per_s", -10, 10);
        if (fault.kind == SensorFaultKind::wrong_scale)
          fault.amount = entry.number("factor", 0, 100);
        return fault;
      });
}

bool spoil(const std::vector<SensorFault>& faults, double t, const haptics::Wrench& zero,
           haptics::WrenchSample* sample) {
  for (const SensorFault& fault : faults) {
    if (t < fault.from || t >= fault.to) continue;
    switch (fault.kind) {
      case SensorFaultKind::unplugged:
        return false;
      case SensorFaultKind::saturated:
        sample->flags |= haptics::kSaturated;
        break;
      case SensorFaultKind::drifting:
        sample->f_S[2] += fault.amount * (t - fault.from);
        break;
      case SensorFaultKind::reversed:
        scale(-1, zero, sample);
        break;
      case SensorFaultKind::wrong_scale:
        scale(fault.amount, zero, sample);
        break;
    }
  }
  return true;
}

}  // namespace palpa::twin
