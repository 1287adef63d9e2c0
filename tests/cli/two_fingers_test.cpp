#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "csv_rows.h"
#include "guide_script.h"
#include "program.h"
#include "tests/support/counts.h"

/// Two fingers that search soft tissue for lumps, as an educator runs it; every force that was
/// added computed once more, from what `palpa export` writes, by code of its own.
namespace palpa::cli_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d, nlohmann::json;

/// Hunt and Crossley: x^m max(k + b x', k / 10).
struct SoftLaw {
  double k, b, m;
  explicit SoftLaw(const json& j) : k(j.at("k")), b(j.at("b")), m(j.at("m")) {}
  double factor(double rate) const { return std::max(k + b * rate, 0.1 * k); }
  double force(double x, double rate) const { return x > 0 ? std::pow(x, m) * factor(rate) : 0; }
  double depth(double f, double rate) const { return std::pow(f / factor(rate), 1 / m); }
};

/// The real surface under one finger: normal, depth, friction (10.6 and what the published normal
/// lacks; Dahl's friction).
class FeltSurface {
 public:
  explicit FeltSurface(const json& laws)
      : H_(laws.at("surface").at("H")),
        x0_(laws.at("surface").at("x0_m")),
        least_(laws.at("surface").at("least_contact_N")),
        mu_(laws.at("surface").at("friction").at("mu")),
        sigma_(laws.at("surface").at("friction").at("sigma_N_per_m")),
        B_(laws.at("surface").at("friction").at("B_Ns_per_m")),
        dt_(laws.at("period_s")) {}

  bool touches = false;
  Vector3d u = Vector3d::UnitZ(), f_t = Vector3d::Zero();  // normal; friction, N
  double x = 0, f_n = 0;

  void feel(const Vector3d& p, const Vector3d& f_r) {
    const Vector3d dp = before_ ? Vector3d(p - *before_) : Vector3d::Zero();
    before_ = p;
    touches = f_r.norm() >= least_;
    if (!touches) return forget();
    if (f_last_ == 0) u_s_ = f_r.normalized(), f_last_ = f_r.norm(), fresh_ = true;
    const Vector3d slid = slidIn(dp), normal = f_r + drag(slid);
    f_n = normal.norm();
    touches = f_n >= least_;
    if (!touches) return forget();
    u = normal / f_n;
    f_t = f_r - f_n * u;
    x = std::max(0.0, x0_ + H_.depth(f_n, -dp.dot(u) / dt_));
    turn(slid.norm());
    f_last_ = f_n;
    fresh_ = false;
  }

 private:
  void forget() {
    f_last_ = told_ = f_n = x = 0;
    drag_.setZero();
  }
  /// What goes within a few degrees of the normal is pressing.
  Vector3d slidIn(const Vector3d& dp) const {
    const Vector3d across = dp - dp.dot(u_s_) * u_s_;
    const double pressed = (0.05 + 0.01 / f_last_) * std::abs(dp.dot(u_s_));
    return across.norm() > pressed ? Vector3d(across * (1 - pressed / across.norm()))
                                   : Vector3d::Zero();
  }
  Vector3d drag(const Vector3d& slid) {
    const double most = mu_ * f_last_, size = drag_.norm();
    drag_ -= drag_.dot(u_s_) * u_s_;
    if (drag_.norm() > 1e-12) drag_ *= size / drag_.norm();
    if (slid.norm() > 0) {
      const Vector3d to = most * slid.normalized();
      drag_ = to + std::exp(-sigma_ * slid.norm() / most) * (drag_ - to);
    }
    if (drag_.norm() > most) drag_ *= most / drag_.norm();
    return drag_ + B_ / dt_ * slid;
  }
  void turn(double slid) {
    double share = 0;
    if (!fresh_) share = slid > 0 ? 1 - std::exp(-slid / 1e-4) : 1 - std::min(told_ / f_n, 1.0);
    told_ = std::max(told_, f_n);
    u_s_ = (u_s_ + share * (u - u_s_)).normalized();
  }

