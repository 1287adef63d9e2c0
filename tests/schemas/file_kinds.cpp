#include "file_kinds.h"

#include "anatomy/import/mesh_file.h"
#include "anatomy/patient/patient_file.h"
#include "anatomy/volume/volume.h"
#include "apps/calibrate/recorded.h"
#include "calibration/camera_model.h"
#include "kinds.h"
#include "sample_files.h"
#include "schema_files.h"
#include "tests/anatomy_import/sample_meshes.h"
#include "tests/anatomy_volume/sample_volumes.h"
#include "tests/record/synthetic_session.h"

namespace palpa::schemas {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string documentOf(const Sample& sample) {
  const fs::path shipped = assetsFolder() / sample.asset;
  json document = fs::exists(shipped) ? jsonOf(shipped) : json::object();
  document.merge_patch(sample.more);
  return document.dump(1);
}

/// As somebody would who means harm: the checksum is right again, where there is a document.
std::string sealed(const Kind& kind, const std::string& bytes) {
  json document = json::parse(bytes, nullptr, false);
  if (!document.is_object()) return bytes;
  kind.seal(&document);
  return document.dump(1);
}

FileKind withSchema(const Kind& kind) {
  FileKind file{.name = kind.name, .samples = {}, .read = kind.read, .has_places = true};
  if (kind.seal) file.seal = [kind](const std::string& bytes) { return sealed(kind, bytes); };
  for (const Sample& sample : kind.samples) {
    const std::string bytes = documentOf(sample);
    file.samples.push_back({sample.asset, file.seal ? file.seal(bytes) : bytes});
  }
  return file;
}

std::vector<FileKind> surfaceKinds() {
  const anatomy::RawMesh box = anatomy::test::box();
  const auto read = [](const fs::path& file) { anatomy::readMeshFile(file); };
  return {{"surface_obj", {{"own/box.obj", anatomy::test::asObj(box)}}, read},
          {"surface_stl",
           {{"own/box.stl", anatomy::test::asStl(box, true)},
            {"own/packed.stl", anatomy::test::asStl(box, false)}},
           read},
          {"surface_ply",
           {{"own/box.ply", anatomy::test::asPly(box, 't')},
            {"own/packed.ply", anatomy::test::asPly(box, 'l')}},
           read},
          {"surface_glb", {{"own/box.glb", anatomy::test::asGlb(box)}}, read},
          {"patient", {{"own/patient.glb", patientGlb()}}, [](const fs::path& file) {
             anatomy::readPatient(file);
           }}};
}

anatomy::Volume smallVolume() {
  const Mat3 steps = Vec3(1e-3, 1.5e-3, 2e-3).asDiagonal();
  return anatomy::test::sampled({9, 8, 7}, steps, Vec3::Zero(), [](const Vec3& p) {
    return static_cast<float>(std::round(40 * std::sin(900 * p.sum())));
  });
}

std::vector<FileKind> volumeKinds() {
  const anatomy::Volume v = smallVolume();
  const std::string shorts = anatomy::test::bytesOfVoxels<std::int16_t>(v);
  const std::string nifti = anatomy::test::asNifti(v, 4, 16, shorts, true);
  const auto read = [](const fs::path& file) { anatomy::readVolume(file); };
  return {{"volume_mha",
           {{"own/plain.mha", anatomy::test::asMha(v, "MET_SHORT", shorts, false)},
            {"own/packed.mha", anatomy::test::asMha(v, "MET_SHORT", shorts, true)}},
           read},
          {"volume_nifti",
           {{"own/plain.nii", nifti}, {"own/packed.nii.gz", anatomy::test::deflated(nifti, true)}},
           read},
          {.name = "dicom",
           .samples = {{"own/series/0.dcm", dicomSlice(0)}, {"own/series/1.dcm", dicomSlice(1)}},
           .read = [](const fs::path& file) { anatomy::readVolume(file.parent_path()); },
           .is_folder = true}};
}

std::vector<FileKind> cameraKinds() {
  const auto read = [](const fs::path& file) { calibration::readCameraModel(file); };
  return {{.name = "camera_yaml", .samples = {{"own/camera.yaml", openCvYaml()}}, .read = read},
          {.name = "camera_xml", .samples = {{"own/camera.xml", openCvXml()}}, .read = read}};
}

/// `header`, and twelve times this line of numbers.
std::string table(const std::string& header, const std::string& line) {
  std::string text = header + "\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(i) + "," + line + "\n";
  return text;
}

std::vector<FileKind> tableKinds() {
  return {
      {"poses",
       {{"own/poses.csv", table("t_s,x_mm,y_mm,z_mm,q_w,q_x,q_y,q_z", "1.5,-2,3e1,1,0,0,0")},
        {"own/poses.json", "[[[1,0,0,0.25],[0,1,0,-0.5],[0,0,1,0],[0,0,0,1]]]"}},
       [](const fs::path& file) { calibrate::readPoses(file); }},
      {"touches",
       {{"own/touches.csv", table("name,known_x_mm,known_y_mm,known_z_mm,touched_x_mm,touched_y_mm,"
                                  "touched_z_mm,for",
                                  "1.5,2.5,-3.5,1e1,22.25,-0.125,fit")}},
       [](const fs::path& file) { calibrate::readTouches(file); }},
      {"track",
       {{"own/track.csv", table("t_s,x_m,y_m,z_m", "0.1,0.25,-0.5")}},
       [](const fs::path& file) { calibrate::readTrack(file); }},
      {"force_readings",
       {{"own/readings.csv", table("t_s,q_w,q_x,q_y,q_z,force_x_N,force_y_N,force_z_N,torque_x_Nm,"
                                   "torque_y_Nm,torque_z_Nm",
                                   "1,0,0,0,0.5,-0.25,1e-2,0,0.001,0")}},
       [](const fs::path& file) { calibrate::readStaticReadings(file); }}};
}

std::vector<FileKind> evidenceKinds() {
  return {{.name = "session",
           .samples = {{"own/session.palpa", sessionFile()}},
           .read = [](const fs::path& file) {
             const record::SessionReader reader(file);
             record::test::everything(reader);
           }}};
}

}  // namespace

std::vector<FileKind> everyFileKind() {
  std::vector<FileKind> all;
  for (const Kind& kind : everyKind()) all.push_back(withSchema(kind));
  for (std::vector<FileKind> some : {cameraKinds(), tableKinds()})
    for (FileKind& kind : some) {
      kind.has_places = true;
      all.push_back(std::move(kind));
    }
  for (const std::vector<FileKind>& some : {surfaceKinds(), volumeKinds(), evidenceKinds()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace palpa::schemas
