#include "apps/twin/lump_search.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace palpa::twin {
namespace {

// m, of a closer look: its presses lie within 5 mm of each other; the search itself has felt the
// flanks
constexpr double kCross = 0.0035;
constexpr double kFingersApart = 0.02;  // m, of two fingertips side by side
constexpr double kKnown = 0.014;        // m: nobody looks twice at the same lump or its flank
constexpr double kAround = 0.016;       // m: as far as a lump is felt
constexpr double kBelongs =
    0.017;  // m from the middle of what belongs there: farther off a lump would be felt as one
// Sum of squares of firmness: less is explained where a single press was firm by chance
constexpr double kNoHill = 0.035, kClearHill = 0.06;
constexpr std::size_t kLooksBack = 2;  // hills, at the end
constexpr double kClearly = 0.12;      // ln of firmness: two standard deviations of a press
constexpr double kSame = 0.008;        // m, of a place that was dismissed
// Of what made the hand look closer: a small lump's hill is thought up to 6 mm off its top, where
// half of it is felt
constexpr double kFlank = 0.5;

}  // namespace

LumpSearch::LumpSearch(const PalpatingSkill& skill, const VisiblePhantom& phantom, int fingers,
                       std::uint64_t seed)
    : skill_(skill),
      phantom_(phantom),
      seed_(seed),
      fingers_(fingers),
      strips_(std::max(1, static_cast<int>(std::ceil(
                              2 * phantom.half_x * phantom.longer.x() / skill.strip - 1e-9)))),
      judgement_(seed, "palpating.judgement.0"),
      memory_(skill.pressures.size()) {
  const double width = 2 * phantom_.half_x / strips_;
  beside_ = std::max(1, static_cast<int>(std::lround(kFingersApart / width)));
  if (fingers_ > 1) apart_ = Vec3(beside_ * width, 0, 0);
}

void LumpSearch::begin(int trial) {
  judgement_ = RandomStream(seed_, "palpating.judgement." + std::to_string(trial));
  memory_.forget();
  closer_.clear();
  closer_places_.clear();
  waiting_.clear();
  suspect_P_.reset();
  marked_P_.clear();
  dismissed_P_.clear();
  looked_back_P_.clear();
  planStrips();
}

void LumpSearch::planStrips() {
  places_.clear();
  const int steps = std::max(
      1,
      static_cast<int>(std::ceil(2 * phantom_.half_y * phantom_.longer.y() / skill_.step - 1e-9)));
  for (int i = 0; i < skill_.area_share * strips_; ++i) {
    if (fingers_ > 1 && (i / beside_) % 2 == 1) continue;  // the other finger's
    for (int k = 0; k < steps; ++k) {
      const int j = i % 2 == 0 ? k : steps - 1 - k;
      Vec3 planned(phantom_.half_x * ((2 * i + 1.0) / strips_ - 1),
                   phantom_.half_y * ((2 * j + 1.0) / steps - 1), 0);
      if (judgement_.uniform() < skill_.skip || !takeIn(&planned)) continue;
      places_.push_back(planned +
                        skill_.wander * Vec3(judgement_.normal(), judgement_.normal(), 0));
    }
  }
  std::reverse(places_.begin(), places_.end());
}

/// Beside the outline a finger still feels what lies in it; farther off nobody presses.
bool LumpSearch::takeIn(Vec3* planned) const {
  if (!phantom_.to_area) return true;
  const Vec3 there = phantom_.to_area(*planned);
  const bool near = across(there, *planned) <= 0.5 * std::min(skill_.strip, skill_.step);
  *planned = there;
  return near;
}

/// As far as it matters: where nothing of it is felt any more, one place is like another.
double LumpSearch::fromNormal(const Vec3& p_P) const {
  constexpr double kFelt = 0.030;  // m
  return skill_.knows_anatomy && phantom_.from_normal ? std::min(kFelt, phantom_.from_normal(p_P))
                                                      : kFelt;
}

/// What belongs there, or the flank of a lump that was marked.
bool LumpSearch::accountedFor(const Vec3& p_P) const {
  const auto near = [&](const Vec3& other) { return across(other, p_P) < kKnown; };
  return fromNormal(p_P) < kBelongs || std::any_of(marked_P_.begin(), marked_P_.end(), near);
}

/// Or a place that was dismissed: no reason to look again. A hill that is felt beside it is one.
bool LumpSearch::known(const Vec3& p_P) const {
  const auto same = [&](const Vec3& other) { return across(other, p_P) < kSame; };
  return accountedFor(p_P) || std::any_of(dismissed_P_.begin(), dismissed_P_.end(), same);
}

void LumpSearch::felt(const Vec3& p_P, std::vector<double> depths) {
  FeltPress felt{p_P, std::move(depths), false, fromNormal(p_P)};
  for (double& depth : felt.depths) depth *= std::exp(skill_.weber * judgement_.normal());
  if (suspect_P_) {
    (look_ == Look::climb ? closer_ : fresh_).push_back(felt);
    return;
  }
  felt.firm =
      memory_.firmness(felt) > skill_.looks_closer;  // what is firm is no measure of the rest
  memory_.add(felt);
  waiting_.push_back(felt);
}

