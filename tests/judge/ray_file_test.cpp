#include "app/judge/ray_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/base/error.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

// What reading a file with this content says is wrong with it, without the file's name; empty if
// nothing is.
template <typename Read>
std::string fault_of(Read read, const std::string& name, const std::string& content) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / name;
  std::ofstream(path, std::ios::binary) << content;
  try {
    read(path);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with(path.string())) << text;
    return text.substr(path.string().size());
  }
  return "";
}

std::vector<FileRay> some_rays() {
  FileRay plain;
  plain.origin = {0.1F, -2e-30F, 3e9F};
  plain.direction = {0.0, 0.0, -7.5};
  FileRay ending;
  ending.origin = {1, 2, 3};
  ending.t_min = -0.3F;
  ending.direction = {0.6F, -0.0, 0.8F};
  ending.t_max = 1e20F;
  return {plain, ending};
}

std::vector<FileHit> some_hits() {
  return {{1.5F, 0.1F, 0.7F, 12}, {}, {-2e-5F, std::nan(""), std::nan(""), kSomeTriangle}};
}

TEST(RayFile, IsReadAsItWasWritten) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.csv", "a.rays"}) {
    const fs::path path = folder / name;
    std::ofstream(path, std::ios::binary) << rays_for(name, some_rays());
    const std::vector<FileRay> read = read_rays(path);
    ASSERT_EQ(read.size(), 2U) << name;
    for (std::size_t i = 0; i < 2; ++i) {
      const FileRay ray = some_rays()[i];
      EXPECT_EQ(read[i].origin, ray.origin) << name << i;
      EXPECT_EQ(read[i].direction, ray.direction) << name << i;
      EXPECT_EQ(read[i].t_min, ray.t_min) << name << i;
      EXPECT_EQ(read[i].t_max, ray.t_max) << name << i;
    }
  }
}

TEST(HitFile, IsReadAsItWasWritten) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.csv", "a.hits"}) {
    const fs::path path = folder / name;
    std::ofstream(path, std::ios::binary) << hits_for(name, some_hits());
    const std::vector<FileHit> read = read_hits(path);
    ASSERT_EQ(read.size(), 3U) << name;
    EXPECT_EQ(read[0].t, 1.5) << name;
    EXPECT_EQ(read[0].u, 0.1F) << name;
    EXPECT_EQ(read[0].v, 0.7F) << name;
    EXPECT_EQ(read[0].triangle, 12U) << name;
    EXPECT_EQ(read[1].triangle, NO_TRIANGLE) << name;
    EXPECT_EQ(read[2].t, -2e-5F) << name;
    EXPECT_TRUE(std::isnan(read[2].u)) << name;
    EXPECT_EQ(read[2].triangle, kSomeTriangle) << name;
  }
}

// Records of 32 and 16 bytes, little-endian, as docs/formats.md has them.
TEST(RayFile, HasTheRecordsThatAreDescribed) {
  const std::string rays = rays_for("a", some_rays());
  ASSERT_EQ(rays.size(), 64U);
  // -7.5 is 0xc0f00000, the third component of the direction.
  EXPECT_EQ(rays.substr(24, 4), std::string("\x00\x00\xf0\xc0", 4));
  const std::string hits = hits_for("a", some_hits());
  ASSERT_EQ(hits.size(), 48U);
  EXPECT_EQ(hits.substr(12, 4), std::string("\x0c\x00\x00\x00", 4));
  EXPECT_EQ(hits.substr(28, 4), "\xff\xff\xff\xff");
  EXPECT_EQ(hits.substr(44, 4), "\xfe\xff\xff\xff");
  EXPECT_EQ(hits_for("a.csv", some_hits()),
            "t,u,v,triangle\n1.5,0.10000000149011612,0.699999988079071,12\n,,,-1\n"
            "-1.9999999494757503e-05,,,\n");
}

