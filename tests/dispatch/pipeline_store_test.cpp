// Pipelines are stored between runs and found again; a damaged file is not used.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/buffers/kernels.h"
#include "app/dispatch/pipeline_store.h"
#include "tests/support/file_content.h"
#include "tests/support/gpu.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

void write_to(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  return {fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator()};
}

class Pipelines : public test::GpuTest {
 protected:
  // Makes a device, its store and a kernel, as a program does. Returns the device's pipeline data.
  std::vector<std::byte> run() {
    const gpu::Device device(test::validated_instance(), "");
    const PipelineStore store(device, folder_.path());
    const gpu::Kernel kernel = make_kernel(device, "cast_rays", {});
    return device.pipeline_data();
  }

  test::TemporaryFolder folder_;
};

TEST_F(Pipelines, AreKeptUnderTheNameOfTheDevice) {
  const std::vector<std::byte> data = run();
  const std::vector<fs::path> files = files_in(folder_.path());
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].filename().string(), "pipelines-" + test::validated_device().pipeline_key());
  // A checksum of eight bytes comes first.
  EXPECT_EQ(test::content_of(files[0]).size(), data.size() + 8);
  const fs::file_time_type written = fs::last_write_time(files[0]);
  run();
  EXPECT_EQ(fs::last_write_time(files[0]), written) << "nothing new was to be kept";
}

TEST_F(Pipelines, ThatAreDamagedAreCompiledAnew) {
  run();
  const fs::path file = files_in(folder_.path()).at(0);
  const std::string whole = test::content_of(file);
  EXPECT_FALSE(kept_pipelines(file).empty());
  std::string flipped = whole;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  for (const std::string& damaged :
       {std::string(), whole.substr(0, 4), whole.substr(0, whole.size() - 1), flipped,
        std::string(1000, 'x')}) {
    write_to(file, damaged);
    EXPECT_TRUE(kept_pipelines(file).empty());
    run();
    EXPECT_EQ(test::content_of(file), whole);
  }
}

TEST_F(Pipelines, OfARunAreInTheUsersCacheOrNowhere) {
  const std::string cache = "XDG_CACHE_HOME=" + folder_.path().string();
  const std::vector<std::string> render{
      "render", test::asset_path("sphere-20"), "--size", "8x8", "-o", folder_ / "a.png"};
  ASSERT_EQ(test::run_trisect(render, {cache}).exit_code, 0);
  EXPECT_TRUE(fs::is_directory(folder_.path() / "trisect"));
  // A file of that name: the folder cannot be made.
  fs::remove_all(folder_.path() / "trisect");
  write_to(folder_.path() / "trisect", "");
  const test::ProgramRun run = test::run_trisect(render, {cache});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  // A relative XDG_CACHE_HOME is ignored. Mesa does not ignore it, so it gets a folder of its own.
  const std::string mesa = "MESA_SHADER_CACHE_DIR=" + (folder_ / "mesa").string();
  EXPECT_EQ(test::run_trisect(render, {"XDG_CACHE_HOME=a", "HOME=", mesa}).exit_code, 0);
  EXPECT_FALSE(fs::exists("a/trisect"));
}

}  // namespace
}  // namespace trisect
