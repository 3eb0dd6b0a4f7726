#include "vk/shader_code.h"

#include <algorithm>
#include <array>
#include <spirv-tools/optimizer.hpp>
#include <spirv/unified1/spirv.hpp>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace trisect::gpu {
namespace {

using spv::Op;

constexpr std::size_t kHeaderWords = 5;
constexpr std::size_t kBoundWord = 3;

// An instruction of a module: its words, the first of which is the opcode with the number of words.
using Instruction = std::span<const uint32_t>;

Op opcode(Instruction instruction) {
  return static_cast<Op>(instruction[0] & 0xFFFFU);
}

// Calls visit(instruction) for each instruction, in order.
template <typename Visit>
void for_each_instruction(std::span<const uint32_t> spirv, const Visit& visit) {
  for (std::size_t at = kHeaderWords; at < spirv.size();) {
    const std::size_t count = spirv[at] >> 16U;
    if (count == 0 || at + count > spirv.size()) {
      throw std::logic_error("a SPIR-V module is cut off");
    }
    visit(spirv.subspan(at, count));
    at += count;
  }
}

// The parts of a module, in the order that the specification gives them (2.4, logical layout of a
// module), as far as they matter here.
enum class Section { capabilities, extensions, declarations, execution_modes, annotations, rest };

Section section_of(Op op) {
  switch (op) {
    case Op::OpCapability:
      return Section::capabilities;
    case Op::OpExtension:
      return Section::extensions;
    case Op::OpExtInstImport:
    case Op::OpMemoryModel:
    case Op::OpEntryPoint:
      return Section::declarations;
    case Op::OpExecutionMode:
    case Op::OpExecutionModeId:
      return Section::execution_modes;
    case Op::OpString:
    case Op::OpSource:
    case Op::OpSourceContinued:
    case Op::OpSourceExtension:
    case Op::OpName:
    case Op::OpMemberName:
    case Op::OpModuleProcessed:
    case Op::OpDecorate:
    case Op::OpMemberDecorate:
    case Op::OpDecorationGroup:
    case Op::OpGroupDecorate:
    case Op::OpGroupMemberDecorate:
    case Op::OpDecorateId:
    case Op::OpDecorateString:
    case Op::OpMemberDecorateString:
      return Section::annotations;
    default:
      return Section::rest;
  }
}

// Instructions to be added at the end of a section.
using Additions = std::array<ShaderCode, 6>;

void add(Additions& additions, Section section, Op op, const ShaderCode& operands) {
  ShaderCode& words = additions[static_cast<std::size_t>(section)];
  words.push_back(static_cast<uint32_t>(op) | static_cast<uint32_t>(operands.size() + 1) << 16U);
  words.insert(words.end(), operands.begin(), operands.end());
}

ShaderCode with_additions(std::span<const uint32_t> spirv, const Additions& additions) {
  ShaderCode out(spirv.begin(), spirv.begin() + kHeaderWords);
  std::size_t section = 0;
  const auto leave_sections_before = [&](std::size_t end) {
    for (; section < end; ++section) {
      out.insert(out.end(), additions[section].begin(), additions[section].end());
    }
  };
  for_each_instruction(spirv, [&](Instruction instruction) {
    leave_sections_before(static_cast<std::size_t>(section_of(opcode(instruction))));
    out.insert(out.end(), instruction.begin(), instruction.end());
  });
  return out;
}

// Whether it rounds a float, so that a driver may do it another way without NoContraction. Negation
// does not round.
bool rounds_floats(Op op) {
  switch (op) {
    case Op::OpFAdd:
    case Op::OpFSub:
    case Op::OpFMul:
    case Op::OpFDiv:
    case Op::OpFRem:
    case Op::OpFMod:
    case Op::OpVectorTimesScalar:
    case Op::OpMatrixTimesScalar:
    case Op::OpVectorTimesMatrix:
    case Op::OpMatrixTimesVector:
    case Op::OpMatrixTimesMatrix:
    case Op::OpOuterProduct:
    case Op::OpDot:
      return true;
    default:
      return false;
  }
}

void add_extension(Additions& additions, const std::string& text) {
  // The characters with the zero that ends them.
  ShaderCode words(text.size() / 4 + 1, 0);
  for (std::size_t i = 0; i < text.size(); ++i) {
    words[i / 4] |= static_cast<uint32_t>(static_cast<unsigned char>(text[i])) << (8U * (i % 4));
  }
  add(additions, Section::extensions, Op::OpExtension, words);
}

// Adds an execution mode with these operands to each entry point.
void add_mode(Additions& additions, std::span<const uint32_t> spirv, spv::ExecutionMode mode,
              const ShaderCode& operands) {
  for_each_instruction(spirv, [&](Instruction instruction) {
    if (opcode(instruction) != Op::OpEntryPoint) return;
    ShaderCode all{instruction[2], static_cast<uint32_t>(mode)};
    all.insert(all.end(), operands.begin(), operands.end());
    add(additions, Section::execution_modes, Op::OpExecutionMode, all);
  });
}

}  // namespace

