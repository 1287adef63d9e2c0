#include "anatomy/patient/patient_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "anatomy/base/error.h"
#include "test_shapes.h"

namespace palpa::anatomy {
namespace {

/// Small, so that hundreds of damaged copies are quick to try.
Patient smallPatient() {
  Patient patient = patientOf(sphereMesh(0.05, 0.02), Organ::skin);
  OrganSurface& skin = patient.organs.front();
  for (std::size_t i = 0; i < skin.mesh.points.size(); ++i)
    skin.mesh.uvs.push_back({0.01f * static_cast<float>(i), 0.25f});
  skin.texture = {6, 4, std::vector<std::uint8_t>(72, 130)};
  patient.organs.push_back({"bone",
                            Organ::clavicle,
                            capsuleMesh({0, 0, 0}, {0.1, 0, 0}, 0.006, 5, 8),
                            {0.9f, 0.8f, 0.7f, 0.5f}});
  patient.name = "small \"patient\"";
  patient.side = Side::left;
  patient.seed = 0xfedcba9876543210u;  // beyond what a JSON number keeps
  patient.layers = {0.0021, 0.0055, 0.0083};
  for (const char* key : {landmark::kNotch, landmark::kMedialThird, landmark::kEntry,
                          landmark::kSternalEndPosteriorSuperior, landmark::kVeinTarget})
    patient.landmarks[key] = Vec3(0.01, -0.02, 1.0 / 3);
  return patient;
}

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void expectSensible(const Patient& patient) {
  EXPECT_FALSE(patient.organs.empty());
  for (const OrganSurface& o : patient.organs) {
    ASSERT_EQ(o.mesh.points.size(), o.mesh.normals.size());
    ASSERT_TRUE(o.mesh.uvs.empty() || o.mesh.uvs.size() == o.mesh.points.size());
    ASSERT_EQ(o.texture.rgb.size(), std::size_t{3} * o.texture.width * o.texture.height);
    for (const Vec3& p : o.mesh.points) ASSERT_TRUE(p.allFinite());
    for (const auto& t : o.mesh.triangles)
      for (const auto index : t) ASSERT_LT(index, o.mesh.points.size());
  }
  for (const auto& [key, p] : patient.landmarks) EXPECT_TRUE(p.allFinite()) << key;
}

/// The file is a patient or an Error; anything else (crash, other exception) fails the test.
bool readsOrRefuses(const std::filesystem::path& file) {
  try {
    expectSensible(readPatient(file));
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(PatientFile, RoundTripKeepsEverything) {
  const ScratchFolder folder("round_trip");
  Patient written = referencePatient();
  roundAsInFile(written);
  writePatient(written, folder / "p.glb");
  const Patient read = readPatient(folder / "p.glb");
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.side, written.side);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.layers.skin, written.layers.skin);
  EXPECT_EQ(read.layers.fat, written.layers.fat);
  EXPECT_EQ(read.layers.muscle, written.layers.muscle);
  ASSERT_EQ(read.landmarks.size(), written.landmarks.size());
  for (const auto& [key, p] : written.landmarks) EXPECT_EQ(read.landmark(key), p) << key;
  ASSERT_EQ(read.organs.size(), written.organs.size());
  for (std::size_t i = 0; i < read.organs.size(); ++i) {
    const OrganSurface &a = written.organs[i], &b = read.organs[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.organ, b.organ);
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_EQ(a.mesh.uvs, b.mesh.uvs);
    EXPECT_EQ(a.texture.width, b.texture.width);
    EXPECT_EQ(a.texture.height, b.texture.height);
    EXPECT_EQ(a.texture.rgb, b.texture.rgb);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_TRUE(a.mesh.points == b.mesh.points) << a.id;
    EXPECT_TRUE(a.mesh.normals == b.mesh.normals) << a.id;
  }
}

TEST(PatientFile, SmallPatientKeepsALargeSeedAndQuotes) {
  const ScratchFolder folder("small");
  writePatient(smallPatient(), folder / "p.glb");
  const Patient read = readPatient(folder / "p.glb");
  EXPECT_EQ(read.seed, 0xfedcba9876543210u);
  EXPECT_EQ(read.name, "small \"patient\"");
  EXPECT_EQ(read.side, Side::left);
}

TEST(PatientFile, ItsBytesAreReadAndWrittenWithoutAFile) {
  const ScratchFolder folder("bytes");
  writePatient(smallPatient(), folder / "p.glb");
  const std::string bytes = glbOf(smallPatient(), "here");
  EXPECT_TRUE(bytes == bytesOf(folder / "p.glb"));
  const Patient read = readPatient(folder / "p.glb"), parsed = patientOfGlb(bytes, "here");
  EXPECT_TRUE(glbOf(parsed, "here") == glbOf(read, "here"));
  EXPECT_EQ(parsed.landmarks, read.landmarks);
  try {
    patientOfGlb(std::string_view(bytes).substr(0, bytes.size() / 2), "the record, its patient");
    ADD_FAILURE() << "half a patient was taken for a whole one";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("the record, its patient: ", 0), 0u) << error.what();
  }
}

TEST(PatientFile, LeavesOnlyTheFinishedFile) {
  const ScratchFolder folder("atomic");
  writePatient(smallPatient(), folder / "p.glb");
  writePatient(smallPatient(), folder / "p.glb");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().filename(), "p.glb");
    ++files;
  }
  EXPECT_EQ(files, 1);
  EXPECT_THROW(writePatient(smallPatient(), folder / "no_such_folder" / "p.glb"), Error);
}

