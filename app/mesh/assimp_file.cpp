#include "app/mesh/assimp_file.h"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/base/trimmed.h"

namespace trisect {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;

dmat4 matrix_from(const aiMatrix4x4& m) {
  dmat4 matrix(1.0);
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      matrix[static_cast<int>(column)][static_cast<int>(row)] = static_cast<double>(m[row][column]);
    }
  }
  return matrix;
}

dvec3 vector_from(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

// Puts the meshes of a scene together.
class AssimpScene {
 public:
  // format: as Assimp names it. STL's normals are those of facets, and what some programs take for
  // colours there others write anything into. Of the three formats FBX alone has materials; Assimp
  // makes one itself for the others.
  AssimpScene(const aiScene& scene, const std::string& format, const std::string& name)
      : scene_(scene), is_stl_(format == "stl"), takes_materials_(format == "fbx"), name_(name) {}

  PolygonModel assemble() {
    // Without recursion, which a long chain of nodes could make too deep.
    std::vector<std::pair<const aiNode*, dmat4>> waiting;
    if (scene_.mRootNode != nullptr) waiting.emplace_back(scene_.mRootNode, dmat4(1.0));
    while (!waiting.empty()) {
      const auto [node, above] = waiting.back();
      waiting.pop_back();
      const dmat4 here = above * matrix_from(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) add(*scene_.mMeshes[node->mMeshes[i]], here);
      for (unsigned i = node->mNumChildren; i > 0; --i) {
        waiting.emplace_back(node->mChildren[i - 1], here);
      }
    }
    close_groups(model_.sizes.size(), model_.groups);
    note_left_out(points_, "point", model_);
    note_left_out(lines_, "line", model_);
    if (model_.sizes.empty()) {
      throw InputError(name_ + ": the file has no faces" + notes_after_semicolon(model_) + ".");
    }
    return std::move(model_);
  }

 private:
  void add(const aiMesh& mesh, const dmat4& matrix) {
    const std::size_t first = model_.positions.size();
    const std::size_t first_normal = model_.normals.size();
    if (first + mesh.mNumVertices > 0xfffffffeU) {
      throw InputError(name_ + ": has too many vertices.");
    }
    const bool has_normals = !is_stl_ && mesh.HasNormals();
    const bool mirrored = glm::determinant(dmat3(matrix)) < 0.0;
    const dmat3 turn = matrix_for_normals(dmat3(matrix));
    make_room(mesh.mNumVertices, model_.positions);
    if (has_normals) make_room(mesh.mNumVertices, model_.normals);
    make_room(mesh.mNumFaces, model_.sizes);
    make_room(std::size_t{3} * mesh.mNumFaces, model_.corners);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const dvec3 position(matrix * glm::dvec4(vector_from(mesh.mVertices[i]), 1.0));
      dvec3 normal(0.0);
      if (has_normals) normal = turn * vector_from(mesh.mNormals[i]);
      if (!add_vertex(position, has_normals ? &normal : nullptr, model_)) {
        throw InputError(fmt::format("{}: vertex {} is not three finite numbers.", name_, i));
      }
    }
    const bool has_colors = !is_stl_ && mesh.HasVertexColors(0);
    const std::size_t first_face = model_.sizes.size();
    add_group(mesh.mName.C_Str(), first_face, model_.groups);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++(face.mNumIndices == 2 ? lines_ : points_);
        continue;
      }
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned i = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
        if (i >= mesh.mNumVertices) {
          throw InputError(
              fmt::format("{}: a face names vertex {} of {}.", name_, i, mesh.mNumVertices));
        }
        model_.corners.push_back(
            {static_cast<uint32_t>(first + i),
             has_normals ? static_cast<uint32_t>(first_normal + i) : PolygonCorner::no_normal});
      }
      model_.sizes.push_back(face.mNumIndices);
      if (has_colors) {
        add_color(model_.sizes.size() - 1, color_of(mesh, face), model_);
      }
    }
    if (!has_colors) add_color(first_face, material_color(mesh), model_);
  }

  // The mean of a face's vertices.
  static glm::vec3 color_of(const aiMesh& mesh, const aiFace& face) {
    glm::vec3 sum(0.0F);
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const aiColor4D& color = mesh.mColors[0][face.mIndices[k]];
      sum += glm::vec3(color.r, color.g, color.b);
    }
    return sum / static_cast<float>(face.mNumIndices);
  }

  // If the file has a material for the mesh whose colour no texture changes.
  [[nodiscard]] std::optional<glm::vec3> material_color(const aiMesh& mesh) const {
    if (!takes_materials_ || mesh.mMaterialIndex >= scene_.mNumMaterials) return std::nullopt;
    const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
    aiColor3D color;
    if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME) ||
        material.GetTextureCount(aiTextureType_DIFFUSE) > 0 ||
        material.GetTextureCount(aiTextureType_BASE_COLOR) > 0 ||
        material.Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS) {
      return std::nullopt;
    }
    return glm::vec3(color.r, color.g, color.b);
  }

  const aiScene& scene_;
  bool is_stl_;
  bool takes_materials_;
  const std::string& name_;
  PolygonModel model_;
  std::size_t points_ = 0;
  std::size_t lines_ = 0;
};

// Throws InputError for a PLY file that cannot have what its head promises: Assimp takes any time
// for one whose head does not end, or that promises much.
void expect_whole_ply(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: cannot be read as ply: {}.", name, why));
  };
  std::size_t items = 0;
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::string_view whole = rest.substr(0, rest.find_first_of("\r\n"));
    rest.remove_prefix(std::min(whole.size() + 1, rest.size()));
    const std::string_view line = trimmed(whole);
    if (line == "end_header") {
      // Each has a byte at least.
      if (items <= rest.size()) return;
      refuse("it ends before the elements that its head promises");
    }
    if (!line.starts_with("element ")) continue;
    const std::string_view number = line.substr(line.find_last_of(' ') + 1);
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
    if (error == std::errc::result_out_of_range) refuse("it promises too many elements");
    items = count > bytes.size() - std::min(items, bytes.size()) ? bytes.size() + 1 : items + count;
  }
  refuse("its head does not end");
}

}  // namespace

PolygonModel parse_by_assimp(std::string bytes, const std::string& format,
                             const std::string& name) {
  if (format == "ply") expect_whole_ply(bytes, name);
  PolygonModel model;
  {
    Assimp::Importer importer;
    // From memory, so that nothing beside the file is read.
    const aiScene* scene =
        importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, format.c_str());
    if (scene == nullptr) {
      const std::string reason = reason_of(importer.GetErrorString());
      if (reason.find("no facets") != std::string::npos) {
        throw InputError(name + ": the file has no faces.");
      }
      throw InputError(fmt::format("{}: cannot be read as {}: {}.", name, format, reason));
    }
    // Two copies of a model are enough.
    bytes = std::string();
    malloc_trim(0);
    model = AssimpScene(*scene, format, name).assemble();
  }
  // Assimp allocates each face; what those leave is of no use to the large arrays that follow.
  malloc_trim(0);
  return model;
}

}  // namespace trisect
