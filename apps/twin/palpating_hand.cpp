#include "apps/twin/palpating_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::twin {
namespace {

constexpr std::int64_t kThink_ns = 10'000'000, kGlance_ns = 100'000'000;  // 100 Hz, 10 Hz
constexpr double kThink_s = 0.01;
constexpr double kSharp = 0.3;      // touch is not sharper than about 25 ms
constexpr double kOverTop = 0.005;  // m, from where a press begins
constexpr double kMoves = 0.003,
                 kNear = 0.0008;  // m above the top: between them the hand learns what moving takes
constexpr double
    kTouch_N = 0.06,
    kDeepest = 0.009;  // N above the air's, m below the top: a hand that feels nothing stops there
constexpr double kLift = 0.05;  // m/s
// m, of a closer look: its presses lie within 5 mm of each other; the search itself has felt the
// flanks
constexpr double kCross = 0.0035;
constexpr double kKnown = 0.014;   // m: nobody looks twice at the same lump or its flank
constexpr double kAround = 0.016;  // m: as far as a lump is felt
constexpr double kBelongs =
    0.017;  // m from the middle of what belongs there: farther off a lump would be felt as one
// Sum of squares of firmness: less is explained where a single press was firm by chance
constexpr double kNoHill = 0.035, kClearHill = 0.06;
constexpr std::size_t kLooksBack = 2;  // hills, at the end
constexpr double kClearly = 0.12;      // ln of firmness: two standard deviations of a press
constexpr double kSame = 0.008;        // m, of a place that was dismissed
constexpr double kMarkFor_s = 0.3;
constexpr double kHome = 0.04;  // m above the top

}  // namespace

PalpatingHand::PalpatingHand(const PalpatingSkill& skill, const VisiblePhantom& phantom,
                             const Pose& X_ET, std::uint64_t seed)
    : skill_(skill),
      phantom_(phantom),
      X_ET_(X_ET),
      X_TE_(X_ET.inverse()),
      seed_(seed),
      judgement_(seed, "palpating.judgement.0"),
      noise_(seed, "palpating.noise"),
      tremor_(skill.tremor_rms, RandomStream(seed, "palpating.tremor")),
      memory_(skill.pressures.size()) {}

void PalpatingHand::planStrips() {
  places_.clear();
  const int strips =
      std::max(1, static_cast<int>(std::ceil(2 * phantom_.half_x / skill_.strip - 1e-9)));
  const int steps =
      std::max(1, static_cast<int>(std::ceil(2 * phantom_.half_y / skill_.step - 1e-9)));
  for (int i = 0; i < skill_.area_share * strips; ++i) {
    for (int k = 0; k < steps; ++k) {
      const int j = i % 2 == 0 ? k : steps - 1 - k;
      const Vec3 planned(phantom_.half_x * ((2 * i + 1.0) / strips - 1),
                         phantom_.half_y * ((2 * j + 1.0) / steps - 1), 0);
      if (judgement_.uniform() < skill_.skip) continue;
      places_.push_back(planned +
                        skill_.wander * Vec3(judgement_.normal(), judgement_.normal(), 0));
    }
  }
  std::reverse(places_.begin(), places_.end());
}

void PalpatingHand::beginTrial(int trial, double now_s) {
  trial_ = trial;
  judgement_ = RandomStream(seed_, "palpating.judgement." + std::to_string(trial));
  memory_.forget();
  closer_.clear();
  closer_places_.clear();
  waiting_.clear();
  suspect_P_.reset();
  marked_P_.clear();
  dismissed_P_.clear();
  looked_back_P_.clear();
  done_ = false;
  planStrips();
  next(now_s);
}

void PalpatingHand::goTo(const Vec3& p_P, double now_s, PalpationStep next) {
  const Vec3 over(p_P.x(), p_P.y(), p_P.z() + kOverTop);
  move_ = MinJerk(makePose(Mat3::Identity(), tip_P_), makePose(Mat3::Identity(), over), now_s,
                  std::max(0.15, (over - tip_P_).norm() / skill_.travel_speed));
  step_ = PalpationStep::travel;
  after_travel_ = next;
}

