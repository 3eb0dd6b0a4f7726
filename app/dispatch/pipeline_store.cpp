#include "app/dispatch/pipeline_store.h"

#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "app/base/atomic_file.h"
#include "app/base/error.h"

namespace trisect {
namespace {

using Checksum = uint64_t;

// The 64-bit hash FNV-1a of Fowler, Noll and Vo. Drivers check the header of a pipeline cache but
// not its body, so the store checks that.
Checksum checksum_of(const std::vector<std::byte>& data) {
  Checksum sum = 0xcbf29ce484222325U;
  for (const std::byte byte : data) sum = (sum ^ std::to_integer<Checksum>(byte)) * 0x100000001b3U;
  return sum;
}

void write_checked(const std::filesystem::path& path, const std::vector<std::byte>& data) {
  const Checksum sum = checksum_of(data);
  std::string content(sizeof(sum) + data.size(), '\0');
  std::memcpy(content.data(), &sum, sizeof(sum));
  std::memcpy(content.data() + sizeof(sum), data.data(), data.size());
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace

std::vector<std::byte> kept_pipelines(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
  Checksum sum = 0;
  if (content.size() <= sizeof(sum)) return {};
  std::memcpy(&sum, content.data(), sizeof(sum));
  std::vector<std::byte> data(content.size() - sizeof(sum));
  std::memcpy(data.data(), content.data() + sizeof(sum), data.size());
  if (checksum_of(data) != sum) data.clear();
  return data;
}

PipelineStore::PipelineStore(const gpu::Device& device,
                             const std::optional<std::filesystem::path>& folder)
    : device_(device) {
  if (!folder) return;
  file_ = *folder / ("pipelines-" + device.pipeline_key());
  loaded_ = kept_pipelines(file_);
  try {
    if (!loaded_.empty()) device_.add_pipeline_data(loaded_);
  } catch (const DeviceError&) {
    // The pipelines are compiled again.
  }
}

PipelineStore::~PipelineStore() {
  if (file_.empty()) return;
  try {
    keep();
  } catch (const std::exception&) {
    // The next run compiles the pipelines again, which costs time and nothing else.
  }
}

void PipelineStore::keep() const {
  const std::vector<std::byte> data = device_.pipeline_data();
  if (data == loaded_) return;
  std::filesystem::create_directories(file_.parent_path());
  write_checked(file_, data);
}

}  // namespace trisect
