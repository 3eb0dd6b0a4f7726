#include "vk/aabb_acceleration_structure.h"

#include "vk/result.h"

namespace trisect::gpu {
namespace {

// The description of one level's geometry that its build takes.
struct Build {
  explicit Build(VkAccelerationStructureTypeKHR type) {
    info.type = type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = 1;
  }

  VkAccelerationStructureGeometryKHR geometry{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  VkAccelerationStructureBuildGeometryInfoKHR info{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  uint32_t count = 0;
};

Build build_of_boxes(VkDeviceAddress boxes, std::size_t count) {
  Build build(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR);
  VkAccelerationStructureGeometryAabbsDataKHR aabbs{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR};
  aabbs.data.deviceAddress = boxes;
  aabbs.stride = sizeof(VkAabbPositionsKHR);
  build.geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
  build.geometry.geometry.aabbs = aabbs;
  // The kernel handles each box at most once per ray.
  build.geometry.flags = VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
  build.count = static_cast<uint32_t>(count);
  return build;
}

Build build_of_instances(VkDeviceAddress instances) {
  Build build(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR);
  VkAccelerationStructureGeometryInstancesDataKHR data{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
  data.data.deviceAddress = instances;
  build.geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  build.geometry.geometry.instances = data;
  build.count = 1;
  return build;
}

VkAccelerationStructureBuildSizesInfoKHR sizes_of(const Device& device, Build& build) {
  build.info.pGeometries = &build.geometry;
  VkAccelerationStructureBuildSizesInfoKHR sizes{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  device.structures().get_sizes(device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR,
                                &build.info, &build.count, &sizes);
  return sizes;
}

// Bytes of the structure that the build makes. They depend on the counts only, not on the
// addresses.
std::size_t structure_size(const Device& device, Build build) {
  return sizes_of(device, build).accelerationStructureSize;
}

// Builds a level and waits until it is built.
void build_level(const Device& device, Commands& commands, Build& build,
                 VkAccelerationStructureKHR structure) {
  const VkDeviceSize alignment = device.scratch_alignment();
  const Buffer scratch(device, sizes_of(device, build).buildScratchSize + alignment,
                       Memory::addressed, "scratch");
  build.info.dstAccelerationStructure = structure;
  build.info.scratchData.deviceAddress =
      (scratch.address() + alignment - 1) / alignment * alignment;
  const VkAccelerationStructureBuildRangeInfoKHR range{build.count, 0, 0, 0};
  commands.begin();
  commands.build(build.info, range);
  commands.submit_and_wait();
}

}  // namespace

AabbAccelerationStructure::Level::Level(const Device& its_device,
                                        VkAccelerationStructureTypeKHR type, std::size_t size,
                                        const char* name)
    : device(its_device), buffer(its_device, size, Memory::addressed, name) {
  VkAccelerationStructureCreateInfoKHR info{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
  info.buffer = buffer.get();
  info.size = size;
  info.type = type;
  TRISECT_VK(device.structures().create(device.get(), &info, nullptr, &structure));
  VkAccelerationStructureDeviceAddressInfoKHR address_info{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
  address_info.accelerationStructure = structure;
  address = device.structures().get_address(device.get(), &address_info);
}

AabbAccelerationStructure::Level::~Level() {
  device.structures().destroy(device.get(), structure, nullptr);
}

AabbAccelerationStructure::AabbAccelerationStructure(const Device& device, Staging& staging,
                                                     Commands& commands,
                                                     std::span<const VkAabbPositionsKHR> boxes)
    : bottom_(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
              structure_size(device, build_of_boxes(0, boxes.size())), "boxes"),
      top_(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR,
           structure_size(device, build_of_instances(0)), "the scene of boxes") {
  // Not where they are made: a name that cannot be given must leave nothing behind.
  device.name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, bottom_.structure, "boxes");
  device.name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, top_.structure, "the scene of boxes");
  const Buffer input(device, boxes.size_bytes(), Memory::addressed, "corners of boxes");
  staging.upload(commands, std::as_bytes(boxes), input);
  Build bottom = build_of_boxes(input.address(), boxes.size());
  build_level(device, commands, bottom, bottom_.structure);

  VkAccelerationStructureInstanceKHR instance{};
  for (uint32_t k = 0; k < 3; ++k) instance.transform.matrix[k][k] = 1.0F;
  instance.mask = 0xFF;
  instance.accelerationStructureReference = bottom_.address;
  const Buffer instances(device, sizeof(instance), Memory::addressed, "instance of the boxes");
  staging.upload(commands, std::as_bytes(std::span(&instance, 1)), instances);
  Build top = build_of_instances(instances.address());
  build_level(device, commands, top, top_.structure);
}

}  // namespace trisect::gpu