KernelFacts facts_of(std::span<const uint32_t> spirv) {
  KernelFacts facts;
  for_each_instruction(spirv, [&](Instruction instruction) {
    if (opcode(instruction) == Op::OpCapability &&
        static_cast<spv::Capability>(instruction[1]) == spv::CapabilityGroupNonUniform) {
      facts.uses_subgroups = true;
    }
    if (opcode(instruction) == Op::OpExecutionMode &&
        static_cast<spv::ExecutionMode>(instruction[2]) == spv::ExecutionModeLocalSize) {
      facts.workgroup_x = instruction[3];
    }
  });
  return facts;
}

ShaderCode with_exact_floats(std::span<const uint32_t> spirv) {
  constexpr auto exact = static_cast<uint32_t>(spv::DecorationNoContraction);
  std::vector<bool> decorated(spirv[kBoundWord], false);
  Additions additions;
  for_each_instruction(spirv, [&](Instruction instruction) {
    const Op op = opcode(instruction);
    if (op == Op::OpDecorate && instruction[2] == exact) decorated[instruction[1]] = true;
    if (rounds_floats(op) && !decorated[instruction[2]]) {
      add(additions, Section::annotations, Op::OpDecorate, {instruction[2], exact});
    }
  });
  return with_additions(spirv, additions);
}

ShaderCode with_float_controls(std::span<const uint32_t> spirv, const FloatControls& controls) {
  struct Mode {
    bool has;
    spv::Capability capability;
    spv::ExecutionMode mode;
  };
  const std::array modes{
      Mode{controls.rounds_to_nearest_even, spv::CapabilityRoundingModeRTE,
           spv::ExecutionModeRoundingModeRTE},
      Mode{controls.preserves_signed_zero_inf_nan, spv::CapabilitySignedZeroInfNanPreserve,
           spv::ExecutionModeSignedZeroInfNanPreserve},
      Mode{controls.preserves_denormals, spv::CapabilityDenormPreserve,
           spv::ExecutionModeDenormPreserve}};
  if (std::none_of(modes.begin(), modes.end(), [](const Mode& mode) { return mode.has; })) {
    return {spirv.begin(), spirv.end()};
  }
  Additions additions;
  add_extension(additions, "SPV_KHR_float_controls");
  for (const Mode& mode : modes) {
    if (!mode.has) continue;
    add(additions, Section::capabilities, Op::OpCapability,
        {static_cast<uint32_t>(mode.capability)});
    add_mode(additions, spirv, mode.mode, {32U});
  }
  return with_additions(spirv, additions);
}

ShaderCode with_reconverging_subgroups(std::span<const uint32_t> spirv) {
  Additions additions;
  add_extension(additions, "SPV_KHR_subgroup_uniform_control_flow");
  add_mode(additions, spirv, spv::ExecutionModeSubgroupUniformControlFlowKHR, {});
  return with_additions(spirv, additions);
}

ShaderCode specialized(std::span<const uint32_t> spirv,
                       const std::vector<Specialization>& constants) {
  std::unordered_map<uint32_t, std::vector<uint32_t>> values;
  for (const Specialization& constant : constants) {
    values[constant.constant_id] = {constant.value};
  }
  std::string messages;
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1_SPIRV_1_4);
  optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                   const char* message) { messages += message; });
  // Many constants reach a branch as a function's argument or within a struct. Only where functions
  // are inlined and structs are taken apart does the branch go.
  constexpr uint32_t of_any_size = 0;
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateMergeReturnPass())
      .RegisterPass(spvtools::CreateInlineExhaustivePass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateScalarReplacementPass(of_any_size))
      .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
      .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
      .RegisterPass(spvtools::CreateSSARewritePass())
      .RegisterPass(spvtools::CreateCCPPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass());
  spvtools::OptimizerOptions options;
  // The build has validated the module.
  options.set_run_validator(false);
  ShaderCode code;
  if (!optimizer.Run(spirv.data(), spirv.size(), &code, options)) {
    throw std::runtime_error("SPIRV-Tools could not specialise a shader: " + messages);
  }
  return code;
}

}  // namespace trisect::gpu
