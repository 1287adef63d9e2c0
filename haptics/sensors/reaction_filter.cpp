#include "haptics/sensors/reaction_filter.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Gain = Eigen::Matrix<double, 6, 2, Eigen::RowMajor>;
template <int N>
using Axes = Eigen::Map<Eigen::Matrix<double, N, 3, Eigen::RowMajor>>;

// [chosen], by the errors of stiffness and friction on the finite elements' silicone.
constexpr double kSnap = 5e4,       // m/s^4: the jerk's step in a tick, over the tick
    kSnapAlert = 3e7;               // the same where places are not as predicted
constexpr double kForceRate = 600;  // N/s^2: step of d, likewise
constexpr double kExplained = 3, kStartling = 2, kAlert_s = 0.05;  // see header: alert
constexpr double kStick = 500, kSlides = 0.02;                     // N/m; m/s
constexpr double kSlow_s = 0.06;  // slower motion is left out of the regression
constexpr double kForgets_s = 2;  // how long it remembers
constexpr double kLeastMotion = 1e-7, kSteepest = 5000;  // of the regression; units of c
constexpr double kTouched_N = 0.1;                       // more than that is predicted
constexpr double kRise = 0.26;                           // 1 - 1/M of the force law with M = 1.35
constexpr double kAir_N = 0.01, kAir_s = 0.1, kLate_s = 0.02;
constexpr double kSpeedNoise = 5e-3;  // m/s, of the difference of two velocities
constexpr int kBlock = 50;            // ticks
constexpr double kMassWithin = 0.2;   // of the identified one: the gains are of that
constexpr double kBiasWalk = 1e-3;    // N/sqrt(s): a sensor that warms up
constexpr double kLongestGap = 10;    // ticks
constexpr std::int32_t kSettling = 30, kLongQuiet = 1 << 30;  // ticks

template <int N>
Eigen::Matrix<double, N, N> chain(double dt) {
  Eigen::Matrix<double, N, N> F = Eigen::Matrix<double, N, N>::Identity();
  for (int row = 0; row < N; ++row) {
    double term = 1;
    for (int column = row + 1; column < N; ++column) F(row, column) = term *= dt / (column - row);
  }
  return F;
}

/// The gain of a filter that has settled: K = P H' (H P H' + R)^-1, P predicted.
template <int N, int M>
Eigen::Matrix<double, N, M> settledGain(const Eigen::Matrix<double, N, N>& F,
                                        const Eigen::Matrix<double, M, N>& H,
                                        const Eigen::Matrix<double, N, 1>& q,
                                        const Eigen::Matrix<double, M, 1>& r) {
  using Cov = Eigen::Matrix<double, N, N>;
  Cov P = Cov::Identity();
  Eigen::Matrix<double, N, M> K = Eigen::Matrix<double, N, M>::Zero();
  for (int i = 0; i < 4000; ++i) {
    P = F * P * F.transpose();
    P.diagonal() += q.cwiseAbs2();
    Eigen::Matrix<double, M, M> S = H * P * H.transpose();
    S.diagonal() += r.cwiseAbs2();
    K = P * H.transpose() * S.inverse();
    const Cov keeps = Cov::Identity() - K * H;
    P = keeps * P * keeps.transpose() +
        K * Eigen::Matrix<double, M, M>(r.cwiseAbs2().asDiagonal()) * K.transpose();
  }
  return K;
}

Mat6 reactionChain(double dt) {
  Mat6 F = Mat6::Identity();
  F.topLeftCorner<4, 4>() = chain<4>(dt);
  F(4, 5) = dt;
  return F;
}

}  // namespace

ReactionFilter::ReactionFilter(const ReactionSettings& settings) : settings_(settings) {
  const double m = settings.tool.mass;
  if (!(settings.rate_Hz > 0) || !(settings.noise_N > 0) || !(settings.place_m > 0) || !(m >= 0))
    throw UsageError("a rate, a noise or a resolution that is not above zero, or a mass below",
                     "force filter", "Give them in SI units.");
  const double dt = 1 / settings.rate_Hz;
  Eigen::Matrix<double, 2, 6> H = Eigen::Matrix<double, 2, 6>::Zero();
  H(0, 0) = 1;
  H(1, 2) = -m;
  H(1, 4) = 1;
  const Mat6 F = reactionChain(dt);
  Eigen::Map<Mat6>(F_.data()) = F;
  Vec6 q = Vec6::Zero();
  q[3] = kSnap * dt;
  q[5] = kForceRate * dt;
  const Eigen::Vector2d noise(settings.place_m, settings.noise_N);
  Eigen::Map<Gain>(calm_gain_.data()) = settledGain<6, 2>(F, H, q, noise);
  q[3] = kSnapAlert * dt;
  Eigen::Map<Gain>(alert_gain_.data()) = settledGain<6, 2>(F, H, q, noise);
  Eigen::Map<Vec4>(place_gain_.data()) =
      settledGain<4, 1>(chain<4>(dt), Eigen::RowVector4d(1, 0, 0, 0), Vec4(0, 0, 0, kSnap * dt),
                        Eigen::Matrix<double, 1, 1>(settings.place_m));
}

