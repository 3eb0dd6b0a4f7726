#include "app/view/kernel_compiler.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/base/error.h"
#include "app/buffers/kernels.h"

namespace trisect::view {
namespace {

constexpr int kDefaultVersion = 100;  // #version of a source without one
constexpr int kVulkanDialect = 100;   // the value of the macro VULKAN (GL_KHR_vulkan_glsl)
constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

// glslang's global state, initialised once per process.
class Glslang {
 public:
  Glslang() {
    if (!glslang::InitializeProcess()) throw std::runtime_error("glslang could not be started.");
  }
  ~Glslang() { glslang::FinalizeProcess(); }
  Glslang(const Glslang&) = delete;
  Glslang& operator=(const Glslang&) = delete;
};

std::string text_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);  // fails for a folder
  std::ifstream file(path, std::ios::binary);
  if (!error && !file) error.assign(errno, std::generic_category());
  if (error) {
    throw InputError(fmt::format("{}: cannot be read: {}.", path.string(), error.message()));
  }
  std::string text(size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

// Resolves #include by the files of one folder. Each is read once, so that all kernels are compiled
// from the same text even if a file is saved meanwhile.
class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(const std::filesystem::path& folder) : folder_(folder) {}

  // Null is a failure, of which glslang reports the line; exceptions must not cross glslang. After
  // a failure all further includes fail: a file that includes itself twice would otherwise double
  // the work at every level.
  IncludeResult* includeLocal(const char* name, const char* /*includer*/,
                              std::size_t depth) override {
    constexpr std::size_t deepest = 32;  // deeper only if files include each other in a circle
    failed_ = failed_ || depth > deepest;
    if (failed_) return nullptr;
    try {
      return &files_.try_emplace(name, folder_ / name).first->second.result;
    } catch (const std::exception&) {
      failed_ = true;
      return nullptr;
    }
  }
  void releaseInclude(IncludeResult* /*result*/) override {}

 private:
  struct File {
    explicit File(const std::filesystem::path& path)
        : text(text_of(path)), result(path.string(), text.data(), text.size(), nullptr) {}
    std::string text;
    IncludeResult result;
  };

  std::filesystem::path folder_;
  std::map<std::string, File> files_;
  bool failed_ = false;
};

// The first error of glslang's log, which has lines like "ERROR: file:line: 'token' : what is
// wrong", as a sentence. Errors of the linker name no file: they get that of the kernel.
InputError first_error(std::string_view log, const std::filesystem::path& kernel) {
  constexpr std::string_view mark = "ERROR: ";
  while (!log.empty() && !log.starts_with(mark)) {
    log.remove_prefix(std::min(log.find('\n'), log.size() - 1) + 1);
  }
  if (log.empty()) return InputError(kernel.string() + ": does not compile.");
  log.remove_prefix(mark.size());
  std::string what(log.substr(0, log.find('\n')));
  what.erase(what.find_last_not_of(" .") + 1);
  constexpr std::string_view no_token = "'' :  ";
  if (const auto at = what.find(no_token); at != std::string::npos) what.erase(at, no_token.size());
  const bool names_file = what.starts_with((kernel.parent_path() / "").string());
  return InputError(names_file ? what + "." : fmt::format("{}: {}.", kernel.string(), what));
}

std::vector<uint32_t> compile(const KernelSource& source, const std::filesystem::path& folder,
                              Includer& includer) {
  const std::filesystem::path path = folder / source.file;
  const std::string name = path.string();
  const std::string text = text_of(path);
  const char* const texts = text.c_str();
  const auto length = static_cast<int>(text.size());
  const char* const names = name.c_str();

  glslang::TShader shader(EShLangCompute);
  shader.setStringsWithLengthsAndNames(&texts, &length, &names, 1);
  shader.setPreamble(source.preamble);
  shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan,
                     kVulkanDialect);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv,
                      source.ray_queries ? glslang::EShTargetSpv_1_4 : glslang::EShTargetSpv_1_3);
  if (!shader.parse(GetDefaultResources(), kDefaultVersion, false, kMessages, includer)) {
    throw first_error(shader.getInfoLog(), path);
  }
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) throw first_error(program.getInfoLog(), path);
  std::vector<uint32_t> spirv;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), spirv);
  return spirv;
}

}  // namespace

KernelCode compile_kernels(const std::filesystem::path& folder) {
  static const Glslang glslang;
  Includer includer(folder);
  KernelCode code;
  for (const KernelSource& source : kernel_sources()) {
    if (source.interface != Interface::frame) continue;
    code.emplace(source.name, compile(source, folder, includer));
  }
  return code;
}

}  // namespace trisect::view
