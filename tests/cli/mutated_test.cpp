#include <gtest/gtest.h>

#include <fstream>
#include <ostream>

#include "program.h"
#include "tests/anatomy_import/sample_meshes.h"
#include "tests/anatomy_volume/sample_volumes.h"
#include "tests/schemas/sample_files.h"
#include "tests/support/counts.h"
#include "tests/support/hang_watch.h"
#include "tests/support/library_words.h"
#include "tests/support/mutations.h"
#include "tests/support/setting.h"

/// Mutated files of every kind that a command reads soon: it takes one, or ends with a line of ours
/// and leaves nothing behind. (Their readers, with far more of them: tests/schemas.)
namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr std::chrono::seconds kHung{300};  // a session may go on with what was taken

int casesAKind() { return test::counted(2, 50); }

/// A file, and the command that reads it; "@" in this stands for the file.
struct ReadBy {
  const char* file;  ///< below a copy of assets/; what is not shipped: in own/
  Arguments command;

  std::string name() const {
    std::string name = file;
    for (char& c : name)
      if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
  }
};

void PrintTo(const ReadBy& one, std::ostream* out) { *out << one.file; }

/// A task that is taken has no place for its session, which would take long.
Arguments trained(const std::string& task) {
  return {"train",  "--task",  task,    "--operator",  "expert",
          "--fast", "--quiet", "--out", "/dev/null/r", "--no-views"};
}

Arguments performed(const Arguments& words) {
  Arguments all = quickly(words);
  all.insert(all.end(), {"--out", "r"});
  return all;
}

const std::vector<ReadBy>& everyFile() {
  static const std::vector<ReadBy> files{
      {"stations/virtual_bench.json", {"board", "print", "--station", "@", "--out", "b.pdf"}},
      {"boards/table.json", {"board", "print", "--board", "@", "--out", "b.pdf"}},
      {"tasks/paracentesis.json", trained("@")},
      {"tasks/palpation_breast.json", trained("@")},
      {"tasks/search.json", trained("@")},
      {"tasks/squeeze.json", trained("@")},
      {"tasks/friction.json", trained("@")},
      {"tasks/pulse.json", trained("@")},
      {"tasks/paracentesis_expert_path.json",
       performed({"subclavian", "--expert-path", "@", "--operator", "expert"})},
      {"materials/needle.json", performed({"subclavian", "--operator", "expert"})},
      {"materials/lumps.json", performed({"squeeze", "--operator", "expert"})},
      {"materials/lumps/large.json", performed({"squeeze", "--operator", "expert"})},
      {"operators/expert.json", performed({"subclavian", "--operator", "@"})},
      {"operators/palpation_expert.json", performed({"palpation", "--operator", "@"})},
      {"operators/search_expert.json", performed({"search", "--operator", "@"})},
      {"operators/squeeze_expert.json", performed({"squeeze", "--operator", "@"})},
      {"operators/friction_expert.json", performed({"friction", "--operator", "@"})},
      {"operators/pulse_expert.json", performed({"pulse", "--operator", "@"})},
      {"presentations/pilot.json",
       performed({"squeeze", "--operator", "expert", "--presentation", "@"})},
      {"patients/reference.json", {"patient", "build", "--out", "p.glb"}},
      {"patients/bodyparts3d_hra.json",
       {"patient", "import", "own", "--map", "@", "--out", "p.glb"}},
      {"checklists/subclavian.json", {"rate", "form", "--checklist", "@", "--out", "f.html"}},
      {"checklists/global_rating.json", {"rate", "form", "--global", "@", "--out", "f.html"}},
      {"own/patient.glb", {"patient", "info", "@"}},
      {"own/box.obj", {"patient", "info", "@", "--unit", "mm"}},
      {"own/box.stl", {"patient", "info", "@", "--unit", "mm"}},
      {"own/box.ply", {"patient", "info", "@", "--unit", "mm"}},
      {"own/box.glb", {"patient", "info", "@", "--unit", "mm"}},
      {"own/scan.mha", {"patient", "build", "--ct", "@", "--out", "p.glb"}},
      {"own/scan.nii", {"patient", "build", "--ct", "@", "--out", "p.glb"}},
      {"own/series/0.dcm", {"patient", "build", "--ct", "own/series", "--out", "p.glb"}},
      {"own/session.palpa", {"replay", "@"}},
      {"own/poses.csv", {"calibrate", "tool", "--pivot", "@", "--quiet", "--out", "r"}},
      {"own/readings.csv",
       {"calibrate", "force-sensor", "--readings", "@", "--quiet", "--out", "r"}}};
  return files;
}