/// One tick's work.
struct ReactionStep {
  const ReactionFilter& filter;
  const ReactionSettings& of = filter.settings_;
  ReactionState& state;
  const double dt = 1 / of.rate_Hz;
  Axes<6> x{state.x.data()};
  Axes<4> k{state.k.data()};

  void begin(const Vec3& p_M, const Vec3& p_K, const Vec3& s) noexcept {
    state.x = {};
    state.k = {};
    x.row(0) = p_M;
    x.row(4) = s;
    k.row(0) = p_K;
    state.f_slow = pack(s);
    state.k_slow = pack(p_K);
    state.f_late = pack(s);
    state.c = state.xy = state.xx = 0;
    state.alert = 1;
    if (state.load_P[0] == 0) {
      const double bias = of.bias_sd_N, mass = of.mass_sd * of.tool.mass;
      Eigen::Map<Mat4>(state.load_P.data()) =
          Vec4(bias * bias, bias * bias, bias * bias, mass * mass).asDiagonal();
    }
  }

  double mass() const noexcept { return of.tool.mass + state.load[3]; }

  Vec3 bias() const noexcept {
    return unpack(of.bias_N) + Vec3(state.load[0], state.load[1], state.load[2]);
  }

  /// How the reaction changes of itself, N/s.
  Vec3 predictedChange() const noexcept {
    const Vec3 f = x.row(4), v = k.row(1);
    const double size = f.norm();
    if (size < kTouched_N) return Vec3::Zero();
    const Vec3 u = f / size, along = v.dot(u) * u, across = v - along;
    return -state.c * pinned::pow(size, kRise) * along -
           kStick / (1 + across.squaredNorm() / (kSlides * kSlides)) * across;
  }

  void predict() noexcept {
    const Vec3 change = predictedChange();
    const Eigen::Matrix<double, 6, 3> before = x;
    const Eigen::Map<const Mat6> F(filter.F_.data());
    x.noalias() = F * before;
    x.row(4) += dt * change.transpose();
    const Eigen::Matrix<double, 4, 3> was = k;
    k.noalias() = F.topLeftCorner<4, 4>() * was;
  }

  void correct(const Vec3& p_M, const Vec3& p_K, const Vec3& s) noexcept {
    const Eigen::Map<const Gain> calm(filter.calm_gain_.data()), alert(filter.alert_gain_.data());
    Eigen::Matrix<double, 2, 3> off;
    off.row(0) = p_M.transpose() - x.row(0);
    off.row(1) = s.transpose() - (x.row(4) - mass() * x.row(2));
    const double missed = off.row(0).squaredNorm() / (3 * of.place_m * of.place_m),
                 startled = std::clamp((missed - kExplained) / kStartling, 0.0, 1.0);
    state.alert = std::max(startled, state.alert * (1 - dt / kAlert_s));
    x += (calm + state.alert * (alert - calm)) * off;
    const Eigen::RowVector3d k_off = p_K.transpose() - k.row(0);
    k += Eigen::Map<const Vec4>(filter.place_gain_.data()) * k_off;
  }

  /// `f`: the reaction of this tick alone.
  void learnRise(const Vec3& f) noexcept {
    const double follows = dt / kSlow_s, keeps = 1 - dt / kForgets_s;
    Vec3 f_slow = unpack(state.f_slow), k_slow = unpack(state.k_slow);
    f_slow += follows * (f - f_slow);
    k_slow += follows * (Vec3(k.row(0)) - k_slow);
    state.f_slow = pack(f_slow);
    state.k_slow = pack(k_slow);
    const Vec3 now = x.row(4);
    const double size = now.norm();
    if (size < kTouched_N) return;  // what was touched last will be touched next
    const Vec3 u = now / size, df = f - f_slow, dp = k_slow - Vec3(k.row(0));
    const double pressed = pinned::pow(size, kRise) * dp.dot(u);
    state.xy = keeps * state.xy + pressed * df.dot(u);
    state.xx = keeps * state.xx + pressed * pressed;
    state.c = std::clamp(state.xy / (state.xx + kLeastMotion), 0.0, kSteepest);
  }