LumpSearch::Intent LumpSearch::next() {
  if ((suspect_P_ || lookCloser() || lookBack()) && closer_places_.empty()) return decide();
  std::vector<Vec3>& places = suspect_P_ ? closer_places_ : places_;
  if (places.empty()) return {Deed::end, Vec3::Zero(), {Hand::WordKind::done, 0, 0, 0}};
  const Vec3 place = places.back();
  places.pop_back();
  const bool both = fingers_ > 1 && !suspect_P_ && place.x() + apart_.x() <= phantom_.half_x;
  return {Deed::press, place, {}, both};
}

/// Where the hill about a place has its top, by what the search has told; a hand that looked closer
/// on the flank would mark the flank.
Vec3 LumpSearch::thoughtOver(Vec3 p_P) const {
  constexpr int kTimes = 3;  // of a centimetre at most
  for (int i = 0; i < kTimes && skill_.feels_around; ++i)
    p_P = inArea(memory_.hillAbout({}, p_P).top);
  return p_P;
}

/// At the first that waits and whose surroundings were felt as far as they will be: first at the
/// hill's top, and where that was none, at the place itself.
bool LumpSearch::lookCloser() {
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

void LumpSearch::beginLook(const Vec3& top_P, const FeltPress& felt) {
  suspect_P_ = top_P;
  rounds_left_ = skill_.rounds;
  aside_ = false;
  closer_.assign(1, felt);
  look_ = Look::climb;
}

/// When all was felt: at the clearest hills that no mark accounts for, whatever was thought of them
/// before the rest was known.
bool LumpSearch::lookBack() {
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

/// The presses of a look are done: was it chance, where is it firmest, is it a lump?
LumpSearch::Intent LumpSearch::decide() {
  constexpr double kOnTop = 2.4e-3;  // m
  if (look_ == Look::again && memory_.meanFirmness(fresh_) < kFlank * skill_.looks_closer)
    return dismiss();
  if (look_ != Look::confirm) {
    const bool begins = closer_.size() == 1;
    look_ = Look::climb;
    const Vec3 top = begins ? *suspect_P_ : inArea(memory_.hillAbout(closer_, *suspect_P_).top);
    if (accountedFor(top)) return dismiss();
    if ((begins || across(top, *suspect_P_) > kOnTop) && rounds_left_-- > 0) {
      suspect_P_ = top;
      planCross(top);
      return next();
    }
    if (skill_.confirms > 0) {
      pressAfresh(top, skill_.confirms, Look::confirm);
      return next();
    }
  }
  std::vector<FeltPress> all = closer_;
  all.insert(all.end(), fresh_.begin(), fresh_.end());
  const Vec3 middle = inArea(memory_.hillAbout(all, *suspect_P_).top);
  const double firmest = memory_.meanFirmness(look_ == Look::confirm ? fresh_ : closer_);
  if (firmest < skill_.marks_from || accountedFor(middle)) return dismiss();
  if (goesAside(middle, firmest)) return next();
  suspect_P_.reset();
  marked_P_.push_back(middle);
  return {Deed::mark, Vec3(middle.x(), middle.y(), 0), grade(middle, firmest)};
}

/// Where it is clearly firmer close by this was a flank: on to there, once in a closer look.
bool LumpSearch::goesAside(const Vec3& from_P, double firmest) {
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

LumpSearch::Intent LumpSearch::dismiss() {
  dismissed_P_.push_back(*suspect_P_);
  suspect_P_.reset();
  return next();
}

void LumpSearch::planCross(const Vec3& p_P) {
  for (const Vec3& off : {Vec3(0, -kCross, 0), Vec3(0, kCross, 0), Vec3(kCross, 0, 0),
                          Vec3(-kCross, 0, 0), Vec3(0, 0, 0)})
    closer_places_.push_back(inArea(Vec3(p_P.x(), p_P.y(), 0) + off));
}

/// At one place, so often: what led there was chosen for being firm, only fresh presses tell.
void LumpSearch::pressAfresh(const Vec3& p_P, int times, Look look) {
  look_ = look;
  fresh_.clear();
  suspect_P_ = Vec3(p_P.x(), p_P.y(), 0);
  closer_places_.assign(static_cast<std::size_t>(times), *suspect_P_);
}

/// Nobody asks what lies beyond the outline; and toward the edge of a block it gives way less by
/// itself.
Vec3 LumpSearch::inArea(const Vec3& p_P) const {
  if (phantom_.to_area) return phantom_.to_area(p_P);
  return {std::clamp(p_P.x(), -phantom_.half_x, phantom_.half_x),
          std::clamp(p_P.y(), -phantom_.half_y, phantom_.half_y), p_P.z()};
}

/// As wide as where it was felt to be firm.
Hand::Word LumpSearch::grade(const Vec3& p_P, double firmest) {
  constexpr double kAcross = 3, kSmallest = 0.006, kLargest = 0.035;  // of the spread; m
  Hand::Word word;
  word.kind = Hand::WordKind::grade;
  word.diameter = std::clamp(
      kAcross * memory_.spreadAbout(p_P, closer_) * (1 + skill_.size_sd * judgement_.normal()),
      kSmallest, kLargest);
  word.hardness = firmest >= skill_.hard_from ? 2 : 1;
  return word;
}

}  // namespace palpa::twin
