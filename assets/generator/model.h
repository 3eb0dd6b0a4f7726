// A model under construction, and its OBJ text.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace trisect::assets {

// A surface point with its exact unit normal.
struct Vertex {
  glm::dvec3 position;
  glm::dvec3 normal;
};

// Vertices that are written with the same nine digits are the same vertex; positions and normals
// are numbered apart, as OBJ has them.
class Model {
 public:
  explicit Model(std::string comment) : comment_(std::move(comment)) {}

  // Counter-clockwise seen from outside. A triangle with two coincident corners is left out.
  void add_triangle(const Vertex& a, const Vertex& b, const Vertex& c);

  // A quadrilateral a, b, c, d, cut along its shorter diagonal.
  void add_quad(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d);

  [[nodiscard]] std::size_t triangles() const { return faces_.size(); }
  [[nodiscard]] std::string obj() const;

 private:
  // Distinct lines in order of first use.
  struct Lines {
    std::vector<std::string> lines;
    std::unordered_map<std::string, uint32_t> number;
    uint32_t add(const glm::dvec3& v);
  };

  std::string comment_;
  Lines positions_;
  Lines normals_;
  struct Corner {
    uint32_t position;
    uint32_t normal;
  };
  std::vector<std::array<Corner, 3>> faces_;
};

// Fills a grid of columns x rows quadrilaterals with vertex(u, v), u and v in [0, 1]. Seen from
// outside, v runs to the left of u.
template <typename VertexAt>
void add_grid(Model& model, int columns, int rows, VertexAt vertex) {
  const auto at = [&](int i, int j) {
    return vertex(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      model.add_quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

}  // namespace trisect::assets