  SoftLaw H_;
  double x0_, least_, mu_, sigma_, B_, dt_;
  std::optional<Vector3d> before_;
  Vector3d u_s_ = Vector3d::UnitZ(), drag_ = Vector3d::Zero();
  double f_last_ = 0, told_ = 0;
  bool fresh_ = false;
};

/// A lump in its bed under both fingers: (10.18) to (10.20), by Newton's method on differences.
class FeltLump {
 public:
  FeltLump(const json& kind, const json& place, double radius, double dt)
      : l0_(kind.at("l0_m")),
        H_T_(kind.at("H_T")),
        G_{SoftLaw(kind.at("G")[0]), SoftLaw(kind.at("G")[1]), SoftLaw(kind.at("G")[2])},
        p_T0_(place.at("p_P_m")[0], place.at("p_P_m")[1], place.at("p_P_m")[2]),
        radius_(radius),
        dt_(dt) {}

  std::array<Vector3d, 2> press(const std::array<FeltSurface, 2>& fingers,
                                const std::array<Vector3d, 2>& middles) {
    std::array<Vector3d, 2> f;
    std::array<double, 2> l{};
    const auto left = [&](const Vector3d& d) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t t = 0; t < 2; ++t) sum += f[t] = push(fingers[t], middles[t], d, t, &l[t]);
      for (int i = 0; i < 3; ++i) {
        const double side = d[i] < 0 ? -1 : 1;
        sum[i] +=
            side * G_[static_cast<std::size_t>(i)].force(side * d[i], side * (d[i] - d_[i]) / dt_);
      }
      return sum;
    };
    Vector3d d = d_, off = left(d);
    for (int i = 0; i < 100 && off.norm() > 1e-7; ++i) {
      Matrix3d slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d step = 1e-8 * Vector3d::Unit(axis);
        slope.col(axis) = (left(d + step) - left(d - step)) / 2e-8;
      }
      Vector3d move = -slope.fullPivLu().solve(off);
      for (int halved = 0; halved < 30 && left(d + move).norm() >= off.norm(); ++halved) move /= 2;
      if (left(d + move).norm() >= off.norm()) break;
      d += move;
      off = left(d);
    }
    left(d);
    d_ = d;
    l_ = l;
    return f;
  }

 private:
  Vector3d push(const FeltSurface& finger, const Vector3d& p_M, const Vector3d& d, std::size_t t,
                double* l) const {
    *l = 0;
    if (!finger.touches) return Vector3d::Zero();
    const Vector3d p_H = p_M - radius_ * finger.u;
    const double l0 = (p_H + finger.x * finger.u - p_T0_).norm();
    *l = std::max(l0_ / l0 * (l0 - (p_H - p_T0_ - d).norm()), 0.0);
    return H_T_.force(*l, (*l - l_[t]) / dt_) * (p_M - p_T0_ - d).normalized();
  }

  double l0_;
  SoftLaw H_T_;
  std::array<SoftLaw, 3> G_;
  Vector3d p_T0_;
  double radius_, dt_;
  Vector3d d_ = Vector3d::Zero();
  std::array<double, 2> l_{};
};

/// The columns of a table that are asked for, line by line.
class Columns {
 public:
  Columns(const std::filesystem::path& csv, const std::vector<std::string>& names) : in_(csv) {
    std::getline(in_, line_);
    const std::vector<std::string> header = cellsOf(line_);
    for (const std::string& name : names)
      at_.push_back(
          static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin()));
    values.resize(names.size());
  }
  std::vector<double> values;
  bool next() {
    if (!std::getline(in_, line_)) return false;
    std::vector<const char*> cells{line_.c_str()};
    for (const char& c : line_)
      if (c == ',') cells.push_back(&c + 1);
    for (std::size_t i = 0; i < at_.size(); ++i)
      std::from_chars(cells.at(at_[i]), line_.c_str() + line_.size(), values[i]);
    return true;
  }
  Vector3d three(std::size_t from) const {
    return {values[from], values[from + 1], values[from + 2]};
  }

 private:
  std::ifstream in_;
  std::string line_;
  std::vector<std::size_t> at_;
};