TEST(PatientFile, EveryTruncationIsRefused) {
  const ScratchFolder folder("truncated");
  writePatient(smallPatient(), folder / "p.glb");
  const std::string whole = bytesOf(folder / "p.glb");
  for (int i = 0; i < 50; ++i) {
    put(folder / "cut.glb", whole.substr(0, whole.size() * i / 50));
    EXPECT_FALSE(readsOrRefuses(folder / "cut.glb")) << i << "/50 of the file";
  }
}

// A file that claims its true length but lacks the end of its data.
TEST(PatientFile, TruncationWithARepairedHeaderIsRefused) {
  const ScratchFolder folder("repaired");
  writePatient(smallPatient(), folder / "p.glb");
  const std::string whole = bytesOf(folder / "p.glb");
  for (int i = 1; i < 50; ++i) {
    std::string cut = whole.substr(0, whole.size() * i / 50 / 4 * 4);
    const auto size = static_cast<std::uint32_t>(cut.size());
    if (cut.size() >= 12) cut.replace(8, 4, reinterpret_cast<const char*>(&size), 4);
    put(folder / "cut.glb", cut);
    EXPECT_FALSE(readsOrRefuses(folder / "cut.glb")) << i << "/50 of the file";
  }
}

TEST(PatientFile, FlippedBitsGiveAPatientOrAnError) {
  const ScratchFolder folder("flipped");
  writePatient(smallPatient(), folder / "p.glb");
  const std::string whole = bytesOf(folder / "p.glb");
  const std::size_t json_end = 20 + *reinterpret_cast<const std::uint32_t*>(whole.data() + 12);
  RandomStream random = RandomStream::ofSeed(21);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string damaged = whole;
    // Half of them in the header and the JSON part, where structure is at stake.
    const std::size_t range = i % 2 == 0 ? json_end : whole.size();
    const std::size_t at =
        std::min(range - 1, static_cast<std::size_t>(random.openUniform() * range));
    damaged[at] =
        static_cast<char>(damaged[at] ^ (1 << static_cast<int>(random.openUniform() * 8)));
    put(folder / "flip.glb", damaged);
    refused += !readsOrRefuses(folder / "flip.glb");
  }
  EXPECT_GT(refused, 50);  // most flips in structure must have been noticed
}

TEST(PatientFile, NamesWhatIsWrong) {
  const ScratchFolder folder("wrong");
  const auto message = [&](const std::string& bytes) -> std::string {
    put(folder / "x.glb", bytes);
    try {
      readPatient(folder / "x.glb");
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(message("").find("not a glTF binary"), std::string::npos);
  EXPECT_NE(message("solid cube\nfacet normal 0 0 1").find("not a glTF binary"), std::string::npos);
  EXPECT_THROW(readPatient(folder / "absent.glb"), Error);

  writePatient(smallPatient(), folder / "p.glb");
  const std::string whole = bytesOf(folder / "p.glb");
  const auto renamed = [&](const std::string& from, const std::string& to) {
    std::string changed = whole;
    changed.replace(changed.find("\"" + from + "\"") + 1, from.size(), to);
    return message(changed);
  };
  EXPECT_NE(renamed("clavicle", "clavicoe").find("unknown organ"), std::string::npos);
  EXPECT_EQ(renamed("entry_point", "entry_poinx"), "no error")
      << "a patient may be there to be looked at";
  EXPECT_NE(renamed("tissue\":\"bone", "tissue\":\"bome").find("tissue"), std::string::npos);
  EXPECT_NE(renamed("NORMAL", "NORMAX").find("NORMAL"), std::string::npos);
  EXPECT_NE(renamed("TEXCOORD_0", "TEXCOORD_7").find("TEXCOORD_0"), std::string::npos)
      << "a picture needs coordinates";
  std::string no_png = whole;
  no_png.replace(no_png.find("\x89PNG") + 1, 3, "PNX");
  EXPECT_NE(message(no_png).find("not a PNG"), std::string::npos);
  EXPECT_NE(renamed("left", "lefd").find("right or left"), std::string::npos);
}

// A JSON part made of brackets would overflow a recursive reader's stack.
TEST(PatientFile, DeepNestingIsRefused) {
  const ScratchFolder folder("deep");
  std::string json = "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100000, '[') +
                     std::string(100000, ']') + "}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::uint32_t v) {
    return std::string(reinterpret_cast<const char*>(&v), 4);
  };
  put(folder / "deep.glb",
      "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json);
  EXPECT_THROW(readPatient(folder / "deep.glb"), Error);
}

// Counts far beyond the data must be refused before anything of that size is made.
TEST(PatientFile, CountsBeyondTheDataAreRefused) {
  const ScratchFolder folder("count");
  writePatient(smallPatient(), folder / "p.glb");
  std::string whole = bytesOf(folder / "p.glb");
  const std::size_t at = whole.find("\"count\":") + 8;
  for (std::size_t i = at; whole[i] >= '0' && whole[i] <= '9'; ++i) whole[i] = '9';
  put(folder / "x.glb", whole);
  EXPECT_THROW(readPatient(folder / "x.glb"), Error);
}

}  // namespace
}  // namespace palpa::anatomy
