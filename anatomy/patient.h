#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/geometry/pose.h"

/// A patient: closed surfaces with their meaning, and named landmarks. Frame A: +x patient's left,
/// +y posterior, +z superior, origin at the suprasternal notch (on the skin). Metres.
namespace palpa::anatomy {

struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;                            ///< one a point, outward, unit length
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<std::array<float, 2>> uvs;  ///< one a point, v down the picture (glTF); or none
};

/// Rows from the top, sRGB.
struct RgbPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 a pixel; empty: none
};

struct OrganSurface {
  std::string id;  ///< unique in the patient, e.g. "clavicle_right"
  Organ organ = Organ::none;
  TriangleMesh mesh;
  std::array<float, 4> rgba{1, 1, 1, 1};
  std::string licence{};                     ///< of this surface, where it is not the patient's
  std::string source{};                      ///< who made it, as its licence asks to be named
  RgbPicture texture{};                      ///< laid over it by its uvs, multiplied by rgba
  std::vector<unsigned char> texture_png{};  ///< as a file held it, to be written so again; or none
};

/// What a surface encloses; air where it says nothing of it.
Tissue tissueInside(Organ organ);

enum class Side { right, left };
inline const char* name(Side side) { return side == Side::right ? "right" : "left"; }

/// Thickness of the layers under the skin's surface, metres, measured along its normal.
struct SoftLayers {
  double skin = 0.002;
  double fat = 0.006;
  double muscle = 0.008;
};

/// Names used in `landmarks`; all are points in A.
namespace landmark {
inline constexpr const char* kNotch = "suprasternal_notch";
inline constexpr const char* kSternalEnd = "clavicle_sternal_end";
inline constexpr const char* kSternalEndPosteriorSuperior =
    "clavicle_sternal_end_posterior_superior";
inline constexpr const char* kAcromialEnd = "clavicle_acromial_end";
/// junction of medial and middle thirds
inline constexpr const char* kMedialThird = "clavicle_medial_third";
inline constexpr const char* kLateralThird = "clavicle_lateral_third";
/// on the skin, 1 cm below the medial-third junction
inline constexpr const char* kEntry = "entry_point";
/// centre of the lumen where the taught line meets it
inline constexpr const char* kVeinTarget = "vein_target";
/// centre of the vein's lumen below the middle of the clavicle
inline constexpr const char* kWindow = "infraclavicular_window";
inline constexpr const char* kWindowSkin = "infraclavicular_window_skin";  ///< on the skin over it
}  // namespace landmark

struct Patient {
  std::string name;
  Side side = Side::right;  ///< the side that is punctured
  std::uint64_t seed = 0;
  SoftLayers layers;
  std::vector<OrganSurface> organs;
  std::map<std::string, Vec3> landmarks;  ///< p_A
  std::string licence = "CC0-1.0";        ///< of the whole
  std::string source{};
  /// What a person sees in the skin's place in the large view, in A: only seen, on no account felt
  /// or judged, and in no patient's file
  std::optional<OrganSurface> seen_as{};

  const Vec3& landmark(const std::string& landmark_name) const;  ///< throws Error when absent
  const OrganSurface& organ(Organ kind) const;  ///< the first of its kind; throws Error
};

/// Side-free coordinates for what is taught: (medial, posterior, cephalad) about the junction of
/// the clavicle's medial and middle thirds. Medial points along the clavicle's chord to its sternal
/// end; cephalad is the part of +z_A across it; posterior completes the orthogonal triple, pointing
/// to +y_A. On the left side the triple is left-handed: both sides give the same numbers for
/// mirrored motion.
class LandmarkFrame {
 public:
  explicit LandmarkFrame(const Patient& patient);

  Vec3 pointToLandmarks(const Vec3& p_A) const { return basis_.transpose() * (p_A - origin_); }
  Vec3 pointToA(const Vec3& p_L) const { return origin_ + basis_ * p_L; }
  Vec3 vectorToLandmarks(const Vec3& v_A) const { return basis_.transpose() * v_A; }
  Vec3 vectorToA(const Vec3& v_L) const { return basis_ * v_L; }

 private:
  Vec3 origin_;
  Mat3 basis_;  ///< columns: medial, posterior, cephalad in A; determinant +-1
};

}  // namespace palpa::anatomy
