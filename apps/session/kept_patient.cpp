#include "apps/session/kept_patient.h"

#include <cstdlib>
#include <optional>
#include <sstream>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/patient/patient_file.h"
#include "apps/os/file_access.h"

namespace palpa::session {
namespace {

constexpr std::size_t kDigest = 64;  // hexadecimal digits; a line's end follows

/// All that a patient is built from, to the bit.
std::string textOf(const anatomy::PatientParameters& p) {
  static_assert(sizeof(p) == 13 * sizeof(double), "A new parameter must be part of the text, too");
  std::ostringstream text;
  text << std::hexfloat << static_cast<int>(p.side) << ' ' << p.seed << ' '
       << static_cast<int>(p.extent) << ' ' << static_cast<int>(p.sex);
  for (const double value :
       {p.height, p.bmi, p.vein_depth, p.vein_diameter, p.pleura_distance, p.clavicle_length,
        p.clavicle_thickness, p.layers.skin, p.layers.fat, p.layers.muscle})
    text << ' ' << value;
  return text.str();
}

std::optional<std::filesystem::path> placeOf(const anatomy::PatientParameters& parameters) {
  const char* folder = std::getenv("PALPA_CACHE");
  if (!folder || !*folder) return std::nullopt;
  const std::string name = sha256(os::programStamp() + '\n' + textOf(parameters));
  return std::filesystem::path(folder) / "patients" / (name + ".glb");
}

std::optional<anatomy::Patient> kept(const std::filesystem::path& file) {
  const std::optional<std::string> bytes = readWhole(file);
  if (!bytes || bytes->size() <= kDigest) return std::nullopt;
  const std::string_view glb = std::string_view(*bytes).substr(kDigest + 1);
  if (sha256(glb) != bytes->substr(0, kDigest)) return std::nullopt;
  return anatomy::patientOfGlb(glb, file.string());
}

void keep(const anatomy::Patient& patient, const std::filesystem::path& file) {
  os::makeFolders(file.parent_path());  // writing says what is wrong
  const std::string glb = anatomy::glbOf(patient, file.string());
  try {
    writeWhole(file, sha256(glb) + '\n' + glb, Lasts::no);
  } catch (const Error&) {  // a full disk, a folder that is not ours: the next one builds it anew
  }
}

}  // namespace

anatomy::Patient keptPatient(const anatomy::PatientParameters& parameters) {
  const std::optional<std::filesystem::path> place = placeOf(parameters);
  if (!place) return anatomy::buildPatient(parameters);
  if (std::optional<anatomy::Patient> patient = kept(*place)) return *std::move(patient);
  anatomy::Patient patient = anatomy::buildPatient(parameters);
  keep(patient, *place);
  return patient;
}

}  // namespace palpa::session
