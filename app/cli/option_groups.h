// The subjects that help and manual group the options by, the same ones for every command.
#pragma once

#include <array>

namespace trisect::option_group {

inline constexpr const char* kModel = "Model";
inline constexpr const char* kInput = "Images";  // that are read
inline constexpr const char* kRays = "Rays";     // and hits, that are read
inline constexpr const char* kSurface = "Surface";
inline constexpr const char* kCamera = "Camera";
inline constexpr const char* kPicture = "Picture";
inline constexpr const char* kSequence = "Frames and parts";
inline constexpr const char* kTracing = "How rays are traced";
inline constexpr const char* kMeasuring = "What is measured";
inline constexpr const char* kWindow = "Window";
inline constexpr const char* kOutput = "Output";
inline constexpr const char* kHelp = "Help";

// In the order in which help shows them.
inline constexpr std::array kAll{kModel,    kInput,   kRays,      kSurface, kCamera, kPicture,
                                 kSequence, kTracing, kMeasuring, kWindow,  kOutput, kHelp};

}  // namespace trisect::option_group
