#pragma once

#include <optional>
#include <string>

#include "apps/link/igtl/igtl_server.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"

namespace palpa::igt {

/// Where a session is served, and what of its station does not change.
struct IgtlLinkSetup {
  std::string ipv4 = "127.0.0.1";
  std::uint16_t port = 0;
  std::int64_t utc_start_ns = 0;  ///< UTC of session time 0
  std::string tool = "Needle";    ///< as its names begin: "Needle", "Probe"
  Pose X_WA = Pose::Identity(), X_WD = Pose::Identity(), X_ET = Pose::Identity();
  std::optional<Pose> second_X_WD{};  ///< of a second tool
  std::optional<Pose> X_WP{};         ///< of the phantom
};

/// A running session, told to whoever connects: tool, camera, patient and phantom in W, forces,
/// events, where the trial and the tool's tip stand. Reads the bus as any activity does and never
/// waits. The tables of names: README.
class IgtlLink final : public runtime::Activity {
 public:
  static constexpr std::int64_t
      kStep_ns = 10'000'000,
      kShow_ns = 20'000'000;  ///< TDATA at most every 10 ms; TRANSFORM and SENSOR at 50 Hz

  IgtlLink(const IgtlLinkSetup& setup, runtime::Bus& bus);
  const char* name() const override { return "igtl"; }
  std::int64_t step(std::int64_t now_ns) override;

  const IgtlServer& server() const { return server_; }

 private:
  void addTool(const std::string& tool, const runtime::ToolState& state, const Pose& X_WD,
               ShownMoment& moment) const;
  void sendEvidence();
  void sendPhase(const runtime::ToolState& tool, std::int64_t utc_ns);
  ShownMoment momentAt(std::int64_t now_ns);
  std::int64_t utc(std::int64_t t_ns) const { return setup_.utc_start_ns + t_ns; }

  const IgtlLinkSetup setup_;
  runtime::Bus& bus_;
  IgtlServer server_;
  std::int64_t next_show_ns_ = 0;
  std::string phase_;  ///< as it was told last
  int running_ = 0;    ///< the trial that is on; 0: none
};

}  // namespace palpa::igt
