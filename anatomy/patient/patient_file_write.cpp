#include <tiny_gltf.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/patient/gltf.h"
#include "anatomy/patient/patient_file.h"

namespace palpa::anatomy {
namespace {

using tinygltf::Value;

Value triple(const Vec3& v) {
  return Value(Value::Array{Value(v.x()), Value(v.y()), Value(v.z())});
}

class ModelWriter {
 public:
  explicit ModelWriter(std::string where) : where_(std::move(where)) {}

  tinygltf::Model write(const Patient& patient) {
    model_.asset.version = "2.0";
    model_.asset.generator = "palpa";
    model_.extras = rootExtras(patient);
    model_.buffers.resize(1);
    model_.scenes.resize(1);
    model_.defaultScene = 0;
    for (const OrganSurface& surface : patient.organs) addSurface(surface);
    return std::move(model_);
  }

 private:
  static Value rootExtras(const Patient& patient) {
    Value::Object landmarks;
    for (const auto& [landmark_name, p_A] : patient.landmarks)
      landmarks[landmark_name] = triple(p_A);
    Value::Object layers{{"skin", Value(patient.layers.skin)},
                         {"fat", Value(patient.layers.fat)},
                         {"muscle", Value(patient.layers.muscle)}};
    Value::Object extras{
        {"format", Value(std::string("palpa-patient"))},
        {"version", Value(1)},
        {"unit", Value(std::string("m"))},
        {"frame", Value(std::string("landmarks: x left, y posterior, z superior, origin at the "
                                    "suprasternal notch; meshes: x left, y superior, z anterior"))},
        {"name", Value(patient.name)},
        {"side", Value(std::string(name(patient.side)))},
        {"seed", Value(std::to_string(patient.seed))},
        {"layers", Value(layers)},
        {"landmarks", Value(landmarks)},
        {"licence", Value(patient.licence)}};
    if (!patient.source.empty()) extras["source"] = Value(patient.source);
    return Value(extras);
  }

  static Value surfaceExtras(const OrganSurface& surface) {
    Value::Object extras{{"organ", Value(std::string(palpa::name(surface.organ)))},
                         {"tissue", Value(std::string(palpa::name(tissueInside(surface.organ))))}};
    if (!surface.licence.empty()) extras["licence"] = Value(surface.licence);
    if (!surface.source.empty()) extras["source"] = Value(surface.source);
    return Value(extras);
  }

  // Appends to the one buffer, where a float may begin, and returns the view's index.
  int addView(const void* data, std::size_t bytes, int target) {
    auto& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = bytes;
    view.target = target;
    buffer.resize(buffer.size() + bytes);
    std::memcpy(buffer.data() + view.byteOffset, data, bytes);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  int addVectors(const std::vector<Vec3>& vectors_A, bool bounds) {
    std::vector<float> floats;
    tinygltf::Accessor accessor;
    Eigen::AlignedBox3f box;
    for (const Vec3& v_A : vectors_A) {
      const Eigen::Vector3f v_G = gltfFromA(v_A).cast<float>();
      floats.insert(floats.end(), v_G.begin(), v_G.end());
      box.extend(v_G);
    }
    accessor.bufferView =
        addView(floats.data(), floats.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = TINYGLTF_TYPE_VEC3;
    accessor.count = vectors_A.size();
    if (bounds) {
      accessor.minValues.assign(box.min().begin(), box.min().end());
      accessor.maxValues.assign(box.max().begin(), box.max().end());
    }
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int addCoordinates(const std::vector<std::array<float, 2>>& uvs) {
    tinygltf::Accessor accessor;
    accessor.bufferView =
        addView(uvs.data(), uvs.size() * sizeof uvs[0], TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = TINYGLTF_TYPE_VEC2;
    accessor.count = uvs.size();
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  // The picture stays in the one buffer, packed, so that the patient is one file.
  int addPicture(const OrganSurface& surface) {
    const std::vector<unsigned char> png =
        surface.texture_png.empty() ? pngOf(surface.texture, where_) : surface.texture_png;
    tinygltf::Image image;
    image.name = surface.id;
    image.mimeType = "image/png";
    image.bufferView = addView(png.data(), png.size(), 0);
    tinygltf::Sampler sampler;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    tinygltf::Texture texture;
    texture.source = static_cast<int>(model_.images.size());
    texture.sampler = static_cast<int>(model_.samplers.size());
    model_.images.push_back(image);
    model_.samplers.push_back(sampler);
    model_.textures.push_back(texture);
    return static_cast<int>(model_.textures.size()) - 1;
  }

  int addIndices(const TriangleMesh& mesh) {
    tinygltf::Accessor accessor;
    accessor.bufferView =
        addView(mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]),
                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = 3 * mesh.triangles.size();
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int addMaterial(const OrganSurface& surface) {
    tinygltf::Material material;
    material.name = surface.id;
    auto& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor.assign(surface.rgba.begin(), surface.rgba.end());
    pbr.metallicFactor = 0;
    pbr.roughnessFactor = 0.6;
    if (!surface.texture.rgb.empty()) pbr.baseColorTexture.index = addPicture(surface);
    if (surface.rgba[3] < 1) material.alphaMode = "BLEND";
    model_.materials.push_back(material);
    return static_cast<int>(model_.materials.size()) - 1;
  }

  void addSurface(const OrganSurface& surface) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = addVectors(surface.mesh.points, true);
    primitive.attributes["NORMAL"] = addVectors(surface.mesh.normals, false);
    if (!surface.mesh.uvs.empty())
      primitive.attributes["TEXCOORD_0"] = addCoordinates(surface.mesh.uvs);
    primitive.indices = addIndices(surface.mesh);
    primitive.material = addMaterial(surface);
    tinygltf::Mesh mesh;
    mesh.name = surface.id;
    mesh.primitives.push_back(primitive);
    model_.meshes.push_back(mesh);

    tinygltf::Node node;
    node.name = surface.id;
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    node.extras = surfaceExtras(surface);
    model_.nodes.push_back(node);
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()) - 1);
  }

  std::string where_;
  tinygltf::Model model_;
};

}  // namespace

namespace {

/// To floats and back. Through memory: GCC 12 drops a conversion that is undone at once when it
/// does two numbers together.
void throughFloats(std::vector<Vec3>& vectors) {
  std::vector<Eigen::Vector3f> kept;
  for (const Vec3& v : vectors) kept.push_back(v.cast<float>());
  for (std::size_t i = 0; i < kept.size(); ++i) vectors[i] = kept[i].cast<double>();
}

}  // namespace

void roundAsInFile(Patient& patient) {
  for (OrganSurface& surface :
       patient.organs)  // the file's axes are these, swapped and turned: rounding is the same
    for (std::vector<Vec3>* vectors : {&surface.mesh.points, &surface.mesh.normals})
      throughFloats(*vectors);
}

std::string glbOf(const Patient& patient, const std::string& where) {
  const tinygltf::Model model = ModelWriter(where).write(patient);
  std::ostringstream bytes;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true))
    throw Error("the patient cannot be written as glTF", where, "Check its surfaces");
  return bytes.str();
}

void writePatient(const Patient& patient, const std::filesystem::path& file) {
  writeWhole(file, glbOf(patient, file.string()));
}

}  // namespace palpa::anatomy
