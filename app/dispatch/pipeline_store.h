// Compiled pipelines that outlive the program, in files of a folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "vk/device.h"

namespace trisect {

// What a store's file holds behind its checksum; nothing if there is none or that is wrong.
std::vector<std::byte> kept_pipelines(const std::filesystem::path& file);

// Adds what an earlier run kept for this device and driver to the device's pipelines, and keeps
// them when it is destroyed. A file that is damaged is as good as none, a folder that cannot be
// written as well: pipelines are compiled anew.
class PipelineStore {
 public:
  // The device must outlive the store.
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
