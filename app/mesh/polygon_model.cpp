#include "app/mesh/polygon_model.h"

#include <utility>

namespace trisect {

void add_group(std::string name, std::size_t first, std::vector<PolygonGroup>& groups) {
  close_groups(first, groups);
  if (groups.empty() && first > 0) groups.push_back({"", 0});
  groups.push_back({std::move(name), first});
}

void close_groups(std::size_t polygons, std::vector<PolygonGroup>& groups) {
  if (!groups.empty() && groups.back().first == polygons) groups.pop_back();
}

}  // namespace trisect
