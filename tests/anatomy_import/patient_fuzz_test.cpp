#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/import/import_map.h"
#include "anatomy/patient/patient_file.h"
#include "anatomy/shapes/mesh_tools.h"
#include "round_meshes.h"
#include "sample_meshes.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"
#include "tests/support/little_memory.h"
#include "tests/support/scratch_folder.h"

/// Patient files and import maps that nobody vouches for: bits flipped, ends cut off, values of
/// their JSON swapped for absurd counts, invalid numbers, rings of nodes, nests of brackets.
/// Each is read or refused in one line, and no more than kMemory is taken: the address space is
/// limited while they are read (not under the sanitizers, which need terabytes of it).
namespace palpa::anatomy {
namespace {

using namespace test;
using namespace palpa::test;
using Json = nlohmann::json;

constexpr rlim_t kMemory = 256u << 20;  // beyond what the process has already

int cases() { return palpa::test::counted(250, 2500); }

std::string nest(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

/// JSON text in which one value, wherever it stands, has become something else.
std::string absurd(const Json& sound, DamageDice& dice) {
  static const std::string kInstead[] = {"4294967295",
                                         "18446744073709551615",
                                         "-1",
                                         "1e308",
                                         "1e999",
                                         "NaN",
                                         "null",
                                         "true",
                                         "\"\"",
                                         "\"\\u0000\\n\"",
                                         "[]",
                                         "{}",
                                         "0.5",
                                         "\"nan\"",
                                         "[0,0,0,0]",
                                         "[1e39,0,0]",
                                         "{\"a\":{\"a\":{}}}",
                                         nest(20),
                                         nest(3000),
                                         "\"" + std::string(5000, 'x') + "\"",
                                         "[0,1,2,3]",
                                         "7",
                                         "5126"};
  Json changed = sound;
  const Json flat = sound.flatten();
  auto at = flat.begin();
  std::advance(at, static_cast<std::ptrdiff_t>(dice.below(flat.size())));
  Json::json_pointer where(at.key());
  for (std::size_t up = dice.below(3); up > 0 && !where.parent_pointer().empty(); --up)
    where = where.parent_pointer();
  const std::size_t way = dice.below(8);
  if (way == 0) {
    Json& parent = changed[where.parent_pointer()];
    if (parent.is_object()) parent.erase(where.back());
    return changed.dump();
  }
  if (way == 1) {
    Json& parent = changed[where.parent_pointer()];
    if (parent.is_object()) parent["another"] = changed[where];
    return changed.dump();
  }
  changed[where] = "@here@";
  std::string text = changed.dump();
  const std::string mark = "\"@here@\"";
  text.replace(text.find(mark), mark.size(), kInstead[dice.below(std::size(kInstead))]);
  return text;
}

std::string flipped(std::string bytes, DamageDice& dice, std::size_t range) {
  if (dice.below(4) == 0) bytes.resize(dice.below(bytes.size()));
  for (std::size_t i = 0, n = 1 + dice.below(6); i < n && !bytes.empty(); ++i)
    bytes[dice.below(std::min(range, bytes.size()))] ^= static_cast<char>(1 << dice.below(8));
  return bytes;
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The container with another JSON part, its lengths right.
std::string withJson(const std::string& glb, std::string json) {
  const std::string rest = glb.substr(20 + wordAt(glb, 12));
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  test::put(bytes, std::uint32_t{2});
  test::put(bytes, static_cast<std::uint32_t>(20 + json.size() + rest.size()));
  test::put(bytes, static_cast<std::uint32_t>(json.size()));
  return bytes + "JSON" + json + rest;
}

Patient smallSkinPatient() {
  const RawMesh raw = ball(0.1, 6, 8);
  OrganSurface skin;
  skin.id = "skin";
  skin.organ = Organ::skin;
  skin.mesh.points = raw.points;
  skin.mesh.triangles = raw.triangles;
  computeNormals(&skin.mesh);
  skin.licence = "CC0-1.0";
  Patient patient;
  patient.name = "small";
  patient.organs = {skin, skin};
  patient.organs[1].id = "bone";
  patient.organs[1].organ = Organ::rib;
  patient.landmarks[landmark::kEntry] = Vec3(0, 0, 0.1);
  return patient;
}

/// Whether it was read; refused means one line that begins with `where`.
template <class Read>
bool readOrRefused(const std::string& where, Read read) {
  std::string words;
  {
    const LittleMemory little(kMemory);
    try {
      read();
      return true;
    } catch (const Error& error) {
      words = error.what();
    }
  }
  EXPECT_EQ(words.rfind(where, 0), 0u) << words;
  EXPECT_EQ(words.find('\n'), std::string::npos) << words;
  return false;
}

bool patientReads(const ScratchFolder& folder, const std::string& bytes) {
  const std::filesystem::path file = folder / "harmed.glb";
  std::ofstream(file, std::ios::binary) << bytes;
  const bool read = readOrRefused(file.string(), [&] {
    const Patient patient = readPatient(file);
    for (const OrganSurface& organ : patient.organs) {
      for (const Vec3& p : organ.mesh.points) ASSERT_TRUE(p.allFinite());
      for (const auto& t : organ.mesh.triangles)
        for (const auto c : t) ASSERT_LT(c, organ.mesh.points.size());
    }
  });
  readOrRefused("", [&] { readMesh(MeshFormat::gltf, bytes, "harmed"); });  // as a file of surfaces
  return read;
}

TEST(PatientFuzz, HarmedPatientsAreReadOrRefused) {
  const ScratchFolder folder("patient-fuzz");
  writePatient(smallSkinPatient(), folder / "whole.glb");
  std::ifstream in(folder / "whole.glb", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const std::size_t json_end = 20 + wordAt(whole, 12);
  const Json sound = Json::parse(whole.substr(20, json_end - 20));
  ASSERT_TRUE(patientReads(folder, withJson(whole, sound.dump())));
  DamageDice dice(77);
  int read = 0, refused = 0;
  for (int i = 0; i < cases(); ++i) {
    const std::string harmed = i % 2 ? withJson(whole, absurd(sound, dice))
                                     : flipped(whole, dice, i % 4 ? json_end : whole.size());
    ++(patientReads(folder, harmed) ? read : refused);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(read, cases() / 20) << "some damage does no harm";
  EXPECT_GT(refused, cases() / 3);
  expectLessThan2GiB();
}

TEST(PatientFuzz, RingsOfNodesAndAbsurdCountsAreRefused) {
  const ScratchFolder folder("patient-ring");
  writePatient(smallSkinPatient(), folder / "whole.glb");
  std::ifstream in(folder / "whole.glb", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const Json sound = Json::parse(whole.substr(20, wordAt(whole, 12)));
  Json ring = sound;
  ring["nodes"][0]["children"] = {1};
  ring["nodes"][1]["children"] = {0};
  EXPECT_FALSE(
      readOrRefused("", [&] { readMesh(MeshFormat::gltf, withJson(whole, ring.dump()), "ring"); }));
  for (const std::uint64_t count :
       {std::uint64_t{1} << 31, std::uint64_t{1} << 40, std::uint64_t{0xffffffffffffffff}}) {
    Json many = sound;
    many["accessors"][0]["count"] = count;
    EXPECT_FALSE(patientReads(folder, withJson(whole, many.dump()))) << count;
  }
}

TEST(MapFuzz, HarmedMapsAreReadOrRefused) {
  const std::string whole =
      R"({"format":"palpa-import-map","version":1,"name":"n","side":"left","unit":"mm","axes":"LPS","licence":"CC0-1.0","source":"s","entries":[)"
      R"({"file":"a.stl","id":"a","organ":"rib"},{"file":"c.glb","id":"b","organ":"airway","mesh":2,"unit":"m","axes":"LSA","scale":2,)"
      R"("translate_mm":[1,2,3],"colour":[0.5,0.25,1],"licence":"x","pieces":"largest"}],"landmarks":{"entry_point":{"at":[1,2,3],"unit":"cm"}},)"
      R"("origin":{"at":[10,20,30]}})";
  const Json sound = Json::parse(whole);
  DamageDice dice(78);
  int read = 0, refused = 0;
  for (int i = 0; i < cases(); ++i) {
    const std::string harmed = i % 2 ? absurd(sound, dice) : flipped(whole, dice, whole.size());
    ++(readOrRefused("map",
                     [&] {
                       for (const MapEntry& entry : parseImportMap(harmed, "map").entries)
                         ASSERT_TRUE(entry.place(Vec3::Ones()).allFinite());
                     })
           ? read
           : refused);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, cases() / 2);
  expectLessThan2GiB();
}

}  // namespace
}  // namespace palpa::anatomy