/// Down evenly; what it takes to move in the air is no resistance of the phantom.
void PalpatingHand::pressing(double now_s) {
  tip_P_.z() -= skill_.press_speed * kThink_s;
  if (tip_now_P_.z() > kMoves)
    air_N_ = felt_N_;
  else if (tip_now_P_.z() > kNear)
    air_N_ += kSharp * (felt_N_ - air_N_);
  const double resistance = felt_N_ - air_N_, z = tip_now_P_.z();
  // Where between two thoughts a force was passed: a press is felt as one, not in steps.
  const auto passed = [&](double force_N) {
    const double share = (force_N - resistance_N_) / std::max(resistance - resistance_N_, 1e-9);
    return z_ + std::clamp(share, 0.0, 1.0) * (z - z_);
  };
  if (!touched_ && resistance > kTouch_N) {
    touched_ = true;
    touched_z_ = passed(kTouch_N);
  }
  while (touched_ && depths_.size() < skill_.pressures.size() &&
         resistance >= skill_.pressures[depths_.size()]) {
    const double there = passed(skill_.pressures[depths_.size()]);
    if (depths_.empty()) light_z_ = there;
    depths_.push_back((depths_.empty() ? touched_z_ : light_z_) - there);
  }
  resistance_N_ = resistance;
  z_ = z;
  const double enough = skill_.pressures.back() * (suspect_P_ ? skill_.closer_force : 1);
  if (resistance < enough && tip_now_P_.z() > -kDeepest) return;
  since_s_ = now_s;
  step_ = PalpationStep::overshoot;  // it goes on for as long as it takes to react
}

/// As far as it matters: where nothing of it is felt any more, one place is like another.
double PalpatingHand::fromNormal(const Vec3& p_P) const {
  constexpr double kFelt = 0.026;  // m
  return skill_.knows_anatomy && phantom_.from_normal ? std::min(kFelt, phantom_.from_normal(p_P))
                                                      : kFelt;
}

/// What belongs there, or the flank of a lump that was marked.
bool PalpatingHand::accountedFor(const Vec3& p_P) const {
  const auto near = [&](const Vec3& other) { return across(other, p_P) < kKnown; };
  return fromNormal(p_P) < kBelongs || std::any_of(marked_P_.begin(), marked_P_.end(), near);
}

/// Or a place that was dismissed: no reason to look again. A hill that is felt beside it is one.
bool PalpatingHand::known(const Vec3& p_P) const {
  const auto same = [&](const Vec3& other) { return across(other, p_P) < kSame; };
  return accountedFor(p_P) || std::any_of(dismissed_P_.begin(), dismissed_P_.end(), same);
}

void PalpatingHand::judge(double now_s) {
  FeltPress felt{tip_now_P_, depths_, false, fromNormal(tip_now_P_)};
  for (double& depth : felt.depths) depth *= std::exp(skill_.weber * judgement_.normal());
  if (suspect_P_) {
    (look_ == Look::climb ? closer_ : fresh_).push_back(felt);
  } else {
    felt.firm =
        memory_.firmness(felt) > skill_.looks_closer;  // what is firm is no measure of the rest
    memory_.add(felt);
    waiting_.push_back(felt);
  }
  next(now_s);
}

/// Where the hill about a place has its top, by what the search has told; a hand that looked closer
/// on the flank would mark the flank.
Vec3 PalpatingHand::thoughtOver(Vec3 p_P) const {
  constexpr int kTimes = 3;  // of a centimetre at most
  for (int i = 0; i < kTimes && skill_.feels_around; ++i)
    p_P = inArea(memory_.hillAbout({}, p_P).top);
  return p_P;
}

/// At the first that waits and whose surroundings were felt as far as they will be: first at the
/// hill's top, and where that was none, at the place itself.
bool PalpatingHand::lookCloser() {
  while (!waiting_.empty()) {
    const FeltPress felt = waiting_.front();
    if (skill_.feels_around && !places_.empty() && places_.back().x() < felt.p_P.x() + kAround)
      return false;
    const Vec3 top = felt.looked ? felt.p_P : thoughtOver(felt.p_P);
    waiting_.front().looked = true;
    if (felt.looked || across(top, felt.p_P) < kSame) waiting_.erase(waiting_.begin());
    if (memory_.firmness(felt) <= skill_.looks_closer || known(felt.p_P) || known(top)) continue;
    if (skill_.feels_around && memory_.hillAbout({}, top).explained < kNoHill) continue;
    beginLook(top, felt);
    if (skill_.again > 0) pressAfresh(top, skill_.again, Look::again);
    return true;
  }
  return false;
}

void PalpatingHand::beginLook(const Vec3& top_P, const FeltPress& felt) {
  suspect_P_ = top_P;
  rounds_left_ = skill_.rounds;
  aside_ = false;
  closer_.assign(1, felt);
  look_ = Look::climb;
}

