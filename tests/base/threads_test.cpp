// The same results on however many threads.
#include "app/base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/parallel_rows.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

// Sets the number while it lives.
class Threads {
 public:
  explicit Threads(unsigned count) { set_worker_threads(count); }
  ~Threads() { set_worker_threads(0); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  Threads(Threads&&) = delete;
  Threads& operator=(Threads&&) = delete;
};

TEST(Threads, AreAsManyAsWanted) {
  EXPECT_GE(worker_threads(), 1U);
  const Threads three(3);
  EXPECT_EQ(worker_threads(), 3U);
  std::atomic<uint32_t> at_once{0};
  // Each of three waits for the other two.
  EXPECT_TRUE(parallel_rows(3,
                            [&](uint32_t /*y*/) {
                              for (++at_once; at_once < 3;) {
                              }
                            },
                            {}));
  EXPECT_EQ(at_once, 3U);
}

template <typename Item>
std::string bytes_of(const std::vector<Item>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)};
}

TEST(Threads, DoNotChangeWhatIsBaked) {
  const Mesh mesh = test::load_asset("teapot");
  std::string first;
  for (const unsigned count : {1U, 2U, 4U}) {
    const Threads threads(count);
    const BakedScene scene = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
    const std::string bytes =
        bytes_of(scene.triangles) + bytes_of(scene.subpatches) + bytes_of(build_bvh(scene));
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << count;
  }
}

}  // namespace
}  // namespace trisect