TEST(RayFile, TextMayHaveBlanksOtherLineEndsAndDigitsOfDoublePrecision) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "a.csv";
  std::ofstream(path) << "\r\n 0.1, 0 ,0,0,\t1,0,0,inf\r\n\r\n1,2,3,4,5,6,7,8";
  const std::vector<FileRay> rays = read_rays(path);
  ASSERT_EQ(rays.size(), 2U);
  EXPECT_EQ(rays[0].origin.x, 0.1);
  EXPECT_EQ(rays[0].t_max, std::numeric_limits<double>::infinity());
  EXPECT_EQ(rays[1].t_max, 8.0);
}

TEST(RayFile, SaysWhatIsWrongWhere) {
  const auto fault = [](const std::string& text) { return fault_of(read_rays, "a.csv", text); };
  EXPECT_EQ(fault(""), ": there are no rays.");
  EXPECT_EQ(fault("ox,oy,oz,t_min,dx,dy,dz,t_max\n"), ": there are no rays.");
  EXPECT_EQ(fault("\n1,2,3\n"),
            ", line 2: there are 3 cells, not 8 "
            "(ox,oy,oz,t_min,dx,dy,dz,t_max).");
  EXPECT_EQ(fault("1,2,3,4,5,6,7,8,9"),
            ", line 1: there are 9 cells, not 8 "
            "(ox,oy,oz,t_min,dx,dy,dz,t_max).");
  EXPECT_EQ(fault("1,2,3,x,5,6,7,8"), ", line 1: 'x' is not a number.");
  EXPECT_EQ(fault("1,2,3,,5,6,7,8"), ", line 1: '' is not a number.");
  EXPECT_EQ(fault("1,2,nan,4,5,6,7,8"), ", line 1: the origin is not finite.");
  EXPECT_EQ(fault("1,2,3,4,inf,6,7,8"), ", line 1: the direction is not finite.");
  EXPECT_EQ(fault("1,2,3,4,0,0,0,8"),
            ", line 1: the direction is longer than 1e30 or shorter than 1e-30.");
  EXPECT_EQ(fault("1,2,3,-inf,5,6,7,8"), ", line 1: t_min is not finite.");
  EXPECT_EQ(fault("1,2,3,4,5,6,7,3"), ", line 1: t_max is less than t_min.");
  EXPECT_EQ(fault("1,2,3,4,5,6,7,nan"), ", line 1: t_max is less than t_min.");
  EXPECT_EQ(fault_of(read_rays, "a.rays", std::string(33, 'a')),
            ": 33 bytes are not records of 32; if it is a text its name must end in .csv.");
  EXPECT_EQ(fault_of(read_rays, "a.rays", std::string(64, '\0')),
            ", ray 0: the direction is longer than 1e30 or shorter than 1e-30.");
}

TEST(HitFile, SaysWhatIsWrongWhere) {
  const auto fault = [](const std::string& text) { return fault_of(read_hits, "a.csv", text); };
  EXPECT_EQ(fault(""), "");
  EXPECT_EQ(fault("1,0,0"), ", line 1: there are 3 cells, not 4 (t,u,v,triangle).");
  EXPECT_EQ(fault("t,u,v,triangle\n1,0,0,1.5"), ", line 2: '1.5' is not the number of a triangle.");
  for (const char* triangle : {"-2", "x", "nan", "1e12", "4294967294"}) {
    EXPECT_EQ(fault(std::string("1,0,0,") + triangle),
              std::string(", line 1: '") + triangle + "' is not the number of a triangle.");
  }
  EXPECT_EQ(fault(",0,0,1"), ", line 1: '' is not a number.");
  EXPECT_EQ(fault("1,y,0,1"), ", line 1: 'y' is not a number.");
  EXPECT_EQ(fault("nan,0,0,1"), "");
  EXPECT_EQ(fault_of(read_hits, "a.hits", std::string(15, 'a')),
            ": 15 bytes are not records of 16; if it is a text its name must end in .csv.");
}

}  // namespace
}  // namespace trisect
