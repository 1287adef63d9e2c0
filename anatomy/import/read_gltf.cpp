#include <Eigen/Geometry>

#include "anatomy/import/mesh_file.h"
#include "anatomy/patient/gltf.h"

namespace palpa::anatomy {
namespace {

using Affine = Eigen::Affine3d;
constexpr int kDeepestNode = 64;  // parents above a node: more is a ring
constexpr std::size_t kMostNodes = 100'000;

class GltfSurfaces {
 public:
  GltfSurfaces(const std::string& bytes, const std::string& where)
      : where_(where), model_(parseGltfBinary(bytes, where)) {}

  std::vector<RawMesh> read() {
    if (model_.nodes.size() > kMostNodes) refuseMesh("it has more than 100,000 nodes", where_);
    std::vector<bool> child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int c : node.children)
        if (inRange(c, model_.nodes.size())) child[static_cast<std::size_t>(c)] = true;
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
      if (!child[i]) visit(static_cast<int>(i), Affine::Identity(), 0);
    return std::move(meshes_);
  }

 private:
  static bool inRange(int index, std::size_t count) {
    return index >= 0 && static_cast<std::size_t>(index) < count;
  }

  Affine transform(const tinygltf::Node& node) const {
    Affine X = Affine::Identity();
    if (node.matrix.size() == 16) {
      for (int i = 0; i < 16; ++i)
        X.matrix()(i % 4, i / 4) = node.matrix[static_cast<std::size_t>(i)];
    } else {
      if (node.translation.size() == 3)
        X.translate(Vec3(node.translation[0], node.translation[1], node.translation[2]));
      if (node.rotation.size() == 4) {
        const Quat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (q.norm() > 0.5) X.rotate(q.normalized());
      }
      if (node.scale.size() == 3) X.scale(Vec3(node.scale[0], node.scale[1], node.scale[2]));
    }
    if (!X.matrix().allFinite())
      refuseMesh("the node \"" + node.name + "\" has a place that is not a number", where_);
    return X;
  }

  void visit(int index, const Affine& parent, int depth) {
    if (!inRange(index, model_.nodes.size())) refuseMesh("a node is missing", where_);
    if (depth > kDeepestNode) refuseMesh("its nodes are nested too deep, or in a ring", where_);
    if (++visited_ > kMostNodes) refuseMesh("its nodes are used over and over", where_);
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
    const Affine X = parent * transform(node);
    if (inRange(node.mesh, model_.meshes.size())) add(node, X);
    for (const int c : node.children) visit(c, X, depth + 1);
  }

  void add(const tinygltf::Node& node, const Affine& X) {
    const tinygltf::Mesh& from = model_.meshes[static_cast<std::size_t>(node.mesh)];
    RawMesh mesh;
    mesh.name = node.name.empty() ? from.name : node.name;
    for (const tinygltf::Primitive& primitive : from.primitives) {
      if (primitive.mode != TINYGLTF_MODE_TRIANGLES) continue;
      addPrimitive(primitive, X, &mesh);
    }
    if (!mesh.triangles.empty()) meshes_.push_back(std::move(mesh));
  }

  void addPrimitive(const tinygltf::Primitive& primitive, const Affine& X, RawMesh* mesh) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) refuseMesh("a surface has no points", where_);
    const auto first = static_cast<std::uint32_t>(mesh->points.size());
    const AccessorData points = block(position->second, TINYGLTF_TYPE_VEC3, 12);
    if (points.component != TINYGLTF_COMPONENT_TYPE_FLOAT)
      refuseMesh("its points are not floats", where_);
    for (std::size_t i = 0; i < points.count; ++i) {
      Eigen::Vector3f p;
      std::memcpy(p.data(), points.at + i * points.stride, sizeof p);
      const Vec3 placed = X * p.cast<double>();
      if (!placed.allFinite())
        refuseMesh("point " + std::to_string(i) + " is not a number", where_);
      mesh->points.push_back(placed);
    }
    const bool mirrored = X.linear().determinant() < 0;
    const auto count = static_cast<std::uint32_t>(points.count);
    const auto corner = [&](std::uint32_t index) {
      if (index >= count)
        refuseMesh("a triangle names point " + std::to_string(index) + ", which is not there",
                   where_);
      return first + index;
    };
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh->triangles.push_back({corner(a), corner(mirrored ? c : b), corner(mirrored ? b : c)});
    };
    if (primitive.indices < 0) {
      for (std::uint32_t i = 0; i + 2 < count; i += 3) triangle(i, i + 1, i + 2);
      return;
    }
    const AccessorData indices = block(primitive.indices, TINYGLTF_TYPE_SCALAR, 0);
    for (std::size_t i = 0; i + 2 < indices.count; i += 3)
      triangle(index(indices, i), index(indices, i + 1), index(indices, i + 2));
  }

  /// An accessor's data, after checking that all of it lies inside its buffer.
  struct AccessorData {
    const unsigned char* at = nullptr;
    std::size_t count = 0, stride = 0;
    int component = 0;
  };

  static std::size_t bytesOf(int component) {
    switch (component) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return 4;
      default:
        return 0;
    }
  }

  AccessorData block(int index, int type, std::size_t element) const {
    if (!inRange(index, model_.accessors.size())) refuseMesh("an accessor is missing", where_);
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    if (accessor.type != type || accessor.sparse.isSparse)
      refuseMesh("an accessor has the wrong type", where_);
    if (element == 0) element = bytesOf(accessor.componentType);
    if (element == 0 || !inRange(accessor.bufferView, model_.bufferViews.size()))
      refuseMesh("an accessor's data are missing (compressed files are not read)", where_);
    const tinygltf::BufferView& view =
        model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    if (!inRange(view.buffer, model_.buffers.size())) refuseMesh("a buffer is missing", where_);
    const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    const std::size_t stride = view.byteStride ? view.byteStride : element;
    const bool inside =
        stride >= element && view.byteOffset <= data.size() &&
        view.byteLength <= data.size() - view.byteOffset &&
        accessor.byteOffset <= view.byteLength &&
        (accessor.count == 0 ||
         (element <= view.byteLength - accessor.byteOffset &&
          accessor.count - 1 <= (view.byteLength - accessor.byteOffset - element) / stride));
    if (!inside) refuseMesh("an accessor reaches beyond its buffer", where_);
    return {data.data() + view.byteOffset + accessor.byteOffset, accessor.count, stride,
            accessor.componentType};
  }

  static std::uint32_t index(const AccessorData& block, std::size_t i) {
    std::uint32_t value = 0;  // glTF and every processor this runs on are little-endian
    std::memcpy(&value, block.at + i * block.stride, bytesOf(block.component));
    return value;
  }

  std::string where_;
  tinygltf::Model model_;
  std::vector<RawMesh> meshes_;
  std::size_t visited_ = 0;
};

}  // namespace

std::vector<RawMesh> readGltf(const std::string& bytes, const std::string& where) {
  return GltfSurfaces(bytes, where).read();
}

}  // namespace palpa::anatomy