/// One trial, felt again.
class FeltAgain {
 public:
  FeltAgain(const json& laws, const std::string& trial)
      : radius_(laws.at("tip_radius_m")), fingers{FeltSurface(laws), FeltSurface(laws)} {
    for (std::size_t t = 0; t < 2; ++t) {
      const json& p = laws.at("X_DP").at(t).at("p_m");
      const json& q = laws.at("X_DP").at(t).at("q_wxyz");
      X_DP_[t] = Eigen::Translation3d(p[0], p[1], p[2]) *
                 Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    }
    for (const json& lump : laws.at("lumps").at(trial))
      lumps_.emplace_back(laws.at("kinds").at(lump.at("kind").get<std::size_t>() - 1), lump,
                          radius_, laws.at("period_s"));
  }

  /// In D of each device, N.
  std::array<Vector3d, 2> added(const std::array<Vector3d, 2>& p_DM,
                                const std::array<Vector3d, 2>& f_D) {
    std::array<Vector3d, 2> middles, sum{Vector3d::Zero(), Vector3d::Zero()};
    for (std::size_t t = 0; t < 2; ++t) {
      middles[t] = X_DP_[t].inverse() * p_DM[t];
      fingers[t].feel(middles[t], X_DP_[t].linear().transpose() * f_D[t]);
    }
    for (FeltLump& lump : lumps_) {
      const std::array<Vector3d, 2> f = lump.press(fingers, middles);
      for (std::size_t t = 0; t < 2; ++t)
        if (fingers[t].touches)
          sum[t] += f[t] + fingers[t].f_t * (f[t].dot(fingers[t].u) / fingers[t].f_n);
    }
    return {X_DP_[0].linear() * sum[0], X_DP_[1].linear() * sum[1]};
  }

 private:
  double radius_;
  std::array<Eigen::Isometry3d, 2> X_DP_;
  std::vector<FeltLump> lumps_;

 public:
  std::array<FeltSurface, 2> fingers;
};

/// What the session of two fingers added against that, tick by tick.
struct Agreement {
  int ticks = 0, both = 0;  // both: with a lump felt by both fingers
  double worst_N = 0, worst_depth = 0, most_N = 0;
};

Agreement agreement(const std::filesystem::path& csv, const json& laws) {
  Columns table(csv, {"tool", "trial", "armed", "f_contact_D_x_N", "f_contact_D_y_N",
                      "f_contact_D_z_N", "f_sensed_D_x_N", "f_sensed_D_y_N", "f_sensed_D_z_N",
                      "p_sensed_D_x_m", "p_sensed_D_y_m", "p_sensed_D_z_m", "indentation_m"});
  FeltAgain again(laws, "1");
  Agreement all;
  std::array<Vector3d, 2> p, f, told;
  std::array<double, 2> depth{};
  while (table.next()) {
    if (table.values[1] != 1) continue;
    const std::size_t tool = table.values[0] == 0 ? 0 : 1;
    told[tool] = table.three(3);
    f[tool] = table.three(6);
    p[tool] = table.three(9);
    depth[tool] = table.values[12];
    if (tool == 0) continue;
    const std::array<Vector3d, 2> computed = again.added(p, f);
    ++all.ticks;
    all.both += computed[0].norm() > 0.02 && computed[1].norm() > 0.02;
    for (std::size_t t = 0; t < 2; ++t) {
      all.worst_N = std::max(all.worst_N, (computed[t] - told[t]).norm());
      all.worst_depth = std::max(all.worst_depth, std::abs(again.fingers[t].x - depth[t]));
      all.most_N = std::max(all.most_N, told[t].norm());
    }
  }
  return all;
}

/// A part of the shipped breast that is searched sooner, with two lumps.
std::string smallBreast(const Folder& here) {
  return taskWith(
      "palpation_breast",
      {{"area", {{"half_across_mm", 18}, {"half_away_mm", 18}}},
       {"cases", {{"lumps", {0, 0, 1}}, {"apart_mm", 24}, {"kinds", {"large", "hard"}}}}},
      here);
}

