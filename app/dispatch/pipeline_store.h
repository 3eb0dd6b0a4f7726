// A cache on disk of the pipelines that a driver has compiled.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "vk/device.h"

namespace trisect {

// The pipeline data in a store's file; empty if there is no such file or its checksum is wrong.
std::vector<std::byte> kept_pipelines(const std::filesystem::path& file);

// On construction, adds the pipelines that an earlier run stored for this device and driver to the
// device's pipeline cache; on destruction, stores the cache. Never fails: if the file is damaged or
// the folder cannot be written, pipelines are compiled anew.
class PipelineStore {
 public:
  // folder: nothing is read or stored without one. The device must outlive the store.
  PipelineStore(const gpu::Device& device, const std::optional<std::filesystem::path>& folder);
  ~PipelineStore();
  PipelineStore(const PipelineStore&) = delete;
  PipelineStore& operator=(const PipelineStore&) = delete;
  PipelineStore(PipelineStore&&) = delete;
  PipelineStore& operator=(PipelineStore&&) = delete;

 private:
  void keep() const;

  const gpu::Device& device_;
  std::filesystem::path file_;     // empty if there is no folder
  std::vector<std::byte> loaded_;  // what the file held
};

}  // namespace trisect
