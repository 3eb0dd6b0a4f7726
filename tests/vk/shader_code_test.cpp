// What becomes of the kernels' SPIR-V on its way to the driver.
#include "vk/shader_code.h"

#include <gtest/gtest.h>

#include <spirv/unified1/GLSL.std.450.h>
#include <map>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <spirv/unified1/spirv.hpp>
#include <string>
#include <vector>

#include "app/buffers/kernels.h"
#include "app/surface/shared.h"

namespace trisect::gpu {
namespace {

using spv::Op;

// The instructions of a module, read without the code under test.
struct Module {
  explicit Module(std::span<const uint32_t> spirv) {
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> 16U) {
      instructions.push_back(spirv.subspan(at, spirv[at] >> 16U));
    }
  }

  static Op op(std::span<const uint32_t> instruction) {
    return static_cast<Op>(instruction[0] & 0xFFFFU);
  }

  [[nodiscard]] std::size_t count(Op op_code) const {
    std::size_t sum = 0;
    for (const auto& instruction : instructions) sum += op(instruction) == op_code ? 1 : 0;
    return sum;
  }

  std::vector<std::span<const uint32_t>> instructions;
};

// Names of the instructions whose results a driver may round in another way than as they are
// written: those that compute floats and have no NoContraction, and functions that Vulkan defines
// by formulas of several operations.
std::vector<std::string> inexact(std::span<const uint32_t> spirv) {
  const Module module(spirv);
  std::set<uint32_t> exact;
  std::set<uint32_t> float_types;
  for (const auto& instruction : module.instructions) {
    const Op op = Module::op(instruction);
    if (op == Op::OpTypeFloat) float_types.insert(instruction[1]);
    if (op == Op::OpTypeVector && float_types.count(instruction[2]) != 0) {
      float_types.insert(instruction[1]);
    }
    if (op == Op::OpDecorate &&
        static_cast<spv::Decoration>(instruction[2]) == spv::DecorationNoContraction) {
      exact.insert(instruction[1]);
    }
  }
  // What computes a float without a rounding: it chooses, moves or negates.
  const std::set<Op> without_rounding{
      Op::OpFNegate, Op::OpLoad, Op::OpSelect, Op::OpPhi, Op::OpFunctionCall,
      Op::OpFunctionParameter, Op::OpCompositeConstruct, Op::OpCompositeExtract,
      Op::OpCompositeInsert, Op::OpVectorShuffle, Op::OpVectorExtractDynamic, Op::OpCopyObject,
      Op::OpCopyLogical, Op::OpBitcast, Op::OpUndef, Op::OpConstant, Op::OpConstantComposite,
      Op::OpConstantNull, Op::OpFunction, Op::OpTypeFloat, Op::OpTypeVector,
      // Of integers, of which those that kernels convert are exact or rounded once.
      Op::OpConvertUToF, Op::OpConvertSToF,
      // Of the values of a subgroup: a choice.
      Op::OpGroupNonUniformBroadcast, Op::OpGroupNonUniformFMin, Op::OpGroupNonUniformFMax,
      Op::OpRayQueryGetIntersectionTKHR};
  // Functions with one rounding at most, or with an error that shaders/ states where it takes them.
  const std::set<uint32_t> functions{
      GLSLstd450FAbs,   GLSLstd450FMin,  GLSLstd450FMax,  GLSLstd450NMin,  GLSLstd450NMax,
      GLSLstd450FClamp, GLSLstd450FSign, GLSLstd450Floor, GLSLstd450Fract, GLSLstd450Sqrt};
  std::vector<std::string> names;
  for (const auto& instruction : module.instructions) {
    const Op op = Module::op(instruction);
    if (instruction.size() < 3 || float_types.count(instruction[1]) == 0) continue;
    if (without_rounding.count(op) != 0 || op == Op::OpDecorate || op == Op::OpName) continue;
    if (op == Op::OpExtInst) {
      if (functions.count(instruction[4]) == 0) {
        names.push_back("function " + std::to_string(instruction[4]));
      }
    } else if (exact.count(instruction[2]) == 0) {
      names.push_back("instruction " + std::to_string(static_cast<uint32_t>(op)));
    }
  }
  return names;
}

// What SPIRV-Tools says of a module; empty if it is valid.
std::string faults(std::span<const uint32_t> spirv, bool ray_queries) {
  spvtools::SpirvTools tools(ray_queries ? SPV_ENV_VULKAN_1_1_SPIRV_1_4 : SPV_ENV_VULKAN_1_1);
  std::string text;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { text += message; });
  const bool valid = tools.Validate(spirv.data(), spirv.size());
  return valid ? std::string() : text + " (not valid)";
}

