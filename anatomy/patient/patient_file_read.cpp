#include <cmath>
#include <cstring>

#include "anatomy/base/error.h"
#include "anatomy/patient/gltf.h"
#include "anatomy/patient/patient_file.h"

namespace palpa::anatomy {
namespace {

constexpr double kLargestCoordinate = 3.0;  // metres: beyond this the unit is wrong
constexpr double kUnit = 1e-6;              // a unit vector in floats, which stays as it is
constexpr float kLargestRepeat = 100;       // of a picture over a surface

class PatientReader {
 public:
  PatientReader(tinygltf::Model model, std::string where)
      : where_(std::move(where)), model_(std::move(model)) {}

  Patient read() {
    readExtras();
    for (const tinygltf::Node& node : model_.nodes)
      if (node.mesh >= 0) readNode(node);
    if (patient_.organs.empty()) fail("it holds no surfaces");
    return std::move(patient_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, where_, "Write the patient again or take another file");
  }

  double number(const tinygltf::Value& value, const std::string& what) const {
    if (!value.IsNumber() && !value.IsInt()) fail("\"" + what + "\" is not a number");
    const double x = value.GetNumberAsDouble();
    if (!std::isfinite(x)) fail("\"" + what + "\" is not finite");
    return x;
  }

  std::string textOf(const tinygltf::Value& object, const char* key) const {
    if (!object.Has(key) || !object.Get(key).IsString())
      fail(std::string("extras lack the text \"") + key + "\"");
    return object.Get(key).Get<std::string>();
  }

  // Empty where there is none.
  std::string optionalText(const tinygltf::Value& object, const char* key) const {
    return object.Has(key) ? textOf(object, key) : std::string();
  }

  const tinygltf::Value& objectOf(const tinygltf::Value& object, const char* key) const {
    if (!object.Has(key) || !object.Get(key).IsObject())
      fail(std::string("extras lack the object \"") + key + "\"");
    return object.Get(key);
  }

  void readExtras() {
    const tinygltf::Value& extras = model_.extras;
    if (!extras.IsObject()) fail("the file holds no patient (no extras)");
    if (textOf(extras, "format") != "palpa-patient")
      fail("the file holds no patient of this program");
    if (textOf(extras, "unit") != "m") fail("the unit is not the metre");
    patient_.name = textOf(extras, "name");
    const std::string side = textOf(extras, "side");
    if (side != "right" && side != "left")
      fail("the side is \"" + side + "\" instead of right or left");
    patient_.side = side == "right" ? Side::right : Side::left;
    patient_.licence = optionalText(extras, "licence");
    patient_.source = optionalText(extras, "source");
    patient_.seed = readSeed(textOf(extras, "seed"));
    readLayers(objectOf(extras, "layers"));
    readLandmarks(objectOf(extras, "landmarks"));
  }

  std::uint64_t readSeed(const std::string& digits) const {
    if (digits.empty() || digits.size() > 20 ||
        digits.find_first_not_of("0123456789") != std::string::npos)
      fail("the seed is not a whole number");
    try {
      return std::stoull(digits);
    } catch (const std::out_of_range&) {
      fail("the seed is too large");
    }
  }

  void readLayers(const tinygltf::Value& layers) {
    for (auto [key, thickness] :
         {std::pair{"skin", &patient_.layers.skin}, std::pair{"fat", &patient_.layers.fat},
          std::pair{"muscle", &patient_.layers.muscle}}) {
      if (!layers.Has(key)) fail(std::string("the layer \"") + key + "\" is missing");
      *thickness = number(layers.Get(key), key);
      if (*thickness < 0 || *thickness > 0.1)
        fail(std::string("the layer \"") + key + "\" is not between 0 and 0.1 m thick");
    }
  }

  void readLandmarks(const tinygltf::Value& landmarks) {
    for (const std::string& key : landmarks.Keys()) {
      const tinygltf::Value& value = landmarks.Get(key);
      if (!value.IsArray() || value.ArrayLen() != 3)
        fail("the landmark \"" + key + "\" is not three numbers");
      Vec3 p;
      for (int i = 0; i < 3; ++i) p[i] = number(value.Get(i), key);
      if (p.cwiseAbs().maxCoeff() > kLargestCoordinate)
        fail("the landmark \"" + key + "\" is metres away");
      patient_.landmarks[key] = p;
    }
  }