TEST(TwoFingers, SearchRollAndFeelWhatSeparateCodeComputes) {
  const Folder here;
  const Outcome session = palpa(quickly({"palpation", "--task", smallBreast(here), "--tools", "2",
                                         "--operator", "expert", "--seed", "2402", "--out", "A"}),
                                here.path());
  ASSERT_EQ(session.exit_code, 0) << session.err;
  EXPECT_TRUE(says(session.out, "Found both lumps")) << session.out;
  const Outcome replay = palpa({"replay", "A/session.palpa"}, here.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.out;
  EXPECT_TRUE(says(replay.out, "The replay equals the record: same forces, same score"));
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here.path()).exit_code, 0);
  const Agreement found =
      agreement(here / "ticks.csv", json::parse(contentOf(here / "ticks.laws.json")));
  EXPECT_GT(found.ticks, 50'000);
  EXPECT_GT(found.both, 1000) << "each of both lumps is rolled for 2.4 s";
  EXPECT_GT(found.most_N, 0.1);
  // Both solvers leave 1 uN in the balance; 155 mN without the second finger's part in it.
  EXPECT_LT(found.worst_N, 1e-3);
  EXPECT_LT(found.worst_depth, 1e-6);
}

/// The second finger is bare and tracked: its force is estimated, labelled, and estimated again by
/// the guide's script.
TEST(TwoFingers, ATrackedFingersForceIsEstimatedAndCalledSo) {
  const Folder here;
  const Outcome session =
      palpa(quickly({"palpation", "--task", smallBreast(here), "--tools", "2", "--second", "finger",
                     "--operator", "expert", "--seed", "2402", "--out", "A"}),
            here.path());
  ASSERT_EQ(session.exit_code, 0) << session.err;
  const std::string page = contentOf(here / "A/report.html");
  EXPECT_TRUE(says(page, "The second finger&#39;s force is estimated")) << "below its curve";
  EXPECT_TRUE(says(page, "it is tracked and has no force sensor"));
  const Outcome replay = palpa({"replay", "A/session.palpa"}, here.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.out;
  EXPECT_TRUE(says(replay.out, "The replay equals the record: same forces, same score"));
  ASSERT_EQ(palpa({"export", "A/session.palpa", "--out", "ticks.csv"}, here.path()).exit_code, 0);
  const json laws = json::parse(contentOf(here / "ticks.laws.json"));
  EXPECT_EQ(laws.at("estimated").at("face"), "beside");
  if (test::fullCounts()) {  // what two sensed fingers are held to above
    const Agreement found = agreement(here / "ticks.csv", laws);
    EXPECT_GT(found.most_N, 0.1) << "the lump presses on both";
    EXPECT_LT(found.worst_N, 1e-3);
  }
  if (!pythonIsThere()) GTEST_SKIP() << "no Python (Debian: python3)";
  const std::string run = "cd '" + here.path().string() + "' && python3 '" + PALPA_SOURCE_DIR +
                          "/docs/check_estimate.py' ticks.csv > said.txt 2>&1";
  ASSERT_EQ(std::system(run.c_str()), 0) << contentOf(here / "said.txt");
  int ticks = 0;
  double most_N = 0, worst_mN = 1e9;
  ASSERT_EQ(
      std::sscanf(contentOf(here / "said.txt").c_str(),
                  "%d ticks, estimated up to %lf N, at most %lf mN", &ticks, &most_N, &worst_mN),
      3);
  EXPECT_GT(ticks, 50'000);
  EXPECT_GT(most_N, 0.3);
  EXPECT_LT(worst_mN, 1);
  const ScriptVerdict sums = checkedBy("check_ticks.py", here, 10000);
  EXPECT_EQ(sums.ticks, 10000);
  EXPECT_LT(sums.worst_mN, 1) << sums.said;
}

TEST(TwoFingers, ABareFingerIsASecondOne) {
  const Folder here;
  const Outcome alone =
      palpa(quickly({"palpation", "--second", "finger", "--operator", "expert"}), here.path());
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_TRUE(says(alone.err, "Add --tools 2")) << alone.err;
}

}  // namespace
}  // namespace palpa::cli_test