/// When all was felt: at the clearest hills that no mark accounts for, whatever was thought of them
/// before the rest was known.
bool PalpatingHand::lookBack() {
  if (!skill_.feels_around || !places_.empty() || looked_back_P_.size() >= kLooksBack) return false;
  const auto again = [&](const Vec3& p_P) {
    return std::any_of(looked_back_P_.begin(), looked_back_P_.end(),
                       [&](const Vec3& other) { return across(other, p_P) < kKnown; });
  };
  const FeltPress* at = nullptr;
  TouchMemory::Hill clearest{Vec3::Zero(), kClearHill};
  for (const FeltPress& press : memory_.presses()) {
    if (memory_.firmness(press) <= skill_.looks_closer || accountedFor(press.p_P)) continue;
    TouchMemory::Hill hill = memory_.hillAbout({}, press.p_P);
    hill.top = inArea(hill.top);
    if (hill.explained <= clearest.explained || accountedFor(hill.top) || again(hill.top)) continue;
    clearest = hill;
    at = &press;
  }
  if (!at) return false;
  looked_back_P_.push_back(clearest.top);
  beginLook(clearest.top, *at);
  return true;
}

void PalpatingHand::planCross(const Vec3& p_P) {
  for (const Vec3& off : {Vec3(0, -kCross, 0), Vec3(0, kCross, 0), Vec3(kCross, 0, 0),
                          Vec3(-kCross, 0, 0), Vec3(0, 0, 0)})
    closer_places_.push_back(inArea(Vec3(p_P.x(), p_P.y(), 0) + off));
}

/// Nobody asks what lies beyond the outline; and toward the edge of a block it gives way less by
/// itself.
Vec3 PalpatingHand::inArea(const Vec3& p_P) const {
  return {std::clamp(p_P.x(), -phantom_.half_x, phantom_.half_x),
          std::clamp(p_P.y(), -phantom_.half_y, phantom_.half_y), p_P.z()};
}

/// At one place, so often: what led there was chosen for being firm, only fresh presses tell.
void PalpatingHand::pressAfresh(const Vec3& p_P, int times, Look look) {
  look_ = look;
  fresh_.clear();
  suspect_P_ = Vec3(p_P.x(), p_P.y(), 0);
  closer_places_.assign(static_cast<std::size_t>(times), *suspect_P_);
}

/// The presses of a look are done: was it chance, where is it firmest, is it a lump?
void PalpatingHand::decide(double now_s) {
  constexpr double kOnTop = 2.4e-3;  // m
  if (look_ == Look::again && memory_.meanFirmness(fresh_) < skill_.looks_closer)
    return dismiss(now_s);
  if (look_ != Look::confirm) {
    const bool begins = closer_.size() == 1;
    look_ = Look::climb;
    const Vec3 top = begins ? *suspect_P_ : inArea(memory_.hillAbout(closer_, *suspect_P_).top);
    if (accountedFor(top)) return dismiss(now_s);
    if ((begins || across(top, *suspect_P_) > kOnTop) && rounds_left_-- > 0) {
      suspect_P_ = top;
      planCross(top);
      return next(now_s);
    }
    if (skill_.confirms > 0) {
      pressAfresh(top, skill_.confirms, Look::confirm);
      return next(now_s);
    }
  }
  std::vector<FeltPress> all = closer_;
  all.insert(all.end(), fresh_.begin(), fresh_.end());
  const Vec3 middle = inArea(memory_.hillAbout(all, *suspect_P_).top);
  const double firmest = memory_.meanFirmness(look_ == Look::confirm ? fresh_ : closer_);
  if (firmest < skill_.marks_from || accountedFor(middle)) return dismiss(now_s);
  if (goesAside(middle, firmest)) return next(now_s);
  suspect_P_.reset();
  marked_P_.push_back(middle);
  word_ = grade(middle, firmest);
  goTo(Vec3(middle.x(), middle.y(), 0), now_s, PalpationStep::mark);
}

/// Where it is clearly firmer close by this was a flank: on to there, once in a closer look.
bool PalpatingHand::goesAside(const Vec3& from_P, double firmest) {
  const FeltPress* beside = memory_.firmestAbout(from_P, kAround);
  if (aside_ || !beside || across(beside->p_P, from_P) < kSame || known(beside->p_P) ||
      memory_.firmness(*beside) < firmest + kClearly)
    return false;
  aside_ = true;
  suspect_P_ = inArea(memory_.hillAbout({}, beside->p_P).top);
  closer_.assign(1, *beside);
  look_ = Look::climb;
  planCross(*suspect_P_);
  return true;
}

void PalpatingHand::dismiss(double now_s) {
  dismissed_P_.push_back(*suspect_P_);
  suspect_P_.reset();
  next(now_s);
}

