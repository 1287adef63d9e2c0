#include "sample_files.h"

#include <cstdint>
#include <cstring>

#include "anatomy/patient/patient_file.h"
#include "anatomy/shapes/mesh_tools.h"
#include "tests/anatomy_import/round_meshes.h"
#include "tests/record/synthetic_session.h"
#include "tests/support/files.h"
#include "tests/support/scratch_folder.h"

namespace palpa::schemas {
namespace {

template <class Number>
void append(std::string* bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes->append(raw, sizeof number);
}

/// An element of DICOM's explicit little-endian way of writing (PS3.5, 7.1.2).
std::string element(std::uint16_t group, std::uint16_t number, const std::string& kind,
                    std::string value) {
  if (value.size() % 2) value += kind == "UI" ? '\0' : ' ';
  std::string bytes;
  append(&bytes, group);
  append(&bytes, number);
  bytes += kind;
  if (kind == "OB" || kind == "OW") {
    append(&bytes, std::uint16_t{0});
    append(&bytes, static_cast<std::uint32_t>(value.size()));
  } else {
    append(&bytes, static_cast<std::uint16_t>(value.size()));
  }
  return bytes + value;
}

template <class Number>
std::string rawOf(Number number) {
  std::string bytes;
  append(&bytes, number);
  return bytes;
}

std::string wholeNumber(std::uint16_t number, std::uint16_t value) {
  return element(0x0028, number, "US", rawOf(value));
}

std::string dicomHeader(const std::string& instance) {
  const std::string meta = element(0x0002, 0x0001, "OB", std::string("\0\1", 2)) +
                           element(0x0002, 0x0002, "UI", "1.2.840.10008.5.1.4.1.1.2") +
                           element(0x0002, 0x0003, "UI", instance) +
                           element(0x0002, 0x0010, "UI", "1.2.840.10008.1.2.1") +
                           element(0x0002, 0x0012, "UI", "1.2.3");
  return std::string(128, '\0') + "DICM" +
         element(0x0002, 0x0000, "UL", rawOf(static_cast<std::uint32_t>(meta.size()))) + meta;
}

}  // namespace

std::string openCvYaml() {
  return "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
         "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
         "   data: [ 602.5, 0., 322.5, 0., 601.5, 237.5, 0., 0., 1. ]\n"
         "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
         "   data: [ -0.21, 0.09, 0.0006, -0.0004, 0. ]\navg_reprojection_error: 0.2\n";
}

std::string openCvXml() {
  return "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n"
         "<image_height>480</image_height>\n<camera_matrix type_id=\"opencv-matrix\">\n"
         "<rows>3</rows><cols>3</cols><dt>d</dt>\n"
         "<data>602.5 0. 322.5 0. 601.5 237.5 0. 0. 1.</data></camera_matrix>\n"
         "<distortion_coefficients type_id=\"opencv-matrix\">\n"
         "<rows>1</rows><cols>5</cols><dt>d</dt>\n"
         "<data>-0.21 0.09 0.0006 -0.0004 0.</data></distortion_coefficients>\n"
         "</opencv_storage>\n";
}

std::string dicomSlice(int number) {
  const std::string instance = "1.2.3.4." + std::to_string(number + 1);
  const std::string place = "-12\\30\\" + std::to_string(100 + 3 * number);
  std::string voxels;
  for (int i = 0; i < 30; ++i) append(&voxels, static_cast<std::int16_t>(5 * number + i % 6));
  return dicomHeader(instance) + element(0x0008, 0x0016, "UI", "1.2.840.10008.5.1.4.1.1.2") +
         element(0x0008, 0x0018, "UI", instance) + element(0x0008, 0x103e, "LO", "chest") +
         element(0x0020, 0x000e, "UI", "1.2.3.4") + element(0x0020, 0x0032, "DS", place) +
         element(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0") + wholeNumber(0x0002, 1) +
         element(0x0028, 0x0004, "CS", "MONOCHROME2") + wholeNumber(0x0010, 5) +
         wholeNumber(0x0011, 6) + element(0x0028, 0x0030, "DS", "0.9\\0.8") +
         wholeNumber(0x0100, 16) + wholeNumber(0x0101, 16) + wholeNumber(0x0102, 15) +
         wholeNumber(0x0103, 1) + element(0x0028, 0x1052, "DS", "-1000") +
         element(0x0028, 0x1053, "DS", "2") + element(0x7fe0, 0x0010, "OW", voxels);
}

std::string patientGlb() {
  const anatomy::RawMesh raw = anatomy::test::ball(0.1, 6, 8);
  anatomy::OrganSurface skin;
  skin.id = "skin";
  skin.organ = Organ::skin;
  skin.mesh.points = raw.points;
  skin.mesh.triangles = raw.triangles;
  anatomy::computeNormals(&skin.mesh);
  skin.licence = "CC0-1.0";
  anatomy::Patient patient;
  patient.name = "small";
  patient.organs = {skin};
  patient.landmarks[anatomy::landmark::kEntry] = Vec3(0, 0, 0.1);
  const test::ScratchFolder folder("sample-patient");
  anatomy::writePatient(patient, folder / "p.glb");
  return test::slurp(folder / "p.glb");
}

std::string sessionFile() {
  const test::ScratchFolder folder("sample-session");
  {
    record::SessionWriter writer(folder / "s.palpa", record::test::syntheticInfo());
    record::test::writeTrial(writer, 400);
    writer.close();
  }
  return test::slurp(folder / "s.palpa");
}

}  // namespace palpa::schemas