  // A view that lies inside its buffer.
  const tinygltf::BufferView& viewOf(int index) const {
    if (index < 0 || index >= static_cast<int>(model_.bufferViews.size()))
      fail("a buffer view is missing");
    const tinygltf::BufferView& view = model_.bufferViews[index];
    if (view.buffer < 0 || view.buffer >= static_cast<int>(model_.buffers.size()))
      fail("a buffer is missing");
    const std::size_t size = model_.buffers[view.buffer].data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
      fail("a buffer view reaches beyond its buffer");
    return view;
  }

  // Start of an accessor's data, after checking that all of it lies inside its buffer.
  const unsigned char* data(int index, int type, std::size_t element, std::size_t* count,
                            int* component) const {
    if (index < 0 || index >= static_cast<int>(model_.accessors.size()))
      fail("an accessor is missing");
    const tinygltf::Accessor& accessor = model_.accessors[index];
    if (accessor.type != type || accessor.sparse.isSparse) fail("an accessor has the wrong type");
    const tinygltf::BufferView& view = viewOf(accessor.bufferView);
    if (element == 0)
      element = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2 : 4;
    if (view.byteStride != 0 && view.byteStride != element)
      fail("interleaved data are not supported");
    const bool inside = accessor.byteOffset <= view.byteLength &&
                        accessor.count <= (view.byteLength - accessor.byteOffset) / element;
    if (!inside) fail("an accessor reaches beyond its buffer");
    *count = accessor.count;
    *component = accessor.componentType;
    return model_.buffers[view.buffer].data.data() + view.byteOffset + accessor.byteOffset;
  }

  std::vector<Vec3> vectors(const tinygltf::Primitive& primitive, const char* attribute) const {
    const auto found = primitive.attributes.find(attribute);
    if (found == primitive.attributes.end()) fail(std::string("a surface has no ") + attribute);
    std::size_t count = 0;
    int component = 0;
    const unsigned char* at =
        data(found->second, TINYGLTF_TYPE_VEC3, 3 * sizeof(float), &count, &component);
    if (component != TINYGLTF_COMPONENT_TYPE_FLOAT)
      fail(std::string(attribute) + " are not floats");
    std::vector<Vec3> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3f v;
      std::memcpy(v.data(), at + i * sizeof v, sizeof v);
      if (!v.allFinite() || v.cwiseAbs().maxCoeff() > kLargestCoordinate)
        fail(std::string(attribute) + " number " + std::to_string(i) + " is not a sensible vector");
      result[i] = aFromGltf(v.cast<double>());
    }
    return result;
  }

  std::vector<std::array<std::uint32_t, 3>> triangles(const tinygltf::Primitive& primitive,
                                                      std::size_t points) const {
    std::size_t count = 0;
    int component = 0;
    const unsigned char* at = data(primitive.indices, TINYGLTF_TYPE_SCALAR, 0, &count, &component);
    if (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT &&
        component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
      fail("indices are not unsigned 16 or 32 bit numbers");
    if (count % 3 != 0 || count == 0) fail("the indices are not whole triangles");
    std::vector<std::array<std::uint32_t, 3>> result(count / 3);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t index = 0;  // glTF and every processor this runs on are little-endian
      const std::size_t bytes = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2 : 4;
      std::memcpy(&index, at + i * bytes, bytes);
      if (index >= points)
        fail("index " + std::to_string(index) + " is beyond the " + std::to_string(points) +
             " vertices");
      result[i / 3][i % 3] = index;
    }
    return result;
  }

  void readNode(const tinygltf::Node& node) {
    if (node.mesh >= static_cast<int>(model_.meshes.size())) fail("a mesh is missing");
    const auto& primitives = model_.meshes[node.mesh].primitives;
    if (primitives.size() != 1 || primitives[0].mode != TINYGLTF_MODE_TRIANGLES)
      fail("the surface \"" + node.name + "\" is not one set of triangles");
    if (!node.matrix.empty() || !node.translation.empty() || !node.rotation.empty() ||
        !node.scale.empty())
      fail("the surface \"" + node.name +
           "\" is moved by its node, which a patient file does not do");
    OrganSurface surface;
    surface.id = node.name;
    for (const OrganSurface& other : patient_.organs)
      if (other.id == surface.id) fail("two surfaces are called \"" + surface.id + "\"");
    if (!node.extras.IsObject()) fail("the surface \"" + node.name + "\" does not name its organ");
    surface.organ = organFromName(textOf(node.extras, "organ").c_str());
    if (surface.organ == Organ::none)
      fail("the surface \"" + node.name + "\" is of an unknown organ");
    if (const std::string tissue = optionalText(node.extras, "tissue");
        !tissue.empty() && tissue != palpa::name(tissueInside(surface.organ)))
      fail("the surface \"" + node.name + "\" is of the tissue \"" + tissue +
           "\", which its organ does not enclose");
    surface.licence = optionalText(node.extras, "licence");
    surface.source = optionalText(node.extras, "source");
    surface.mesh.points = vectors(primitives[0], "POSITION");
    surface.mesh.normals = vectors(primitives[0], "NORMAL");
    checkNormals(&surface);
    surface.mesh.triangles = triangles(primitives[0], surface.mesh.points.size());
    readColour(primitives[0], &surface);
    readPicture(primitives[0], &surface);
    patient_.organs.push_back(std::move(surface));
  }

