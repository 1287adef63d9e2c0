#include <gtest/gtest.h>

#include "anatomy/parametric/parametric_patient.h"
#include "scene/view/anatomical_plate.h"
#include "scene/view/contact_sheet.h"
#include "scene/view/scene_view.h"
#include "tests/scene/offscreen.h"
#include "tests/support/picture_match.h"

/// One line a picture, each beside a baseline that was looked at.
namespace palpa::scene {
namespace {

constexpr int kLook_px = 300;

const anatomy::Patient& patientOf(anatomy::Side side) {
  const auto make = [](anatomy::Side s) {
    anatomy::PatientParameters parameters = anatomy::drawParameters(
        anatomy::readPopulation(PALPA_SOURCE_DIR "/assets/patients/reference.json"), s, 0);
    parameters.extent = anatomy::Extent::bust;
    return anatomy::buildPatient(parameters);
  };
  static const anatomy::Patient right = make(anatomy::Side::right),
                                left = make(anatomy::Side::left);
  return side == anatomy::Side::right ? right : left;
}

/// A picture of a table, lighter to the right, with a dark sheet on it.
const Image& table() {
  static const Image picture = [] {
    Image image{kLook_px, kLook_px, 3, {}};
    for (int v = 0; v < kLook_px; ++v)
      for (int u = 0; u < kLook_px; ++u) {
        const bool sheet = u > 60 && u < 150 && v > 190 && v < 270;
        const auto level = static_cast<std::uint8_t>(sheet ? 40 : 90 + u / 4);
        for (int k = 0; k < 3; ++k) image.pixels.push_back(level);
      }
    return image;
  }();
  return picture;
}

struct Look {
  const char* name;
  SceneState state;
  anatomy::Side side = anatomy::Side::right;
  ViewLayout layout{kLook_px, kLook_px, FixedViews::none, true};
  double threshold = 0.97;
};

void PrintTo(const Look& look, std::ostream* out) { *out << look.name; }

SceneState registered(anatomy::Side side = anatomy::Side::right) {
  const Vec3 entry_A = patientOf(side).landmark(anatomy::landmark::kEntry);
  const double outward = side == anatomy::Side::right ? -1 : 1;
  SceneState state;
  state.picture = &table();
  state.registered = true;
  state.camera = {kLook_px, kLook_px, 380, 370, 152, 144};
  state.X_CA =
      lookAt(entry_A + Vec3(0.1 * outward, -0.42, 0.2), entry_A + Vec3(-0.03 * outward, 0, 0));
  state.X_AT = makePose(rotationWithZ(Vec3(-0.7 * outward, 0.45, 0.35).normalized()), entry_A);
  return state;
}

template <class Change>
SceneState with(Change change) {
  SceneState state = registered();
  change(state);
  return state;
}

/// Before the table, both eyes on the entry point, nothing real to be seen.
SceneState standing() {
  return with([](SceneState& s) {
    const Vec3 entry_A = s.X_AT.translation();
    s.picture = nullptr;
    std::array<EyeCamera, 2> eyes;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 apart((i == 0 ? -1 : 1) * 0.032, 0, 0);
      eyes[i] = {{2 * kLook_px, 2 * kLook_px, 300, 300, kLook_px - 0.5, kLook_px - 0.5},
                 lookAt(entry_A + Vec3(0, -0.55, -0.75) + apart, entry_A + apart)};
    }
    s.X_CA = eyes[0].X_CA;
    s.eyes = eyes;
  });
}

std::vector<Look> looks() {
  static const anatomy::TriangleMesh hand = test::sphere({0, 0, 0}, {0.03, 0.02, 0.05});
  const Vec3 entry_A = patientOf(anatomy::Side::right).landmark(anatomy::landmark::kEntry),
             vein_A = patientOf(anatomy::Side::right).landmark(anatomy::landmark::kVeinTarget);
  const auto pushed = [](SceneState& s) {
    const Vec3 tip = s.X_AT.translation();
    s.forces = {{ForceKind::reaction, tip, {0.3, -1.2, -0.4}},
                {ForceKind::weight, tip + Vec3(0, 0, 0.06), {0, 0, -0.8}},
                {ForceKind::device, tip + Vec3(-0.07, 0, 0), {-0.2, 1.4, 0.2}}};
  };
  ViewLayout safe{kLook_px, kLook_px, FixedViews::none, true},
      all{3 * kLook_px, 2 * kLook_px, FixedViews::three, true};
  safe.force_colours = ForceColours::safe;
  ViewLayout worn{4 * kLook_px, 2 * kLook_px, FixedViews::none, false};
  worn.stereo = Stereo::headset;
  return {
      {"skin-translucent", registered()},
      {"skin-solid", with([](SceneState& s) { s.skin = SkinStyle::solid; })},
      {"skin-hidden", with([](SceneState& s) { s.skin = SkinStyle::hidden; })},
      {"left-side", registered(anatomy::Side::left), anatomy::Side::left},
      {"needle-with-blood", with([&](SceneState& s) {
         s.X_AT.translation() = vein_A;
         s.plunger = 0.6;
         s.blood = 0.4;
       })},
      {"needle-with-arterial-blood", with([&](SceneState& s) {
         s.X_AT.translation() = vein_A;
         s.plunger = 0.6;
         s.blood = 0.4;
         s.blood_of = Tissue::artery_lumen;
       })},
      {"needle-with-air", with([&](SceneState& s) {
         s.X_AT.translation() = vein_A;
         s.plunger = 0.6;
         s.blood_of = Tissue::lung;
       })},
      {"probe", with([](SceneState& s) { s.tool = Tool::probe; })},
      {"forces-paper", with(pushed)},
      {"forces-safe", with(pushed), anatomy::Side::right, safe},
      {"guide-and-ellipse", with([&](SceneState& s) {
         s.guide = GuideLine{entry_A, vein_A};
         s.tip_covariance_A = 2e-5 * Mat3::Identity();
       })},
      {"trail", with([&](SceneState& s) {
         for (int i = 0; i <= 40; ++i)
           s.trail_A.push_back(entry_A + 0.025 * i * (vein_A - entry_A) +
                               Vec3(0, 0, 0.004 * std::sin(0.5 * i)));
       })},
      {"occluder", with([&](SceneState& s) {
         s.occluders = {{&hand, makePose(Mat3::Identity(), entry_A + Vec3(0.02, -0.06, 0.02))}};
       })},
      {"words", with([](SceneState& s) {
         s.hud = {"phase 2: advance to the vein",
                  "12 mm inserted, in fat",
                  "1.2 N",
                  "0:31",
                  "clavicle",
                  "within 0.4 mm",
                  "The camera has lost the board: the overlay stands still",
                  "SIMULATED OPERATOR",
                  false,
                  "2 lumps",
                  "scaled to the device"};
       })},
      {"alarm", with([](SceneState& s) {
         s.hud.notice = "The needle touches the lung";
         s.hud.alarm = true;
       })},
      {"no-camera", with([](SceneState& s) {
         s.picture = nullptr;
         s.registered = false;
       })},
      {"not-registered", with([](SceneState& s) { s.registered = false; })},
      {"all-views", registered(), anatomy::Side::right, all},
      {"headset", standing(), anatomy::Side::right, worn},
  };
}

cv::Mat toBgr(const Image& image) {
  cv::Mat bgr;
  cv::cvtColor(
      cv::Mat(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data())),
      bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

class Looks : public testing::TestWithParam<Look> {};

TEST_P(Looks, LikeItsBaseline) {
  SceneView view(offscreen(), patientOf(GetParam().side), GetParam().layout);
  view.show(GetParam().state);
  test::expectLooksLike(toBgr(view.capture()), GetParam().name, GetParam().threshold);
}

INSTANTIATE_TEST_SUITE_P(Every, Looks, testing::ValuesIn(looks()), [](const auto& one) {
  std::string name;
  for (const char c : std::string(one.param.name)) name += c == '-' ? '_' : c;
  return name;
});

TEST(Looks, ContactSheetLikeItsBaseline) {
  test::expectLooksLike(toBgr(contactSheet(offscreen(), patientOf(anatomy::Side::right), 600, 600)),
                        "contact-sheet");
}

TEST(Looks, PlateLikeItsBaseline) {
  PlateWish wish;
  wish.width = 600;
  wish.height = 450;
  wish.plane = Plane::axial;
  wish.section = 0.03;
  wish.skin = SkinStyle::solid;
  test::expectLooksLike(toBgr(anatomicalPlate(offscreen(), patientOf(anatomy::Side::right), wish)),
                        "plate");
}

/// The comparison sees what a person would see.
TEST(PictureMatch, AMissingNeedleIsSeenANoisyPixelIsNot) {
  SceneView view(offscreen(), patientOf(anatomy::Side::right),
                 {kLook_px, kLook_px, FixedViews::none, true});
  SceneState state = registered();
  view.show(state);
  const cv::Mat whole = toBgr(view.capture());
  state.show_tool = false;
  view.show(state);
  EXPECT_LT(test::leastSimilarity(whole, toBgr(view.capture())), 0.95);
  cv::Mat noisy = whole.clone();
  for (int i = 0; i < noisy.rows; ++i) noisy.at<cv::Vec3b>(i, (7 * i) % noisy.cols)[1] ^= 3;
  EXPECT_GT(test::leastSimilarity(whole, noisy), 0.97);
}

}  // namespace
}  // namespace palpa::scene