/// Small sound files of the kinds that are not shipped.
std::string madeHere(const std::string& name) {
  const anatomy::RawMesh box = anatomy::test::box();
  const anatomy::Volume scan =
      anatomy::test::sampled({9, 8, 7}, 1e-3 * Mat3::Identity(), Vec3::Zero(),
                             [](const Vec3& p) { return static_cast<float>(1e5 * p.sum()); });
  const std::string voxels = anatomy::test::bytesOfVoxels<std::int16_t>(scan);
  if (name == "own/patient.glb") return schemas::patientGlb();
  if (name == "own/session.palpa") return schemas::sessionFile();
  if (name == "own/box.obj") return anatomy::test::asObj(box);
  if (name == "own/box.stl") return anatomy::test::asStl(box, true);
  if (name == "own/box.ply") return anatomy::test::asPly(box, 't');
  if (name == "own/box.glb") return anatomy::test::asGlb(box);
  if (name == "own/scan.mha") return anatomy::test::asMha(scan, "MET_SHORT", voxels, false);
  if (name == "own/scan.nii") return anatomy::test::asNifti(scan, 4, 16, voxels, true);
  if (name == "own/series/0.dcm") return schemas::dicomSlice(0);
  if (name == "own/poses.csv") return "x_mm,y_mm,z_mm,q_w,q_x,q_y,q_z\n1,2,3,1,0,0,0\n";
  return "q_w,q_x,q_y,q_z,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm\n"
         "1,0,0,0,1,2,3,0,0,0\n";
}

/// After the progress, where there is any: "palpa: ..." once, as the last line.
bool endsInALineOfOurs(const std::string& said) {
  const std::string lines = "\n" + said;
  const std::size_t ours = lines.find("\npalpa: ");
  return ours != std::string::npos && lines.find('\n', ours + 1) + 1 == lines.size();
}

class MutatedFile : public testing::TestWithParam<ReadBy> {
 protected:
  MutatedFile() {
    fs::create_directories(here / "own/series");
    std::ofstream(here / "own/series/1.dcm", std::ios::binary) << schemas::dicomSlice(1);
    const fs::path shipped = fs::path(PALPA_SOURCE_DIR) / "assets" / GetParam().file;
    sound_ = fs::exists(shipped) ? contentOf(shipped) : madeHere(GetParam().file);
  }

  /// The program's data, in which the file is another.
  fs::path dataWith(const std::string& bytes) const {
    const bool is_shipped = std::string(GetParam().file).rfind("own/", 0) != 0;
    fs::path file = is_shipped ? data_ / GetParam().file : here / GetParam().file;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  Arguments command(const std::string& file) const {
    Arguments words = GetParam().command;
    for (std::string& word : words)
      if (word == "@") word = file;
    return words;
  }

  void expectTakenOrRefused(const std::string& bytes) {
    const std::string file = dataWith(bytes).string();
    const std::vector<std::string> before = here.files();
    const Outcome outcome = palpa(command(file), here.path());
    EXPECT_EQ(test::libraryWordsIn(outcome.err), "") << outcome.err.substr(0, 500);
    if (outcome.exit_code == 0) return;
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 2) << outcome.exit_code;
    EXPECT_TRUE(endsInALineOfOurs(outcome.err)) << outcome.err.substr(0, 500);
    EXPECT_EQ(here.files(), before) << "something was left behind";
  }

  Folder data_, here;
  std::string sound_;
};

TEST_P(MutatedFile, IsTakenOrRefusedInALine) {
  fs::copy(fs::path(PALPA_SOURCE_DIR) / "assets", data_.path(),
           fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  const test::Setting assets("PALPA_ASSETS", data_.path().string().c_str());
  test::HangWatch watch(kHung);
  test::DamageDice dice(20'261'128 + std::string(GetParam().file).size());
  for (int i = 0; i < casesAKind(); ++i) {
    SCOPED_TRACE("file " + std::to_string(i));
    watch.begin(std::string(GetParam().file) + ", file " + std::to_string(i));
    expectTakenOrRefused(test::mutated(sound_, dice));
  }
}

INSTANTIATE_TEST_SUITE_P(Every, MutatedFile, testing::ValuesIn(everyFile()),
                         [](const auto& one) { return one.param.name(); });

}  // namespace
}  // namespace palpa::cli_test