  void checkNormals(OrganSurface* surface) const {
    if (surface->mesh.normals.size() != surface->mesh.points.size())
      fail("the surface \"" + surface->id + "\" has not one normal a vertex");
    for (Vec3& n : surface->mesh.normals) {
      const double length = n.norm();
      if (std::abs(length - 1) > 0.01)
        fail("the surface \"" + surface->id + "\" has a normal of length " +
             std::to_string(length));
      if (std::abs(length - 1) > kUnit) n /= length;
    }
  }

  void readColour(const tinygltf::Primitive& primitive, OrganSurface* surface) const {
    if (primitive.material < 0) return;
    if (primitive.material >= static_cast<int>(model_.materials.size()))
      fail("a material is missing");
    const auto& factor = model_.materials[primitive.material].pbrMetallicRoughness.baseColorFactor;
    for (std::size_t i = 0; i < 4 && i < factor.size(); ++i) {
      if (!(factor[i] >= 0 && factor[i] <= 1)) fail("a colour is not between 0 and 1");
      surface->rgba[i] = static_cast<float>(factor[i]);
    }
  }

  std::vector<std::array<float, 2>> coordinates(const tinygltf::Primitive& primitive,
                                                std::size_t points) const {
    const auto found = primitive.attributes.find("TEXCOORD_0");
    if (found == primitive.attributes.end()) return {};
    std::size_t count = 0;
    int component = 0;
    const unsigned char* at =
        data(found->second, TINYGLTF_TYPE_VEC2, 2 * sizeof(float), &count, &component);
    if (component != TINYGLTF_COMPONENT_TYPE_FLOAT) fail("TEXCOORD_0 are not floats");
    if (count != points) fail("a surface has not one TEXCOORD_0 a vertex");
    std::vector<std::array<float, 2>> result(count);
    std::memcpy(result.data(), at, count * sizeof result[0]);
    for (const auto& [u, v] : result)
      if (!(std::abs(u) <= kLargestRepeat && std::abs(v) <= kLargestRepeat))
        fail("a TEXCOORD_0 is not a sensible number");
    return result;
  }

  // Absent in most surfaces; what is there must be whole.
  void readPicture(const tinygltf::Primitive& primitive, OrganSurface* surface) const {
    surface->mesh.uvs = coordinates(primitive, surface->mesh.points.size());
    if (primitive.material < 0) return;
    const auto& info = model_.materials[primitive.material].pbrMetallicRoughness.baseColorTexture;
    if (info.index == -1) return;
    if (info.index < 0 || info.index >= static_cast<int>(model_.textures.size()))
      fail("a texture is missing");
    const int source = model_.textures[info.index].source;
    if (source < 0 || source >= static_cast<int>(model_.images.size()))
      fail("a picture is missing");
    if (info.texCoord != 0 || surface->mesh.uvs.empty())
      fail("the surface \"" + surface->id + "\" has a picture but no TEXCOORD_0");
    const tinygltf::BufferView& view = viewOf(model_.images[source].bufferView);
    const unsigned char* png = model_.buffers[view.buffer].data.data() + view.byteOffset;
    surface->texture = textureOfPng(png, view.byteLength, where_);
    surface->texture_png.assign(png, png + view.byteLength);
  }

  std::string where_;
  tinygltf::Model model_;
  Patient patient_;
};

}  // namespace

Patient readPatient(const std::filesystem::path& file) {
  return PatientReader(readGltfBinary(file.string()), file.string()).read();
}

Patient patientOfGlb(std::string_view bytes, const std::string& where) {
  return PatientReader(parseGltfBinary(bytes, where), where).read();
}

bool isPatientFile(const std::filesystem::path& file) {
  const tinygltf::Model model = readGltfBinary(file.string());
  if (!model.extras.IsObject() || !model.extras.Has("format")) return false;
  const tinygltf::Value& format = model.extras.Get("format");
  return format.IsString() && format.Get<std::string>() == "palpa-patient";
}

}  // namespace palpa::anatomy
