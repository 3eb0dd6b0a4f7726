#include "assets/generator/model.h"

#include <fmt/format.h>

namespace trisect::assets {

uint32_t Model::Lines::add(const glm::dvec3& v) {
  // Nine digits carry single precision; what is 0 but for rounding is written as 0.
  const auto number_text = [](double x) {
    return fmt::format("{:.9g}", std::abs(x) < 1e-12 ? 0.0 : x);
  };
  std::string line = fmt::format("{} {} {}", number_text(v.x), number_text(v.y), number_text(v.z));
  const auto [entry, added] = number.try_emplace(line, static_cast<uint32_t>(lines.size() + 1));
  if (added) lines.push_back(std::move(line));
  return entry->second;
}

void Model::add_triangle(const Vertex& a, const Vertex& b, const Vertex& c) {
  std::array<Corner, 3> face{};
  const std::array<const Vertex*, 3> corners{&a, &b, &c};
  for (std::size_t i = 0; i < 3; ++i) {
    face[i] = {positions_.add(corners[i]->position), normals_.add(corners[i]->normal)};
  }
  const bool coincident = face[0].position == face[1].position ||
                          face[1].position == face[2].position ||
                          face[2].position == face[0].position;
  if (!coincident) faces_.push_back(face);
}

void Model::add_quad(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  // A little in favour of one diagonal, so that rounding does not decide between equals.
  if (glm::distance(a.position, c.position) <= 1.001 * glm::distance(b.position, d.position)) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
  } else {
    add_triangle(b, c, d);
    add_triangle(b, d, a);
  }
}

std::string Model::obj() const {
  std::string text = fmt::format("# {}, {} triangles\n", comment_, faces_.size());
  for (const std::string& line : positions_.lines) text += "v " + line + "\n";
  for (const std::string& line : normals_.lines) text += "vn " + line + "\n";
  for (const auto& [a, b, c] : faces_) {
    text += fmt::format("f {}//{} {}//{} {}//{}\n", a.position, a.normal, b.position, b.normal,
                        c.position, c.normal);
  }
  return text;
}

}  // namespace trisect::assets