std::vector<FloatControls> all_controls() {
  std::vector<FloatControls> all;
  for (unsigned bits = 0; bits < 8; ++bits) {
    all.push_back({(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0});
  }
  return all;
}

// Whether a kernel's floats are to be exact. What a window shows has 8 bits a component; and some
// kernels measure what a driver makes of all operations.
bool is_exact(const KernelSource& kernel) {
  return kernel.interface != Interface::screen && kernel.interface != Interface::floats;
}

TEST(ExactFloats, LeavesNoOperationOfAKernelToTheDriver) {
  for (const KernelSource& kernel : kernel_sources()) {
    if (!is_exact(kernel)) continue;
    EXPECT_EQ(inexact(with_exact_floats(kernel.spirv)), std::vector<std::string>{}) << kernel.name;
  }
  // The test sees what is inexact.
  EXPECT_GT(inexact(spirv_of("trace_list")).size(), 100U);
}

TEST(ExactFloats, DecoratesEachOperationOnce) {
  const ShaderCode once = with_exact_floats(spirv_of("trace_list"));
  EXPECT_EQ(with_exact_floats(once), once);
}

TEST(FloatControls, AreDeclaredAsFarAsTheDeviceHasThem) {
  for (const KernelSource& kernel : kernel_sources()) {
    const ShaderCode exact = with_exact_floats(kernel.spirv);
    EXPECT_EQ(faults(with_float_controls(exact, {true, true, true}), kernel.ray_queries), "")
        << kernel.name;
    for (const FloatControls& controls : all_controls()) {
      const ShaderCode code = with_float_controls(exact, controls);
      std::set<spv::ExecutionMode> modes;
      std::set<spv::Capability> capabilities;
      for (const auto& instruction : Module(code).instructions) {
        if (Module::op(instruction) == Op::OpExecutionMode) {
          modes.insert(static_cast<spv::ExecutionMode>(instruction[2]));
        }
        if (Module::op(instruction) == Op::OpCapability) {
          capabilities.insert(static_cast<spv::Capability>(instruction[1]));
        }
      }
      EXPECT_EQ(modes.count(spv::ExecutionModeRoundingModeRTE),
                controls.rounds_to_nearest_even ? 1U : 0U);
      EXPECT_EQ(modes.count(spv::ExecutionModeSignedZeroInfNanPreserve),
                controls.preserves_signed_zero_inf_nan ? 1U : 0U);
      EXPECT_EQ(modes.count(spv::ExecutionModeDenormPreserve),
                controls.preserves_denormals ? 1U : 0U);
      EXPECT_EQ(capabilities.count(spv::CapabilityRoundingModeRTE),
                controls.rounds_to_nearest_even ? 1U : 0U);
    }
  }
}

TEST(FloatControls, ChangeNothingWhereTheDeviceHasNone) {
  const std::span<const uint32_t> spirv = spirv_of("trace_list");
  EXPECT_EQ(with_float_controls(spirv, {}), ShaderCode(spirv.begin(), spirv.end()));
}

TEST(ReconvergingSubgroups, AreAskedForOnce) {
  const ShaderCode code = with_reconverging_subgroups(spirv_of("trace_tiles"));
  EXPECT_EQ(faults(code, false), "");
  int modes = 0;
  for (const auto& instruction : Module(code).instructions) {
    const bool is_mode = Module::op(instruction) == Op::OpExecutionMode;
    modes += is_mode && static_cast<spv::ExecutionMode>(instruction[2]) ==
                            spv::ExecutionModeSubgroupUniformControlFlowKHR;
  }
  EXPECT_EQ(modes, 1);
}

// What rounds must round once and where it is written: its exactness outlives the passes.
TEST(Specialized, LeavesNoConstantToTheDriverAndKeepsFloatsExact) {
  const std::vector<Specialization> constants{
      {CONSTANT_SURFACE, SURFACE_SPHERE}, {CONSTANT_SOLVER, SOLVER_ROBUST}, {CONSTANT_AOVS, 1U}};
  for (const KernelSource& kernel : kernel_sources()) {
    SCOPED_TRACE(kernel.name);
    const ShaderCode code =
        specialized(is_exact(kernel) ? with_exact_floats(kernel.spirv)
                                     : ShaderCode(kernel.spirv.begin(), kernel.spirv.end()),
                    constants);
    EXPECT_EQ(faults(code, kernel.ray_queries), "");
    const Module module(code);
    for (const Op op : {Op::OpSpecConstant, Op::OpSpecConstantTrue, Op::OpSpecConstantFalse,
                        Op::OpSpecConstantOp, Op::OpSpecConstantComposite}) {
      EXPECT_EQ(module.count(op), 0U);
    }
    if (!is_exact(kernel)) continue;
    EXPECT_EQ(inexact(code), std::vector<std::string>{});
  }
}

std::size_t operations(const ShaderCode& code) {
  return Module(code).instructions.size();
}

// A surface reaches its branches as a member of a struct, whether patches may be nonsmooth as an
// argument.
TEST(Specialized, RulesOutWhatTheConstantsDo) {
  const std::span<const uint32_t> spirv = spirv_of("trace_list");
  const auto with = [&](uint32_t surface, uint32_t solver, uint32_t nonsmooth) {
    return operations(specialized(
        spirv,
        {{CONSTANT_SURFACE, surface}, {CONSTANT_SOLVER, solver}, {CONSTANT_NONSMOOTH, nonsmooth}}));
  };
  const std::size_t all = with(SURFACE_SPHERE, SOLVER_ROBUST, 1);
  EXPECT_LT(with(SURFACE_SPHERE, SOLVER_ROBUST, 0), all);
  EXPECT_LT(with(SURFACE_PHONG, SOLVER_ROBUST, 0), with(SURFACE_SPHERE, SOLVER_ROBUST, 0));
  EXPECT_LT(with(SURFACE_SPHERE, SOLVER_BISECT, 0), with(SURFACE_SPHERE, SOLVER_ROBUST, 0));
}

// A driver that gives each local variable a place on the stack finds few: SwiftShader crashes at
// too many.
TEST(Specialized, LeavesFewVariables) {
  const ShaderCode code = specialized(
      spirv_of("trace_list"),
      {{CONSTANT_SURFACE, SURFACE_SPHERE}, {CONSTANT_AOVS, 1U}, {CONSTANT_NONSMOOTH, 1U}});
  const Module module(code);
  EXPECT_EQ(module.count(Op::OpFunction), 1U);
  int locals = 0;
  for (const auto& instruction : module.instructions) {
    locals += Module::op(instruction) == Op::OpVariable &&
              static_cast<spv::StorageClass>(instruction[3]) == spv::StorageClassFunction;
  }
  // Of thousands. What stays are arrays with an index that is not constant.
  EXPECT_LT(locals, 100);
}

TEST(ShaderCode, OfACutOffModuleIsRefused) {
  const std::span<const uint32_t> spirv = spirv_of("trace_list");
  // The header's five words, and one of the two of the first instruction, a capability.
  EXPECT_THROW(with_exact_floats(spirv.first(6)), std::logic_error);
}

TEST(KernelFacts, AreThoseOfTheSource) {
  EXPECT_TRUE(facts_of(spirv_of("trace_tiles")).uses_subgroups);
  EXPECT_FALSE(facts_of(spirv_of("trace_list")).uses_subgroups);
  EXPECT_EQ(facts_of(spirv_of("trace_tiles")).workgroup_x, TILE_SIZE * TILE_SIZE);
}

}  // namespace
}  // namespace trisect::gpu