/// As wide as where it was felt to be firm.
Hand::Word PalpatingHand::grade(const Vec3& p_P, double firmest) {
  constexpr double kAcross = 3, kSmallest = 0.006, kLargest = 0.035;  // of the spread; m
  Word word;
  word.kind = WordKind::grade;
  word.diameter = std::clamp(
      kAcross * memory_.spreadAbout(p_P, closer_) * (1 + skill_.size_sd * judgement_.normal()),
      kSmallest, kLargest);
  word.hardness = firmest >= skill_.hard_from ? 2 : 1;
  return word;
}

void PalpatingHand::next(double now_s) {
  if ((suspect_P_ || lookCloser() || lookBack()) && closer_places_.empty()) return decide(now_s);
  if (std::vector<Vec3>& places = suspect_P_ ? closer_places_ : places_; !places.empty()) {
    const Vec3 place = places.back();
    places.pop_back();
    return goTo(place, now_s, PalpationStep::press);
  }
  done_ = true;
  word_ = Word{WordKind::done, 0, 0, 0};
  goTo(Vec3(0, 0, kHome), now_s, PalpationStep::rest);
}

void PalpatingHand::think(const Senses& senses) {
  const double now_s = static_cast<double>(senses.now_ns) * 1e-9;
  const Pose X_PD = phantom_.X_AP.inverse() * bearings_.X_DA().inverse();
  tip_now_P_ = X_PD * (senses.X_DE * X_ET_).translation();
  felt_N_ += kSharp * (-(X_PD.linear() * senses.f_fingers_D).z() - felt_N_);
  if (!senses.seen) return;
  if (senses.seen->running && senses.seen->trial != trial_)
    return beginTrial(senses.seen->trial, now_s);
  if (!senses.seen->running && step_ != PalpationStep::rest &&
      step_ != PalpationStep::travel) {  // paused or over: away from it
    return goTo(Vec3(tip_P_.x(), tip_P_.y(), kHome), now_s, PalpationStep::rest);
  }
  if (senses.seen->running && step_ == PalpationStep::rest && trial_ > 0 && !done_)
    return next(now_s);  // after a pause
  switch (step_) {
    case PalpationStep::rest:
      return;
    case PalpationStep::travel:
      tip_P_ = move_.at(now_s).translation();
      if (!move_.done(now_s)) return;
      step_ = after_travel_;
      since_s_ = now_s;
      touched_ = false;
      air_N_ = felt_N_;
      resistance_N_ = 0;
      z_ = tip_now_P_.z();
      depths_.clear();
      return;
    case PalpationStep::press:
      return pressing(now_s);
    case PalpationStep::overshoot:
      tip_P_.z() -= skill_.press_speed * kThink_s;
      if (now_s - since_s_ >= skill_.reaction) step_ = PalpationStep::lift;
      return;
    case PalpationStep::lift:
      tip_P_.z() += kLift * kThink_s;
      if (tip_P_.z() >= kOverTop) judge(now_s);
      return;
    case PalpationStep::mark:
      if (now_s - since_s_ >= kMarkFor_s) step_ = PalpationStep::release, since_s_ = now_s;
      return;
    case PalpationStep::release:
      if (now_s - since_s_ >= kMarkFor_s) next(now_s);
      return;
  }
}

Hand::Action PalpatingHand::act(const Senses& senses, double dt) {
  const Vec3 p_D = senses.X_DE.translation();
  hand_speed_ += ((p_D - p_last_D_).norm() / dt - hand_speed_) * std::min(1.0, dt / 0.05);
  p_last_D_ = p_D;
  if (senses.seen && (senses.now_ns - last_look_ns_ >= kGlance_ns || !bearings_.taken())) {
    last_look_ns_ = senses.now_ns;
    const bool first = !bearings_.taken();
    bearings_.look(senses.seen->X_AT, senses.X_DE * X_ET_, skill_.look_sd, hand_speed_, noise_);
    if (first) tip_P_ = phantom_.X_AP.inverse() * bearings_.X_AT().translation();
  }
  if (!bearings_.taken()) return {senses.X_DE, 0, 0, {}};
  if (senses.now_ns >= next_thought_ns_) {
    next_thought_ns_ = senses.now_ns + kThink_ns;
    think(senses);
  }
  const Vec3 tip_P = tip_P_ + tremor_.next(dt);
  Action action;
  action.X_DH =
      bearings_.X_DA() * phantom_.X_AP *
      makePose(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix(), tip_P) *
      X_TE_;
  action.buttons = step_ == PalpationStep::mark ? 1u : 0u;
  const bool says_now = word_.kind == WordKind::done ? step_ == PalpationStep::travel
                                                     : step_ == PalpationStep::release;
  if (says_now && word_.kind != WordKind::none) std::swap(action.says, word_);
  return action;
}

}  // namespace palpa::twin