  /// In the air, where no more is left of late than the doubts of b and m explain, block by block:
  /// what is left of the mean of s, with the mean acceleration of M, the change of its velocity.
  void learnLoad(const Mat3& R_WS, const Vec3& s, const Vec3& g) noexcept {
    Eigen::Map<Mat4> P(state.load_P.data());
    Eigen::Matrix<double, 3, 4> rows;
    rows << R_WS, g;
    const double doubt = std::sqrt((rows * P * rows.transpose()).trace());
    Vec3 f_late = unpack(state.f_late);
    f_late += dt / kLate_s * (Vec3(x.row(4)) - f_late);
    state.f_late = pack(f_late);
    const bool air = f_late.norm() < kAir_N + 2 * doubt;
    state.quiet = air ? std::min(state.quiet + 1, kLongQuiet) : 0;
    if (state.quiet * dt < kAir_s) {
      state.block = 0;
      return;
    }
    Eigen::Map<Mat3> turns(state.turn_sum.data());
    if (state.block == 0) {
      turns.setZero();
      state.shown_sum = {};
      state.v_first = pack(Vec3(x.row(1)));
    }
    turns += R_WS;
    state.shown_sum = pack(Vec3(unpack(state.shown_sum) + s));
    if (++state.block < kBlock) return;
    state.block = 0;
    const Vec3 a = (Vec3(x.row(1)) - unpack(state.v_first)) / (kBlock * dt);
    rows << turns / kBlock, g;  // not g - a: the noise of a would pull the mass toward zero
    learn(rows, unpack(state.shown_sum) / kBlock + mass() * a);
  }

  void learn(const Eigen::Matrix<double, 3, 4>& rows, const Vec3& left) noexcept {
    Eigen::Map<Vec4> load(state.load.data());
    Eigen::Map<Mat4> P(state.load_P.data());
    const double noise = of.noise_N * of.noise_N / kBlock,
                 swing = mass() * kSpeedNoise / (kBlock * dt), r = noise + swing * swing;
    P.diagonal().head<3>().array() += kBiasWalk * kBiasWalk * kBlock * dt;
    Vec4 learnt = Vec4::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const Vec4 row = rows.row(axis), shown = P * row;
      const Vec4 gain = shown / (row.dot(shown) + r);
      learnt += gain * (left[axis] - row.dot(learnt));
      P -= gain * shown.transpose();
    }
    load += learnt;
    const double widest = kMassWithin * of.tool.mass;
    load[3] = std::clamp(load[3], -widest, widest);
  }
};

Reaction step(const ReactionFilter& filter, ReactionState& state, const WrenchSample& sample,
              const PackedPose& X_WS, std::int64_t t_ns) noexcept {
  Reaction now;
  if (!finite(X_WS.p) || !finite(X_WS.q)) {
    state.seen = state.quiet = 0;
    return now;
  }
  ReactionStep tick{filter, filter.settings(), state};
  const Mat3 R_WS = unpack(X_WS.q).normalized().toRotationMatrix();
  const Vec3 p_WS = unpack(X_WS.p), p_M = p_WS + R_WS * unpack(tick.of.tool.p_SM),
             p_K = p_WS + R_WS * unpack(tick.of.p_SK), g = unpack(tick.of.g_W);
  now.p_WK = pack(p_K);
  const bool usable = !(sample.flags & kUnusable) && finite(sample.f_S);
  const double periods = static_cast<double>(t_ns - state.t_ns) * 1e-9 * tick.of.rate_Hz;
  state.t_ns = t_ns;
  if (!usable || periods < 0 || periods > kLongestGap) state.seen = state.quiet = 0;
  if (!usable) return now;
  const Vec3 s = R_WS * (unpack(sample.f_S) - tick.bias()) - tick.mass() * g;
  if (state.seen == 0) tick.begin(p_M, p_K, s);
  const int ticks = state.seen == 0 ? 1 : std::max(1, static_cast<int>(std::lround(periods)));
  for (int i = 0; i < ticks; ++i) tick.predict();  // what was missed, too
  tick.correct(p_M, p_K, s);
  tick.learnRise(s + tick.mass() * Vec3(tick.x.row(2)));
  tick.learnLoad(R_WS, s, g);
  if (!finite(state.x) || !finite(state.k) || !finite(state.load)) {  // beyond all numbers
    state = {};
    return now;
  }
  state.seen = std::min(state.seen + 1, kSettling);
  now.valid = state.seen == kSettling;
  if (now.valid) now.f_W = pack(Vec3(tick.x.row(4)));
  now.p_WK = pack(Vec3(tick.k.row(0)));
  return now;
}

Reaction ahead(const ReactionFilter& filter, const ReactionState& state, double dt) noexcept {
  ReactionState then = state;
  const ReactionStep tick{filter, filter.settings(), then};
  const double on = std::clamp(dt, 0.0, tick.dt);
  Reaction now;
  now.valid = state.seen == kSettling;
  now.p_WK = pack(Vec3(tick.k.row(0) + on * tick.k.row(1)));
  if (now.valid)
    now.f_W =
        pack(Vec3(tick.x.row(4).transpose() + on * (tick.predictedChange() + Vec3(tick.x.row(5)))));
  return now;
}

}  // namespace palpa::haptics
